"""Common planar lidars by name, with the numbers of their data sheets.

A data sheet states an error either as a standard deviation, which is taken as it is, or as a limit
or a share of the range. From those `sigma` is derived as the `source` of the lidar says: the model
has one standard deviation for all ranges. Offsets that all ranges share (`systematic`) are off;
`source` names those that a data sheet states. No data sheet tells how many beams get lost:
`dropout` is about one beam a scan of the TiM561, and the same share for all others.
"""

from __future__ import annotations

import math

from semnav_features.lidar_spec import LidarSpec
from semnav_features.validation import by_name

DROPOUT = 0.001
"""Probability that a beam has no return; assumed."""


def _sector(
    name: str,
    degrees: float,
    gaps: int,
    ranges: tuple[float, float],
    rate_hz: float,
    sigma: float,
    source: str,
) -> LidarSpec:
    """A lidar that looks to the front.

    Args:
        name: of the lidar.
        degrees: field of view, symmetric about the front.
        gaps: number of beams less one.
        ranges: smallest and largest range, metres.
        rate_hz: scans per second.
        sigma: standard deviation of a range, metres.
        source: where the numbers come from.
    """
    width = math.radians(degrees)
    beams = gaps + 1, -width / 2.0, width / gaps
    return LidarSpec(name, *beams, *ranges, rate_hz, sigma, DROPOUT, source=source)


def _full_turn(
    name: str, beams: int, ranges: tuple[float, float], rate_hz: float, sigma: float, source: str
) -> LidarSpec:
    """A lidar that looks all around; see `_sector`."""
    angles = -math.pi, math.tau / beams
    return LidarSpec(name, beams, *angles, *ranges, rate_hz, sigma, DROPOUT, source=source)


TIM561 = _sector(
    "tim561", 270.0, 810, (0.05, 10.0), 15.0, 0.02,
    "SICK TiM561 data sheet: 270 degrees at 0.33 degrees, 15 Hz, 0.05 to 10 m, statistical "
    "error 20 mm (1 sigma), systematic error +-60 mm",
)  # fmt: skip
"""The lidar that is taken if none is named."""

BARBRET = LidarSpec(
    name="barbret",
    beams=786,
    angle_min=-2.356,
    angle_increment=0.006,
    sigma=0.03,
    source="the TiM561 as Barbret 2021 rounds it: 270 degrees at 0.006 rad, sigma 30 mm",
)
"""The lidar of Barbret 2021, with the roundings of the thesis."""

_CATALOGUE = (
    TIM561,
    BARBRET,
    _sector(
        "tim551", 270.0, 270, (0.05, 10.0), 15.0, 0.02,
        "SICK TiM551 data sheet: 270 degrees at 1 degree, 15 Hz, 0.05 to 10 m, statistical error "
        "20 mm (1 sigma), systematic error +-60 mm",
    ),
    _sector(
        "tim571", 270.0, 810, (0.05, 25.0), 15.0, 0.02,
        "SICK TiM571 data sheet: as the TiM561, 0.05 to 25 m",
    ),
    _sector(
        "lms111", 270.0, 540, (0.5, 20.0), 50.0, 0.012,
        "SICK LMS111 data sheet: 270 degrees at 0.5 degrees, 50 Hz, 0.5 to 20 m, statistical "
        "error 12 mm (1 sigma), systematic error +-30 mm",
    ),
    _sector(
        "lms200", 180.0, 360, (0.05, 8.0), 37.5, 0.005,
        "SICK LMS200 technical description: 180 degrees at 0.5 degrees, 37.5 Hz, 8 m in the mode "
        "with millimetres, statistical error 5 mm (1 sigma), systematic error +-15 mm. It states "
        "no smallest range; 0.05 m is assumed",
    ),
    _sector(
        "urg04lx", 360.0 * 681 / 1024, 681, (0.02, 5.6), 10.0, 0.03,
        "Hokuyo URG-04LX data sheet: steps 44 to 725 of 1024 a turn (240 degrees), 10 Hz, 0.02 to "
        "5.6 m, accuracy +-10 mm to 1 m and +-1 % beyond; the URG-04LX-UG01 +-30 mm to 1 m and "
        "+-3 % beyond. sigma is the 30 mm",
    ),
    _sector(
        "ust10lx", 270.0, 1080, (0.06, 10.0), 40.0, 0.03,
        "Hokuyo UST-10LX data sheet: 270 degrees at 0.25 degrees, 40 Hz, 0.06 to 10 m, repeated "
        "accuracy sigma below 30 mm, accuracy +-40 mm",
    ),
    _sector(
        "utm30lx", 270.0, 1080, (0.1, 30.0), 40.0, 0.01,
        "Hokuyo UTM-30LX data sheet: 270 degrees at 0.25 degrees, 40 Hz, 0.1 to 30 m, repeated "
        "accuracy sigma below 10 mm to 10 m, accuracy +-30 mm to 10 m",
    ),
    _full_turn(
        "rplidar_a1", 360, (0.15, 12.0), 5.5, 0.03,
        "Slamtec RPLIDAR A1M8 data sheet: 360 samples a turn at 5.5 Hz, 0.15 to 12 m, resolution "
        "below 1 % of the range. sigma is the 1 % at 3 m",
    ),
    _full_turn(
        "rplidar_a2", 800, (0.15, 12.0), 10.0, 0.03,
        "Slamtec RPLIDAR A2M8 data sheet: 8000 samples a second, 10 Hz, 0.45 degrees, 0.15 to "
        "12 m, resolution below 1 % of the range. sigma is the 1 % at 3 m",
    ),
    _full_turn(
        "rplidar_a3", 1600, (0.2, 25.0), 10.0, 0.03,
        "Slamtec RPLIDAR A3M1 data sheet, enhanced mode: 16000 samples a second, 10 Hz, 0.225 "
        "degrees, 0.2 to 25 m, accuracy 1 % of the range to 3 m. sigma is the 1 % at 3 m",
    ),
    _full_turn(
        "rplidar_s2", 3200, (0.05, 30.0), 10.0, 0.03,
        "Slamtec RPLIDAR S2 data sheet: 32000 samples a second, 10 Hz, 0.1125 degrees, 0.05 to "
        "30 m, accuracy +-30 mm, which is taken as sigma",
    ),
    _full_turn(
        "lds01", 360, (0.12, 3.5), 5.0, 0.035,
        "LDS-01 (HLS-LFCD2) of the TurtleBot3, its manual: 1 degree, 300 turns a minute, 0.12 to "
        "3.5 m, precision +-10 mm to 0.5 m and +-3.5 % beyond, accuracy +-15 mm and +-5 %. sigma "
        "is the 3.5 % at 1 m",
    ),
    _full_turn(
        "lds02", 360, (0.16, 8.0), 5.0, 0.03,
        "LDS-02 of the TurtleBot3, its manual: 1 degree, 5 Hz or above, 0.16 to 8 m, accuracy "
        "+-10 mm to 0.3 m, +-3 % to 6 m and +-5 % beyond. sigma is the 3 % at 1 m",
    ),
    _full_turn(
        "ld19", 450, (0.02, 12.0), 10.0, 0.01,
        "LDROBOT LD19 data sheet: 4500 samples a second, 10 Hz, 0.02 to 12 m, standard deviation "
        "10 mm, accuracy of the mean +-45 mm",
    ),
)  # fmt: skip

LIDARS = {spec.name: spec for spec in _CATALOGUE}
"""The lidars by their names."""


def lidar_spec(name_or_spec: str | LidarSpec) -> LidarSpec:
    """The lidar with a name, or the specification itself.

    Raises:
        ValueError: no such lidar; lists those there are.
    """
    return by_name("lidar", name_or_spec, LidarSpec, LIDARS)
