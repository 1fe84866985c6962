"""A simulated 2D lidar: exact ranges by an interval raster, noise by a counter-based hash."""

from semnav_env.features.lidar_spec import BARBRET, LIDARS, TIM561, LidarSpec, lidar_spec
from semnav_env.lidar.lidar import Key, Lidar

__all__ = ["BARBRET", "LIDARS", "TIM561", "Key", "Lidar", "LidarSpec", "lidar_spec"]
