"""A stereo pair as a depth camera: pose, field of view and errors."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_features.frames import FloatArray

MISSING = (0.5, 0.15, 0.35, 0.3, 0.4, 0.3)
"""Share of the pixels without depth, by `FaceKind`: wall, frame, leaf, furniture, floor, person.
Stereo matches texture, and a painted wall has little of it, but the edges of a frame have much.
Assumed."""

CAMERA = np.dtype(
    [
        (name, "f8")
        for name in (
            *("tan_across", "tan_up", "range_min", "range_max", "baseline"),
            *("inverse_sigma", "mismatch", "bleeding"),
        )
    ]
)
"""The dtype of a `DepthCamera` for kernels: an array of shape (1,)."""


@dataclass(frozen=True)
class DepthCamera:
    """A pair of cameras whose images give the depth of each pixel.

    Camera frame: x along the optical axis, y left, z up; a pixel looks along (1, u, v).

    Attributes:
        name: of its place on the body.
        position: (x, y, z) in the robot frame, metres; z above the floor.
        yaw: direction of the optical axis in the robot frame, radians.
        tilt: of the optical axis below the horizon, radians.
        columns: pixels across.
        rows: pixels from top to bottom.
        across: horizontal field of view, radians.
        up: vertical field of view, radians.
        range_min: least depth along the optical axis that gives a match, metres.
        range_max: largest one, metres.
        baseline: distance of the second camera to the right, metres, negative to the left; 0 for
            a sensor that sees all that one eye sees.
        inverse_sigma: standard deviation of 1 / depth, 1/m: depth errs by it times the depth
            squared (Gallup et al. 2008, "Variable baseline/resolution stereo", eq. 1).
        missing: share of the pixels without a match, by `FaceKind`: half of it pixel by pixel, and
            half in patches of 8 pixels, which may overlap.
        mismatch: share of the pixels that are matched with something else: any depth.
        bleeding: share of the pixels at an edge that read a depth between the two sides of it.
    """

    name: str
    position: tuple[float, float, float]
    yaw: float
    tilt: float
    columns: int
    rows: int
    across: float
    up: float
    range_min: float = 0.25
    range_max: float = 4.0
    baseline: float = 0.0
    inverse_sigma: float = 0.0
    missing: tuple[float, ...] = MISSING
    mismatch: float = 0.0
    bleeding: float = 0.0

    def __post_init__(self) -> None:
        """Refuse fields that do not make a camera."""
        shares = (*self.missing, self.mismatch, self.bleeding)
        rules = (
            (self.columns >= 1 and self.rows >= 1, "columns and rows must be at least 1"),
            (0 < self.across < math.pi and 0 < self.up < math.pi, "views must lie in (0, pi) rad"),
            (0 < self.range_min < self.range_max < math.inf, "0 < range_min < range_max m needed"),
            (math.isfinite(self.baseline), "the baseline must be finite"),
            (0 <= self.inverse_sigma < math.inf, "inverse_sigma must be at least 0"),
            (all(0 <= share <= 1 for share in shares), "shares must lie in [0, 1]"),
            (len(self.missing) == len(MISSING), f"missing must have {len(MISSING)} shares"),
        )
        for holds, right in rules:
            if not holds:
                raise ValueError(f"depth camera {self.name!r}: {right}; it is {self}")

    @property
    def rotation(self) -> FloatArray:
        """From the camera frame to the robot frame, shape (3, 3): tilt, then yaw."""
        c, s = math.cos(self.tilt), math.sin(self.tilt)
        tilted = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        turned = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        return np.asarray(turned @ tilted)

    @property
    def directions(self) -> tuple[FloatArray, FloatArray]:
        """U of the columns from left to right, v of the rows from top to bottom."""
        half, high = math.tan(0.5 * self.across), math.tan(0.5 * self.up)
        return _centres(half, self.columns), _centres(high, self.rows)

    @property
    def record(self) -> np.ndarray:
        """The numbers that kernels need, shape (1,), dtype `CAMERA`."""
        half, high = math.tan(0.5 * self.across), math.tan(0.5 * self.up)
        limits = half, high, self.range_min, self.range_max, self.baseline
        return np.array([(*limits, self.inverse_sigma, self.mismatch, self.bleeding)], CAMERA)


def _centres(half: float, count: int) -> FloatArray:
    """Middles of pixels between half and -half."""
    return half * (1.0 - (2.0 * np.arange(count) + 1.0) / count)
