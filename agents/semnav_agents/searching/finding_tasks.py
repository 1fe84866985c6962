"""What a robot does for a clause to find people: search a room, turn once, or go to somebody."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple, Protocol, TypeAlias

import numpy as np

from semnav_agents.pilot_rules import REACH_TOLERANCE
from semnav_agents.searching.search_map import SearchMap
from semnav_agents.searching.searcher import SAME_PERSON, Searcher
from semnav_agents.searching.views import Looker, place_before, place_towards
from semnav_agents.searching.voice_places import VoicePlaces
from semnav_agents.searching.ways import ways_from
from semnav_env.rescue.microphones import MicrophoneSettings
from semnav_env.rescue.voice_fix import HeardVoice, PersonVoice, by_speaker
from semnav_features.frames import Point, Pose, to_local, wrap_angle

TURN_RATE = 1.0
"""Yaw rate of a look around, rad/s."""

TURN_MARGIN = 0.28
"""Distance from everything solid beside the body that turns on the spot, metres: it comes to within
0.2 m of the place to turn."""

LOOK_RADIUS = 1.1
"""Largest distance of the axle from where the clause began at the place to look around, metres: the
middle of a turning wheelchair comes 0.18 m farther, and 0.2 m more is the tolerance of the way
there."""

FACE_RADIUS = 3.0
"""The same where the robot only turns to face a door, metres."""

FACED = math.radians(30.0)
"""Angle from straight ahead up to which the robot faces a door."""

PATIENCE = 200
"""Control periods after which the robot turns where it is, though it has not come to that place."""

STALLED = 15
"""Control periods without turning after which the robot turns the other way."""

STILL = 0.01
"""Turn in a control period below which the robot does not turn, radians."""

SURE = 0.9
"""Probability from which on a possible person counts as found."""

TALKING_RANGE = 1.8
"""Distance within which a robot is with a person, metres: a little less than the judge's."""

MOST_PLACES = 6
"""Places before one person that are tried with a margin around the body, and then without one."""

SAME_DIRECTION = 3.0
"""Standard deviations up to which a voice may come from a known person."""

People: TypeAlias = list[tuple[Point, float, bool]]
"""Place (odometry frame), probability and whether it is reported, of each possible person."""


class Percepts(NamedTuple):
    """What is known of people: the possible ones, and the voices, odometry frame."""

    people: People
    voices: Sequence[PersonVoice] = ()


class FindingStep(NamedTuple):
    """What to do in a control period: drive to a pose, or turn on the spot, or stand still.

    Attributes:
        target: pose to drive to, odometry frame; None to stay.
        yaw_rate: of a turn on the spot, rad/s.
        careful: whether to plan with a margin alone.
        tolerance: distance from the pose at which the robot stops, metres.
    """

    target: Pose | None = None
    yaw_rate: float = 0.0
    careful: bool = True
    tolerance: float = REACH_TOLERANCE

    @property
    def is_idle(self) -> bool:
        """Whether there is nothing to do."""
        return self.target is None and self.yaw_rate == 0.0


class FindingTask(Protocol):
    """A clause to find people, under way."""

    def next_step(self, pose: Pose, seen: Percepts) -> FindingStep:
        """What to do now, at a believed pose."""
        ...


class SearchTask:
    """Searches one room of the plan, or the whole house.

    Args:
        chart: the map.
        looker: body and detector.
        room: number of the room; None for all.
    """

    def __init__(self, chart: SearchMap, looker: Looker, room: int | None) -> None:
        self._searcher = Searcher(chart, looker, room)

    def next_step(self, pose: Pose, seen: Percepts) -> FindingStep:
        """See `FindingTask`."""
        target = self._searcher.update(pose, seen.people)
        careful, tolerance = not self._searcher.stuck, self._searcher.chart.settings.stop_tolerance
        return FindingStep(target, careful=careful, tolerance=tolerance)


class LookTask:
    """Turns on the spot once, where there is room for the body to turn.

    A robot that something holds up turns the other way.

    Args:
        chart: the map.
        looker: body and detector.
        pose: where the clause began.
        radius: largest distance of the place to turn from there, metres.
    """

    def __init__(
        self, chart: SearchMap, looker: Looker, pose: Pose, radius: float = LOOK_RADIUS
    ) -> None:
        self._axle = looker.robot.axle
        self._place: Pose | None = _place_to_turn(chart, looker, pose, radius)
        self._patience = PATIENCE
        self._tolerance = chart.settings.near_tolerance
        self._turned, self._heading = 0.0, pose[2]
        self._least = self._most = 0.0
        self._rate, self._idle = TURN_RATE, 0

    def next_step(self, pose: Pose, seen: Percepts) -> FindingStep:
        """See `FindingTask`."""
        del seen
        if self._place is not None:
            self._patience -= 1
            away = math.dist(_axle(pose, self._axle), _axle(self._place, self._axle))
            if away > self._tolerance and self._patience > 0:
                return FindingStep(self._place)
            self._place, self._heading = None, pose[2]
        self._note_turn(pose[2])
        return FindingStep() if self._is_done(pose) else FindingStep(yaw_rate=self._rate)

    def _is_done(self, pose: Pose) -> bool:
        """Whether it has turned far enough."""
        return self._most - self._least >= math.tau

    def _note_turn(self, heading: float) -> None:
        """Note how far it has turned to each side, and change the side if it does not turn."""
        turn = wrap_angle(heading - self._heading)
        self._heading, self._turned = heading, self._turned + turn
        self._least, self._most = min(self._least, self._turned), max(self._most, self._turned)
        self._idle = self._idle + 1 if abs(turn) < STILL else 0
        if self._idle > STALLED:
            self._rate = -TURN_RATE if self._rate > 0.0 else 0.0
            self._idle = 0


class FaceTask(LookTask):
    """Turns towards the door of a room, where there is room for the body to turn.

    Into a room in which somebody may lie the robot does not back, as it sees little behind.

    Args:
        chart: the map.
        looker: body and detector.
        pose: where the robot is.
        door: place of the door.
    """

    def __init__(self, chart: SearchMap, looker: Looker, pose: Pose, door: Point) -> None:
        super().__init__(chart, looker, pose, FACE_RADIUS)
        self._door = door

    def _is_done(self, pose: Pose) -> bool:
        x, y = to_local(pose, self._door)
        gone_round = super()._is_done(pose)
        return gone_round or self._rate == 0.0 or abs(math.atan2(y, x)) < FACED


class PersonTask:
    """Goes to the nearest person that was found and was not gone to before.

    If nobody was found, but somebody else has answered, it goes to where the voice tells more. If
    nobody is heard either, it looks at those who may be people. Where no way leads to a person, it
    looks from the nearest place that it can reach.

    Args:
        chart: the map.
        looker: body and detector.
        microphones: their errors by distance and walls.
        visited: places of the people to whom the robot went; it adds one.
        again: whether it may stay with the person to whom it went last.
    """

    def __init__(
        self,
        chart: SearchMap,
        looker: Looker,
        microphones: MicrophoneSettings,
        visited: list[Point],
        *,
        again: bool,
    ) -> None:
        self._chart, self._looker, self._visited = chart, looker, visited
        self._places = VoicePlaces(chart, looker, microphones)
        self._again = again
        self._person: Point | None = None
        self._target: Pose | None = None
        self._tried: list[Point] = []
        self._waited = self._looked = 0
        self._careful, self._done = True, False
        self._last: Pose | None = None

    def next_step(self, pose: Pose, seen: Percepts) -> FindingStep:
        """See `FindingTask`."""
        if self._again and self._visited and _is_with(pose, self._visited[-1]):
            self._done = True
        if self._done:
            return FindingStep()
        if self._person is None and not self._finds(pose, seen.people, SURE):
            towards = self._places.next_place(pose, _clearest(seen.voices, self._visited))
            suspicion = self._chart.settings.suspicion
            if towards is not None or not self._finds(pose, seen.people, suspicion):
                return FindingStep(towards)
        return self._step_before(pose, seen)

    def _finds(self, pose: Pose, people: People, least: float) -> bool:
        """Choose the nearest who is a person with a least probability and was not gone to before.

        Returns whether there is somebody.
        """
        found = [place for place, share, reported in people if reported or share >= least]
        new = [p for p in found if all(math.dist(p, v) >= SAME_PERSON for v in self._visited)]
        self._person = min(new, key=lambda place: math.dist(place, pose[:2]), default=None)
        self._tried, self._careful = [], True
        return self._person is not None

    def _step_before(self, pose: Pose, seen: Percepts) -> FindingStep:
        """What to do to see the chosen person from near, unless it turns out to be nobody."""
        assert self._person is not None
        near = [each for each in seen.people if math.dist(each[0], self._person) < SAME_PERSON]
        voices = by_speaker(seen.voices).values()
        if near:
            self._person = near[0][0]
        elif not any(_come_from(self._person, each) for each in voices):
            self._person = self._target = None
            return FindingStep()
        if self._target is None:
            self._choose(pose)
        elif self._arrived(pose):
            self._look(any(reported for _, _, reported in near))
        elif self._stays(pose):
            self._target = None
        return FindingStep(self._target, careful=self._careful)

    def _choose(self, pose: Pose) -> None:
        """Take the next place before the person, if one is left to be tried."""
        assert self._person is not None
        if len(self._tried) == MOST_PLACES:
            self._done, self._careful, self._tried = not self._careful, False, []
        if self._done:
            return
        half_width = self._looker.robot.width / 2 + 0.03
        ways = ways_from(self._chart, pose[:2], half_width)
        told = self._chart, ways, self._looker, self._person, self._tried
        self._target = place_before(*told) or place_towards(*told)
        self._tried.append(self._person if self._target is None else self._target[:2])
        self._waited = self._looked = 0

    def _arrived(self, pose: Pose) -> bool:
        assert self._target is not None
        s = self._chart.settings
        near = math.dist(pose[:2], self._target[:2]) < s.near_tolerance
        return near and abs(wrap_angle(pose[2] - self._target[2])) < s.heading_tolerance

    def _look(self, reported: bool) -> None:
        """Stand before the person until it is reported, or for a while."""
        assert self._person is not None
        self._looked += 1
        if reported:
            self._visited.append(self._person)
            self._done, self._target = True, None
        elif self._looked > self._chart.settings.person_looks:
            self._target = None

    def _stays(self, pose: Pose) -> bool:
        """Whether the robot has not moved for a while."""
        last = self._last
        moved = last is None or math.dist(last[:2], pose[:2]) > 0.1
        if moved or (last is not None and abs(wrap_angle(last[2] - pose[2])) > 0.2):
            self._last, self._waited = pose, 0
        self._waited += 1
        return self._waited > self._chart.settings.patience


def _clearest(voices: Sequence[PersonVoice], known: Sequence[Point]) -> list[HeardVoice]:
    """The directions of the speaker who was heard most clearly, and is not at a known place."""
    speakers = by_speaker(voices).values()
    others = [each for each in speakers if not any(_come_from(place, each) for place in known)]
    return min(others, key=lambda each: min(voice.std for voice in each), default=[])


def _come_from(place: Point, voices: Sequence[HeardVoice]) -> bool:
    """Whether all directions of a voice may be those of somebody at a place."""
    x, y = place
    return all(
        abs(wrap_angle(math.atan2(y - v.pose[1], x - v.pose[0]) - v.direction))
        <= SAME_DIRECTION * v.std
        for v in voices
    )


def _is_with(pose: Pose, person: Point) -> bool:
    return math.dist(pose[:2], person) <= TALKING_RANGE


def _axle(pose: Pose, axle: float) -> Point:
    """The point that a body at a pose turns about."""
    return pose[0] + axle * math.cos(pose[2]), pose[1] + axle * math.sin(pose[2])


def _place_to_turn(chart: SearchMap, looker: Looker, pose: Pose, radius: float) -> Pose | None:
    """The nearest place where the body can turn about its axle; None for where it is."""
    robot = looker.robot
    ways = ways_from(chart, pose[:2], robot.width / 2 + 0.03)
    reach = math.hypot(robot.length / 2 + abs(robot.axle), robot.width / 2) + TURN_MARGIN
    if ways.room[chart.grid.cell(_axle(pose, robot.axle))] >= reach:
        return None
    cells = np.argwhere((ways.room >= reach) & np.isfinite(ways.costs))
    if not len(cells):
        return None
    points = chart.grid.points(cells)
    away = np.hypot(*(points - pose[:2]).T)
    costs = np.where(away <= radius, ways.costs[tuple(cells.T)], np.inf)
    best = int(np.argmin(costs))
    if not math.isfinite(costs[best]):
        return None
    x, y = points[best].tolist()
    heading = math.atan2(y - pose[1], x - pose[0])
    return *_axle((x, y, heading), -robot.axle), heading
