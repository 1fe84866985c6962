"""Summaries of a floor plan, as numbers and in one line."""

from __future__ import annotations

from typing import Any

from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.doorways import door_state
from semnav_scripts.outputs import counted


def summary(plan: FloorPlan) -> dict[str, Any]:
    """The contents of a plan as JSON; metres."""
    west, south, east, north = plan.boundary.bounds
    return {
        "name": plan.name,
        "size": [round(east - west, 3), round(north - south, 3)],
        "bounds": [west, south, east, north],
        "segments": len(plan.segments),
        "doors": [
            {
                "name": door.name,
                "open": door.open,
                "state": door_state(door, plan).value,
                "width": round(door.width, 3),
                "start": door.start,
                "end": door.end,
            }
            for door in plan.doors
        ],
        "rooms": [room.name for room in plan.rooms],
        "corridors": [corridor.name for corridor in plan.corridors],
        "intersections": [crossing.name for crossing in plan.intersections],
        "source": plan.source,
    }


def in_a_line(plan: dict[str, Any]) -> str:
    """A plan's name, size and number of doors and rooms, from its `summary`."""
    width, height = plan["size"]
    doors, rooms = counted(len(plan["doors"]), "door"), counted(len(plan["rooms"]), "room")
    return f"{plan['name']:<20} {width:5.1f} x {height:.1f} m, {doors}, {rooms}"
