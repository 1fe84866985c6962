"""Localization of a robot in a known floor plan, by odometry and the doors that it detects.

This package is separate from the belief tracker: agents that follow commands without a map use
`semnav_env.mind.belief`.
"""

from semnav_env.mind.localization.dead_reckoning import OdometryErrors
from semnav_env.mind.localization.door_pose import pose_from_door
from semnav_env.mind.localization.plan_localizer import LocalizerRules, PlanLocalizer

__all__ = ["LocalizerRules", "OdometryErrors", "PlanLocalizer", "pose_from_door"]
