"""Draws random commands of a given length and topic that can be carried out."""

from __future__ import annotations

from copy import copy
from functools import cached_property

import numpy as np

from semnav_env.judge import plan_goals
from semnav_env.judge.episodes.ambiguity_filter import AmbiguityFilter
from semnav_env.judge.episodes.random_clauses import CommandTopic, RandomClauses
from semnav_env.judge.goals import check_grounded
from semnav_env.judge.readings import answers
from semnav_env.judge.routes.room_guide import RoomGuide
from semnav_env.judge.tasks.starts import leads_on
from semnav_env.language import (
    Clause,
    Command,
    DoorReference,
    Follow,
    GoToDoor,
    IfThere,
    Leave,
    Place,
    PlaceReference,
    Turn,
    Turning,
)
from semnav_env.mind.grounding import GroundingError
from semnav_env.mind.grounding.follower import Follower
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.corridor import axis_at
from semnav_features.frames import Pose

MAX_CLAUSE_DRAWS = 15
"""Largest number of clauses drawn for one place in a command before the command is given up."""

TURN_AROUND_SHARE = 0.1
"""Share of the commands of several clauses that begin with turning around."""


class Drafter:
    """Draws commands clause by clause; each clause can be carried out after those before.

    Args:
        plan: the floor plan.
        geodesic: its shortest ways.
        start: pose from which commands are carried out.
        rng: source of randomness.
    """

    def __init__(
        self, plan: FloorPlan, geodesic: Geodesic, start: Pose, rng: np.random.Generator
    ) -> None:
        self.start, self.rng = start, rng
        self._plan, self._geodesic = plan, geodesic
        self._clauses = RandomClauses(rng, plan.room_names)
        self._followers: dict[tuple[Clause, ...], Follower] = {}

    @cached_property
    def ambiguity_filter(self) -> AmbiguityFilter:
        """The filter of the floor plan."""
        return AmbiguityFilter(self._plan)

    def feasible(self, clauses: int, topic: CommandTopic | None) -> Command | None:
        """Draw a command that can be carried out; None if none was found.

        Args:
            clauses: number of clauses.
            topic: its topic; None if further clauses will follow.
        """
        if topic is CommandTopic.CONDITION:
            return self._conditional(clauses)
        said: tuple[Clause, ...] = (Leave(),) if topic is CommandTopic.LEAVE else ()
        if said and self.problem(said) is not None:
            return None
        for index in range(len(said), clauses):
            for attempt in range(MAX_CLAUSE_DRAWS):
                clause = self._draw_clause(said, topic if index == clauses - 1 else None, attempt)
                if self._follows(said, clause) and self.problem((*said, clause)) is None:
                    said = (*said, clause)
                    break
            else:
                return None
        return Command(said)

    def infeasible(self, clauses: int) -> Command | None:
        """Draw a command of which only the last clause is impossible, by rules and for people."""
        first = self.feasible(clauses - 1, None) if clauses > 1 else None
        if clauses > 1 and first is None:
            return None
        before = first.clauses if first else ()
        begin = self._begin_after(before)
        for _ in range(MAX_CLAUSE_DRAWS):
            topic = self._clauses.choose(
                CommandTopic.ENTER,
                CommandTopic.ENTER,
                CommandTopic.TURN,
                CommandTopic.APPROACH,
                CommandTopic.FOLLOW,
            )
            last = self._clauses.last(topic, alone=True)
            impossible = self.problem((*before, last)) is not None
            if (
                impossible
                and self._follows(before, last)
                and self.ambiguity_filter.impossible(last, begin)
                and not self._has_an_answer((*before, last))
            ):
                return Command((*before, last))
        return None

    def turns(self, clauses: int) -> Command | None:
        """Draw a command with turns at junctions only, so that no count of doors restarts."""
        said: tuple[Clause, ...] = ()
        for _ in range(MAX_CLAUSE_DRAWS):
            clause = self._clauses.turn()
            if self._follows(said, clause) and self.problem((*said, clause)) is None:
                said = (*said, clause)
            if len(said) == clauses:
                return Command(said)
        return None

    def problem(self, clauses: tuple[Clause, ...]) -> str | None:
        """The reason why clauses cannot be carried out; None if they can."""
        try:
            self._followed(clauses)
        except GroundingError as error:
            return str(error)
        if _passes_corner(clauses[-1]):
            return f"{clauses[-1]}: around it, or straight on behind it? a turn says which"
        return None

    def skips_a_closed_door(self, command: Command) -> bool:
        """Whether a command ends with the first door, which comes after a closed one."""
        *before, last = command.clauses
        if not isinstance(last, GoToDoor) or last.door.ordinal != 1:
            return False
        if any(isinstance(clause, IfThere) for clause in before):
            return False
        return self.ambiguity_filter.is_behind_a_closed_one(last, self._begin_after(tuple(before)))

    def _conditional(self, clauses: int) -> Command | None:
        """Draw a command that ends with an unambiguous condition and its branches."""
        hanging = 2 if clauses == 2 or self.rng.random() < 0.5 else 3
        before = self.feasible(clauses - hanging, None) if clauses > hanging else None
        if before is None and clauses > hanging:
            return None
        said = before.clauses if before else ()
        begin = self._begin_after(said)
        for _ in range(MAX_CLAUSE_DRAWS):
            condition, *rest = self._clauses.condition(otherwise=hanging == 3)
            assert isinstance(condition, IfThere)
            command = Command((*said, condition, *rest))
            sure = self.ambiguity_filter.met(condition, begin) is not None
            if sure and self._goals(command) == len(said) + 1:
                return command
        return None

    def _goals(self, command: Command) -> int:
        """Number of goals of a command; 0 if it cannot be carried out."""
        guide = RoomGuide(self._plan, command, self._geodesic)
        try:
            return len(plan_goals(self._plan, command, self.start, guide))
        except GroundingError:
            return 0

    def _has_an_answer(self, clauses: tuple[Clause, ...]) -> bool:
        """Whether clauses can be carried out in some reading of the floor plan."""
        try:
            answers(self._plan, self._geodesic, Command(clauses), self.start)
        except GroundingError:
            return False
        return True

    def _begin_after(self, clauses: tuple[Clause, ...]) -> Pose:
        """Pose at which the clause after some others begins."""
        if not clauses:
            return self.start
        goal = self._followed(clauses).goal
        return goal.next_begin

    def _followed(self, clauses: tuple[Clause, ...]) -> Follower:
        """A follower at the last of some clauses; it is kept for the next clauses."""
        if clauses in self._followers:
            return self._followers[clauses]
        command = Command(clauses)
        guide = RoomGuide(self._plan, command, self._geodesic)
        if len(clauses) == 1:
            follower = Follower(command, complete=True, guide=guide)
            follower.start(self._plan.scene, self.start)
        else:
            follower = copy(self._followed(clauses[:-1]))
            follower.command, follower.guide = command, guide
            follower.skip_to_next(self._plan.scene)
        check_grounded(follower)
        self._followers[clauses] = follower
        return follower

    def _follows(self, said: tuple[Clause, ...], clause: Clause) -> bool:
        """Whether a clause adds something; two clauses along a corridor may be one."""
        if not said or not isinstance(clause, Follow):
            return True
        before = said[-1]
        if not isinstance(before, Follow):
            return True
        return isinstance(before.until, DoorReference) or isinstance(clause.until, DoorReference)

    def _draw_clause(
        self, said: tuple[Clause, ...], topic: CommandTopic | None, attempt: int
    ) -> Clause:
        """Draw the next clause: of the topic, or of any kind if more clauses follow."""
        if said and isinstance(said[-1], Leave) and self._faces_a_wall(said):
            return self._clauses.turn_here()
        if topic is not None:
            return self._clauses.last(topic, alone=not said)
        if not said and attempt == 0 and self.rng.random() < TURN_AROUND_SHARE:
            return Turn(Turning.AROUND)
        return self._clauses.underway()

    def _faces_a_wall(self, said: tuple[Clause, ...]) -> bool:
        """Whether the robot looks across a corridor; people would not count its doors then."""
        axis = axis_at(self._plan.scene, self._begin_after(said))
        return not leads_on(axis.half_width, axis.end)


def _passes_corner(clause: Clause) -> bool:
    """Whether a clause leads past a corner, which people may take in several ways."""
    place = clause.until if isinstance(clause, Follow) and clause.past else None
    return isinstance(place, PlaceReference) and place.place is Place.CORNER
