"""The situations of the rules of reference, and what is meant in them: `rules.json`.

A situation is a corridor along x (see `hand_made.corridor`), whose doors are called L1, L2, ... on
the left and R1, R2, ... on the right in the order of x, and A in the end; or walls and doors that
are given one by one; or a bundled floor plan. A row says what a command means there.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from shapely import box

from semnav_env.world.maps import FloorPlan, Material, PlanDoor, Surface, load_floor_plan
from semnav_features.frames import Point, Pose
from semnav_features.scene import Scene, Wall
from tests.support.hand_made import corridor, polyline

TABLE: dict[str, Any] = json.loads(Path(__file__).with_name("rules.json").read_text())
CORRIDOR = ("left", "right", "length", "half", "end_door")


@dataclass(frozen=True)
class Row:
    """What a command means in a situation.

    Attributes:
        id: what docs/concepts/commands.md calls it.
        situation: a key of the table's situations.
        begin: where the command is given.
        command: its text.
        expected: a door's name, a place (x, y), or what the error says.
    """

    id: str
    situation: str
    begin: Pose
    command: str
    expected: str | Point


ROWS = [
    Row(name, where, tuple(begin), command, tuple(meant) if isinstance(meant, list) else meant)
    for name, where, begin, command, meant in TABLE["rows"]
]


@cache
def situation(name: str) -> FloorPlan:
    """The floor plan of a situation."""
    given = dict(TABLE["situations"][name])
    if "plan" in given:
        return load_floor_plan(given["plan"])
    scene = Scene() if "walls" in given else _corridor(given)
    extra = given.get("doors", {}).items()
    doors = [*_named(scene), *(PlanDoor(n, tuple(e[:2]), tuple(e[2:])) for n, e in extra)]
    lines = [*given.get("walls", ()), *given.get("more", ())]
    walls = [*scene.walls, *(wall for line in lines for wall in polyline(*map(tuple, line)))]
    shut = given.get("closed", ())
    leaves = [(tuple(a), tuple(b)) for a, b in given.get("leaves", ())]
    leaves += [(door.start, door.end) for door in doors if door.name in shut]
    return _plan(name, walls, doors, leaves, shut)


def _corridor(given: dict[str, Any]) -> Scene:
    arms = {key: [tuple(arm) for arm in given.get(key, ())] for key in ("left_arms", "right_arms")}
    return corridor(**{key: given[key] for key in CORRIDOR if key in given}, **arms)


def _named(scene: Scene) -> list[PlanDoor]:
    """The doors of a corridor by their side and number."""
    named, counts = [], {"L": 0, "R": 0}
    for door in sorted(scene.doors, key=lambda door: door.midpoint[0]):
        side = "L" if door.midpoint[1] > 0.1 else "R" if door.midpoint[1] < -0.1 else "A"
        counts[side] = counts.get(side, 0) + 1
        name = "A" if side == "A" else f"{side}{counts[side]}"
        named.append(PlanDoor(name, door.start, door.end))
    return named


def _plan(
    name: str,
    walls: list[Wall],
    doors: list[PlanDoor],
    leaves: list[tuple[Point, Point]],
    shut: tuple[str, ...],
) -> FloorPlan:
    surfaces = [Surface((wall.start, wall.end)) for wall in walls]
    surfaces += [Surface(leaf, Material.LEAF) for leaf in leaves]
    doors = [PlanDoor(d.name, d.start, d.end, d.name not in shut) for d in doors]
    xs, ys = zip(*(point for surface in surfaces for point in surface.points), strict=True)
    outline = box(min(xs), min(ys), max(xs), max(ys))
    return FloorPlan(name, tuple(surfaces), tuple(doors), (), (), (), outline)
