"""The simulated robot: world, lidar and odometry behind one object, `step(twist) -> Sensed`."""

from typing import TYPE_CHECKING

from semnav_env.world.simulator.sensed import Motion, Sensed
from semnav_features.lazy_names import lazy_names

if TYPE_CHECKING:
    from semnav_env.world.simulator.odometry import EXACT, OdometrySettings
    from semnav_env.world.simulator.odometry_presets import (
        ODOMETRIES,
        SPOT_ODOMETRY,
        WHEELCHAIR_ODOMETRY,
        odometry_settings,
    )
    from semnav_env.world.simulator.simulator import RobotSetup, Simulator

__all__ = [
    "EXACT",
    "ODOMETRIES",
    "SPOT_ODOMETRY",
    "WHEELCHAIR_ODOMETRY",
    "Motion",
    "OdometrySettings",
    "RobotSetup",
    "Sensed",
    "Simulator",
    "odometry_settings",
]

__getattr__ = lazy_names(
    __name__,  # a judge needs motions only
    {
        ".odometry": ("EXACT", "OdometrySettings"),
        ".odometry_presets": (
            "ODOMETRIES",
            "SPOT_ODOMETRY",
            "WHEELCHAIR_ODOMETRY",
            "odometry_settings",
        ),
        ".simulator": ("RobotSetup", "Simulator"),
    },
)
