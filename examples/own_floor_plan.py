"""A floor plan of one's own, drawn as GeoJSON: a corridor with a room on its right.

One sees the plan's doors, the command that leads into the room, and a robot that drives there.
Give a path to keep the plan (.geojson); `semnav map check PATH` then says what is wrong with it.

    python examples/own_floor_plan.py corridor.geojson
"""

import json
import sys
import tempfile
from pathlib import Path

from semnav_agents import make_agent
from semnav_agents.base import steps
from semnav_env.env import SemNavEnv
from semnav_env.world.maps import load_floor_plan


def feature(kind: str, shape: str, coordinates: list, **properties: str) -> dict:
    """One thing in the plan; coordinates are metres, x to the right and y up."""
    geometry = {"type": shape, "coordinates": coordinates}
    return {"type": "Feature", "properties": {"kind": kind, **properties}, "geometry": geometry}


def rectangle(west: float, south: float, east: float, north: float) -> list:
    """The outline of a rectangle; its last point is its first."""
    return [[west, south], [east, south], [east, north], [west, north], [west, south]]


ROOM = [[6.0, 0.0], [12.0, 0.0], [12.0, 2.0], [0.0, 2.0], [0.0, 0.0], [5.0, 0.0]]
PLAN = {
    "type": "FeatureCollection",
    "name": "corridor",
    "features": [
        feature("boundary", "Polygon", [rectangle(-1, -5, 13, 3)]),
        feature("wall", "LineString", ROOM),  # the corridor, open where the door is
        feature("wall", "LineString", [[3, 0], [3, -4], [8, -4], [8, 0]]),
        feature("door", "LineString", [[5, 0], [6, 0]], name="office_door"),
        feature("corridor", "Polygon", [rectangle(0, 0, 12, 2)], name="corridor"),
        feature("room", "Polygon", [rectangle(3, -4, 8, 0)], name="office"),
    ],
}


def main(path: str | None = None) -> None:
    """Write the plan, load it, and drive in it."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(path or f"{folder}/corridor.geojson")
        file.write_text(json.dumps(PLAN))
        plan = load_floor_plan(file)
    for door in plan.doors:
        print(f"{door.name}: {door.width:.2f} m wide at {door.midpoint}")
    agent = make_agent("scripted")
    env = SemNavEnv(floor_plan=plan, observation=agent.observation)
    start = {"command": "go through the first door on the right", "pose": (1.2, 1.0, 0.0)}
    *_, last = steps(env, agent, *env.reset(seed=0, options=start))
    print("crossed:", last.info["crossed_doors"], " success:", last.info["is_success"])


if __name__ == "__main__":
    main(*sys.argv[1:2])
