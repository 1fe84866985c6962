"""Odometry without wheels: each scan matched with a keyframe."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_env.features.frames import Pose, compose, relative
from semnav_env.features.mapping.matching import (
    DEFAULT_MATCH_SETTINGS,
    Match,
    MatchError,
    Surface,
    match_surfaces,
    surface_of,
)
from semnav_env.features.mapping.settings import MatchSettings
from semnav_env.features.scan import Scan


@dataclass(frozen=True)
class KeyframeRule:
    """When a scan becomes the next keyframe.

    Attributes:
        distance: from the last keyframe, metres.
        angle: turned since, radians.
        inliers: a smaller share of the scan's points lies on the keyframe.
        lost: so many scans in a row could not be matched; one that can't be is no keyframe.
    """

    distance: float = 0.5
    angle: float = math.radians(20.0)
    inliers: float = 0.6
    lost: int = 3


class ScanOdometry:
    """Where the lidar is in the frame of its first scan, from scans alone.

    Every scan is matched with the last keyframe rather than with its predecessor, so that errors
    add up only from keyframe to keyframe. The first guess is that it moves on as it did.

    Args:
        settings: of the matches.
        rule: when a scan becomes a keyframe.

    Attributes:
        pose: of the last scan in the frame of the first; (0, 0, 0) before any.
        match: of the last scan with its keyframe; None where there is none.
        keyframes: how many there were.
        lost: how many scans could not be matched; they are taken to have moved as guessed.
    """

    def __init__(
        self,
        settings: MatchSettings = DEFAULT_MATCH_SETTINGS,
        rule: KeyframeRule = KeyframeRule(),
    ) -> None:
        self.pose: Pose = (0.0, 0.0, 0.0)
        self.match: Match | None = None
        self.keyframes = 0
        self.lost = 0
        self._settings = settings
        self._rule = rule
        self._keyframe: Surface | None = None
        self._keyframe_pose: Pose = (0.0, 0.0, 0.0)
        self._moved: Pose = (0.0, 0.0, 0.0)
        self._lost_in_a_row = 0

    def update(self, scan: Scan, moved: Pose | None = None) -> Pose:
        """Take the next scan, and say where it was taken.

        Args:
            scan: the scan.
            moved: a guess of its pose in the frame of the scan before, as wheels would give it.

        Returns:
            Its pose in the frame of the first scan.
        """
        surface = surface_of(scan, self._settings)
        if self._keyframe is None:
            self._keep(surface, self.pose)
            return self.pose
        guess = compose(self.pose, self._moved if moved is None else moved)
        found = self._found(self._keyframe, surface, guess)
        self._lost_in_a_row = 0 if found else self._lost_in_a_row + 1
        self.lost += found is None
        self._moved = relative(self.pose, found or guess)
        self.pose = found or guess
        if self._leaves_keyframe():
            self._keep(surface, self.pose)
        return self.pose

    def _found(self, keyframe: Surface, surface: Surface, guess: Pose) -> Pose | None:
        start = relative(self._keyframe_pose, guess)
        try:
            self.match = match_surfaces(keyframe, surface, start, self._settings)
        except MatchError:
            self.match = None
            return None
        return compose(self._keyframe_pose, self.match.pose)

    def _leaves_keyframe(self) -> bool:
        if self.match is None:
            return self._lost_in_a_row >= self._rule.lost
        x, y, turn = self.match.pose
        return (
            math.hypot(x, y) > self._rule.distance
            or abs(turn) > self._rule.angle
            or self.match.inliers < self._rule.inliers
        )

    def _keep(self, surface: Surface, pose: Pose) -> None:
        self._keyframe, self._keyframe_pose = surface, pose
        self.keyframes += 1
        self._lost_in_a_row = 0
