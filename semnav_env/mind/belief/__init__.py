"""The belief of a robot, made from its ranges, its odometry and its bumps.

This package needs features, commands and grounding, but no simulator.
"""

from semnav_env.mind.belief.belief import Belief
from semnav_env.mind.belief.bump_map import BumpMap
from semnav_env.mind.belief.tracker import BeliefTracker

__all__ = ["Belief", "BeliefTracker", "BumpMap"]
