"""Drives a robot out through a door of a floor plan that it knows: `exit_via_door` of Mes 2021."""

from __future__ import annotations

import numpy as np

from semnav_agents.pilot import Pilot
from semnav_agents.planning.obstacles import points_of_segments
from semnav_env.approach import DoorSide
from semnav_env.approach.in_plan import side_towards
from semnav_env.approach.poses import is_behind
from semnav_env.mind.grounding import GoalKind
from semnav_env.mind.observations import SeenGoal
from semnav_env.robots import RobotSpec
from semnav_env.robots.actions import Actions
from semnav_env.world.maps import FloorPlan
from semnav_features.frames import Pose, Twist, points_to_local, relative, to_local
from semnav_features.scene import ends_of

GOAL_DISTANCE = 1.0
"""Distance behind the door of the goal's pose, metres."""


class DoorExit:
    """Leads a robot that knows plan and pose from any pose to the far side of a door.

    Args:
        plan: with everything solid.
        side: the door and the side that is left.
        robot: the body.
        alternatives: whether to try other poses where no path leads straight through the door.
    """

    def __init__(
        self, plan: FloorPlan, side: DoorSide, robot: RobotSpec, alternatives: bool = True
    ) -> None:
        self.side, self.robot = side, robot
        self._pilot = Pilot(robot, alternatives)
        self._actions = Actions(robot)
        self._points = points_of_segments(plan.segments)
        self._doors = ends_of(plan.scene.doors).reshape(-1, 2)
        [(x, y)] = side.before(np.array([(-GOAL_DISTANCE, 0.0)])).tolist()
        self._goal: Pose = (x, y, side.through)

    @staticmethod
    def named(plan: FloorPlan, door: str, start: Pose, robot: RobotSpec) -> DoorExit:
        """Make an exit through a named door, to the side away from the robot's start.

        Raises:
            KeyError: the plan has no such door.
        """
        return DoorExit(plan, side_towards(plan, plan.door(door), start[:2]), robot)

    def twist(self, pose: Pose, velocity: Twist) -> Twist:
        """The velocity for the next control period.

        Args:
            pose: of the robot's centre, world frame.
            velocity: of the robot's centre.
        """
        doors = points_to_local(pose, self._doors).reshape(-1, 4)
        jambs = to_local(pose, self.side.right), to_local(pose, self.side.left)
        goal = SeenGoal(GoalKind.PASS, relative(pose, self._goal), jambs)
        action = self._pilot.act(self._points, doors, goal, pose, velocity)
        return self._actions.twist(action)

    def is_out(self, pose: Pose) -> bool:
        """Whether the whole body lies behind the line of the door."""
        return is_behind(self.side, pose, self.robot)
