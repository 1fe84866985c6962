"""A simulated microphone array: the robot calls, people answer, and it hears from where."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from shapely import LineString, STRtree

from semnav_env.world.dynamics.victims import victims_of
from semnav_env.world.maps.floor_plan import FloorPlan, Material
from semnav_features.checked_fields import Angle, Length, Seconds, Share, check_fields
from semnav_features.frames import Point, Pose, to_local, wrap_angle


@dataclass(frozen=True)
class MicrophoneSettings:
    """A microphone array on the middle of the robot, and the people who answer.

    Valin et al. (2003) locate speakers with eight microphones to 3 degrees within 3 m in a room.
    The other figures are assumptions: farther off and behind walls echoes come from elsewhere.

    Attributes:
        bearing_std: standard deviation of the error of a direction within `near`, radians.
        near: distance within which it is that, metres.
        std_per_metre: added to it for each metre beyond, radians.
        std_per_wall: added to it for each wall on the straight line, radians.
        hearing_range: farthest that a call and its answer are heard without walls, metres.
        range_per_wall: taken from it for each wall on the straight line, metres.
        answers: share of the people who can answer; one who cannot never does.
        listening: duration of a call and its answers, seconds.
    """

    bearing_std: Angle = math.radians(3.0)
    near: Length = 3.0
    std_per_metre: Angle = math.radians(0.5)
    std_per_wall: Angle = math.radians(10.0)
    hearing_range: Length = 15.0
    range_per_wall: Length = 4.0
    answers: Share = 0.8
    listening: Seconds = 4.0

    def __post_init__(self) -> None:
        check_fields(self)

    def hears(self, distance: float, walls: int) -> bool:
        """Whether an answer is heard over a distance, metres, through some walls."""
        return distance <= self.hearing_range - walls * self.range_per_wall

    def std(self, distance: float, walls: int) -> float:
        """Standard deviation of a direction, radians."""
        beyond = max(distance - self.near, 0.0)
        return self.bearing_std + beyond * self.std_per_metre + walls * self.std_per_wall


USUAL_MICROPHONES = MicrophoneSettings()
"""The default microphone array."""


class VoiceAnswer(NamedTuple):
    """An answer to a call.

    Attributes:
        person: number of the person, who is told from the others by the voice.
        bearing: direction from which it is heard, robot frame, radians.
        std: its standard deviation, radians; a robot judges it by how loud and clear a voice is.
    """

    person: int
    bearing: float
    std: float


class MicrophoneArray:
    """Hears the answers of the people on the floor of a plan.

    Walls count by their lines in the plan, so one that is drawn with both faces counts twice.

    Args:
        plan: with the people on its floor.
        settings: of the array and the people.
        rng: draws who can answer, and later the errors.
    """

    settings: MicrophoneSettings

    def __init__(
        self, plan: FloorPlan, settings: MicrophoneSettings, rng: np.random.Generator
    ) -> None:
        self.settings, self._rng = settings, rng
        self._people: list[Point] = [(v.centroid.x, v.centroid.y) for v in victims_of(plan)]
        self._can_answer = rng.random(len(self._people)) < settings.answers
        solid = [s.points for s in plan.surfaces if s.material in (Material.WALL, Material.GLASS)]
        self._walls = STRtree([LineString(ends) for points in solid for ends in pairwise(points)])

    def near(self, pose: Pose, distance: float) -> list[int]:
        """The people who can be talked to: within a distance, with no wall between; nearest first.

        Args:
            pose: true pose of the robot, world frame.
            distance: metres.
        """
        lines = [LineString((pose[:2], place)) for place in self._people]
        near = [k for k, line in enumerate(lines) if line.length <= distance]
        open_ = [k for k in near if not len(self._walls.query(lines[k], "intersects"))]
        return sorted(open_, key=lambda person: lines[person].length)

    def can_answer(self, person: int) -> bool:
        """Whether a person can answer."""
        return bool(self._can_answer[person])

    def call(self, pose: Pose) -> list[VoiceAnswer]:
        """Call once; the answers that are heard.

        Args:
            pose: true pose of the robot, world frame.
        """
        answers = []
        for person, place in enumerate(self._people):
            line = LineString((pose[:2], place))
            distance, walls = line.length, len(self._walls.query(line, "intersects"))
            if self._can_answer[person] and self.settings.hears(distance, walls):
                x, y = to_local(pose, place)
                std = self.settings.std(distance, walls)
                error = std * float(self._rng.standard_normal())
                answers.append(VoiceAnswer(person, wrap_angle(math.atan2(y, x) + error), std))
        return answers
