"""Which doors count, on which side of a corridor and in which order."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_env.commands.references import Side
from semnav_env.features.corridor import MAX_KNOWN_VIEWS, Corridor
from semnav_env.features.frames import Point, Pose, heading_between, middle_of, to_local, wrap_angle
from semnav_env.features.scene import Door, Scene, StillScene
from semnav_env.grounding.door_geometry import bearing, heading_through
from semnav_env.grounding.visible_doors import doors_around
from semnav_env.rules import GroundingRules

SIDE_SAMPLES = (0.15, 0.5, 0.85)
"""Places in an opening that are tested for lying on the side of a corridor, as shares of its width;
one of them is enough, for a wall may end in the opening."""


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
    counted = (_counted(door, corridor, rules) for door in scene.doors)
    return sorted((each for each in counted if each is not None), key=lambda door: door.along)


def doors_straight_ahead(scene: Scene, pose: Pose, rules: GroundingRules) -> list[CountedDoor]:
    """The doors in view that lie more ahead of a turned pose than beside it: those behind a robot.

    They are ordered not along a corridor but by their angle off straight ahead.
    """
    seen = ((bearing(pose, door), door) for door in doors_around(scene, pose, rules=rules))
    return [
        CountedDoor(door, ahead, Side.BEHIND, heading_through(door, heading), off)
        for off, door in sorted(seen, key=lambda each: each[0])
        if off < math.pi / 4
        for heading in [heading_between(pose[:2], door.midpoint)]
        for ahead in [to_local(pose, door.midpoint)[0]]
    ]


def _counted(door: Door, corridor: Corridor, rules: GroundingRules) -> CountedDoor | None:
    """The door as the corridor counts it; None if it does not."""
    start, end = to_local(corridor.frame, door.start), to_local(corridor.frame, door.end)
    dx, dy = end[0] - start[0], end[1] - start[1]
    along, offset = middle_of(start, end)
    if along < 0.0:
        return None
    if abs(dx) < abs(dy):
        near_end = abs(along - corridor.end) <= rules.end_door_offset
        at_end = near_end and abs(offset) <= corridor.half_width
        side, towards = Side.AHEAD if at_end else None, 0.0
    else:
        beside = Side.LEFT if offset > 0 else Side.RIGHT
        side = beside if _is_on_the_side(start, end, corridor, rules) else None
        towards = math.copysign(math.pi / 2, offset)
    if side is None:
        return None
    normal = math.atan2(dx, -dy)
    if math.cos(normal - towards) < 0:
        normal += math.pi
    return CountedDoor(door, along, side, wrap_angle(corridor.frame[2] + normal))


def _is_on_the_side(start: Point, end: Point, corridor: Corridor, rules: GroundingRules) -> bool:
    """Whether a ray from the axis to the side meets the door first, somewhere along it."""
    for share in SIDE_SAMPLES:
        along = start[0] + share * (end[0] - start[0])
        offset = start[1] + share * (end[1] - start[1])
        if abs(corridor.side_at(offset > 0, along) - abs(offset)) < rules.door_offset:
            return True
    return False
