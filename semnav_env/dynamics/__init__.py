"""What changes while the robot drives, or between episodes: people, doors, furniture."""

from semnav_env.dynamics.plan_source import PlanSource
from semnav_env.dynamics.settings import NO_DYNAMICS, Dynamics, Swinging, Walking

__all__ = ["NO_DYNAMICS", "Dynamics", "PlanSource", "Swinging", "Walking"]
