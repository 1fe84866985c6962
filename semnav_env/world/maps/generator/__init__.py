"""Offices drawn from a seed: corridors, rooms with names, doors, furniture."""

from semnav_env.world.maps.generator.distributions import DISTRIBUTIONS
from semnav_env.world.maps.generator.naming import generate_office
from semnav_env.world.maps.generator.settings import OfficeSettings

__all__ = ["DISTRIBUTIONS", "OfficeSettings", "generate_office"]
