"""Decides where to go next in a search: to a place to look from, or to somebody."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from semnav_env.agents.searching.search_map import SearchMap
from semnav_env.agents.searching.settings import SearchSettings
from semnav_env.agents.searching.views import (
    View,
    best_view,
    place_before,
    wanted_cells,
    ways_from,
)
from semnav_env.features.frames import Point, Pose
from semnav_env.robots import RobotSpec

SAME_PERSON = 1.0
"""Distance below which two places are of one person, metres."""


@dataclass
class Suspect:
    """Somebody who may be a person, and the places from which it was looked at."""

    place: Point
    tried: list[Point] = field(default_factory=list)


class Searcher:
    """Goes from view to view, and to whoever may be a person, until nothing is left.

    Args:
        chart: the map, which is kept up to date elsewhere.
        robot: the body.
        fov: field of view of the detector, radians.
        view_range: of the detector, metres.

    Attributes:
        target: where to go now, odometry frame; None when the search is over.
        done: whether nothing is left to look at.
    """

    def __init__(self, chart: SearchMap, robot: RobotSpec, fov: float, view_range: float) -> None:
        self.chart, self._robot, self._fov, self._range = chart, robot, fov, view_range
        self.target: Pose | None = None
        self.done = False
        self._view: View | None = None
        self._refused: list[Point] = []
        self._suspects: list[Suspect] = []
        self._suspect: Suspect | None = None
        self._steps = self._idle = self._looks = 0
        self._last: Pose | None = None

    @property
    def _settings(self) -> SearchSettings:
        return self.chart.settings

    def update(self, pose: Pose, people: list[tuple[Point, float, bool]]) -> Pose | None:
        """Where to go now; None when the search is over.

        Args:
            pose: believed pose of the robot.
            people: place, probability and whether it is reported, of whoever may be there.
        """
        self._steps += 1
        self._note_motion(pose)
        if self._suspect is not None:
            self._look_at_suspect(pose, people)
        elif self._view is not None:
            self._follow_view(pose)
        suspicious = self._steps % self._settings.recheck == 0
        if self.target is None or (suspicious and self._suspect is None):
            self._choose(pose, people, only_people=self.target is not None)
        return self.target

    def give_up(self) -> None:
        """Leave the target aside: it cannot be reached."""
        if self._view is not None:
            self.chart.tries.ravel()[self._view.cells] += 1
            self._refused.append(self._view.pose[:2])
        self._drop()

    def _note_motion(self, pose: Pose) -> None:
        """Give up a target that the robot does not get nearer to."""
        last = self._last
        moved = last is None or math.dist(last[:2], pose[:2]) > 0.1
        turned = last is not None and abs(math.remainder(last[2] - pose[2], math.tau)) > 0.2
        if moved or turned:
            self._last, self._idle = pose, 0
            return
        self._idle += 1
        if self._idle > self._settings.patience and self.target is not None:
            self._idle = 0
            self.give_up()

    def _drop(self) -> None:
        self.target = self._view = self._suspect = None

    def _arrived(self, pose: Pose) -> bool:
        assert self.target is not None
        near = math.dist(pose[:2], self.target[:2]) < self._settings.position_tolerance
        turned = abs(math.remainder(pose[2] - self.target[2], math.tau))
        return near and turned < self._settings.heading_tolerance

    def _follow_view(self, pose: Pose) -> None:
        """Drop a view that was taken, or that shows little that was not seen on the way."""
        assert self._view is not None
        cells, s = self._view.cells, self._settings
        if self._arrived(pose):
            left = cells[wanted_cells(self.chart).ravel()[cells]]
            self.chart.tries.ravel()[left] += 2
            self._drop()
        elif self._steps % s.recheck == 0:
            left_share = wanted_cells(self.chart).ravel()[cells].mean() if len(cells) else 0.0
            if left_share * self._view.gain < max(s.least_gain, 0.3 * self._view.gain):
                self._drop()

    def _look_at_suspect(self, pose: Pose, people: list[tuple[Point, float, bool]]) -> None:
        """Stand before somebody until it is clear who it is, or for a while."""
        assert self._suspect is not None
        place = self._suspect.place
        near = [each for each in people if math.dist(each[0], place) < SAME_PERSON]
        if not near or any(reported for _, _, reported in near):
            self._drop()
        elif self._arrived(pose):
            self._looks += 1
            self._idle = 0
            if self._looks > self._settings.person_looks:
                self._drop()

    def _choose(
        self, pose: Pose, people: list[tuple[Point, float, bool]], only_people: bool
    ) -> None:
        suspect = self._next_suspect(pose, people, near=True)
        if only_people and suspect is None:
            return
        ways = ways_from(self.chart, pose[:2], self._robot.width / 2 + 0.03)
        if suspect is None:
            room = int(self.chart.rooms[self.chart.cell(pose[:2])])
            self._view = best_view(
                self.chart, ways, pose, self._fov, self._range, room, self._refused
            )
            self.target = None if self._view is None else self._view.pose
            suspect = None if self.target else self._next_suspect(pose, people, near=False)
        while suspect is not None:
            place = place_before(self.chart, ways, suspect.place, suspect.tried)
            suspect.tried.append(suspect.place if place is None else place[:2])
            if place is not None:
                self._view, self._suspect, self.target, self._looks = None, suspect, place, 0
                return
            suspect = self._next_suspect(pose, people, near=False)
        self.done = self.target is None

    def _next_suspect(
        self, pose: Pose, people: list[tuple[Point, float, bool]], near: bool
    ) -> Suspect | None:
        """Whoever is to be looked at next: somebody near, or when nothing else is left anybody."""
        s = self._settings
        reported = [place for place, _, done in people if done]
        for place, probability, done in sorted(people, key=lambda each: -each[1]):
            known = any(math.dist(place, each) < SAME_PERSON for each in reported)
            if done or known or (near and probability < s.suspicion):
                continue
            if near and math.dist(place, pose[:2]) > self._range:
                continue
            suspect = self._suspect_at(place)
            if len(suspect.tried) < s.person_tries:
                suspect.place = place
                return suspect
        return None

    def _suspect_at(self, place: Point) -> Suspect:
        for each in self._suspects:
            if math.dist(each.place, place) < SAME_PERSON:
                return each
        self._suspects.append(Suspect(place))
        return self._suspects[-1]
