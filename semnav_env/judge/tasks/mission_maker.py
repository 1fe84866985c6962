"""Makes a mission from the request of an episode; values that are not requested are drawn."""

from __future__ import annotations

from collections import Counter

import numpy as np
import shapely

from semnav_env.judge import Mission, plan_goals, plan_mission
from semnav_env.judge.routes.room_guide import RoomGuide
from semnav_env.judge.tasks.request import EpisodeRequest
from semnav_env.language import Command
from semnav_env.language.told import Told
from semnav_env.mind.grounding import GroundingError
from semnav_env.robots import RobotSpec
from semnav_env.rules import Rules
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_env.world.maps.placement import placement_error
from semnav_features.frames import Pose

MOST_DRAWS = 200
"""Largest number of start poses drawn before a floor plan is refused as unfit for commands."""

NO_START = (
    'no start found in {plan} from which "{command}" can be carried out: {why}; random starts lie '
    "in corridors, so give a pose of your own, such as one in a room; or another floor plan may "
    "have one"
)
"""What is told where no random start was found."""


class MissionMaker:
    """Makes missions in one floor plan for one body.

    Args:
        floor_plan: the floor plan.
        robot: the body that must have space at the start.
        rules: rules of doors, grounding and success.
    """

    floor_plan: FloorPlan
    robot: RobotSpec
    rules: Rules
    geodesic: Geodesic

    def __init__(self, floor_plan: FloorPlan, robot: RobotSpec, rules: Rules = Rules()) -> None:
        self.floor_plan, self.robot, self.rules = floor_plan, robot, rules
        self.geodesic = floor_plan.derived(Geodesic)

    def make(self, request: EpisodeRequest, rng: np.random.Generator) -> Mission:
        """Choose or check the start pose and the command of an episode.

        Args:
            request: the request of the episode.
            rng: draws the values that are not requested.

        Raises:
            ValueError: the pose is not free, or the command is not understood or not feasible.
        """
        command, pose = request.checked_command(self.floor_plan.room_names), request.checked_pose()
        if pose is not None:
            error = placement_error(self.floor_plan, self.robot, pose)
            if error is not None:
                raise ValueError(f"start pose {pose}: {error}")
        if command is None:
            return self._drawn(pose, rng)
        try:
            start = pose or self._start_for(command, rng)
            if request.implicit_steps:
                command = self._with_implicit_steps(command, start)
            return plan_mission(
                self.floor_plan, self.geodesic, command, start, request.feasible, self.rules
            )
        except GroundingError as error:
            from semnav_env.language.vocabulary.recognition import (
                language_of_text,  # only to say why
            )

            spoken = language_of_text(request.instruction, request.language)
            raise error.in_words_of(spoken) from None

    def _drawn(self, pose: Pose | None, rng: np.random.Generator) -> Mission:
        """A random mission from a pose, or from a random start."""
        from semnav_env.judge.tasks.sampling import sample_mission  # only to draw
        from semnav_env.judge.tasks.starts import sample_start

        for _ in range(MOST_DRAWS):
            start = pose or sample_start(self.floor_plan, self.robot, rng, self.rules)
            mission = sample_mission(self.floor_plan, self.geodesic, start, rng, rules=self.rules)
            if mission is not None:
                return mission
        name = self.floor_plan.name
        raise ValueError(f"no command found that can be carried out in {name} from {pose or 'it'}")

    def _start_for(self, command: Command, rng: np.random.Generator) -> Pose:
        """A random start from which a command can be carried out.

        Raises:
            GroundingError: none was found.
        """
        from semnav_env.judge.tasks.starts import sample_start

        objections: Counter[str] = Counter()
        errors: dict[str, GroundingError] = {}
        for _ in range(MOST_DRAWS):
            start = sample_start(self.floor_plan, self.robot, rng, self.rules)
            objection = self._objection(command, start)
            if objection is None:
                return start
            objections[str(objection)] += 1
            errors[str(objection)] = objection
        [(why, _)] = objections.most_common(1)
        plan = self.floor_plan.name
        raise GroundingError(Told(NO_START, plan=plan, command=command, why=errors[why]))

    def _with_implicit_steps(self, command: Command, start: Pose) -> Command:
        from semnav_env.judge.tasks.implicit import (
            with_implicit_steps,  # only for commands that are told
        )

        here = shapely.Point(start[:2])
        in_room = any(room.polygon.contains(here) for room in self.floor_plan.rooms)
        return with_implicit_steps(
            command, lambda each: self._objection(each, start) is None, in_room=in_room
        )

    def _objection(self, command: Command, start: Pose) -> GroundingError | None:
        """The reason why a command cannot be carried out from a pose; None if it can."""
        try:
            guide = RoomGuide(self.floor_plan, command, self.geodesic)
            plan_goals(self.floor_plan, command, start, guide, self.rules)
        except GroundingError as error:
            return error
        return None
