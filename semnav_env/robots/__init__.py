"""The robots: their bodies, limits, actions and depth cameras."""

from semnav_env.robots.depth_camera import DepthCamera
from semnav_env.robots.depth_rig import DepthRig
from semnav_env.robots.spec import ROBOTS, SPOT, WHEELCHAIR, RobotSpec, robot_spec

__all__ = ["ROBOTS", "SPOT", "WHEELCHAIR", "DepthCamera", "DepthRig", "RobotSpec", "robot_spec"]
