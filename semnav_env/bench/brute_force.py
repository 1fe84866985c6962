"""A lidar by brute force in NumPy: the yardstick of the benchmark and the reference of tests."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable

import numpy as np

from semnav_env.bench.timing import Part, seconds_per_call
from semnav_features.frames import ORIGIN, FloatArray, Pose, points_to_local
from semnav_features.kernels.compiling import kernel
from semnav_features.lidars import TIM561

YARDSTICK_SEGMENTS, YARDSTICK_SCANS = 208, 20
"""Wall segments of the yardstick, whatever the floor plan, and scans of it in a timing."""


def brute_force_ranges(pose: Pose, segments: FloatArray, angles: FloatArray) -> FloatArray:
    """Intersect every beam with every segment.

    Args:
        pose: of the lidar in the world.
        segments: x1, y1, x2, y2 in metres, shape (m, 4).
        angles: of the beams in the lidar frame, radians, shape (n,).

    Returns:
        Distance to the nearest hit in metres, shape (n,); +inf without a hit.
    """
    ends = points_to_local(pose, segments.reshape(-1, 2, 2))
    a, along = ends[:, 0], ends[:, 1] - ends[:, 0]
    cos, sin = np.cos(angles)[:, None], np.sin(angles)[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        facing = cos * along[:, 1] - sin * along[:, 0]
        distance = (a[:, 0] * along[:, 1] - a[:, 1] * along[:, 0]) / facing
        place = (a[:, 0] * sin - a[:, 1] * cos) / facing
    met = (distance >= 0.0) & (place >= -1e-12) & (place <= 1.0 + 1e-12)
    nearest: FloatArray = np.where(met, distance, np.inf).min(axis=1, initial=np.inf)
    return nearest


@kernel
def compiled_ranges(segments: FloatArray, directions: FloatArray, out: FloatArray) -> None:
    """As `brute_force_ranges` for a lidar at the origin, one beam and segment after the other.

    Args:
        segments: shape (m, 4).
        directions: unit vectors of the beams, shape (n, 2).
        out: written, shape (n,).
    """
    for i in range(len(out)):
        out[i], cos, sin = np.inf, directions[i, 0], directions[i, 1]
        for k in range(len(segments)):
            ax, ay = segments[k, 0], segments[k, 1]
            along_x, along_y = segments[k, 2] - ax, segments[k, 3] - ay
            facing = cos * along_y - sin * along_x
            distance, place = (ax * along_y - ay * along_x) / facing, (ax * sin - ay * cos) / facing
            if distance >= 0.0 and -1e-12 <= place <= 1.0 + 1e-12 and distance < out[i]:
                out[i] = distance


def compiled_scan(clock: Callable[[], float]) -> Part:
    """The scan of the yardstick in compiled code, which varies less than in NumPy.

    Args:
        clock: by which it is timed.
    """
    segments, out = _random_walls(), np.empty(TIM561.beams)

    def scan() -> None:
        compiled_ranges(segments, TIM561.directions, out)

    name = f"compiled brute-force scan, {len(out)} beams, {len(segments)} segments"
    return Part(name, lambda: seconds_per_call(scan, YARDSTICK_SCANS, clock))


def _random_walls() -> FloatArray:
    rng = np.random.default_rng(0)
    starts = rng.uniform(-15.0, 15.0, (YARDSTICK_SEGMENTS, 2))
    walls: FloatArray = np.hstack((starts, starts + rng.uniform(-4.0, 4.0, starts.shape)))
    return walls


def yardstick() -> Part:
    """A brute-force scan of a TiM561 in NumPy among random walls."""
    segments, angles = _random_walls(), TIM561.angles

    def scan() -> None:
        brute_force_ranges(ORIGIN, segments, angles)

    name = f"brute-force scan, {len(angles)} beams, {len(segments)} segments"
    return Part(name, lambda: seconds_per_call(scan, YARDSTICK_SCANS))


def yardstick_alone() -> Part:
    """A scan of the yardstick in a process that does nothing else.

    In such a process the C library returns the memory of each large array to the system, and every
    scan pays for new pages. A process that once held more memory keeps its pages.
    """
    return Part("the same in a process of its own", _seconds_alone)


def _seconds_alone() -> float:
    words = (
        f"from {__name__} import yardstick as y; part = y(); part.seconds(); print(part.seconds())"
    )
    done = subprocess.run([sys.executable, "-c", words], check=True, capture_output=True, text=True)
    return float(done.stdout)
