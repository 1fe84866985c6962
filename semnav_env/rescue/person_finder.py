"""The payload of a robot that is told how to find people: a camera, microphones and a voice."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from shapely import Point as Place
from shapely.geometry.base import BaseGeometry

from semnav_env.language.clauses import Clause
from semnav_env.language.finding_clauses import (
    AskName,
    CallOut,
    FindingClause,
    GoToPerson,
    LookAround,
    SearchRoom,
)
from semnav_env.language.rooms import plain_name
from semnav_env.mind.belief import BeliefTracker
from semnav_env.rescue.call_and_listen import NEXT_CALL_DISTANCE, STILL_SPEED, STILL_YAW_RATE
from semnav_env.rescue.microphones import USUAL_MICROPHONES, MicrophoneArray, MicrophoneSettings
from semnav_env.rescue.person_map import PersonTrack
from semnav_env.rescue.person_search import PersonSearch
from semnav_env.rescue.settings import PersonDetectorSettings, PersonMapSettings, SearchRules
from semnav_env.rescue.voice_fix import HeardVoice, PersonVoice, by_speaker, fix
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.simulator import Motion, RobotSetup
from semnav_features.frames import Pose, to_parent

NAMES = ("Ada", "Ben", "Clara", "David", "Emma", "Felix", "Greta", "Hugo", "Ida", "Jonas")
"""Names of the people; they are dealt out anew in each episode."""

HEADING_BINS = 72
"""Directions of a look around, 5 degrees apart."""

TALKING_SECONDS = 2.0
"""Time for which the robot stands still to ask for a name and to hear it, seconds."""

LOCATED_STD = 1.0
"""Largest standard deviation of a place in any direction with which a voice makes a track,
metres."""


@dataclass
class ClauseLog:
    """What has happened since a clause began.

    Attributes:
        place: where it began, world frame; None before its first control period.
        looked: the directions that the camera has seen from there, shape (`HEADING_BINS`,).
        called: whether the robot has called.
        asked: whether it has asked somebody for the name.
        still: for how long it has stood still, seconds.
    """

    place: Place | None = None
    looked: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(HEADING_BINS, np.bool_))
    called: bool = False
    asked: bool = False
    still: float = 0.0


class PersonFinder(PersonSearch):
    """The payload for all clauses to find people; give it as `payload=` to `SemNavEnv`.

    It is a `PersonSearch` with microphones and a voice. When the robot believes that it is to call,
    it calls as soon as it has stood still for as long as a call and its answers last. On its way to
    a person it calls again wherever it stands so long, as long as somebody has answered whose place
    is not known. Directions of one voice from several places make a track in the map of people.
    When it is to ask for a name, it asks the nearest person within `SearchRules.person_distance`
    and behind no wall, who says the name if he or she can answer.

    Args:
        detector: rates and errors of the detector.
        person_map: how detections become reports.
        rules: tolerances of the judge.
        microphones: their errors, and who can answer.

    Attributes:
        voices: directions of voices, in the order in which they were heard, odometry frame.
    """

    microphones: MicrophoneSettings
    voices: list[PersonVoice]

    def __init__(
        self,
        detector: PersonDetectorSettings = PersonDetectorSettings(),
        person_map: PersonMapSettings = PersonMapSettings(),
        rules: SearchRules = SearchRules(),
        microphones: MicrophoneSettings = USUAL_MICROPHONES,
    ) -> None:
        super().__init__(detector, person_map, rules)
        self.microphones = microphones

    def begin(
        self, plan: FloorPlan, setup: RobotSetup, start: Pose, rng: np.random.Generator
    ) -> None:
        """See `Payload`."""
        super().begin(plan, setup, start, rng)
        drawn = np.random.default_rng([self._seed, 1])
        self._array = MicrophoneArray(plan, self.microphones, drawn)
        self._dealt = drawn.permutation(len(NAMES)).tolist()
        self._regions = (*plan.rooms, *plan.areas, *plan.corridors, *plan.intersections)
        self._pose, self._log, self._ended = start, ClauseLog(), False
        self.voices = []
        self._heard: dict[int, PersonTrack] = {}
        self._visited, self._reached = set[int](), set[int]()
        self._called_at: list[Pose] = []

    @property
    def calls(self) -> int:
        """Number of calls so far."""
        return len(self._called_at)

    def update(self, motion: Motion, tracker: BeliefTracker) -> None:
        """See `Payload`."""
        if self._ended:
            self._visited |= self._reached
            self._log, self._ended, self._reached = ClauseLog(), False, set()
        super().update(motion, tracker)
        self._pose = motion.pose
        self._note_view()
        stands = abs(motion.speed) < STILL_SPEED and abs(motion.yaw_rate) < STILL_YAW_RATE
        self._log.still = self._log.still + motion.seconds if stands else 0.0
        follower = tracker.follower
        clause = None if follower.done else follower.command.clauses[follower.active]
        first = isinstance(clause, CallOut) and not self._log.called
        if first or (isinstance(clause, GoToPerson | AskName) and self._calls_again(tracker)):
            self._call(tracker.belief.pose)
        if isinstance(clause, AskName) and self._log.still >= TALKING_SECONDS:
            self._ask(tracker.belief.pose)

    def _note_view(self) -> None:
        """Note in which directions the camera looks, near where the clause began."""
        x, y, heading = self._pose
        log = self._log
        log.place = Place(x, y) if log.place is None else log.place
        if log.place.distance(Place(x, y)) <= self.rules.look_distance:
            angles = math.tau * np.arange(HEADING_BINS) / HEADING_BINS - heading
            off = np.abs(np.angle(np.exp(1j * (angles - self.detector.mount[2]))))
            log.looked |= off <= self.settings.field_of_view / 2

    def _calls_again(self, tracker: BeliefTracker) -> bool:
        """Whether a call from here may locate somebody who has answered."""
        here = tracker.belief.pose[:2]
        near = any(math.dist(here, each[:2]) < NEXT_CALL_DISTANCE for each in self._called_at)
        return not near and not by_speaker(self.voices).keys() <= self._heard.keys()

    def _call(self, believed: Pose) -> None:
        """Call once the robot has stood still for long enough, and locate who answers."""
        if self._log.still < self.microphones.listening:
            return
        self._log.called = True
        self._called_at.append(believed)
        for person, bearing, std in self._array.call(self._pose):
            self.voices.append(PersonVoice(person, HeardVoice(believed, bearing, std)))
            found = fix(by_speaker(self.voices)[person])
            if found is not None and _largest_std(found.covariance) <= LOCATED_STD:
                self._locate(person, found.place, _largest_std(found.covariance))

    def _locate(self, person: int, place: tuple[float, float], std: float) -> None:
        known = self._heard.get(person)
        if known is not None and not known.reported and known in self.people.tracks:
            known.place, known.weight = place, 1.0 / std**2
        elif (track := self.people.hear(place, std)) is not None:
            self._heard[person] = track

    def _ask(self, believed: Pose) -> None:
        """Ask the nearest person for the name, once."""
        near = self._array.near(self._pose, self.rules.person_distance)
        if self._log.asked or not near:
            return
        self._log.asked = True
        self._reached.add(near[0])
        tracks = self.people.tracks
        track = min(tracks, key=lambda t: math.dist(t.place, believed[:2]), default=None)
        if track is not None and self._array.can_answer(near[0]):
            track.name = NAMES[self._dealt[near[0] % len(NAMES)]]

    def fulfils(self, clause: Clause) -> bool:
        """See `Payload`: whether a clause, at whose end the robot stands still, has been done.

        - A search: 95 % of the floor of the room that can be seen has been seen, everybody in it
          has a report within 1 m, and there is no false report.
        - A look around: the camera has seen all directions from within 1.5 m of where it
          began.
        - A call, and a question: they were made.
        - The way to a person: the robot is within 2 m of somebody to whom the command has not led
          before, no wall is between, and this person has a report within 1 m.
        """
        self._ended = True
        match clause:
            case SearchRoom():
                return self._has_searched(self._region_of(clause))
            case LookAround():
                return bool(self._log.looked.all())
            case CallOut():
                return self._log.called
            case GoToPerson():
                return bool(self._at_people())
            case AskName():
                return self._log.asked
        return super().fulfils(clause) if isinstance(clause, FindingClause) else True

    def _region_of(self, clause: SearchRoom) -> BaseGeometry:
        """The outline of the room that a clause names, or of the one where the robot is."""
        named = None if clause.room is None else clause.room.name
        here = Place(self._pose[:2])
        regions = [r for r in self._regions if named in (None, plain_name(r.name))]
        return min(regions, key=lambda region: region.polygon.distance(here)).polygon

    def _has_searched(self, region: BaseGeometry) -> bool:
        outcome, near = self.outcome, self.rules.report_distance
        inside = [victim for victim in self._victims if region.contains(Place(victim))]
        found = all(any(math.dist(r.place, v) <= near for r in self.reports) for v in inside)
        covered = self.coverage.share_in(region) >= self.rules.coverage
        return covered and found and outcome.false_reports <= self.rules.false_reports

    def _at_people(self) -> set[int]:
        """The people to whom the robot has come, and to whom the command has not led before."""
        near = self._array.near(self._pose, self.rules.person_distance)
        least = self.rules.report_distance
        self._reached = {
            person
            for person in near
            if person not in self._visited
            and any(math.dist(r.place, self._victims[person]) <= least for r in self.reports)
        }
        return self._reached

    def start_info(self) -> dict[str, Any]:
        """See `Payload`: the robot knows the settings of its detector and its microphones."""
        return super().start_info() | {"microphones": vars(self.microphones).copy()}

    def final_info(self) -> dict[str, Any]:
        """See `Payload`: also where people are believed to be, world frame, and their names.

        `voices` are the places by voice alone, with their largest standard deviation, metres, by
        number of the person, of those whose directions cross.
        """
        people = [
            {
                "place": to_parent(self._frame, track.place),
                "probability": track.probability,
                "reported": track.reported,
                "name": track.name,
            }
            for track in self.people.tracks
        ]
        fixes = {person: fix(voices) for person, voices in by_speaker(self.voices).items()}
        by_voice = {
            person: {
                "place": to_parent(self._frame, each.place),
                "std": _largest_std(each.covariance),
            }
            for person, each in fixes.items()
            if each is not None
        }
        found = {"people": people, "calls": self.calls, "voices": by_voice}
        return super().final_info() | {"found": found}


def _largest_std(covariance: NDArray[np.float64]) -> float:
    return math.sqrt(float(np.linalg.eigvalsh(covariance)[-1]))
