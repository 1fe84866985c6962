"""Which doors count, on which side of a corridor and in which order."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_env.commands.references import Side
from semnav_env.features.corridor import MAX_KNOWN_VIEWS, Corridor
from semnav_env.features.frames import Pose
from semnav_env.features.kernels.door_counting import count_doors
from semnav_env.features.scene import Door, Scene, StillScene, ends_of
from semnav_env.rules import GroundingRules

SIDES = (Side.LEFT, Side.RIGHT, Side.AHEAD)
"""Sides by the numbers that the kernel gives them."""


@dataclass(frozen=True, slots=True)
class CountedDoor:
    """A door as a reference counts it.

    Attributes:
        door: in the scene's frame.
        along: where its middle lies along the corridor's axis, metres.
        side: on which side of the axis, or ahead, behind or opposite.
        outward: the heading that leads through it, away from the corridor, scene frame.
        off: angle off straight behind, radians; only of doors that are ordered by it.
    """

    door: Door
    along: float
    side: Side
    outward: float
    off: float = 0.0

    def pose(self, beyond: float) -> Pose:
        """The pose on the door's axis `beyond` its line (negative: before it), facing outward."""
        x, y = self.door.midpoint
        c, s = math.cos(self.outward), math.sin(self.outward)
        return x + beyond * c, y + beyond * s, self.outward


def doors_along(
    scene: Scene,
    corridor: Corridor,
    side: Side | None = None,
    rules: GroundingRules = GroundingRules(),
) -> list[CountedDoor]:
    """The doors that open onto a corridor ahead of its frame, in the order of travel.

    A door counts while at least half of its opening is still ahead. A door that runs with the
    corridor belongs to the side it lies on, if a look from the axis to that side meets it; one that
    runs across the corridor and ends it lies ahead.

    Args:
        scene: the doors, in the frame of the corridor.
        corridor: whose frame stands where the counting begins.
        side: count only the doors there.
        rules: distances.
    """
    every = _known_doors_along(scene, corridor, rules)
    return [door for door in every if side in (None, door.side)]


def _known_doors_along(
    scene: Scene, corridor: Corridor, rules: GroundingRules
) -> list[CountedDoor]:
    """The doors on all sides; in a scene that never changes they are counted once a corridor."""
    if not isinstance(scene, StillScene):
        return _all_doors_along(scene, corridor, rules)
    known, key = scene.known_doors, (corridor, rules)
    if key not in known:
        if len(known) >= MAX_KNOWN_VIEWS:
            known.clear()
        known[key] = _all_doors_along(scene, corridor, rules)
    found: list[CountedDoor] = known[key]
    return found


def _all_doors_along(scene: Scene, corridor: Corridor, rules: GroundingRules) -> list[CountedDoor]:
    doors = scene.doors
    rows = count_doors(
        scene.door_ends if isinstance(scene, StillScene) else ends_of(doors),
        corridor.frame,
        corridor.half_width,
        corridor.end,
        corridor.left,
        corridor.right,
        rules.door_offset,
        rules.end_door_offset,
    )
    return [
        CountedDoor(doors[k], along, SIDES[side], outward)
        for along, k, side, outward in sorted(rows.tolist())
    ]
