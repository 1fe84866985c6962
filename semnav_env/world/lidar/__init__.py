"""A simulated 2D lidar: exact ranges by an interval raster, noise by a counter-based hash."""

from semnav_env.world.lidar.lidar import Key, Lidar
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import BARBRET, LIDARS, TIM561, lidar_spec

__all__ = ["BARBRET", "LIDARS", "TIM561", "Key", "Lidar", "LidarSpec", "lidar_spec"]
