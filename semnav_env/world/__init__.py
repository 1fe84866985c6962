"""The physical world: a robot that is driven through a floor plan and stopped by what is solid."""

from semnav_env.world.bodies import GRAVITY, GRIP
from semnav_env.world.contacts import Contacts
from semnav_env.world.world import World

__all__ = ["GRAVITY", "GRIP", "Contacts", "World"]
