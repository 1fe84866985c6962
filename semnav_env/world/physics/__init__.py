"""The physical world: a robot that drives through a floor plan and is stopped by solid things."""

from semnav_env.world.physics.bodies import GRAVITY, GRIP
from semnav_env.world.physics.contacts import Contacts
from semnav_env.world.physics.world import World

__all__ = ["GRAVITY", "GRIP", "Contacts", "World"]
