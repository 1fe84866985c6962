"""The shortest command that leads along a route."""

from __future__ import annotations

import heapq
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import count

import numpy as np

from semnav_env.judge import place
from semnav_env.judge.routes.choices import Choices, words_of
from semnav_env.judge.routes.follow import check_route, crossings, destination, follows, with_rest
from semnav_env.judge.routes.route import Route
from semnav_env.language import MAX_CLAUSES, Approach, Clause, Command, Follow, Turn, Turning
from semnav_env.language.command import may_count_on
from semnav_env.mind.grounding import Goal, GroundingError, PassGoal, ReachGoal
from semnav_env.mind.grounding.goal import door_of
from semnav_env.mind.grounding.ground import goal_of
from semnav_env.mind.grounding.situation import Situation
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import Pose, path_length, wrap_angle


@dataclass(frozen=True)
class DescriptionLimits:
    """Required accuracy of the description of a route, and limits of the search for it.

    Attributes:
        end_distance: largest distance from the end of a route to the end of its command, metres,
            where neither is a door.
        end_angle: largest angle between the headings at these ends where the route fixes one,
            radians.
        rest: longest part of a route that may be left when its command is done, metres.
        detour_factor: largest ratio of the part of a route that a clause leads along to the
            straight line; the part may be longer by `rest`.
        states: largest number of partial descriptions that are continued before a route is given
            up.
    """

    end_distance: float = 1.0
    end_angle: float = 0.3
    rest: float = 3.0
    detour_factor: float = 2.0
    states: int = 1000


LIMITS = DescriptionLimits()
"""Limits of all descriptions."""


class UndescribableError(ValueError):
    """No command leads along a route; the message says why."""


@dataclass(frozen=True)
class PartialDescription:
    """A command that describes the first part of a route.

    Attributes:
        clauses: the clauses so far.
        begin: pose at which the next clause begins.
        index: index of the pose of the route at which the last clause is done.
        words: number of words.
    """

    clauses: tuple[Clause, ...]
    begin: Pose
    index: int
    words: int

    def key(self) -> tuple[object, ...]:
        """The state that determines the rest of the description, to 5 cm and 3 degrees."""
        x, y, heading = self.begin
        past = bool(self.clauses) and _is_past(self.clauses[-1])
        turned = round(math.cos(heading) * 20), round(math.sin(heading) * 20)
        return round(x * 20), round(y * 20), turned, self.index, past


def describe(floor_plan: FloorPlan, route: Route) -> Command:
    """Find the shortest command that leads along a route: fewest clauses, then fewest words.

    The judge accepts the route for it. If the route ends behind a door that it has crossed, or
    facing one, the command ends with going through that door, or to it; else it ends within
    `LIMITS.end_distance` of the end of the route.

    Args:
        floor_plan: the floor plan.
        route: a route in the world frame of the plan.

    Raises:
        RouteError: the route leads through something solid, or nowhere.
        UndescribableError: no command of up to eight clauses leads along the route; says how far
            one leads.
        TypeError: `route` is not a `Route`.
    """
    if not isinstance(route, Route):
        raise TypeError(f"describe needs a Route, as route_to makes it, not {route!r}")
    check_route(floor_plan, route)
    return _Search(floor_plan, route).best()


class _Search:
    """Best-first search over partial descriptions, by clauses and then by words."""

    def __init__(self, floor_plan: FloorPlan, route: Route) -> None:
        self._plan = floor_plan
        self._route = route
        self._poses = with_rest(route)
        self._crossings = crossings(floor_plan, self._poses)
        self._destination = destination(floor_plan, route)
        self._farthest = PartialDescription((), route.start, 0, 0)

    def best(self) -> Command:
        """The cheapest command that the judge accepts."""
        order: Iterator[int] = count()
        seen: set[tuple[object, ...]] = set()
        queue = [(0, 0, next(order), self._farthest, False)]
        while queue and len(seen) < LIMITS.states:
            least, _, _, told, there = heapq.heappop(queue)
            if least > MAX_CLAUSES:
                break
            if there and follows(self._plan, Command(told.clauses), self._route):
                return Command(told.clauses)
            if told.key() in seen or told.clauses[-1:] == (Follow(),):
                continue
            seen.add(told.key())
            for further, ends in self._further(told):
                least = len(further.clauses) + self._still_to_tell(further, ends)
                heapq.heappush(queue, (least, further.words, next(order), further, ends))
        raise self._undescribable()

    def _still_to_tell(self, told: PartialDescription, ends: bool) -> int:
        """Lower bound of the clauses for the rest: one for each door still to be crossed."""
        doors = sum(k > told.index for k, _ in self._crossings)
        return doors if ends else max(1, doors)

    def _further(self, told: PartialDescription) -> Iterator[tuple[PartialDescription, bool]]:
        """Descriptions with one more clause, each with whether it is the whole route."""
        crossing = next((c for c in self._crossings if c[0] > told.index), None)
        stop, door = crossing or (len(self._poses), None)
        way = self._poses[told.index : stop + 1]
        situation = Situation(self._plan.scene, told.begin, told.begin, complete=True)
        for group in Choices(situation, way, door).groups():
            for clause in group:
                if _is_on_the_spot(clause) and _is_on_the_spot(*told.clauses[-1:]):
                    continue  # two turns on one spot are one turn
                goal = _goal(clause, told, situation)
                if goal is None:
                    continue
                done = self._done(goal, told.index, stop, door)
                if done is not None and self._is_direct(goal, told.index, done):
                    yield self._told(told, clause, goal, done), self._is_end(goal, done)
                break

    def _done(self, goal: Goal, index: int, stop: int, door: str | None) -> int | None:
        """Index of the pose at which a goal is reached, up to the next door; None if it is not."""
        if isinstance(goal, PassGoal):
            return stop if goal.door.name == door and self._crosses(goal, stop) else None
        if not isinstance(goal, ReachGoal):
            return None
        x, y, heading = (self._poses[index + 1 : stop] - goal.pose).T
        there = np.hypot(x, y) <= goal.distance_tolerance
        if goal.fixes_heading:
            there &= np.cos(heading) >= math.cos(goal.heading_tolerance)
        return index + 1 + int(np.argmax(there)) if there.any() else None

    def _is_direct(self, goal: Goal, index: int, done: int) -> bool:
        """Whether the part of the route of a clause is about as long as the straight line."""
        most = LIMITS.detour_factor * math.dist(place(goal), self._poses[index, :2]) + LIMITS.rest
        return self._length(index, done) <= most

    def _length(self, start: int, stop: int) -> float:
        """Length of the route between two poses, metres."""
        return path_length(self._poses[start : stop + 1, :2])

    def _crosses(self, goal: PassGoal, stop: int) -> bool:
        before, after = (tuple(pose.tolist()) for pose in self._poses[stop - 1 : stop + 1])
        return goal.crossed_between(before, after)

    def _told(
        self, told: PartialDescription, clause: Clause, goal: Goal, done: int
    ) -> PartialDescription:
        anew = 2 if told.clauses and may_count_on(told.clauses[-1], clause) else 0
        words = told.words + words_of(clause) + anew
        further = PartialDescription((*told.clauses, clause), goal.next_begin, done, words)
        if done > self._farthest.index:
            self._farthest = further
        return further

    def _is_end(self, goal: Goal, done: int) -> bool:
        """Whether a goal is where the route leads."""
        if self._destination is not None:
            name, approach = self._destination
            kind = PassGoal if approach is Approach.THROUGH else ReachGoal
            door = door_of(goal)
            is_it = isinstance(goal, kind) and door is not None and door.name == name
            return is_it and self._is_late(done)
        near = math.dist(place(goal), self._poses[-1, :2]) <= LIMITS.end_distance
        return near and self._faces(goal) and self._is_late(done)

    def _faces(self, goal: Goal) -> bool:
        facing = self._route.facing
        return facing is None or abs(wrap_angle(goal.pose[2] - facing)) <= LIMITS.end_angle

    def _is_late(self, done: int) -> bool:
        """Whether almost nothing of the route is left at a pose."""
        crossed = all(k <= done for k, _ in self._crossings)
        return crossed and self._length(done, len(self._poses)) <= LIMITS.rest

    def _undescribable(self) -> UndescribableError:
        told = self._farthest
        x, y, _ = self._poses[told.index].tolist()
        crossing = next((name for k, name in self._crossings if k > told.index), None)
        where = f"({x:.1f}, {y:.1f})" + (
            f' by "{Command(told.clauses)}"' if told.clauses else ", its start"
        )
        rest = f"through door {crossing}" if crossing else "to its end"
        return UndescribableError(
            f"no command of up to {MAX_CLAUSES} clauses leads along this route: it can be told as "
            f"far as {where}, but not from there {rest}"
        )


def _goal(clause: Clause, told: PartialDescription, situation: Situation) -> Goal | None:
    """The goal of a clause; None if it cannot be carried out there."""
    bare = _is_on_the_spot(clause) and clause != Turn(Turning.AROUND)
    if bare and told.clauses and _is_past(told.clauses[-1]):
        situation = replace(situation, after_corridor=True)
    try:
        return goal_of(clause, situation)
    except GroundingError:
        return None


def _is_past(clause: Clause) -> bool:
    return isinstance(clause, Follow) and clause.past


def _is_on_the_spot(clause: Clause | None = None) -> bool:
    return isinstance(clause, Turn) and clause.at is None
