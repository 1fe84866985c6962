"""Selects the next target of a search: a viewpoint, or a place in front of a suspected person."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

from semnav_agents.searching.search_map import SearchMap
from semnav_agents.searching.settings import SearchSettings
from semnav_agents.searching.views import (
    Circle,
    Looker,
    View,
    ViewGrid,
    best_view,
    place_before,
    shown_from,
    wanted_cells,
)
from semnav_agents.searching.ways import Ways, ways_from
from semnav_features.frames import Point, Pose, wrap_angle

SAME_PERSON = 1.0
"""Distance below which two places are of one person, metres."""

HOME = 0.5
"""Distance from the start at which a robot counts as back, metres."""


@dataclass
class Suspect:
    """A suspected person, and the places from which the robot has observed it."""

    place: Point
    tried: list[Point] = field(default_factory=list)


class Searcher:
    """Visits viewpoints and suspected persons until none are left, then drives back.

    Args:
        chart: the map, which the agent updates.
        looker: body and detector.
        room: number of the plan's only room that is searched; None for all, after which the robot
            drives back.

    Attributes:
        target: the pose to drive to, odometry frame; None when the search is over.
        done: whether nothing is left to search; the robot then drives back to its start.
    """

    def __init__(self, chart: SearchMap, looker: Looker, room: int | None = None) -> None:
        self.chart, self._looker, self._room = chart, looker, room
        self.target: Pose | None = None
        self.done = False
        self._view: View | None = None
        self._refused: list[Circle] = []
        self._suspects: list[Suspect] = []
        self._suspect: Suspect | None = None
        self._steps = self._idle = self._looks = 0
        self._last: Pose | None = None
        self._start: Pose | None = None
        self._nearest, self._since = math.inf, 0
        self._failed = 0
        self._trail: list[Pose] = []

    @property
    def stuck(self) -> bool:
        """Whether two targets in succession could not be reached."""
        return self._failed >= 2

    @property
    def _settings(self) -> SearchSettings:
        return self.chart.settings

    def update(self, pose: Pose, people: list[tuple[Point, float, bool]]) -> Pose | None:
        """Update the target and return it; None when the search is over.

        Args:
            pose: believed pose of the robot.
            people: place, probability and whether it is reported, of each suspected person.
        """
        self._steps += 1
        self._start = pose if self._start is None else self._start
        self._note_motion(pose)
        self._note_progress(pose)
        if self._suspect is not None:
            self._look_at_suspect(pose, people)
        elif self._view is not None:
            self._follow_view(pose)
        elif self.target is not None and not self.done and self._arrived(pose):
            self._drop()  # it has gone back to where it can turn
            self._failed = 1
        suspicious = self._steps % self._settings.recheck == 0
        if self.done:
            self._look_back(pose, people)
        elif self.target is None or (suspicious and self._suspect is None):
            self._choose(pose, people, only_people=self.target is not None)
        return self.target

    def _look_back(self, pose: Pose, people: list[tuple[Point, float, bool]]) -> None:
        """Check now and then on the way back whether a target has appeared."""
        if self._steps % (5 * self._settings.recheck) == 0:
            self._choose(pose, people, only_people=False)

    def give_up(self) -> None:
        """Give up a target that cannot be reached; after two, drive back along the path."""
        self._failed += 1
        if self._view is not None:
            self.chart.tries.ravel()[self._view.cells] += 1
            self._refuse(self._view, self._settings.refused_distance)
        back = self._way_back() if self.stuck else None
        if self.done and self.stuck and back is None:
            self._start = None  # it cannot get back: here it stays
        self._drop()
        if back is not None:
            self.target, self.done = back, False

    def _way_back(self) -> Pose | None:
        """The last pose of the path that is far enough away; the path after it is dropped."""
        here = self._trail[-1] if self._trail else None
        while self._trail and here is not None:
            if math.dist(self._trail[-1][:2], here[:2]) > self._settings.retreat:
                return self._trail[-1]
            self._trail.pop()
        return None

    def _refuse(self, view: View, radius: float) -> None:
        self._refused.append((*view.pose[:2], radius))

    def _note_motion(self, pose: Pose) -> None:
        """Give up a target if the robot stands still."""
        last = self._last
        moved = last is None or math.dist(last[:2], pose[:2]) > 0.1
        turned = last is not None and abs(wrap_angle(last[2] - pose[2])) > 0.2
        if moved or turned:
            self._last, self._idle = pose, 0
            self._trail.append(pose)
            return
        self._idle += 1
        if self._idle > self._settings.patience and self.target is not None:
            self._idle = 0
            self.give_up()

    def _note_progress(self, pose: Pose) -> None:
        """Give up a target if the robot moves but does not come nearer to it."""
        if self.target is None or self._arrived(pose):
            self._nearest, self._since = math.inf, 0
            return
        away = math.dist(pose[:2], self.target[:2])
        self._since += 1
        if away < self._nearest - 0.1:
            self._nearest, self._since = away, 0
        elif self._since > self._settings.long_patience:
            self.give_up()

    def _drop(self) -> None:
        self.target = self._view = self._suspect = None
        self._looks, self._nearest, self._since = 0, math.inf, 0

    def _arrived(self, pose: Pose) -> bool:
        """Whether the target is reached; a robot that stands near it does not get any nearer."""
        assert self.target is not None
        s = self._settings
        exact = self._view is not None and self._idle <= s.settle
        tolerance = s.position_tolerance if exact else s.near_tolerance
        near = math.dist(pose[:2], self.target[:2]) < tolerance
        turned = abs(wrap_angle(pose[2] - self.target[2]))
        return near and turned < self._settings.heading_tolerance

    def _follow_view(self, pose: Pose) -> None:
        """Drop a view after the robot has stood there, or if little of it is still unseen."""
        assert self._view is not None
        s = self._settings
        self._looks += self._arrived(pose)
        if self._looks > s.settle:
            self._failed = 0
            self._note_look(self._view, pose)
            self._drop()
        elif self._steps % s.recheck == 0:
            left = self._left_share(self._view)
            gain = self._view.gain
            if left * gain < max(0.3 * gain, min(s.least_gain, 0.5 * gain)):
                self._drop()

    def _note_look(self, view: View, pose: Pose) -> None:
        """Add one try to unseen cells of a view, two to those that the present pose should show.

        A robot does not stop exactly at the pose of the view. A viewpoint that showed less than
        half of its expected cells is not used again; a viewpoint beside it may be.
        """
        chart = self.chart
        ought = shown_from(chart, pose, self._looker)
        chart.tries[ought] += 2
        left = view.cells[(wanted_cells(chart) & ~ought).ravel()[view.cells]]
        chart.tries.ravel()[left] += 1
        if self._left_share(view) > 0.5:
            self._refuse(view, self._settings.near_tolerance)

    def _left_share(self, view: View) -> float:
        """Share of the cells of a view that are still unseen."""
        left = wanted_cells(self.chart).ravel()[view.cells]
        return float(left.mean()) if len(left) else 0.0

    def _look_at_suspect(self, pose: Pose, people: list[tuple[Point, float, bool]]) -> None:
        """Stand in front of a suspected person until the track is decided, or for a while."""
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
        robot = self._looker.robot
        body = (robot, pose) if self._failed else None
        half_width = robot.width / 2 + 0.03
        ways = ways_from(self.chart, pose[:2], half_width, body)
        if suspect is None:
            self._view = self._next_view(ways, pose)
            if self._view is None and body is not None:  # the map's walls are too thick
                ways = ways_from(self.chart, pose[:2], half_width)
                self._view = self._next_view(ways, pose)
            self.target = None if self._view is None else self._view.pose
            suspect = None if self.target else self._next_suspect(pose, people, near=False)
        while suspect is not None:
            place = place_before(self.chart, ways, self._looker, suspect.place, suspect.tried)
            suspect.tried.append(suspect.place if place is None else place[:2])
            if place is not None:
                self._view, self._suspect, self.target, self._looks = None, suspect, place, 0
                self.done = False
                return
            suspect = self._next_suspect(pose, people, near=False)
        self.done = self.target is None
        if self._room is not None:
            return
        if self.done and self._start is not None and math.dist(pose[:2], self._start[:2]) > HOME:
            self.target = self._start

    def _next_view(self, ways: Ways, pose: Pose) -> View | None:
        """The best view; smaller views are tried before another room and before the end."""
        s, rooms = self._settings, self.chart.rooms
        if self._room is not None:
            coarse = ViewGrid(s.candidate_spacing, s.rays, self._room)
            fine = ViewGrid(s.fine_spacing, s.fine_rays, self._room, thorough=True)
            return self._best(ways, pose, coarse) or self._best(ways, pose, fine)
        room = int(rooms[self.chart.grid.cell(pose[:2])])
        view = self._best(ways, pose, ViewGrid(s.candidate_spacing, s.rays))
        if view is not None and (room < 0 or room == rooms[self.chart.grid.cell(view.pose[:2])]):
            return view
        fine = ViewGrid(s.fine_spacing, s.fine_rays, thorough=True)
        here = None if room < 0 else self._best(ways, pose, replace(fine, room=room))
        return here or view or self._best(ways, pose, fine)

    def _best(self, ways: Ways, pose: Pose, grid: ViewGrid) -> View | None:
        return best_view(self.chart, ways, pose, self._looker, grid, self._refused)

    def _next_suspect(
        self, pose: Pose, people: list[tuple[Point, float, bool]], near: bool
    ) -> Suspect | None:
        """The next suspected person: one that is near, or any if no view is left."""
        s = self._settings
        reported = [place for place, _, done in people if done]
        for place, probability, done in sorted(people, key=lambda each: -each[1]):
            known = any(math.dist(place, each) < SAME_PERSON for each in reported)
            if done or known or (near and probability < s.suspicion):
                continue
            if near and math.dist(place, pose[:2]) > self._looker.view_range:
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
