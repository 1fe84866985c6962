"""The robot's map of people: tracks, each with the probability that it is a person.

Each frame multiplies the odds of a track by the likelihood ratio of a person being there, as in the
binary Bayes filter (Thrun, Burgard and Fox 2005, section 4.2). A frame counts for less than
an independent one, because a classifier makes the same errors from similar viewpoints (Feldman and
Indelman 2020).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_env.rescue.settings import PersonDetectorSettings, PersonMapSettings
from semnav_features.frames import FloatArray, Point, Pose, compose, points_to_parent, to_local
from semnav_features.lidar_spec import LidarSpec

LEAST_STD = 0.05
"""Standard deviation of the position of a detection directly before the robot, metres."""

MAX_LOG_ODDS = 8.0
"""Largest log odds of a track, so that it can still change."""

VIEW_MARGIN = math.radians(5.0)
"""Angle from the edge of the field of view within which a track need not be seen, radians."""


@dataclass
class PersonTrack:
    """A possible person.

    Attributes:
        place: (x, y), odom frame, metres.
        log_odds: log odds of being a person.
        weight: inverse variance of the place, 1/m^2.
        reported: whether the robot has reported it.
        name: that the person has said; None if it is not known.
    """

    place: Point
    log_odds: float
    weight: float
    reported: bool = False
    name: str | None = None

    @property
    def probability(self) -> float:
        """Probability of being a person."""
        return 1.0 / (1.0 + math.exp(-self.log_odds))

    def move_towards(self, place: Point, weight: float) -> None:
        """Average the place with another one."""
        share = weight / (self.weight + weight)
        (x, y), (to_x, to_y) = self.place, place
        self.place = x + share * (to_x - x), y + share * (to_y - y)
        self.weight += weight


class PersonMap:
    """Joins the detections of many frames.

    Args:
        detector: rates and errors of the detector.
        settings: how detections become reports.
        lidar: the lidar, by which the robot decides whether a place is hidden.
        mount: pose of lidar and detector in the robot frame.

    Attributes:
        tracks: the possible people.
    """

    def __init__(
        self,
        detector: PersonDetectorSettings,
        settings: PersonMapSettings,
        lidar: LidarSpec,
        mount: Pose,
    ) -> None:
        self._detector, self._settings, self._lidar, self._mount = detector, settings, lidar, mount
        self.tracks: list[PersonTrack] = []

    def update(self, detections: FloatArray, pose: Pose, ranges: FloatArray) -> list[PersonTrack]:
        """Process a frame; returns the tracks that are reported now.

        Args:
            detections: places, robot frame, shape (n, 2).
            pose: believed pose of the robot, odometry frame.
            ranges: of the lidar, metres, shape (beams,).
        """
        eye = compose(pose, self._mount)
        seen = [self._seen_at((x, y), eye) for x, y in points_to_parent(pose, detections).tolist()]
        for track in self.tracks:
            place = to_local(eye, track.place)
            if not any(track is each for each in seen) and self._in_view(place, ranges):
                self._weigh(track, math.hypot(*place), found=False)
        least = _log_odds(self._settings.drop)
        self.tracks = [t for t in self.tracks if t.reported or t.log_odds > least]
        new = [track for track in self.tracks if self._is_sure(track, eye)]
        for track in new:
            track.reported = True
        return new

    def hear(self, place: Point, std: float) -> PersonTrack | None:
        """The track of a person whose voice comes from a place; None if there is no room for it.

        Args:
            place: odometry frame.
            std: its standard deviation, metres.
        """
        near = min(self.tracks, key=lambda t: math.dist(t.place, place), default=None)
        if near is not None and math.dist(near.place, place) <= self._settings.same_distance:
            return near
        if len(self.tracks) >= self._settings.capacity:
            return None
        track = PersonTrack(place, _log_odds(self._settings.heard), 1.0 / std**2)
        self.tracks.append(track)
        return track

    def _seen_at(self, place: Point, eye: Pose) -> PersonTrack | None:
        """The track of a detection, which may be a new one; None if there is no room for it."""
        distance = math.dist(place, eye[:2])
        weight = 1.0 / (LEAST_STD + self._detector.range_std * distance) ** 2
        near = min(self.tracks, key=lambda t: math.dist(t.place, place), default=None)
        if near is None or math.dist(near.place, place) > self._settings.same_distance:
            if len(self.tracks) >= self._settings.capacity:
                return None
            near = PersonTrack(place, _log_odds(self._settings.prior), weight)
            self.tracks.append(near)
            return near
        near.move_towards(place, weight)
        self._weigh(near, distance, found=True)
        return near

    def _weigh(self, track: PersonTrack, distance: float, found: bool) -> None:
        """Change the odds of a track by a frame with or without a detection there."""
        hit, false = self._detector.hit_chance(distance), self._detector.false_chance(distance)
        ratio = hit / max(false, 1e-3) if found else max(1.0 - hit, 1e-3) / (1.0 - false)
        changed = track.log_odds + self._settings.independence * math.log(ratio)
        track.log_odds = float(np.clip(changed, -MAX_LOG_ODDS, MAX_LOG_ODDS))

    def _in_view(self, place: Point, ranges: FloatArray) -> bool:
        """Whether a place was in view of the detector, camera frame, by the ranges of the lidar."""
        distance, bearing = math.hypot(*place), math.atan2(place[1], place[0])
        detector, lidar = self._detector, self._lidar
        if not detector.range_min <= distance <= detector.range_max:
            return False
        if abs(bearing) > detector.field_of_view / 2 - VIEW_MARGIN:
            return False
        beam = round((bearing - lidar.angle_min) / lidar.angle_increment)
        return 0 <= beam < lidar.beams and ranges[beam] >= distance - self._settings.behind

    def _is_sure(self, track: PersonTrack, eye: Pose) -> bool:
        near = math.dist(track.place, eye[:2]) <= self._settings.report_range
        return near and not track.reported and track.log_odds >= _log_odds(self._settings.report)


def _log_odds(probability: float) -> float:
    return math.log(probability / (1.0 - probability))
