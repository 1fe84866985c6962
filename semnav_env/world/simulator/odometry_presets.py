"""Named settings of odometry, for `odometry=`."""

from __future__ import annotations

from semnav_env.world.simulator.odometry import EXACT, OdometrySettings
from semnav_features.validation import by_name

USUAL_ODOMETRY = OdometrySettings()
"""Well calibrated odometry without slip; the frozen episodes are evaluated with it."""

WHEELCHAIR_ODOMETRY = OdometrySettings(
    distance_bias=0.02,
    turn_bias=0.03,
    distance_noise=0.01,
    turn_noise=0.02,
    veer_noise=0.01,
    veer_bias=0.01,
    slip=1.0,
)
"""Wheel encoders on air tyres, not calibrated for the day.

A tyre 2 % softer changes the scale of distance by as much. Wheels whose diameters differ by 0.6 %
on a track of 0.57 m make it veer by 0.01 rad/m (Borenstein and Feng 1996, the two main systematic
errors of a differential drive: unequal wheel diameters, and the uncertain wheelbase, here 3 % of
each turn). A wheelchair that is blocked spins its wheels, and each encoder counts it.
"""

SPOT_ODOMETRY = OdometrySettings(
    distance_bias=0.02,
    turn_bias=0.01,
    distance_noise=0.03,
    turn_noise=0.02,
    veer_noise=0.015,
    slip=0.5,
)
"""Legs and an inertial sensor: turns are measured well, steps of a trot slip a little at random.

Mes 2021 gives no number for SPOT's drift. These are an assumption of the size that legged odometry
is usually said to have, some percent of the way. Measure your own robot before you trust them.
"""

ODOMETRIES = {
    "usual": USUAL_ODOMETRY,
    "exact": EXACT,
    "wheelchair": WHEELCHAIR_ODOMETRY,
    "spot": SPOT_ODOMETRY,
}
"""The errors of dead reckoning by their names."""


def odometry_settings(name_or_settings: str | OdometrySettings) -> OdometrySettings:
    """The settings of that name, or the settings themselves.

    Raises:
        ValueError: no such odometry; lists those there are.
    """
    return by_name("odometry", name_or_settings, OdometrySettings, ODOMETRIES)
