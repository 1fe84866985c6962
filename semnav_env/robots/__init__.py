"""The robots: their bodies, their limits and what an agent may ask of them."""

from semnav_env.robots.spec import ROBOTS, SPOT, WHEELCHAIR, RobotSpec, robot_spec

__all__ = ["ROBOTS", "SPOT", "WHEELCHAIR", "RobotSpec", "robot_spec"]
