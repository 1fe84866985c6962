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

import numpy as np

from semnav_features.frames import FloatArray, Pose
from semnav_features.readers.geometry import Geometry, checked_pose, checked_scan
from semnav_features.readers.log import BadRecordError
from semnav_features.scan import Scan

_FLASER_SPACING = {180: 1.0, 181: 1.0, 360: 0.5, 361: 0.5, 400: 0.25, 401: 0.25}
"""Degrees between the beams of the SICK LMS's modes, by number of beams: FLASER leaves it out."""

_MAX_BEAMS = 100_000


def parse_flaser(fields: list[bytes], geometry: Geometry) -> tuple[Scan, Pose]:
    """The scan and the lidar's pose of a FLASER line.

    Raises:
        BadRecordError: says what is wrong with it.
    """
    n = _count(fields, 1)
    _expect(fields, n + 11)
    spacing = geometry.beam_spacing or _FLASER_SPACING.get(n)
    if spacing is None:
        raise BadRecordError("its number of beams does not tell their spacing; give the spacing")
    values = _numbers(fields[2 : n + 9])
    step = math.radians(spacing)
    scan = checked_scan(values[:n], -(n // 2) * step, step, geometry.range_max, float(values[-1]))
    return scan, checked_pose(*values[n : n + 3].tolist())


def parse_robotlaser(fields: list[bytes], geometry: Geometry) -> tuple[Scan, Pose]:
    """The scan and the lidar's pose of a ROBOTLASER1 line.

    Raises:
        BadRecordError: says what is wrong with it.
    """
    n = _count(fields, 8)
    m = _count(fields, 9 + n, least=0)
    _expect(fields, n + m + 24)
    _, start, _, step, longest, *_ = _numbers(fields[1:8])
    ranges = _numbers(fields[9 : n + 9])
    tail = _numbers(fields[n + m + 10 : n + m + 22])
    scan = checked_scan(ranges, start, step, geometry.nearer(longest), float(tail[11]))
    return scan, checked_pose(*tail[:3].tolist())


def parse_odometry(fields: list[bytes]) -> Pose:
    """The robot's pose of an ODOM line.

    Raises:
        BadRecordError: says what is wrong with it.
    """
    if len(fields) < 4:
        raise BadRecordError("fewer fields than its format has")
    return checked_pose(*_numbers(fields[1:4]).tolist())


def _count(fields: list[bytes], place: int, least: int = 1) -> int:
    try:
        count = int(fields[place])
    except IndexError:
        raise BadRecordError("fewer fields than its format has") from None
    except ValueError:
        raise BadRecordError("its count is not a whole number") from None
    if not least <= count <= _MAX_BEAMS:
        raise BadRecordError(f"its count is not from {least} to {_MAX_BEAMS}")
    return count


def _expect(fields: list[bytes], count: int) -> None:
    if len(fields) < count:
        raise BadRecordError("fewer fields than its count of beams asks for")
    if len(fields) > count:
        raise BadRecordError("more fields than its count of beams asks for")


def _numbers(fields: list[bytes]) -> FloatArray:
    try:
        return np.array([float(field) for field in fields])
    except ValueError:
        raise BadRecordError("a field that is not a number") from None
