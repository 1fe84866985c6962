"""The oracle as a function of the environment's state, to label the states of a learner."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semnav_agents.pilot import Pilot
from semnav_agents.planning.obstacles import points_of_segments
from semnav_env.env import SemNavEnv
from semnav_env.mind.grounding.goal import door_of
from semnav_env.mind.observations import SeenGoal
from semnav_env.world.maps import FloorPlan
from semnav_features.frames import FloatArray, points_to_local, relative, to_local
from semnav_features.scene import ends_of

MOST_REFUSALS, STANDING_SPEED = 6, 0.05
"""The driver refuses a steering near an obstacle a few times before it lets it through; it is asked
as often where the robot stands, m/s and rad/s."""


class Expert:
    """Gives the action of the oracle for the present state of an environment.

        action = Expert().label(env.unwrapped)

    The expert does not drive and keeps no state. It plans a new path from the robot's pose and
    velocity to the true goal of the active clause, around everything solid in the floor plan.
    Therefore it can label the states of any driver, as DAgger requires (Ross, Gordon and Bagnell
    2011), with any `observation=`. The oracle follows one path: where this path is still the best,
    the expert's actions are those of the oracle, and elsewhere they are similar.
    """

    def __init__(self) -> None:
        self._plan: FloorPlan | None = None
        self._points: FloatArray
        self._doors: FloatArray

    def label(self, env: SemNavEnv) -> NDArray[np.float32]:
        """The action for the present state of an environment, which has been reset."""
        self._look_up(env.floor_plan)
        pose, velocity = env.world.pose, env.world.velocity
        doors = points_to_local(pose, self._doors).reshape(-1, 4)
        pilot, goal = Pilot(env.robot), true_goal(env)
        stands = max(map(abs, velocity)) < STANDING_SPEED  # to brake is no answer then
        for _ in range(MOST_REFUSALS if stands else 0):
            action = pilot.act(self._points, doors, goal, pose, velocity)
            if action.any():
                return action
        return pilot.act(self._points, doors, goal, pose, velocity)

    def _look_up(self, floor_plan: FloorPlan) -> None:
        """Keep the obstacles of the floor plan: they are the same in all its states."""
        if floor_plan is not self._plan:
            self._plan, self._points = floor_plan, points_of_segments(floor_plan.segments)
            self._doors = ends_of(floor_plan.scene.doors).reshape(-1, 2)


def true_goal(env: SemNavEnv) -> SeenGoal:
    """The true goal of the active clause, grounded on the floor plan, robot frame."""
    pose = env.world.pose
    goal = env.judge.follower.target(pose)
    door = door_of(goal)
    jambs = None if door is None else (to_local(pose, door.start), to_local(pose, door.end))
    return SeenGoal(goal.kind, relative(pose, goal.pose), jambs)
