"""Follows a command: which clause is active, and its goal."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass, field
from typing import Self

import numpy as np

from semnav_env.language import Command
from semnav_env.language.clauses import GoBack, IfThere, Pace, Speed
from semnav_env.language.command import reference_of
from semnav_env.language.finding_clauses import SearchRoom
from semnav_env.mind.grounding.clause_order import (
    after,
    comes_after_corridor,
    in_context,
    is_only_a_direction,
    pace_at,
    wall_beside,
)
from semnav_env.mind.grounding.clause_progress import (
    CLAUSE_DONE,
    CLAUSE_PROGRESS,
    NO_NEARER,
    NO_TRAIL,
    TRAIL_DUE,
    farthest_view,
    note_pose,
    put_goal,
)
from semnav_env.mind.grounding.errors import GroundingError
from semnav_env.mind.grounding.goal import Goal, PassGoal, ReachGoal, SeekGoal, StopGoal
from semnav_env.mind.grounding.goals import has_looked, is_search, search_goal
from semnav_env.mind.grounding.ground import goal_of
from semnav_env.mind.grounding.search import Known, Searching
from semnav_env.mind.grounding.situation import Situation, is_behind, turned
from semnav_env.mind.grounding.ways import Guide, KnownWays, Trail, Way
from semnav_env.rules import Rules
from semnav_features.frames import ORIGIN, Pose, to_local
from semnav_features.scene import Door, Scene


@dataclass
class Follower:
    """Follows a command: the active clause and its goal.

    The agent's follower runs on the remembered scene and on odometry; the judge's runs on the
    true scene and the true pose. Both are this class, so both count alike.

    Attributes:
        command: the command to follow.
        complete: whether the scenes are complete (true scenes).
        care: share of a goal's tolerances within which it counts as reached; an agent aims well
            inside what the judge accepts.
        jamb_margin: distance beside a jamb at which a crossing still counts, and distance behind
            the door that the robot must reach, metres; perceived jambs are not exact.
        guide: gives the ways to rooms.
        rules: distances and tolerances.
        progress: progress of the robot in the active clause, dtype `CLAUSE_PROGRESS`, shape (1,);
            kernels change it.
        active: index of the active clause; the number of clauses when all are done.
        begin: pose at which that clause began.
        goal: goal of that clause.
        impossible: reason why the clause cannot be carried out, if it cannot.
        skipped: indices of the clauses that a condition ruled out.
    """

    command: Command
    complete: bool = False
    care: float = 1.0
    jamb_margin: float = 0.0
    guide: Guide = field(default_factory=lambda: KnownWays({}), repr=False)
    rules: Rules = field(default=Rules(), repr=False)
    progress: np.ndarray = field(
        default_factory=lambda: np.zeros(1, CLAUSE_PROGRESS), repr=False, compare=False
    )
    active: int = field(default=0, init=False)
    begin: Pose = field(default=ORIGIN, init=False)
    goal: Goal = field(default=StopGoal(ORIGIN), init=False)
    impossible: str | None = field(default=None, init=False)
    skipped: frozenset[int] = field(default=frozenset(), init=False)
    _beside: Door | None = field(default=None, init=False, repr=False)
    _entry: PassGoal | None = field(default=None, init=False, repr=False)
    _lookouts: tuple[Pose, ...] = field(default=(), init=False, repr=False)
    _found: Goal | None = field(default=None, init=False, repr=False)
    _way: Way | None = field(default=None, init=False, repr=False)
    _inside: bool = field(default=False, init=False, repr=False)
    _searched_from: Pose | None = field(default=None, init=False, repr=False)
    _trail: Trail = field(default_factory=lambda: Trail(ORIGIN), init=False, repr=False)

    def start(self, scene: Scene, pose: Pose) -> None:
        """Begin with the first clause."""
        self.active, self._trail = 0, Trail(pose)
        goes_back = any(isinstance(clause, GoBack) for clause in self.command.clauses)
        trail = pose[:2] if goes_back else NO_TRAIL
        self._write(last=pose[:2], trail=trail, care=self.care, jamb_margin=self.jamb_margin)
        self._write(
            standstill_speed=self.rules.success.standstill_speed,
            inspection_angle=self.rules.grounding.inspection_angle,
        )
        self.skipped, self._beside, self._entry = frozenset(), None, None
        self._inside, self._searched_from = False, None
        self._begin_clause(scene, pose, pose)

    @property
    def done(self) -> bool:
        """Whether every clause has been carried out."""
        return self.active >= len(self.command.clauses)

    @property
    def pace(self) -> Speed | None:
        """How fast to drive now, by what was said; None if nothing was."""
        return pace_at(self.command.clauses, self.active, self.skipped)

    def advance(self, scene: Callable[[], Scene], pose: Pose, speed: float, seconds: float) -> bool:
        """Note the robot's pose, and begin the next clause if this one is done.

        Args:
            scene: called for the scene when a new clause must be grounded.
            pose: of the robot's centre, in the scene's frame.
            speed: m/s.
            seconds: since the last call.

        Returns:
            Whether a clause was completed.
        """
        return self.think(note_pose(self.progress, pose, speed, seconds), scene, pose)

    def think(self, events: int, scene: Callable[[], Scene], pose: Pose) -> bool:
        """Handle the events of `note_pose`; see `advance`."""
        if events & TRAIL_DUE:
            self._trail.note(pose)
            self._write(trail=self._trail.end)
        if events & NO_NEARER:
            self._take_as_looked_from(self.goal.pose)
        return bool(events & CLAUSE_DONE) and self._begin_next(scene(), pose)

    def _take_as_looked_from(self, lookout: Pose) -> None:
        """Go on as if the robot had reached a lookout point: what it leaves unseen stays so."""
        self._lookouts += (lookout,)
        ahead = tuple(self.progress["ahead"][0].tolist())
        along = to_local(ahead, lookout[:2])[0]
        if along > self.progress["farthest_along"][0]:
            self._write(farthest=lookout[:2], farthest_along=along)

    def note_doorway(self, pose: Pose) -> None:
        """Note that the robot has just crossed the line of a door, so that it may go back there."""
        self._trail.note_doorway(pose)

    def target(self, pose: Pose) -> Goal:
        """The target of a robot at a pose: the goal of the clause, or the next place on its way."""
        if not self.goal.places:
            return self.goal
        from semnav_env.mind.grounding.known_way import next_on_way  # few goals lie on a known way

        return next_on_way(self.goal, pose, self.rules.grounding)

    def look(self, scene: Scene, pose: Pose) -> None:
        """Ground the active clause again, on the present scene."""
        if self.done:
            self._lead_to(StopGoal(pose, "done"))
            return
        try:
            found = self._ground(scene, pose)
            self.impossible = None
            if isinstance(found, Known):
                self._go_on(after(self.command.clauses, self.active, found.value))
                self._begin_clause(scene, self.begin, pose)
            else:
                self._lead_to(found)
                if not self.complete and not is_search(found):
                    self._found = found
        except GroundingError as error:
            if self._found is not None:
                self.impossible = None
                self._lead_to(self._found)
                return
            self.impossible = error.reason
            self._lead_to(StopGoal(pose, self.impossible))

    def skip_to_next(self, scene: Scene) -> None:
        """Treat the active clause, or the way into the room that it is to search, as done."""
        self._begin_next(scene, self.goal.next_begin)

    @property
    def leads_in(self) -> bool:
        """Whether the goal is only to go into a room that is searched then."""
        searches = not self.done and isinstance(self.command.clauses[self.active], SearchRoom)
        return searches and isinstance(self.goal, PassGoal | ReachGoal)

    def _ground(self, scene: Scene, pose: Pose) -> Goal | Known[bool]:
        """The goal of the active clause, or whether its condition is met."""
        if not self.complete and has_looked(self.goal, pose, self.rules.grounding):
            self._lookouts += ((*self.goal.pose[:2], pose[2]),)
        situation = self._situation(scene, pose)
        clause = in_context(self.command.clauses, self.active)
        if not isinstance(clause, IfThere):
            return goal_of(clause, situation)
        from semnav_env.mind.grounding.conditions import is_met  # few commands need it

        found = is_met(clause, situation)
        return search_goal(found) if isinstance(found, Searching) else found

    def _situation(self, scene: Scene, pose: Pose) -> Situation:
        x, y, heading = farthest_view(self.progress, pose[2])
        if self._way:
            x, y = pose[:2]
        return Situation(
            scene,
            self.begin,
            (x, y, heading),
            self.complete,
            comes_after_corridor(self.command.clauses, self.active),
            self._way,
            self._beside,
            self._entry,
            self._lookouts,
            wall=wall_beside(self.command.clauses, self.active),
            inside=self._inside or (self._way is not None and _is_there(self._way)),
            searched_from=self._searched_from,
            rules=self.rules,
        )

    def _begin_next(self, scene: Scene, pose: Pose) -> bool:
        """Begin the next clause at the goal of the last one; counting then ignores the driving.

        Where the last one has roamed, the next one begins where the robot is. Returns whether a
        clause was completed, and not only the way into a room that is searched now.
        """
        match self.goal:
            case ReachGoal(beside=beside, door=door):
                self._beside = beside or door
            case PassGoal() as passed:
                self._beside, self._entry = None, passed
            case SeekGoal():
                self._beside = None
            case StopGoal(roams=True):
                self._beside, self._entry = None, None
            case StopGoal():
                pass  # it stays where the clause before led to
        roamed = isinstance(self.goal, StopGoal) and self.goal.roams
        if roamed or not isinstance(self.goal, StopGoal):
            searched = roamed and isinstance(self.command.clauses[self.active], SearchRoom)
            self._searched_from = self.begin if searched else None
        self._inside = self.leads_in
        if not self._inside:
            self._go_on(after(self.command.clauses, self.active))
        self._begin_clause(scene, pose if roamed else self.goal.next_begin, pose)
        return not self._inside

    def _go_on(self, index: int) -> None:
        """Make a clause the active one; the clauses between are skipped."""
        if index > self.active + 1:
            self.skipped |= frozenset(range(self.active + 1, index))
        self.active = index

    def _begin_clause(self, scene: Scene, begin: Pose, pose: Pose) -> None:
        clauses = self.command.clauses
        while not self.done:
            if isinstance(clauses[self.active], Pace):
                self._go_on(after(clauses, self.active))
            elif is_only_a_direction(clauses, self.active):
                self.active += 1
            else:
                break
        self.begin, self._lookouts, self.goal, self._found = begin, (), StopGoal(pose), None
        back = not self.done and is_behind(reference_of(clauses[self.active]))
        ahead = turned(begin) if back else begin
        self._write(ahead=ahead, is_behind=back, looked_back=False, still=0.0)
        self._write(farthest=pose[:2], farthest_along=to_local(ahead, pose[:2])[0])
        self._way = None if self.done else self._way_from(begin, pose)
        self.look(scene, pose)

    def _way_from(self, begin: Pose, pose: Pose) -> Way | None:
        if isinstance(self.command.clauses[self.active], GoBack):
            return self._trail.back(pose)
        if self._inside:
            return None
        return self.guide(self.active, begin)

    def _lead_to(self, goal: Goal) -> None:
        self.goal = goal
        is_open = not self.done and self.impossible is None
        put_goal(self.progress, "goal", goal)
        self.progress["is_open"] = is_open

    def _write(self, **values: object) -> None:
        """Set fields of the record."""
        for name, value in values.items():
            self.progress[name] = value

    def __copy__(self) -> Self:
        """A copy of the follower that advances independently."""
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        other.progress, other._trail = self.progress.copy(), deepcopy(self._trail)
        return other


def _is_there(way: Way) -> bool:
    """Whether a way to a room begins in it."""
    return way.door is None and way.places[0] == way.places[-1]
