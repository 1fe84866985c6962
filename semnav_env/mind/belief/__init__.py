"""The robot's side: what a robot believes, from its ranges, its odometry and its bumps.

It needs features, commands and grounding, and no simulator.
"""

from semnav_env.mind.belief.belief import Belief
from semnav_env.mind.belief.bump_map import BumpMap
from semnav_env.mind.belief.tracker import BeliefTracker

__all__ = ["Belief", "BeliefTracker", "BumpMap"]
