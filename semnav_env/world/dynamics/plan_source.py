"""The floor plan of an episode: as drawn, or with added leaves and moved furniture."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics.settings import Dynamics
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_env.world.maps.placement import footprint
from semnav_features.frames import Pose
from semnav_features.validation import check_kind


class PlanSource:
    """Makes the floor plan of each episode.

    Args:
        default: the plan if no other is requested: a name, a path or a plan.
        dynamics: settings of people, doors and furniture.
        robot: the body for which moved furniture leaves every passage free.

    Raises:
        ValueError: `dynamics` is something else.
    """

    dynamics: Dynamics

    def __init__(
        self, default: str | Path | FloorPlan, dynamics: Dynamics, robot: RobotSpec
    ) -> None:
        check_kind("dynamics", dynamics, Dynamics)
        self.dynamics, self._default, self._robot = dynamics, default, robot
        self._hung: tuple[FloorPlan, FloorPlan] | None = None

    def plan(
        self,
        floor_plan: str | Path | FloorPlan | None = None,
        pose: object = None,
        rng: np.random.Generator | None = None,
    ) -> FloorPlan:
        """The plan of an episode; the same object as loaded if nothing of it changes.

        Args:
            floor_plan: a name, a path or a plan; the default if not given.
            pose: start pose of the robot if one was asked for.
            rng: source of randomness for the furniture; without it furniture stays where it is.

        Raises:
            FloorPlanError: see `load_floor_plan`.
        """
        plan = load_floor_plan(floor_plan or self._default)
        if self.dynamics.changing_doors:
            plan = self._hung_with_leaves(plan, _pose(pose))
        if rng is None or not self.dynamics.furnishes:
            return plan
        from semnav_env.world.dynamics.furniture import (
            with_moved_furniture,  # most plans do not change
        )
        from semnav_env.world.dynamics.victims import with_victims

        start = _pose(pose)
        keep = start and start[:2]
        plan = with_moved_furniture(plan, self.dynamics, self._robot, rng, keep)
        return with_victims(plan, self.dynamics.victims, self._robot, rng, keep)

    def _hung_with_leaves(self, plan: FloorPlan, start: Pose | None) -> FloorPlan:
        """The plan with leaves, but none where the robot starts; usually the same object."""
        from semnav_env.world.dynamics.leaves import (  # most plans do not change
            with_leaves,
            without_leaves_at,
        )

        if self._hung is None or plan is not self._hung[0]:
            self._hung = plan, with_leaves(plan)
        hung = self._hung[1]
        if start is None:
            return hung
        return without_leaves_at(hung, plan, footprint(self._robot, start))


def _pose(pose: Any) -> Pose | None:
    """A requested pose; None if there is none, or it is malformed (refused elsewhere)."""
    try:
        x, y, heading = (float(value) for value in pose)
    except (TypeError, ValueError):
        return None
    return (x, y, heading) if all(map(math.isfinite, (x, y, heading))) else None
