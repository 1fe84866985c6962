"""Points out the ways to named rooms to a robot that does not know the floor plan."""

from __future__ import annotations

from semnav_env.language import Command
from semnav_env.language.command import room_of
from semnav_env.language.told import Told
from semnav_env.mind.grounding.errors import GroundingError
from semnav_env.mind.grounding.ways import Way
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import Pose


class RoomGuide:
    """Knows the floor plan and tells a robot the ways to its rooms.

    Args:
        floor_plan: floor plan of the building.
        command: the command whose clauses name the rooms.
        geodesic: shortest ways in the floor plan; made when first needed if not given.
    """

    def __init__(
        self, floor_plan: FloorPlan, command: Command, geodesic: Geodesic | None = None
    ) -> None:
        self._plan = floor_plan
        self._command = command
        self._geodesic = geodesic
        self.ways: dict[int, Way] = {}

    def __call__(self, clause: int, begin: Pose) -> Way | None:
        """The way to the room that a clause names, world frame; None if it names none.

        Each computed way is kept in `ways` under the number of its clause.

        Raises:
            GroundingError: there is no such room, or no way into it.
        """
        named = self._command.clauses[clause]
        name = room_of(named)
        if name is None:
            return None
        from semnav_env.judge.routes.way_into_room import way_into
        from semnav_env.language.rooms import plain_name  # few commands name a room

        room = next((room for room in self._plan.rooms if plain_name(room.name) == name), None)
        if room is None:
            there = ", ".join(self._plan.room_names) or Told("no room with a name")
            raise GroundingError(
                Told("{what}: {plan} has {rooms}", what=named, plan=self._plan.name, rooms=there)
            )
        if self._geodesic is None:
            self._geodesic = self._plan.derived(Geodesic)
        self.ways[clause] = way_into(self._plan, self._geodesic, room, begin, named)
        return self.ways[clause]
