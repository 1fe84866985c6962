"""Poses from which a robot can pass a door (Mes 2021, chapters 5 and 7), best first."""

from semnav_env.approach.door_side import DoorSide
from semnav_env.approach.plan import ApproachPlan, plan_approach
from semnav_env.approach.poses import CandidatePose
from semnav_env.approach.settings import THESIS_SETTINGS, ApproachSettings
from semnav_env.approach.surroundings import Surroundings

__all__ = [
    "THESIS_SETTINGS",
    "ApproachPlan",
    "ApproachSettings",
    "CandidatePose",
    "DoorSide",
    "Surroundings",
    "plan_approach",
]
