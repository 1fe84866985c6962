"""Walls that a robot bumped into unseen: glass, and walls outside the field of view."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from semnav_env.mind.belief.bump_kernels import (
    BUMP_ROOM,
    Bumps,
    Ends,
    along,
    forget_passed,
    note_contacts,
    seen_from,
)
from semnav_env.mind.belief.bump_limits import LIMITS
from semnav_features.frames import MOST_CONTACTS, Contact, FloatArray, Pose
from semnav_features.lidar_spec import LidarSpec
from semnav_features.scene import Door, PlainWalls, Scene, ends_of


class BumpMap:
    """Pieces of walls that the robot bumped into, in the odom frame.

    A contact makes a piece where the lidar sees through it, or where no beam points. A piece is
    forgotten when the robot's centre passes through it, which shows that it was an error.

    Args:
        spec: the lidar.
        mount: its pose in the robot frame.
    """

    def __init__(self, spec: LidarSpec, mount: Pose) -> None:
        self._spec, self._mount = spec, mount
        self._ends, self._used = np.zeros((BUMP_ROOM, 4)), np.zeros(1, np.int64)

    def __len__(self) -> int:
        return int(self._used[0])

    @property
    def ends(self) -> FloatArray:
        """X and y of the ends of the pieces, metres, odometry frame, shape (n, 4)."""
        return self._ends[: len(self)].copy()

    @property
    def arrays(self) -> Bumps:
        """The pieces in the form that compiled code takes and changes."""
        return self._ends, self._used

    def clear(self) -> None:
        """Forget everything."""
        self._used[0] = 0

    def copy(self) -> BumpMap:
        """A copy of the present pieces, unchanged by later contacts."""
        copy = BumpMap(self._spec, self._mount)
        copy._ends[:], copy._used[:] = self._ends, self._used
        return copy

    def note(self, contacts: Sequence[Contact], ranges: FloatArray, pose: Pose) -> bool:
        """Add the contacts of one step; returns whether a piece was added or changed.

        Args:
            contacts: of the robot, robot frame; the first `MOST_CONTACTS` count.
            ranges: of the scan from the same place, metres.
            pose: of the robot, odometry frame.
        """
        felt = np.array(contacts[:MOST_CONTACTS], np.float64).reshape(-1, 3)
        return bool(note_contacts(self.arrays, felt, ranges, self._spec.sensor, self._mount, pose))

    def pass_on(self, before: Pose, after: Pose) -> None:
        """Forget pieces that the robot's centre crosses between two poses, odom frame."""
        forget_passed(self.arrays, before, after)

    def join(self, scene: Scene) -> Scene:
        """Return a scene of the odom frame with these walls, without the doors that they block."""
        if not len(self):
            return scene
        pieces = [(x1, y1, x2, y2) for x1, y1, x2, y2 in self.ends.tolist()]
        doors = [d for d in scene.doors if not any(_bars(piece, d) for piece in pieces)]
        return Scene(PlainWalls(np.vstack((ends_of(scene.walls), self.ends))), tuple(doors))


def _bars(piece: Ends, door: Door) -> bool:
    """Whether a piece lies in the opening of a door."""
    frame, width = along((*door.start, *door.end))
    (first, offset), (last, last_offset) = seen_from(frame, piece)
    level = max(abs(offset), abs(last_offset)) < 2.0 * LIMITS.line_offset
    inside = LIMITS.opening_overlap
    return level and first < width - inside and last > inside
