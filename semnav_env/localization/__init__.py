"""Where a robot is in a known floor plan, by odometry and the doors that it detects.

A mode of its own: agents that follow commands without a map use `semnav_env.belief`.
"""

from semnav_env.localization.dead_reckoning import OdometryErrors
from semnav_env.localization.door_pose import pose_from_door
from semnav_env.localization.plan_localizer import LocalizerRules, PlanLocalizer

__all__ = ["LocalizerRules", "OdometryErrors", "PlanLocalizer", "pose_from_door"]
