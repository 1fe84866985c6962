"""The lidar of a robot: learned from its first scan; scans of another one are refused."""

from __future__ import annotations

import numpy as np

from semnav_env.mind.belief.log_following import lidar_of
from semnav_features import Scan
from semnav_features.frames import FloatArray, wrap_angle
from semnav_features.lidar_spec import LidarSpec
from semnav_features.readers.geometry import checked_scan
from semnav_features.readers.log import BadRecordError
from semnav_ros.messages import ScanMessage

USUAL_RATE = 15.0
"""Scans per second of a lidar whose driver does not say."""


def scan_of(message: ScanMessage) -> Scan:
    """The scan of a message, counter-clockwise.

    Raises:
        ValueError: its numbers make no scan; says why.
    """
    ranges = np.asarray(message.ranges, np.float64)
    start, step, nearest = message.angle_min, message.angle_increment, message.range_min
    try:
        return checked_scan(ranges, start, step, message.range_max, message.stamp, nearest)
    except BadRecordError as error:
        raise ValueError(f"a scan with {error}") from None


def learned_lidar(message: ScanMessage) -> LidarSpec:
    """The specification of the lidar that made a first scan."""
    rate = 1.0 / message.scan_time if message.scan_time > 0.0 else USUAL_RATE
    return lidar_of(scan_of(message), min(max(rate, 1.0), 100.0))


def ranges_for(lidar: LidarSpec, scan: Scan) -> FloatArray:
    """The ranges of a scan of that lidar, shape (lidar.beams,).

    Raises:
        ValueError: it is a scan of another lidar: other beams or other directions.
    """
    ranges = scan.ranges[: lidar.beams]
    step = lidar.angle_increment
    turned = wrap_angle(scan.angle_min - lidar.angle_min)
    widened = (scan.angle_increment - step) * (lidar.beams - 1)
    if len(ranges) == lidar.beams and max(abs(turned), abs(turned + widened)) <= step:
        return ranges
    raise ValueError(
        f"a scan of another lidar: {len(scan.ranges)} beams from {scan.angle_min:.3f} rad in steps "
        f"of {scan.angle_increment:.5f}, and the first one had {lidar.beams} from "
        f"{lidar.angle_min:.3f} in steps of {step:.5f}; start the node anew for another lidar"
    )
