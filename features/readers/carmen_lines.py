"""The message lines of CARMEN's log format that hold scans and odometry.

The format is CARMEN's own (its logger and log-playback manual): one message a line,

    FLASER n r_1..r_n x y theta odom_x odom_y odom_theta time host logger_time
    ROBOTLASER1 type start fov resolution max_range accuracy remission_mode
        n r_1..r_n m e_1..e_m laser_x laser_y laser_theta robot_x robot_y robot_theta
        tv rv forward_safety side_safety turn_axis time host logger_time
    ODOM x y theta tv rv acceleration time host logger_time

in metres, radians and seconds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.scan import Scan

_FLASER_SPACING = {180: 1.0, 181: 1.0, 360: 0.5, 361: 0.5, 400: 0.25, 401: 0.25}
"""Degrees between the beams of the SICK LMS's modes, by number of beams: FLASER leaves it out."""

_MAX_BEAMS = 100_000


class BadLineError(ValueError):
    """A line that cannot be read; the message is the same for all lines of its fault."""


@dataclass(frozen=True, slots=True)
class Geometry:
    """What the lines leave unsaid.

    Attributes:
        range_max: ranges at or beyond it are no returns, metres. SICK's scanners send 81.91 and
            some logs 50.
        beam_spacing: degrees between the beams of FLASER lines; None to tell it from the number
            of beams, as CARMEN does. The middle beam looks forward.

    Raises:
        ValueError: a number is not positive and finite.
    """

    range_max: float = 50.0
    beam_spacing: float | None = None

    def __post_init__(self) -> None:
        for name in ("range_max", "beam_spacing"):
            value = getattr(self, name)
            if value is not None and not 0 < value < math.inf:
                raise ValueError(f"{name} is {value}; it must be positive and finite")


def parse_flaser(fields: list[bytes], geometry: Geometry) -> tuple[Scan, Pose]:
    """The scan and the lidar's pose of a FLASER line.

    Raises:
        BadLineError: says what is wrong with it.
    """
    n = _count(fields, 1)
    _expect(fields, n + 11)
    spacing = geometry.beam_spacing or _FLASER_SPACING.get(n)
    if spacing is None:
        raise BadLineError("its number of beams does not tell their spacing; give the spacing")
    values = _numbers(fields[2 : n + 9])
    step = math.radians(spacing)
    return _scan(values[:n], -(n // 2) * step, step, geometry.range_max, values[-1]), _pose(
        values[n : n + 3]
    )


def parse_robotlaser(fields: list[bytes], geometry: Geometry) -> tuple[Scan, Pose]:
    """The scan and the lidar's pose of a ROBOTLASER1 line.

    Raises:
        BadLineError: says what is wrong with it.
    """
    n = _count(fields, 8)
    m = _count(fields, 9 + n, least=0)
    _expect(fields, n + m + 24)
    _, start, _, step, longest, *_ = _numbers(fields[1:8])
    ranges = _numbers(fields[9 : n + 9])
    tail = _numbers(fields[n + m + 10 : n + m + 22])
    range_max = min(longest, geometry.range_max) if longest > 0 else geometry.range_max
    return _scan(ranges, start, step, range_max, tail[11]), _pose(tail[:3])


def parse_odometry(fields: list[bytes]) -> Pose:
    """The robot's pose of an ODOM line.

    Raises:
        BadLineError: says what is wrong with it.
    """
    if len(fields) < 4:
        raise BadLineError("fewer fields than its format has")
    return _pose(_numbers(fields[1:4]))


def _count(fields: list[bytes], place: int, least: int = 1) -> int:
    try:
        count = int(fields[place])
    except IndexError:
        raise BadLineError("fewer fields than its format has") from None
    except ValueError:
        raise BadLineError("its count is not a whole number") from None
    if not least <= count <= _MAX_BEAMS:
        raise BadLineError(f"its count is not from {least} to {_MAX_BEAMS}")
    return count


def _expect(fields: list[bytes], count: int) -> None:
    if len(fields) < count:
        raise BadLineError("fewer fields than its count of beams asks for")
    if len(fields) > count:
        raise BadLineError("more fields than its count of beams asks for")


def _numbers(fields: list[bytes]) -> FloatArray:
    try:
        return np.array([float(field) for field in fields])
    except ValueError:
        raise BadLineError("a field that is not a number") from None


def _pose(values: FloatArray) -> Pose:
    x, y, theta = values.tolist()
    if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(theta)):
        raise BadLineError("a pose that is not finite")
    return x, y, theta


def _scan(ranges: FloatArray, start: float, step: float, range_max: float, stamp: float) -> Scan:
    if not math.isfinite(stamp):
        raise BadLineError("a time that is not finite")
    if not (math.isfinite(start) and 0 < step * (len(ranges) - 1) <= 2 * math.pi + step):
        raise BadLineError("angles that do not fit a sweep of one turn")
    try:
        return Scan(ranges, start, step, range_max=range_max, stamp=float(stamp))
    except ValueError:
        raise BadLineError("ranges that are not metres") from None
