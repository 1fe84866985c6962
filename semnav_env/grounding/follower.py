"""How far a robot is in following a command: which clause is active and where it leads."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from semnav_env.commands import Command
from semnav_env.commands.clauses import GoBack, IfThere
from semnav_env.commands.command import reference_of
from semnav_env.features.frames import Pose, to_local
from semnav_env.features.scene import Door, Scene
from semnav_env.grounding.clause_order import (
    after,
    comes_after_corridor,
    in_context,
    is_only_a_direction,
)
from semnav_env.grounding.conditions import is_met
from semnav_env.grounding.errors import GroundingError
from semnav_env.grounding.goal import Goal, PassGoal, ReachGoal, SeekGoal, StopGoal
from semnav_env.grounding.goals import search_goal
from semnav_env.grounding.ground import goal_of
from semnav_env.grounding.known_way import next_on_way
from semnav_env.grounding.search import Known, Searching
from semnav_env.grounding.situation import Situation, is_behind, looks_along, turned
from semnav_env.grounding.ways import Guide, KnownWays, Trail, Way
from semnav_env.rules import Rules


@dataclass
class Follower:
    """The clause under way and its goal.

    The agent's follower runs on the remembered scene and on odometry; the verifier's runs on the
    true scene and the true pose. Both are this class, so both count alike.

    Attributes:
        command: what to follow.
        complete: the scenes hold everything there is (true scenes).
        care: share of a goal's tolerances within which it counts as reached; an agent aims well
            inside what the verifier accepts.
        jamb_margin: how far beside a jamb a crossing still counts, and how far behind it the
            robot must be, metres; perceived jambs are not exact.
        guide: points out the ways to rooms.
        rules: distances and tolerances.
        active: index of the clause under way; the number of clauses when all are done.
        begin: where that clause began.
        goal: where it leads.
        impossible: why the clause cannot be carried out, if it cannot.
        skipped: indices of the clauses that a condition ruled out.
    """

    command: Command
    complete: bool = False
    care: float = 1.0
    jamb_margin: float = 0.0
    guide: Guide = field(default_factory=lambda: KnownWays({}), repr=False)
    rules: Rules = field(default=Rules(), repr=False)
    active: int = field(default=0, init=False)
    begin: Pose = field(default=(0.0, 0.0, 0.0), init=False)
    goal: Goal = field(default=StopGoal((0.0, 0.0, 0.0)), init=False)
    impossible: str | None = field(default=None, init=False)
    skipped: frozenset[int] = field(default=frozenset(), init=False)
    _last: Pose = field(default=(0.0, 0.0, 0.0), init=False)
    _farthest: Pose = field(default=(0.0, 0.0, 0.0), init=False)
    _farthest_along: float = field(default=0.0, init=False)
    _still: float = field(default=0.0, init=False)
    _ahead: Pose = field(default=(0.0, 0.0, 0.0), init=False)
    _looked_back: bool = field(default=False, init=False)
    _beside: Door | None = field(default=None, init=False, repr=False)
    _way: Way | None = field(default=None, init=False, repr=False)
    _trail: Trail = field(default_factory=lambda: Trail((0.0, 0.0, 0.0)), init=False, repr=False)

    def start(self, scene: Scene, pose: Pose) -> None:
        """Begin with the first clause."""
        self.active, self._last, self._trail = 0, pose, Trail(pose)
        self.skipped, self._beside = frozenset(), None
        self._begin_clause(scene, pose, pose)

    @property
    def done(self) -> bool:
        """Whether every clause has been carried out."""
        return self.active >= len(self.command.clauses)

    def advance(self, scene: Callable[[], Scene], pose: Pose, speed: float, seconds: float) -> bool:
        """Note where the robot is now; begin the next clause if this one is done.

        Args:
            scene: called for the scene when a new clause must be grounded.
            pose: of the robot's centre, in the scene's frame.
            speed: m/s.
            seconds: since the last call.

        Returns:
            Whether a clause was completed.
        """
        stopped = speed < self.rules.success.standstill_speed
        self._still = self._still + seconds if stopped else 0.0
        completed = not self.done and self._completed(pose)
        self._last = pose
        self._trail.note(pose)
        along = to_local(self._ahead, (pose[0], pose[1]))[0]
        if along > self._farthest_along:
            self._farthest, self._farthest_along = pose, along
        angle = self.rules.grounding.inspection_angle
        if self._ahead != self.begin and looks_along(pose, self._ahead[2], angle):
            self._looked_back = True
        if completed:
            self._begin_next(scene(), pose)
        return completed

    def target(self, pose: Pose) -> Goal:
        """What a robot at a pose should head for now: the goal, or the next place on the way."""
        return next_on_way(self.goal, pose, self.rules.grounding)

    def look(self, scene: Scene, pose: Pose) -> None:
        """Ground the active clause anew, on what is known by now."""
        if self.done:
            self.goal = StopGoal(pose, "done")
            return
        try:
            found = self._ground(scene, pose)
            self.impossible = None
            if isinstance(found, Known):
                self._go_on(after(self.command.clauses, self.active, found.value))
                self._begin_clause(scene, self.begin, pose)
            else:
                self.goal = found
        except GroundingError as error:
            self.impossible = str(error)
            self.goal = StopGoal(pose, self.impossible)

    def skip_to_next(self, scene: Scene) -> None:
        """Take the active clause for done."""
        self._begin_next(scene, self.goal.next_begin)

    def _ground(self, scene: Scene, pose: Pose) -> Goal | Known[bool]:
        """The goal of the active clause, or whether its condition is met."""
        situation = self._situation(scene, pose)
        clause = in_context(self.command.clauses, self.active)
        if not isinstance(clause, IfThere):
            return goal_of(clause, situation)
        found = is_met(clause, situation)
        return search_goal(found) if isinstance(found, Searching) else found

    def _situation(self, scene: Scene, pose: Pose) -> Situation:
        here = pose if self._way else self._farthest  # what was looked at stays so on coming back
        here = (*here[:2], self._ahead[2] if self._looked_back else pose[2])
        return Situation(
            scene,
            self.begin,
            here,
            self.complete,
            comes_after_corridor(self.command.clauses, self.active),
            self._way,
            self._beside,
            rules=self.rules,
        )

    def _begin_next(self, scene: Scene, pose: Pose) -> None:
        """Begin where the clause before leads, so that counting does not depend on the driving."""
        match self.goal:
            case ReachGoal(beside=beside, door=door):
                self._beside = beside or door
            case PassGoal() | SeekGoal():
                self._beside = None
            case StopGoal():
                pass  # it stays where the clause before led to
        self._go_on(after(self.command.clauses, self.active))
        self._begin_clause(scene, self.goal.next_begin, pose)

    def _go_on(self, index: int) -> None:
        """Make that clause the active one; what lies between is skipped."""
        if index > self.active + 1:
            self.skipped |= frozenset(range(self.active + 1, index))
        self.active = index

    def _begin_clause(self, scene: Scene, begin: Pose, pose: Pose) -> None:
        clauses = self.command.clauses
        while not self.done and is_only_a_direction(clauses, self.active):
            self.active += 1
        self.begin, self._farthest, self._still = begin, pose, 0.0
        back = not self.done and is_behind(reference_of(clauses[self.active]))
        self._ahead, self._looked_back = (turned(begin) if back else begin), False
        self._farthest_along = to_local(self._ahead, (pose[0], pose[1]))[0]
        self._way = None if self.done else self._way_from(begin, pose)
        self.look(scene, pose)

    def _way_from(self, begin: Pose, pose: Pose) -> Way | None:
        if isinstance(self.command.clauses[self.active], GoBack):
            return self._trail.back(pose)
        return self.guide(self.active, begin)

    def _completed(self, pose: Pose) -> bool:
        match self.goal:
            case PassGoal() as goal:
                return goal.crossed_between(self._last, pose, self.jamb_margin)
            case ReachGoal() as goal:
                return goal.reached_by(pose, self.care)
            case StopGoal(wait=wait):
                return self.impossible is None and self._still > wait
            case SeekGoal():
                return False
