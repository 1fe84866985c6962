"""The ways of finding somebody, each tried in one house; the robot knows where it is."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from shapely import Point as Place

from semnav_env.rescue.microphones import USUAL_MICROPHONES, MicrophoneArray
from semnav_env.rescue.person_detector import PersonDetector
from semnav_env.rescue.person_map import PersonMap
from semnav_env.rescue.room_coverage import RoomCoverage
from semnav_env.rescue.settings import PersonDetectorSettings, PersonMapSettings, SearchRules
from semnav_env.rescue.voice_fix import HeardVoice, PersonVoice, by_speaker, fix
from semnav_env.robots import SPOT
from semnav_env.world.lidar.lidar import Lidar
from semnav_features.frames import Point, Pose, compose, heading_between
from semnav_features.lidars import TIM561
from studies.finding.houses import House

SPEED, YAW_RATE = 0.5, 0.8
"""Speeds on the way and on the spot, m/s and rad/s: those that a search of a house assumes."""

HEADINGS = 6
"""Headings of a look around; the camera stands still for a second at each."""

VIEWPOINTS = 4
"""Largest number of places of a room from which it is looked at."""

DETECTOR = PersonDetectorSettings()
FAR_REPORTS = PersonMapSettings(report_range=DETECTOR.range_max)
"""The map of people; it reports also those that the robot does not go near."""

APPROACH, APPROACH_SECONDS = 1.3, 3
"""Distance from a person from which the robot looks, metres, and how long, seconds."""

MAX_FIX_STD = 1.0
"""Largest standard deviation of a place in any direction with which a speaker is reported,
metres."""


@dataclass(frozen=True)
class WayResult:
    """What one way found in one house.

    Attributes:
        errors: distance of each person from the nearest report of this person, metres; inf
            without one.
        false_reports: of nobody.
        seconds: for driving, turning, looking and calling.
        coverage: mean seen share of the visible floor of the rooms.
    """

    errors: tuple[float, ...]
    false_reports: int
    seconds: float
    coverage: float


class PersonCamera:
    """The person detector of a robot that looks around at places of a house."""

    def __init__(self, house: House, rng: np.random.Generator) -> None:
        mount = SPOT.lidar_mount
        self._detector = PersonDetector(house.plan, DETECTOR, mount, rng)
        self._lidar = Lidar(house.plan, TIM561, mount)
        self._coverage = RoomCoverage(house.plan, SPOT, DETECTOR)
        self._people = PersonMap(DETECTOR, FAR_REPORTS, TIM561, mount)

    def look(self, pose: Pose, seconds: int = 1) -> None:
        """Take frames from one pose for some seconds."""
        ranges = self._lidar.exact_ranges(pose)
        for _ in range(seconds * round(DETECTOR.rate_hz)):
            self._people.update(self._detector.look(pose), pose, ranges)
        seen = self._detector.rays, self._detector.ranges, DETECTOR.range_max
        self._coverage.look(compose(pose, SPOT.lidar_mount), *seen)

    def look_around(self, place: Point) -> None:
        """Look in all directions."""
        for k in range(HEADINGS):
            self.look((*place, math.tau * k / HEADINGS))

    @property
    def reports(self) -> list[Point]:
        """Where the reported people are believed to be."""
        return [track.place for track in self._people.tracks if track.reported]

    @property
    def coverage(self) -> float:
        """Mean seen share of the rooms."""
        return float(self._coverage.shares.mean())


def turn_and_look(house: House, rng: np.random.Generator) -> WayResult:
    """Go into each room, turn on the spot and look."""
    return _look_from(house, 1, rng)


def look_from_viewpoints(house: House, rng: np.random.Generator) -> WayResult:
    """Look around from several places of each room."""
    return _look_from(house, VIEWPOINTS, rng)


def call_and_listen(house: House, rng: np.random.Generator) -> WayResult:
    """Call in each room; report where directions of a voice cross."""
    places, heard = _called(house, rng)
    return compared(house, _located(heard), _seconds(house, places, calls=len(places)), 0.0)


def call_with_one_microphone(house: House, rng: np.random.Generator) -> WayResult:
    """Call in each room; report the middle of the room in which a voice is clearest (Mes 2021)."""
    places, heard = _called(house, rng)
    reports = []
    for voices in heard.values():
        clearest = min(voices, key=lambda voice: voice.std).pose[:2]
        room = next(r for r in house.plan.rooms if r.polygon.contains(Place(clearest)))
        reports.append((room.polygon.centroid.x, room.polygon.centroid.y))
    return compared(house, reports, _seconds(house, places, calls=len(places)), 0.0)


def call_and_approach(house: House, rng: np.random.Generator) -> WayResult:
    """Call and listen, then go to each person and look."""
    places, heard = _called(house, rng)
    camera, calls = PersonCamera(house, rng), len(places)
    for person in _located(heard):
        stand = _before(house, person)
        if stand is not None:
            camera.look((*stand, heading_between(stand, person)), APPROACH_SECONDS)
            places = [*places, stand]
    looks = APPROACH_SECONDS * (len(places) - calls)
    seconds = _seconds(house, places, calls=calls, looks=looks)
    return compared(house, camera.reports, seconds, camera.coverage)


WAYS: dict[str, Callable[[House, np.random.Generator], WayResult]] = {
    "turn on the spot and look": turn_and_look,
    "look from several places": look_from_viewpoints,
    "call, one microphone": call_with_one_microphone,
    "call and listen": call_and_listen,
    "call, listen and approach": call_and_approach,
}
"""The ways by what they are called in the table."""


def _look_from(house: House, most: int, rng: np.random.Generator) -> WayResult:
    camera = PersonCamera(house, rng)
    places = house.tour([p for r in house.plan.rooms for p in house.places(r.polygon, most)])
    for place in places:
        camera.look_around(place)
    seconds = _seconds(house, places, looks=HEADINGS * len(places), turns=len(places))
    return compared(house, camera.reports, seconds, camera.coverage)


def _called(
    house: House, rng: np.random.Generator
) -> tuple[list[Point], dict[int, list[HeardVoice]]]:
    """Where the robot called, and the directions of each person's voice."""
    microphones = MicrophoneArray(house.plan, USUAL_MICROPHONES, rng)
    places = house.tour([p for r in house.plan.rooms for p in house.places(r.polygon, 2)])
    heard: list[PersonVoice] = []
    for place in places:
        pose = (*place, 0.0)
        for person, bearing, std in microphones.call(pose):
            heard.append(PersonVoice(person, HeardVoice(pose, bearing, std)))
    return places, by_speaker(heard)


def _located(heard: dict[int, list[HeardVoice]]) -> list[Point]:
    """Where directions of a voice cross, if that is known well enough."""
    found = [each for voices in heard.values() if (each := fix(voices)) is not None]
    stds = [math.sqrt(float(np.linalg.eigvalsh(each.covariance)[-1])) for each in found]
    return [each.place for each, std in zip(found, stds, strict=True) if std <= MAX_FIX_STD]


def _before(house: House, person: Point) -> Point | None:
    """The place in the person's room that is nearest to `APPROACH` from the person."""
    rooms = [r.polygon for r in house.plan.rooms if r.polygon.contains(Place(person))]
    places = [place for room in rooms for place in house.places(room, 100)]
    places = [p for p in places if math.isfinite(house.geodesic.to(p).length(house.start))]
    return min(places, key=lambda p: abs(math.dist(p, person) - APPROACH), default=None)


def _seconds(
    house: House, places: list[Point], looks: int = 0, turns: int = 0, calls: int = 0
) -> float:
    spent = looks + turns * math.tau / YAW_RATE + calls * USUAL_MICROPHONES.listening
    return house.metres(places) / SPEED + spent


def compared(house: House, reports: list[Point], seconds: float, coverage: float) -> WayResult:
    """Compare reports with the people; a report counts for the person who is nearest to it."""
    apart = np.array([[math.dist(r, p) for p in house.people] for r in reports])
    apart = apart.reshape(-1, len(house.people))
    own = np.where(apart == apart.min(axis=1, keepdims=True), apart, np.inf)
    errors = own.min(axis=0, initial=np.inf)
    false = np.count_nonzero(apart.min(axis=1) > SearchRules().report_distance)
    return WayResult(tuple(errors.tolist()), int(false), seconds, coverage)
