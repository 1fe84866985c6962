"""What changes while the robot drives, or between episodes: people, doors, furniture."""

from semnav_env.dynamics.moving import Moving
from semnav_env.dynamics.settings import OFF, Dynamics, Swinging, Walking
from semnav_env.dynamics.stage import Stage

__all__ = ["OFF", "Dynamics", "Moving", "Stage", "Swinging", "Walking"]
