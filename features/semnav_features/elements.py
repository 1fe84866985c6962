"""The features that a scan or a map is made of: walls, doors, corners, corridors and arcs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

from semnav_features.frames import Point, heading_between, middle_of
from semnav_features.validation import finite_floats, require


class CornerKind(IntEnum):
    """The corner types of Barbret 2021, section 3.2.1."""

    OUTER = 0
    INNER = 1
    POTENTIAL = 2


@dataclass(frozen=True, slots=True)
class Wall:
    """A straight wall, directed so that its free side, where the scanner is, lies to its left.

    Attributes:
        start: first end, (x, y) in metres.
        end: last end.
        start_rupture: the beam before the start had no usable return.
        end_rupture: the beam after the end had no usable return.
        start_break: the range jumps before the start.
        end_break: the range jumps after the end.
        beams: how many beams support the wall; 0 for a wall of a floor plan.
        residual: root mean square distance of its points to the line, metres.
        angle_deviation: standard deviation of the direction of the fitted line, radians.
        offset_deviation: standard deviation of the line across itself at `centroid`, metres;
            the two errors are uncorrelated there.
        centroid: mean of its points, (x, y) in metres; None for a wall of a floor plan.
        visible: share of its length that is in view, 0 to 1; below 1 only in a true scene.
    """

    start: Point
    end: Point
    start_rupture: bool = False
    end_rupture: bool = False
    start_break: bool = False
    end_break: bool = False
    beams: int = 0
    residual: float = 0.0
    angle_deviation: float = 0.0
    offset_deviation: float = 0.0
    centroid: Point | None = None
    visible: float = 1.0

    @property
    def length(self) -> float:
        """Metres."""
        return math.dist(self.start, self.end)

    @property
    def heading(self) -> float:
        """Direction from start to end, radians (Barbret (1.6))."""
        return heading_between(self.start, self.end)

    @property
    def line(self) -> tuple[float, float]:
        """Its line x cos(theta) + y sin(theta) = d (Weerakoon et al. (10)) in its frame.

        Returns:
            theta, direction of the normal from the frame's origin, radians in (-pi, pi]; and
            d, distance from the origin, metres, not negative.
        """
        x, y = self.start
        theta = self.heading - 0.5 * math.pi
        distance = x * math.cos(theta) + y * math.sin(theta)
        if distance < 0.0:
            theta, distance = theta + math.pi, -distance
        return math.pi - (math.pi - theta) % math.tau, distance


@dataclass(frozen=True, slots=True)
class SceneLeaf:
    """The open leaf of a door.

    Attributes:
        hinge_at_start: whether it hangs at the door's start, or at its end.
        angle: between the leaf and the closed door, radians; pi / 2 stands square to it.
            Positive away from the scanner, negative towards it.
    """

    hinge_at_start: bool
    angle: float


@dataclass(frozen=True, slots=True)
class Door:
    """An open doorway: the gap from the end of one wall to the start of the next.

    Its ends become tuples, whatever rows of numbers they are given as.

    Attributes:
        start: the jamb where a wall ends, (x, y) in metres.
        end: the jamb where the next wall starts; the scanner is on the left of start-end.
        name: the door's name in its floor plan; None for a perceived door.
        sightings: in how many scans it was seen; 1 in a single scan's scene.
        confidence: how likely it is a door, 0 to 1.
        leaf: its open leaf, if one is seen.
        visible: share of its opening that is in view, 0 to 1; below 1 only in a true scene.

    Raises:
        ValueError: an end is not two finite numbers.
    """

    start: Point
    end: Point
    name: str | None = None
    sightings: int = 1
    confidence: float = 1.0
    leaf: SceneLeaf | None = None
    visible: float = 1.0

    def __post_init__(self) -> None:
        if type(self.start) is tuple and type(self.end) is tuple:
            return
        for name in ("start", "end"):  # doors are keys, and arrays cannot be hashed
            point = finite_floats(getattr(self, name))
            right = "(x, y), two finite numbers of metres"
            require(point and len(point) == 2, name, getattr(self, name), right)
            object.__setattr__(self, name, point)

    @property
    def midpoint(self) -> Point:
        """Middle of the opening, (x, y) in metres."""
        return middle_of(self.start, self.end)

    @property
    def width(self) -> float:
        """Distance between the jambs, metres."""
        return math.dist(self.start, self.end)


@dataclass(frozen=True, slots=True)
class Corner:
    """A place where two walls meet, or where a wall may bend out of sight.

    Attributes:
        point: (x, y) in metres.
        kind: inner and outer as in Barbret (3.1); potential at a rupture or break.
    """

    point: Point
    kind: CornerKind


@dataclass(frozen=True, slots=True)
class CorridorProbe:
    """An entrance to or a cross-section of a corridor: the probe from a corner to a wall.

    Attributes:
        start: the corner that was probed from, (x, y) in metres.
        end: where the probe met another wall.
    """

    start: Point
    end: Point

    @property
    def midpoint(self) -> Point:
        """The point at which a robot would pass, (x, y) in metres."""
        return middle_of(self.start, self.end)


@dataclass(frozen=True, slots=True)
class Arc:
    """A part of a circle: a column or a curved wall (Yan et al.).

    Attributes:
        centre: of the circle, (x, y) in metres.
        radius: metres.
        start: first end on the circle in beam order, (x, y) in metres.
        end: last end.
        convex: it bulges towards the scanner, as a column does; a curved wall seen from its
            hollow side does not.
        beams: how many beams support it; 0 for an arc of a floor plan.
        residual: root mean square distance of its points to the circle, metres.
        visible: share of it that is in view, 0 to 1; below 1 only in a true scene.
    """

    centre: Point
    radius: float
    start: Point
    end: Point
    convex: bool = True
    beams: int = 0
    residual: float = 0.0
    visible: float = 1.0

    @property
    def extent(self) -> float:
        """Angle that it spans about its centre, radians, 0 to 2 pi."""
        start = heading_between(self.centre, self.start)
        end = heading_between(self.centre, self.end)
        # Beams run counter-clockwise, so the near side of a circle is passed clockwise.
        return (start - end if self.convex else end - start) % math.tau


@dataclass(frozen=True, slots=True)
class Rejection:
    """A rejected candidate with its reason; see `extract(..., explain=True)`.

    Attributes:
        kind: "wall", "door", "corner" or "corridor".
        start: one end of the candidate, (x, y) in metres.
        end: the other.
        reason: the limit that it missed, in words.
    """

    kind: str
    start: Point
    end: Point
    reason: str
