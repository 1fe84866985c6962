"""Changes during and between episodes: people, doors that open and close, moved furniture."""

from semnav_env.world.dynamics.plan_source import PlanSource
from semnav_env.world.dynamics.settings import NO_DYNAMICS, Dynamics, Swinging, Walking

__all__ = ["NO_DYNAMICS", "Dynamics", "PlanSource", "Swinging", "Walking"]
