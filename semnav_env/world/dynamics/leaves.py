"""Leaves of doors that can open and close, and the space that they need."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from shapely import LineString, Polygon

from semnav_env.world.maps.doorways import DRAWING_TOLERANCE
from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor, Surface
from semnav_features.frames import Point, heading_between, wrap_angle

OPEN_ANGLE = math.radians(85.0)
"""Angle at which a leaf that the plan does not draw stands open, radians: nearly square to the
opening, so that a robot passes."""

ANGLE_MARGIN = math.radians(1.5)
"""Angle next to the closed and to the open leaf in which walls may lie, radians: the leaf ends at a
jamb and may rest against a wall."""

HINGE_RADIUS = 0.06
"""Radius around the hinge in which walls may lie, metres: a leaf hangs in its jamb."""


@dataclass(frozen=True)
class PlanLeaf:
    """A leaf that swings about one jamb of a door.

    Attributes:
        door: name.
        hinge: (x, y) in metres.
        length: metres.
        closed: direction in which it fills the opening, radians.
        swing: angle from there to where the plan draws it, radians in (-pi, pi).
    """

    door: str
    hinge: Point
    length: float
    closed: float
    swing: float

    def tip(self, angle: float) -> Point:
        """The free end of the leaf after opening by `angle` (of the sign of `swing`), metres."""
        direction = self.closed + angle
        x, y = self.hinge
        return x + self.length * math.cos(direction), y + self.length * math.sin(direction)

    @property
    def swept(self) -> Polygon:
        """The area that it sweeps, less a margin at the hinge and at both ends of the swing."""
        sign = math.copysign(1.0, self.swing)
        angles = np.linspace(sign * ANGLE_MARGIN, self.swing - sign * ANGLE_MARGIN, 16)
        x, y = self.hinge
        rim = [self.tip(angle) for angle in angles]
        share = HINGE_RADIUS / self.length
        inner = [(x + share * (px - x), y + share * (py - y)) for px, py in rim]
        return Polygon([*rim, *inner[::-1]])


def with_leaves(plan: FloorPlan) -> FloorPlan:
    """The plan with an open leaf at every door that has none and has room for one.

    It is hung into the room rather than into the corridor, and where it meets no other leaf.
    """
    hung = []
    taken = [leaf.swept for leaf in swinging_leaves(plan)[0]]
    for door in plan.doors:
        if door.open and not any(_hangs(surface, door) for surface in plan.surfaces):
            choices = (leaf for leaf in _new_leaves(door, plan) if _has_room(leaf, plan))
            leaf = next((leaf for leaf in choices if not _meets(leaf, taken)), None)
            if leaf is not None:
                taken.append(leaf.swept)
                hung.append(Surface((leaf.hinge, leaf.tip(leaf.swing)), Material.LEAF))
    return replace(plan, surfaces=(*plan.surfaces, *hung)) if hung else plan


def without_leaves_at(hung: FloorPlan, plan: FloorPlan, body: Polygon) -> FloorPlan:
    """The plan without the leaves that `with_leaves` hung where a body stands.

    Args:
        hung: the plan with leaves.
        plan: the plan before.
        body: what it covers, world frame.
    """
    added = hung.surfaces[len(plan.surfaces) :]
    rest = tuple(leaf for leaf in added if not body.intersects(LineString(leaf.points)))
    return hung if len(rest) == len(added) else replace(hung, surfaces=(*plan.surfaces, *rest))


def swinging_leaves(plan: FloorPlan) -> tuple[tuple[PlanLeaf, ...], FloorPlan]:
    """The leaves that can close, as drawn, and the plan without them.

    Those of open doors with one leaf as wide as the opening that has room to swing; of two that
    would meet, the first.
    """
    leaves: list[PlanLeaf] = []
    drawn: list[Surface] = []
    taken: list[Polygon] = []
    for door in plan.doors:
        hanging = [surface for surface in plan.surfaces if _hangs(surface, door)]
        leaf = _as_leaf(hanging[0], door) if door.open and len(hanging) == 1 else None
        if leaf and _has_room(leaf, plan, hanging[0]) and not _meets(leaf, taken):
            taken.append(leaf.swept)
            leaves.append(leaf)
            drawn.append(hanging[0])
    if not leaves:
        return (), plan
    rest = tuple(s for s in plan.surfaces if not any(s is each for each in drawn))
    return tuple(leaves), replace(plan, surfaces=rest)


def _hangs(surface: Surface, door: PlanDoor) -> bool:
    if surface.material is not Material.LEAF:
        return False
    ends = surface.points[0], surface.points[-1]
    return any(
        math.dist(end, jamb) < DRAWING_TOLERANCE for end in ends for jamb in (door.start, door.end)
    )


def _as_leaf(surface: Surface, door: PlanDoor) -> PlanLeaf | None:
    """A straight leaf that can close the door; None if it is another kind of leaf."""
    if len(surface.points) != 2:
        return None
    for hinge, tip in (surface.points, surface.points[::-1]):
        for jamb, other in ((door.start, door.end), (door.end, door.start)):
            length = math.dist(hinge, tip)
            if (
                math.dist(hinge, jamb) < DRAWING_TOLERANCE
                and abs(length - door.width) < 2 * DRAWING_TOLERANCE
            ):
                closed = heading_between(hinge, other)
                drawn = heading_between(hinge, tip)
                return PlanLeaf(door.name, hinge, length, closed, wrap_angle(drawn - closed))
    return None


def _new_leaves(door: PlanDoor, plan: FloorPlan) -> list[PlanLeaf]:
    """The four leaves that a door could get, those that open into a corridor last."""
    leaves = []
    for jamb, other in ((door.start, door.end), (door.end, door.start)):
        closed = heading_between(jamb, other)
        leaves += [
            PlanLeaf(door.name, jamb, door.width, closed, swing)
            for swing in (OPEN_ANGLE, -OPEN_ANGLE)
        ]
    return sorted(leaves, key=lambda leaf: _in_corridor(leaf, plan))


def _in_corridor(leaf: PlanLeaf, plan: FloorPlan) -> bool:
    swept = leaf.swept
    return any(region.polygon.intersection(swept).area > 0.1 for region in plan.corridors)


def _meets(leaf: PlanLeaf, taken: Sequence[Polygon]) -> bool:
    """Whether a leaf sweeps an area that another leaf sweeps too."""
    swept = leaf.swept
    return any(swept.intersects(other) for other in taken)


def _has_room(leaf: PlanLeaf, plan: FloorPlan, own: Surface | None = None) -> bool:
    """Whether nothing stands where the leaf swings."""
    if abs(leaf.swing) < 4 * ANGLE_MARGIN:
        return False
    swept = leaf.swept
    if not plan.boundary.covers(swept):
        return False
    rows = plan.solids.query(swept, predicate="intersects").tolist()
    return all(plan.surfaces[int(plan.owners[row])] is own for row in rows)
