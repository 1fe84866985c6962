"""Generates episodes from a seed; each depends only on the seed, its split and its number."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
import shapely
from numpy.random import PCG64, Generator, SeedSequence

from semnav_env.judge import Judge, place, plan_mission
from semnav_env.judge.episodes.ambiguous import ambiguous_text
from semnav_env.judge.episodes.drafts import Drafter
from semnav_env.judge.episodes.episode import Episode, Expected
from semnav_env.judge.episodes.random_clauses import CommandTopic, topics_of
from semnav_env.judge.episodes.site import LARGEST_BODY, Site
from semnav_env.judge.episodes.splits import SEED, Split
from semnav_env.judge.episodes.walk import carries_out
from semnav_env.judge.episodes.wording import worded
from semnav_env.judge.tasks.starts import sample_start
from semnav_env.language import Command
from semnav_env.mind.grounding import Goal, ReachGoal
from semnav_env.mind.grounding.visible_doors import doors_around
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_env.world.maps.placement import is_clear, placement_error, sample_pose
from semnav_features.frames import FloatArray, Point, Pose


@dataclass(frozen=True)
class EpisodeLimits:
    """Limits of an episode, and of the search for one.

    Attributes:
        starts: starts tried for the topic that an episode should have, before it gets another one.
        drafts_per_start: commands drawn at each start.
        min_route_length: length of the shortest true route, metres.
        max_route_length: length of the longest true route, metres: it keeps an episode within a few
            minutes of simulated time.
        goal_distance: largest distance from a goal to a place that the largest body reaches, m.
        route_tolerance: largest distance of a simplified true route from the exact one, metres.
        start_clearance: free radius around a start in a room, metres: every body can turn there.
    """

    starts: int = 15
    drafts_per_start: int = 4
    min_route_length: float = 1.5
    max_route_length: float = 120.0
    goal_distance: float = 0.3
    route_tolerance: float = 0.05
    start_clearance: float = 0.75


LIMITS = EpisodeLimits()
"""Limits of all episodes; the frozen ones were made with them."""

GERMAN_SHARE = 0.2
"""Share of the episodes in German."""


class TooBareError(ValueError):
    """No command of the wanted kind was found in a floor plan."""


def generate_split(
    split: Split, seed: int = SEED, first: int = 0, last: int | None = None
) -> Iterator[Episode]:
    """The episodes of a split, or those from number `first` up to before `last`, in order."""
    site: Site | None = None
    for number in range(first, split.episodes if last is None else last):
        plan = load_floor_plan(split.floor_plan(number))
        if site is None or site.plan is not plan:
            site = Site(plan, split.floor_plan(number))
        yield generate_episode(site, split, number, seed)


def generate_episode(
    site: Site,
    split: Split,
    number: int,
    seed: int = SEED,
    is_wanted: Callable[[Command, Pose], bool] | None = None,
) -> Episode:
    """Make one episode of a split.

    The number of the episode determines its number of clauses and its topic. If the floor plan
    does not allow this combination, other combinations are tried.

    Args:
        site: the floor plan.
        split: the split.
        number: of the episode.
        seed: of the split.
        is_wanted: whether a command at a start is wanted; another one is drawn if not.

    Raises:
        TooBareError: no command was found there.
    """
    rng = Generator(PCG64(SeedSequence((seed, zlib.crc32(split.name.encode()), number))))
    maker = _MAKERS[split.expected]
    for clauses, topic in _wanted(site.plan, split, number, seed):
        for _ in range(LIMITS.starts):
            start = _start(site, split, topic, rng)
            for _ in range(0 if start is None else LIMITS.drafts_per_start):
                assert start is not None
                language = "de" if rng.random() < GERMAN_SHARE else "en"
                drafter = Drafter(site.plan, site.geodesic, start, rng)
                said = maker(site, drafter, clauses, topic, language)
                if said is not None and _is_wanted(said, start, is_wanted):
                    return _episode(f"{split.name}-{number:05d}", site, start, language, said)
    raise TooBareError(f"{site.plan.name}: found no command of the kind of {split.name} there")


def _is_wanted(
    said: EpisodeDraft, start: Pose, is_wanted: Callable[[Command, Pose], bool] | None
) -> bool:
    return is_wanted is None or all(is_wanted(command, start) for command in said.meanings)


def _wanted(
    plan: FloorPlan, split: Split, number: int, seed: int
) -> list[tuple[int, CommandTopic]]:
    """Numbers of clauses and topics for an episode, the wanted one first, then substitutes.

    All combinations are used in turn, in another order each time, so that evenly spaced episodes
    do not share one topic. In a plan without named rooms, rooms are not a topic.
    """
    pairs = [(n, topic) for n in split.clauses for topic in topics_of(n)]
    if not plan.room_names:
        pairs = [pair for pair in pairs if pair[1] is not CommandTopic.ROOM]
    rounds, place = divmod(number, len(pairs))
    rng = Generator(PCG64(SeedSequence((seed, zlib.crc32(split.name.encode()), rounds, 1))))
    order = rng.permutation(len(pairs)).tolist()
    return [pairs[k] for k in (*order[place:], *order[:place])]


@dataclass(frozen=True)
class EpisodeDraft:
    """A text, its meanings, its true route and the right answer."""

    text: str
    meanings: tuple[Command, ...]
    route: tuple[Point, ...]
    expected: Expected


def _feasible(
    site: Site, drafter: Drafter, clauses: int, topic: CommandTopic, language: str
) -> EpisodeDraft | None:
    command = drafter.feasible(clauses, topic)
    route = None if command is None else _route(site, command, drafter.start)
    if command is None or route is None:
        return None
    closed = drafter.skips_a_closed_door(command)
    text = worded(command, language, drafter.rng, site.plan.room_names, closed=closed)
    return None if text is None else EpisodeDraft(text, (command,), route, Expected.FEASIBLE)


def _infeasible(
    site: Site, drafter: Drafter, clauses: int, topic: CommandTopic, language: str
) -> EpisodeDraft | None:
    command = drafter.infeasible(clauses)
    if command is None:
        return None
    route: tuple[Point, ...] | None = (drafter.start[:2],)
    if clauses > 1:
        route = _route(site, Command(command.clauses[:-1]), drafter.start)
    if route is None:
        return None
    text = worded(command, language, drafter.rng, site.plan.room_names)
    return None if text is None else EpisodeDraft(text, (command,), route, Expected.INFEASIBLE)


def _ambiguous(
    site: Site, drafter: Drafter, clauses: int, topic: CommandTopic, language: str
) -> EpisodeDraft | None:
    """Draw a text of which every reading can be carried out from a start."""
    first = drafter.turns(clauses - 1) if clauses > 1 else None
    if clauses > 1 and first is None:
        return None
    text, meanings = ambiguous_text(first, drafter.rng, language)
    if any(drafter.problem(meaning.clauses) for meaning in meanings):
        return None
    return EpisodeDraft(text, meanings, (), Expected.AMBIGUOUS)


_MAKERS = {
    Expected.FEASIBLE: _feasible,
    Expected.INFEASIBLE: _infeasible,
    Expected.AMBIGUOUS: _ambiguous,
}


def _episode(name: str, site: Site, start: Pose, language: str, said: EpisodeDraft) -> Episode:
    readings = tuple(meaning.say(language) for meaning in said.meanings)
    where = site.name, site.plan_hash, start
    episode = Episode(name, *where, said.text, language, readings, said.route, said.expected)
    return replace(episode, programs=said.meanings).understood(site.plan.room_names)


def _start(site: Site, split: Split, topic: CommandTopic, rng: Generator) -> Pose | None:
    """Draw a start at which every body can stand, rounded as in a file; in a room for "leave"."""
    in_room = topic is CommandTopic.LEAVE and split.expected is Expected.FEASIBLE
    pose = (_start_in_room if in_room and site.plan.rooms else _start_in_corridor)(site, rng)
    if pose is None:
        return None
    start = round(pose[0], 2), round(pose[1], 2), round(pose[2], 3)
    stands = placement_error(site.plan, LARGEST_BODY, start) is None
    return start if stands and site.part_at(start[:2]) is not None else None


def _start_in_corridor(site: Site, rng: Generator) -> Pose | None:
    """Draw a pose in a random corridor; None if no body has space in it."""
    try:
        return sample_start(site.plan, LARGEST_BODY, rng)
    except ValueError:
        return None


def _start_in_room(site: Site, rng: Generator) -> Pose | None:
    """Draw a pose in a room with one visible open door and space to turn around; else None."""
    plan = site.plan
    room = plan.rooms[int(rng.integers(len(plan.rooms)))]
    try:
        pose = sample_pose(plan, LARGEST_BODY, rng, room)
    except ValueError:
        return None
    fair = exits(plan, room.polygon) == 1 and len(doors_around(plan.scene, pose)) == 1
    return pose if fair and is_clear(plan, pose[:2], LIMITS.start_clearance) else None


def exits(plan: FloorPlan, room: shapely.Polygon) -> int:
    """Number of open doors of a room."""
    return sum(door.open and room.dwithin(shapely.Point(door.midpoint), 0.1) for door in plan.doors)


def _route(site: Site, command: Command, start: Pose) -> tuple[Point, ...] | None:
    """The true route; None if a body cannot drive it or the judge does not accept it."""
    judge = Judge(plan_mission(site.plan, site.geodesic, command, start), measures_way=False)
    if not LIMITS.min_route_length <= judge.mission.route_length <= LIMITS.max_route_length:
        return None
    places = [shapely.Point(place(goal)) for goal in judge.mission.goals]
    part = site.part_at(start[:2])
    if part is None or not all(part.near(point, LIMITS.goal_distance) for point in places):
        return None
    if not all(_has_room(site.plan, goal) for goal in judge.mission.goals):
        return None
    route = _simple(judge.mission.route)
    return route if carries_out(judge) else None


def _has_room(plan: FloorPlan, goal: Goal) -> bool:
    """Whether every body can stand at a goal that fixes a heading or a distance down a corridor.

    A goal may lie so near to a wall or a corner that no body could stop or turn there.
    """
    stands = isinstance(goal, ReachGoal) and (goal.fixes_heading or goal.corridor is not None)
    return not stands or placement_error(plan, LARGEST_BODY, goal.pose) is None


def _simple(route: FloatArray) -> tuple[Point, ...]:
    """A route with fewer points, in whole centimetres."""
    line = shapely.LineString(route).simplify(LIMITS.route_tolerance, preserve_topology=False)
    return tuple((float(x), float(y)) for x, y in np.round(line.coords, 2).tolist())
