"""Goes towards a voice: to places from which another direction of it tells where the speaker is."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from semnav_agents.searching.search_map import SearchMap
from semnav_agents.searching.view_kernels import fits
from semnav_agents.searching.views import Looker
from semnav_agents.searching.ways import Ways, ways_from
from semnav_env.rescue.call_and_listen import NEXT_CALL_DISTANCE
from semnav_env.rescue.microphones import MicrophoneSettings
from semnav_env.rescue.voice_fix import HeardVoice
from semnav_features.frames import FloatArray, Point, Pose

ENOUGH_STD = 0.5
"""Standard deviation of a place of a speaker, in its least certain direction, with which the robot
is content, metres: from there on it looks."""

MOST_LISTENING_PLACES = 4
"""Places from which a voice is listened to."""

LISTENING_STEPS = 90
"""Control periods for which the robot stands at such a place: the call takes 60 of them."""

FLOOR_STEP, PLACE_STEP = 3, 6
"""Cells of the map between two places of a speaker, and between two places to listen that are
tried."""


class VoicePlaces:
    """Where a robot that has heard a voice goes, to hear it from another direction.

    The speaker is somewhere on the floor of the plan. Each direction makes the places near its line
    more likely, by a normal distribution whose standard deviation comes with it.

    Args:
        chart: the map.
        looker: body and detector.
        microphones: their errors by distance and walls.
    """

    def __init__(self, chart: SearchMap, looker: Looker, microphones: MicrophoneSettings) -> None:
        self._chart, self._looker, self._microphones = chart, looker, microphones
        self._target: Pose | None = None
        self._known = self._stood = self._driven = 0
        self._tried: list[Point] = []

    def next_place(self, pose: Pose, voices: Sequence[HeardVoice]) -> Pose | None:
        """Where to be now; None if nothing more is to be heard.

        Args:
            pose: of the robot, odometry frame.
            voices: directions of one voice, the same frame.
        """
        if len(voices) != self._known:
            self._known, self._target = len(voices), None
        if self._target is not None and self._is_heard_out(pose):
            self._target = None
        if self._target is None and voices and len(self._tried) < MOST_LISTENING_PLACES:
            self._target = self._choose(pose, voices)
            self._tried.append(pose[:2] if self._target is None else self._target[:2])
            self._stood = self._driven = 0
        return self._target

    def _is_heard_out(self, pose: Pose) -> bool:
        """Whether the robot has stood there for a whole call, or tried too long to get there."""
        assert self._target is not None
        settings = self._chart.settings
        there = math.dist(pose[:2], self._target[:2]) < settings.near_tolerance
        self._stood, self._driven = self._stood + there, self._driven + (not there)
        return self._stood > LISTENING_STEPS or self._driven > settings.long_patience

    def _choose(self, pose: Pose, voices: Sequence[HeardVoice]) -> Pose | None:
        """The nearest place that would tell enough, or the one that would tell most."""
        place, covariance = self.speaker(voices)
        ways = ways_from(self._chart, pose[:2], self._looker.robot.width / 2 + 0.03)
        places = self._places(ways, place, voices)
        if not places:
            return None
        stds = [self._std_after(each[:2], place, covariance) for each in places]
        if min(stds) > ENOUGH_STD:
            return places[int(np.argmin(stds))]
        costs = [float(ways.costs[self._chart.grid.cell(each[:2])]) for each in places]
        good = [k for k, std in enumerate(stds) if std <= ENOUGH_STD]
        return places[min(good, key=lambda k: costs[k])]

    def speaker(self, voices: Sequence[HeardVoice]) -> tuple[Point, FloatArray]:
        """Mean and covariance of where the speaker may be, metres and m^2, shape (2, 2)."""
        cells = np.argwhere((self._chart.rooms >= 0) & ~self._chart.walls)
        cells = cells[(cells % FLOOR_STEP == 0).all(axis=1)]
        floor = self._chart.grid.points(cells)
        log = np.zeros(len(floor))
        for voice in voices:
            away = floor - voice.pose[:2]
            turn = np.arctan2(away[:, 1], away[:, 0]) - voice.direction
            log -= 0.5 * (np.angle(np.exp(1j * turn)) / voice.std) ** 2
            log[np.hypot(*away.T) > self._microphones.hearing_range] -= 20.0
        share = np.exp(log - log.max())
        share /= share.sum()
        mean = share @ floor
        off = floor - mean
        return (float(mean[0]), float(mean[1])), (share[:, None] * off).T @ off

    def _places(self, ways: Ways, speaker: Point, voices: Sequence[HeardVoice]) -> list[Pose]:
        """Poses that face the speaker, where the body fits, away from where it has listened."""
        chart, apart = self._chart, NEXT_CALL_DISTANCE + self._chart.settings.near_tolerance
        cells = np.argwhere(np.isfinite(ways.costs) & (chart.rooms >= 0))
        points = chart.grid.points(cells[(cells % PLACE_STEP == 0).all(axis=1)])
        for heard in (*(voice.pose[:2] for voice in voices), *self._tried):
            points = points[np.hypot(*(points - heard).T) > apart]
        size = self._looker.half_size(chart.settings.clearance)
        poses = [(x, y, math.atan2(speaker[1] - y, speaker[0] - x)) for x, y in points.tolist()]
        return [each for each in poses if fits(each, size, ways.room, *chart.grid.frame)]

    def _std_after(self, ear: Point, speaker: Point, covariance: FloatArray) -> float:
        """Largest standard deviation of the speaker's place after a call from a place, metres."""
        x, y = speaker[0] - ear[0], speaker[1] - ear[1]
        distance = max(math.hypot(x, y), 0.1)
        walls = self._walls_between(ear, speaker)
        if not self._microphones.hears(distance, walls):
            return math.inf
        across = np.array((-y, x)) / distance
        error = distance * self._microphones.std(distance, walls)
        known = np.linalg.inv(covariance + 1e-4 * np.eye(2)) + np.outer(across, across) / error**2
        return float(1.0 / math.sqrt(np.linalg.eigvalsh(known)[0]))

    def _walls_between(self, start: Point, end: Point) -> int:
        """How often a straight line enters a wall of the plan."""
        steps = max(2, round(2.0 * math.dist(start, end) / self._chart.settings.spacing))
        line = np.array(start) + np.linspace(0.0, 1.0, steps)[:, None] * (np.array(end) - start)
        solid = self._chart.walls[self._chart.grid.cells(*line.T)]
        return int(np.count_nonzero(solid[1:] & ~solid[:-1]))
