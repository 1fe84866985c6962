"""A simulated 2D lidar: exact ranges by an interval raster, noise by a counter-based hash."""

from semnav_env.world.lidar.lidar import Key, Lidar
from semnav_features.lidar_spec import BARBRET, LIDARS, TIM561, LidarSpec, lidar_spec

__all__ = ["BARBRET", "LIDARS", "TIM561", "Key", "Lidar", "LidarSpec", "lidar_spec"]
