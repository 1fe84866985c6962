"""What has been driven so far: length and contacts."""

from __future__ import annotations

import math

from semnav_env.features.frames import Pose
from semnav_env.simulator.sensed import Motion


class Journey:
    """Adds up the motion of an episode.

    Attributes:
        path_length: metres.
        collisions: contacts begun.
    """

    def __init__(self, start: Pose) -> None:
        self.path_length = 0.0
        self.collisions = 0
        self._in_contact = False
        self._last = start

    def add(self, motion: Motion) -> None:
        """Note the motion of one control period."""
        pose, last = motion.pose, self._last
        self.path_length += math.hypot(pose[0] - last[0], pose[1] - last[1])
        self.collisions += motion.in_contact and not self._in_contact
        self._in_contact, self._last = motion.in_contact, pose
