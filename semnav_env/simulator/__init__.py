"""The simulated robot: world, lidar and odometry behind one object, `step(twist) -> Sensed`."""

from semnav_env.simulator.odometry import EXACT, OdometrySettings
from semnav_env.simulator.sensed import Motion, Sensed
from semnav_env.simulator.simulator import RobotSetup, Simulator

__all__ = ["EXACT", "Motion", "OdometrySettings", "RobotSetup", "Sensed", "Simulator"]
