"""The simulated person detector: detections of people from a true pose."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.rescue.settings import PersonDetectorSettings
from semnav_env.world.dynamics.victim_sight import OUTLINE_TOLERANCE, outline_of
from semnav_env.world.dynamics.victims import victims_of
from semnav_env.world.lidar.lidar import Lidar
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import FloatArray, Pose, compose, points_to_local, to_local
from semnav_features.lidar_spec import LidarSpec

RAY_ANGLE = math.radians(0.5)
"""Angle between the rays that determine what is in view, radians: 5 cm apart at 6 m."""


class PersonDetector:
    """A camera with a person detector on a robot in a floor plan.

    Args:
        plan: floor plan with the people on its floor.
        settings: rates and errors of the detector.
        mount: pose of the camera in the robot frame.
        rng: chooses the look-alikes, and later draws misses, false alarms and errors.

    Attributes:
        victims: outlines of the people, world frame.
        rays: unit vectors of the rays of its field of view, camera frame, shape (n, 2).
        ranges: lengths of the rays in the last frame, metres, shape (n,); inf for no end.
    """

    def __init__(
        self,
        plan: FloorPlan,
        settings: PersonDetectorSettings,
        mount: Pose,
        rng: np.random.Generator,
    ) -> None:
        self.settings, self.mount, self._rng = settings, mount, rng
        spec = view_spec(settings)
        self._caster, self.rays, self._first = Lidar(plan, spec, mount), spec.directions, spec
        self.ranges = np.zeros(spec.beams)
        self.victims = victims_of(plan)
        pieces = [piece for piece in plan.furniture.geometries if piece not in self.victims]
        chosen = rng.random(len(pieces)) < settings.look_alikes
        look_alikes = [piece for piece, like in zip(pieces, chosen, strict=True) if like]
        bodies = [*self.victims, *look_alikes]
        self._real = np.arange(len(bodies)) < len(self.victims)
        self._outlines = [outline_of(body) for body in bodies]
        self._middles = [(body.centroid.x, body.centroid.y) for body in bodies]

    def look(self, pose: Pose) -> FloatArray:
        """Detect people; returns their positions, robot frame, metres, shape (n, 2).

        Args:
            pose: true pose of the robot, world frame.
        """
        settings, rng = self.settings, self._rng
        self.ranges = self._caster.exact_ranges(pose)
        eye = compose(pose, self.mount)
        found: list[tuple[float, float]] = []
        for outline, middle, real in zip(self._outlines, self._middles, self._real, strict=True):
            if self._share_in_view(points_to_local(eye, outline)) < settings.least_share:
                continue
            distance = math.dist(eye[:2], middle)
            chance = settings.hit_chance if real else settings.false_chance
            if rng.random() < chance(distance):
                found.append(self._with_errors(*to_local(eye, middle)))
        if rng.random() < settings.clutter:
            found.append(self._nothing())
        places = [compose(self.mount, (x, y, 0.0))[:2] for x, y in found]
        return np.array(places).reshape(-1, 2)

    def _share_in_view(self, points: FloatArray) -> float:
        """Share of some points that is in view; camera frame, shape (n, 2)."""
        settings, spec = self.settings, self._first
        distances = np.hypot(*points.T)
        bearings = np.arctan2(points[:, 1], points[:, 0])
        index = np.rint((bearings - spec.angle_min) / spec.angle_increment).astype(int)
        inside = (index >= 0) & (index < spec.beams) & (distances >= settings.range_min)
        inside &= distances <= settings.range_max
        free = self.ranges[np.clip(index, 0, spec.beams - 1)] > distances - OUTLINE_TOLERANCE
        return float(np.mean(inside & free))

    def _with_errors(self, x: float, y: float) -> tuple[float, float]:
        far, turned = self._rng.standard_normal(2)
        bearing = math.atan2(y, x) + self.settings.bearing_std * turned
        distance = math.hypot(x, y) * (1.0 + self.settings.range_std * far)
        return distance * math.cos(bearing), distance * math.sin(bearing)

    def _nothing(self) -> tuple[float, float]:
        """Draw a position in view for a false alarm."""
        k = int(self._rng.integers(len(self.rays)))
        reach = min(self.ranges[k], self.settings.range_max) * self._rng.random()
        x, y = reach * self.rays[k]
        return float(x), float(y)


def view_spec(settings: PersonDetectorSettings) -> LidarSpec:
    """The field of view of a detector as rays without errors."""
    beams = math.floor(settings.field_of_view / RAY_ANGLE) + 1
    half = RAY_ANGLE * (beams - 1) / 2
    return LidarSpec(
        "person detector", beams, -half, RAY_ANGLE, range_min=0.0, range_max=settings.range_max
    )
