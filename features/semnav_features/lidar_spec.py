"""The specification of a lidar: its beams, its limits and its errors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated, TypeAlias

import numpy as np

from semnav_features.checked_fields import Bounds, Length, Share, check_fields
from semnav_features.frames import FloatArray
from semnav_features.kernels.lanes import WIDTH
from semnav_features.validation import require

CosinesSines: TypeAlias = tuple[FloatArray, FloatArray]
"""Cosines and sines of the directions of beams, each of shape (beams + `WIDTH`,).

Elsewhere beams are unit vectors, one to a row, shape (n, 2), as points are. The ray caster's inner
loop takes eight beams at a time, also of the last ones, and needs neighbouring cosines beside each
other."""

SENSOR = np.dtype(
    [
        (name, "f8")
        for name in (
            *("angle_min", "angle_increment", "range_min", "range_max"),
            *("sigma", "systematic", "dropout"),
        )
    ]
)
"""The dtype of a `LidarSpec` for kernels: an array of shape (1,)."""


@dataclass(frozen=True)
class LidarSpec:
    """A planar lidar. Beams are counter-clockwise; beam i points to angle_min + i angle_increment.

    Attributes:
        name: as in `semnav_features.lidars.lidar_spec(name)`.
        beams: number of beams.
        angle_min: direction of beam 0 in the lidar frame, radians in [-pi, pi].
        angle_increment: angle between beams, radians; the beams span at most a full turn. It is
            less than pi, because the ray caster tests on which side of a segment's end a beam
            passes.
        range_min: metres; anything measured closer reads -inf (REP 117: too close to tell).
        range_max: metres; anything at or beyond it reads +inf (REP 117: no return).
        rate_hz: scans per second; scan k has the time k / rate_hz.
        sigma: standard deviation of the error of each range, metres.
        dropout: probability that a beam has no return and reads +inf.
        systematic: half the width of the uniform distribution of an offset that all ranges of an
            episode share, metres.
        source: where the numbers come from.

    Raises:
        ValueError: a field has another type or is out of its bounds; names it.
    """

    name: str
    beams: Annotated[int, Bounds(1, 100_000)]
    angle_min: Annotated[float, Bounds(-math.pi, math.pi, "rad")]
    angle_increment: Annotated[float, Bounds(1e-6, 3.0, "rad")]
    range_min: Length = 0.05
    range_max: Annotated[float, Bounds(1e-3, 1e6, "m")] = 10.0
    rate_hz: Annotated[float, Bounds(0.1, 1000.0, "Hz")] = 15.0
    sigma: Length = 0.0
    dropout: Share = 0.0
    systematic: Length = 0.0
    source: str = ""

    def __post_init__(self) -> None:
        check_fields(self)
        step, most = self.angle_increment, most_beams(self.angle_increment)
        require(self.beams <= most, "angle_increment", step, "at most 2 pi / (beams - 1)")
        farther = f"more than range_min, which is {self.range_min}"
        require(self.range_min < self.range_max, "range_max", self.range_max, farther)

    @property
    def angles(self) -> FloatArray:
        """Direction of each beam in the lidar frame, radians, shape (beams,)."""
        return _angles(self.beams, self.angle_min, self.angle_increment)

    @property
    def directions(self) -> FloatArray:
        """Unit vector of each beam in the lidar frame, shape (beams, 2)."""
        return self.shared_directions.copy()

    @property
    def shared_directions(self) -> FloatArray:
        """The `directions` in one array for all lidars with these beams; not to be written."""
        return _tables(self.beams, self.angle_min, self.angle_increment)[0]

    @property
    def cosines_sines(self) -> CosinesSines:
        """The columns of `directions`, each contiguous and longer: what the ray caster reads."""
        return _tables(self.beams, self.angle_min, self.angle_increment)[1]

    @property
    def sensor(self) -> np.ndarray:
        """The numbers that kernels need, shape (1,), dtype `SENSOR`."""
        return np.array([tuple(getattr(self, name) for name in SENSOR.names or ())], SENSOR)


def _angles(beams: int, angle_min: float, angle_increment: float) -> FloatArray:
    return angle_min + angle_increment * np.arange(beams, dtype=np.float64)


@lru_cache(maxsize=16)
def _tables(
    beams: int, angle_min: float, angle_increment: float
) -> tuple[FloatArray, CosinesSines]:
    """Directions of beams by rows and by columns.

    Each table is larger than all other data of a robot's scan; tables of many robots in one process
    would push each other out of the cache.
    """
    angles = _angles(beams + WIDTH, angle_min, angle_increment)
    cosines, sines = np.cos(angles), np.sin(angles)
    return np.stack((cosines[:beams], sines[:beams]), axis=1), (cosines, sines)


def most_beams(angle_increment: float) -> int:
    """Beams of a full turn and one that repeats the first; the increment may have 32 bits."""
    return math.floor(math.tau / angle_increment * (1.0 + 1e-6)) + 1
