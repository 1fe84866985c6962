"""Plans paths that pass no barrier: points across doorways that do not lead to the target."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from semnav_agents.planning.doorway import room_behind
from semnav_agents.planning.known_obstacles import NO_POINTS
from semnav_agents.planning.path import PlannedPath
from semnav_agents.planning.planner import DriveTarget, PlannerSettings, is_free, plan
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Pose

GATE_DETOUR = 6.0
"""Length by which a path around barriers to a gate may exceed what `detour` allows, metres: the
robot may have to turn in the hallway first. A longer one leads through what has not been seen."""


@dataclass
class BarrierPlanner:
    """Plans paths of one robot among obstacles and barriers.

    Attributes:
        robot: the body.
        detour: largest length of a path around barriers, as a multiple of the direct path.
        patience: steps to wait for such a path, where the target has no gate.
        retry_after: steps between two plans where there is none.
        heeds_barriers: whether the last path must stay clear of barriers.
    """

    robot: RobotSpec
    detour: float
    patience: int
    retry_after: int
    heeds_barriers: bool = field(default=False, init=False)
    _barred: int = field(default=0, init=False)

    def reset(self) -> None:
        """Begin anew."""
        self.heeds_barriers, self._barred = False, 0

    def path(
        self,
        points: FloatArray,
        start: Pose,
        target: DriveTarget,
        barriers: FloatArray,
        settings: PlannerSettings,
        insists: bool = False,
    ) -> PlannedPath | None:
        """A path through the target's gate, if it has one, and through no barrier.

        The first of these is taken that leads right: among the points alone; around barriers and
        the walls beside the gate; and, where the first misses the gate, around those walls alone,
        for a barrier may be no door. A way around barriers must be no longer than `detour` allows,
        to a gate by `GATE_DETOUR` longer; without a gate the robot waits for such a way before it
        takes the first.

        Args:
            points: obstacles, metres, shape (n, 2).
            start: the centre's pose in their frame.
            target: where to go.
            barriers: points, metres, shape (m, 2).
            settings: the planner's.
            insists: whether no way through a barrier is taken; then only a part of one around them
                may be, and the answer is None where that is too long or misses the gate.
        """

        def among(*solid: FloatArray) -> PlannedPath:
            return plan(np.vstack((points, *solid)), start, target, self.robot, settings)

        path = plan(points, start, target, self.robot, settings)
        beside = NO_POINTS if target.gate is None else room_behind(target.gate, target.pose)
        self.heeds_barriers = False
        if self._heads_right(path, target, np.vstack((barriers, beside))):
            self._barred = 0
            return path
        longest = self.detour * path.length + (GATE_DETOUR if target.gate is not None else 0.0)
        around = among(barriers, beside)
        if self._leads(around, target, barriers) and around.length < longest:
            self.heeds_barriers = True
            return around
        if insists and not is_free(barriers, path.poses, self.robot):
            self.heeds_barriers = True
            return None if around.complete else around
        if len(barriers) and not self._heads_right(path, target, NO_POINTS):
            around = among(beside)
            if self._leads(around, target, NO_POINTS):
                return around
        if target.gate is None and not around.complete and self._barred < self.patience:
            self._barred += self.retry_after
            self.heeds_barriers = True
            return around
        return path

    def _leads(self, path: PlannedPath, target: DriveTarget, barriers: FloatArray) -> bool:
        """Whether a path leads to the target through its gate and through no barrier."""
        return path.complete and self._heads_right(path, target, barriers)

    def _heads_right(self, path: PlannedPath, target: DriveTarget, barriers: FloatArray) -> bool:
        """Whether a path crosses no barrier, and the target's gate if it has one."""
        if target.gate is not None and not path.crosses(*target.gate):
            return False
        return is_free(barriers, path.poses, self.robot)
