"""SPOT's stereo pairs, and a sensor of full height to compare them with."""

from __future__ import annotations

import math
from typing import Any

from semnav_env.robots.depth_camera import DepthCamera

_TOP = math.radians(25.0)
"""How far above the horizon SPOT's cameras see, radians: up to 1 m at a distance of 1 m."""

_NARROW, _WIDE = math.radians(84.0), math.radians(92.0)
"""The two fields of view of an image, radians; the front pairs stand upright."""

_STEREO: dict[str, Any] = {
    "range_min": 0.25,
    "range_max": 4.0,
    "inverse_sigma": 0.01,
    "mismatch": 0.004,
    "bleeding": 0.3,
}


def _pair(name: str, x: float, y: float, degrees: float, baseline: float) -> DepthCamera:
    """A stereo pair; the two in front stand upright."""
    upright = abs(degrees) < 90.0
    across, up = (_NARROW, _WIDE) if upright else (_WIDE, _NARROW)
    columns, rows = (70, 86) if upright else (86, 70)
    yaw, tilt = math.radians(degrees), 0.5 * up - _TOP
    return DepthCamera(
        name, (x, y, 0.52), yaw, tilt, columns, rows, across, up, baseline=baseline, **_STEREO
    )


SPOT_CAMERAS = (
    _pair("frontleft", 0.40, 0.05, -32.0, 0.08),
    _pair("frontright", 0.40, -0.05, 32.0, -0.08),
    _pair("left", -0.10, 0.11, 90.0, 0.08),
    _pair("right", -0.10, -0.11, -90.0, 0.08),
    _pair("back", -0.42, 0.0, 180.0, 0.08),
)

SPOT_SOURCE = (
    "five stereo pairs of SPOT, 360 degrees to 4 m (Boston Dynamics' specification); the front "
    "ones look across each other (Mes 2021, appendix A), all are tilted down and see little above "
    "1 m (her 6.1). Their exact places, fields of view and errors are not published: assumed, so "
    "that both jambs are in view from the poses of her figure 8.1. Depth errs by 1 % at 1 m and "
    "by 4 % at 4 m; images are thinned to 6,020 pixels each"
)

FULL_HEIGHT_CAMERAS = tuple(
    DepthCamera(
        name,
        (0.0, 0.0, 0.8),
        math.radians(degrees),
        0.0,
        columns=84,
        rows=88,
        across=math.radians(91.0),
        up=math.radians(116.0),
        range_min=0.3,
        range_max=8.0,
        inverse_sigma=0.004,
        missing=(0.05,) * 6,
    )
    for name, degrees in (("ahead", 0.0), ("left", 90.0), ("behind", 180.0), ("right", -90.0))
)

FULL_HEIGHT_SOURCE = (
    "a turning sensor on the robot's back, 360 degrees by 116, as the panoramic one that Mes 2021 "
    "asks for in 9.2.2; its numbers are assumed"
)
