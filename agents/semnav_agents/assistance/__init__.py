"""Shared control: a person or an agent drives, and the robot helps."""

from semnav_agents.assistance.assisted import Assisted
from semnav_agents.assistance.hand import Hand

__all__ = ["Assisted", "Hand"]
