"""The task: carry out a command. It owns the start, the reward and the end of an episode."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely

from semnav_env.commands import Command, parse
from semnav_env.commands.language import language_of
from semnav_env.features.frames import Pose
from semnav_env.grounding import GroundingError
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.maps.geodesic import Geodesic
from semnav_env.maps.placement import placement_error
from semnav_env.robots import RobotSpec
from semnav_env.routes.room_guide import RoomGuide
from semnav_env.tasks.implicit import with_implicit_steps
from semnav_env.tasks.rewards import RewardTerms, RewardWeights
from semnav_env.tasks.sampling import sample_feasible, sample_start
from semnav_env.verifier import Motion, Verifier, plan_goals

START_TRIES = 200
"""Start poses drawn before a floor plan is found unfit for commands."""

MOST_TURNED = 2.0 * math.tau
"""Beyond it a heading is in degrees, not one that nobody wrapped; radians."""


@dataclass
class CommandTask:
    """Carry out one command per episode.

    Attributes:
        floor_plan: where.
        robot: which body must find room.
        weights: of the reward terms.
        verifier: of the episode under way.
    """

    floor_plan: FloorPlan
    robot: RobotSpec
    weights: RewardWeights
    geodesic: Geodesic = field(init=False, repr=False)
    verifier: Verifier = field(init=False, repr=False)
    _remaining: float = field(init=False, default=0.0)

    def __post_init__(self) -> None:
        self.geodesic = Geodesic(self.floor_plan)

    def begin(self, options: dict[str, Any], rng: np.random.Generator) -> Pose:
        """Choose or check the start pose and the command of an episode.

        Args:
            options: "command" (text or `Command`), "language" (of the text; "en"), "implicit_steps"
                (whether to do what goes without saying; True), "pose" (x, y, heading), and
                "feasible" (False where it may be impossible to do; True), each optional.
            rng: for what is not given.

        Returns:
            The start pose, world frame.

        Raises:
            ValueError: the pose is not free, or the command is not understood or not feasible.
        """
        command = _command(options, self.floor_plan.room_names)
        pose = _pose(options.get("pose"))
        if pose is not None:
            error = placement_error(self.floor_plan, self.robot, pose)
            if error is not None:
                raise ValueError(f"start pose {pose}: {error}")
        start, command = self._complete(pose, command, rng)
        if options.get("implicit_steps", True):
            command = self._with_implicit_steps(command, start)
        feasible = bool(options.get("feasible", True))
        self.verifier = Verifier(self.floor_plan, self.geodesic, command, start, feasible)
        self._remaining = self.verifier.remaining
        return start

    def step(self, motion: Motion) -> dict[str, float]:
        """Judge a step; returns the weighted reward terms by name."""
        verifier = self.verifier
        was_over = verifier.over
        completed = verifier.update(motion)
        remaining = verifier.remaining
        progress = self._remaining - (0.0 if completed else remaining)
        if not math.isfinite(progress):
            progress = 0.0
        self._remaining = remaining
        ended = verifier.over and not was_over
        success = ended and verifier.success
        terms = RewardTerms(progress, completed, success, ended != success, motion.in_contact)
        return self.weights.apply(terms)

    def _complete(
        self, pose: Pose | None, command: Command | None, rng: np.random.Generator
    ) -> tuple[Pose, Command]:
        if pose is not None and command is not None:
            return pose, command
        objections: Counter[str] = Counter()
        for _ in range(START_TRIES):
            start = pose or sample_start(self.floor_plan, self.robot, rng)
            drawn = command or sample_feasible(self.floor_plan, start, rng)
            if drawn is None:
                continue
            objection = self._objection(drawn, start) if command is not None else ""
            if not objection:
                return start, drawn
            objections[objection] += 1
        name = self.floor_plan.name
        if command is not None:
            [(why, _)] = objections.most_common(1)
            raise ValueError(
                f'no start found in {name} from which "{command}" can be carried out: {why}'
            )
        raise ValueError(f"no command found that can be carried out in {name} from {pose or 'it'}")

    def _with_implicit_steps(self, command: Command, start: Pose) -> Command:
        here = shapely.Point(start[:2])
        in_room = any(room.polygon.contains(here) for room in self.floor_plan.rooms)
        return with_implicit_steps(
            command, lambda each: not self._objection(each, start), in_room=in_room
        )

    def _objection(self, command: Command, start: Pose) -> str:
        """Why a command cannot be carried out from there; empty if it can."""
        try:
            guide = RoomGuide(self.floor_plan, command, self.geodesic)
            plan_goals(self.floor_plan, command, start, guide)
        except GroundingError as error:
            return str(error)
        return ""


def _command(options: dict[str, Any], rooms: tuple[str, ...]) -> Command | None:
    given, language = options.get("command"), language_of(options.get("language", "en"))
    if given is None or isinstance(given, Command):
        return given
    if isinstance(given, str):
        return parse(given, language, rooms)
    raise ValueError(f"a command is text or a Command, not {type(given).__name__}")


def _pose(given: object) -> Pose | None:
    if given is None:
        return None
    try:
        x, y, heading = (float(value) for value in given)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        raise ValueError(
            f"a pose is (x, y, heading) in metres and radians, not {given!r}"
        ) from None
    if abs(heading) > MOST_TURNED:
        raise ValueError(
            f"the heading {heading:g} is more than two turns; give it in radians, not degrees "
            "(math.radians)"
        )
    return x, y, heading
