"""The payload of a search: detector, map of people, and the judge's measure of coverage."""

from __future__ import annotations

from typing import Any

import numpy as np

from semnav_env.judge.payload import PayloadMarks
from semnav_env.language.clauses import Clause
from semnav_env.language.finding_clauses import SearchHouse
from semnav_env.mind.belief import BeliefTracker
from semnav_env.rescue.outcome import Report, SearchOutcome, judge_reports
from semnav_env.rescue.person_detector import PersonDetector
from semnav_env.rescue.person_map import PersonMap
from semnav_env.rescue.room_coverage import RoomCoverage
from semnav_env.rescue.settings import PersonDetectorSettings, PersonMapSettings, SearchRules
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.simulator import Motion, RobotSetup
from semnav_features.frames import ORIGIN, Pose, compose, to_parent


class PersonSearch:
    """The payload of a robot that searches a house; give it as `payload=` to `SemNavEnv`.

    The detector takes a few frames a second. The map of people belongs to the robot and uses only
    its believed pose; it reports a person of whom it is sure, from a short distance. Coverage is
    measured by the judge.

    Args:
        detector: rates and errors of the detector.
        person_map: how detections become reports.
        rules: tolerances of the judge.

    Attributes:
        people: the robot's map of people.
        coverage: coverage of the rooms, by true poses.
        reports: reports of the robot.
        gained: area seen for the first time in the last control period, m^2.
        reported: value of the reports of the last control period: 1 for each victim found, -1 for
            each false report.
    """

    settings: PersonDetectorSettings
    map_settings: PersonMapSettings
    rules: SearchRules
    detector: PersonDetector
    people: PersonMap
    coverage: RoomCoverage
    gained: float
    reported: int

    def __init__(
        self,
        detector: PersonDetectorSettings = PersonDetectorSettings(),
        person_map: PersonMapSettings = PersonMapSettings(),
        rules: SearchRules = SearchRules(),
    ) -> None:
        self.settings, self.map_settings, self.rules = detector, person_map, rules

    def begin(
        self, plan: FloorPlan, setup: RobotSetup, start: Pose, rng: np.random.Generator
    ) -> None:
        """Begin an episode.

        Args:
            plan: with the people on its floor.
            setup: body and sensors of the robot.
            start: its true pose, world frame.
            rng: of the episode.
        """
        noise, mount = np.random.default_rng(rng.integers(2**62)), setup.robot.lidar_mount
        self.detector = PersonDetector(plan, self.settings, mount, noise)
        self.people = PersonMap(self.settings, self.map_settings, setup.lidar, mount)
        self.coverage = RoomCoverage(plan, setup.robot, self.settings)
        self.reports: list[Report] = []
        self._frame = ORIGIN if setup.exact else start
        self._victims = [(v.centroid.x, v.centroid.y) for v in self.detector.victims]
        self._every = max(1, round(setup.control_hz / self.settings.rate_hz))
        self._step, self._seconds = 0, 0.0
        self.gained, self.reported = 0.0, 0

    def update(self, motion: Motion, tracker: BeliefTracker) -> None:
        """Process one control period; the detector takes a frame in some of them.

        Args:
            motion: the true one.
            tracker: the robot's, after its update.
        """
        self.gained, self.reported = 0.0, 0
        if self._step % self._every == 0:
            self._look(motion.pose, tracker)
        self._step += 1
        self._seconds += motion.seconds

    def _look(self, pose: Pose, tracker: BeliefTracker) -> None:
        detector = self.detector
        detections = detector.look(pose)
        eye = compose(pose, detector.mount)
        self.gained = self.coverage.look(
            eye, detector.rays, detector.ranges, self.settings.range_max
        )
        new = self.people.update(detections, tracker.belief.pose, tracker.ranges)
        if new:
            before = self.outcome
            self.reports += [Report(to_parent(self._frame, t.place), self._seconds) for t in new]
            after = self.outcome
            wrong = after.false_reports - before.false_reports
            self.reported = after.found - before.found - wrong

    def fulfils(self, clause: Clause) -> bool:
        """Whether a clause whose goal was reached has been carried out in full."""
        return not isinstance(clause, SearchHouse) or self.outcome.fulfils(self.rules)

    @property
    def outcome(self) -> SearchOutcome:
        """The judgement of the search so far."""
        names, seen = self.coverage.names, self.coverage
        shares = dict(zip(names, seen.shares.tolist(), strict=True))
        floor = dict(zip(names, seen.floor_shares.tolist(), strict=True))
        return judge_reports(shares, floor, self._victims, self.reports, self.rules)

    def marks(self) -> PayloadMarks:
        """Marks for a picture: the floor that was seen, and the reports."""
        flags = np.array([report.place for report in self.reports]).reshape(-1, 2)
        outcome = self.outcome
        status = f"found: {outcome.found}   least covered: {outcome.least_coverage:.0%}"
        return PayloadMarks(self.coverage.seen_cells, flags, status)

    def start_info(self) -> dict[str, Any]:
        """Entries of `info` of `reset`: the robot knows the settings of its detector."""
        return {"person_detector": vars(self.settings).copy()}

    def final_info(self) -> dict[str, Any]:
        """Entries of `info` at the end of an episode."""
        return {"search": self.outcome.info}
