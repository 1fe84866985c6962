"""What the segments of a floor plan belong to: straight walls and round surfaces."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from semnav_env.world.maps.floor_plan import FloorPlan, Material, Surface
from semnav_features.frames import FloatArray, Point

MAX_CIRCLE_ERROR = 0.01
"""The points of a round surface lie this close to its circle, metres."""

MAX_EDGE_ANGLE = math.radians(30.0)
"""Greatest angle of an edge of a round surface about the centre, radians."""

MIN_ROUND_EDGES = 4
"""Fewest edges of a round surface."""

SAME_END_DISTANCE = 1e-6
"""Ends this close together are one, metres."""

MAX_STRAIGHT_TURN = math.radians(0.5)
"""Segments that meet at a smaller turn are one wall, radians."""


@dataclass(frozen=True)
class PlanCircle:
    """The circle that a round surface follows.

    Attributes:
        centre: metres.
        radius: metres.
        extent: angle that the surface spans about the centre, radians.
    """

    centre: Point
    radius: float
    extent: float


@dataclass(frozen=True, eq=False)
class Shapes:
    """The opaque segments of a floor plan and what each belongs to.

    Attributes:
        segments: world frame, metres, shape (n, 4).
        walls: number of the straight wall that each belongs to, shape (n,).
        lengths: of the straight walls, metres.
        surfaces: number of the surface in the plan that each belongs to, shape (n,).
        circles: of the round surfaces by their numbers, world frame.
    """

    segments: FloatArray
    walls: NDArray[np.intp]
    lengths: FloatArray
    surfaces: NDArray[np.intp]
    circles: dict[int, PlanCircle]

    @classmethod
    def of(cls, floor_plan: FloorPlan) -> Shapes:
        """What a beam can meet in a floor plan."""
        opaque = [
            (number, surface)
            for number, surface in enumerate(floor_plan.surfaces)
            if surface.material is not Material.GLASS
        ]
        rows = [
            (number, *a, *b)
            for number, surface in opaque
            for a, b in zip(surface.points, surface.points[1:], strict=False)
            if a != b
        ]
        table = np.array(rows, dtype=np.float64).reshape(-1, 5)
        circles = {number: circle for number, s in opaque if (circle := fit_circle(s)) is not None}
        walls, lengths = straight_walls(table[:, 1:])
        return cls(table[:, 1:], walls, lengths, table[:, 0].astype(np.intp), circles)


def fit_circle(surface: Surface) -> PlanCircle | None:
    """The circle that a surface follows, if it is round.

    It is if all its points lie within `MAX_CIRCLE_ERROR` of one circle, fitted by least squares
    (Kasa 1976), and it has at least `MIN_ROUND_EDGES` edges that turn the same way, each by at most
    `MAX_EDGE_ANGLE` about the centre. A column drawn with twelve sides or more is round; an
    octagonal one has eight walls.
    """
    points = np.array(surface.points, dtype=np.float64)
    if len(points) <= MIN_ROUND_EDGES:
        return None
    origin = points.mean(axis=0)
    matrix = np.column_stack((2.0 * (points - origin), np.ones(len(points))))
    target = ((points - origin) ** 2).sum(axis=1)
    solution, _, rank, _ = np.linalg.lstsq(matrix, target, rcond=None)
    if rank < 3:
        return None
    centre = origin + solution[:2]
    arms = points - centre
    radius = math.sqrt(solution[2] + solution[:2] @ solution[:2])
    turns = _turns(np.arctan2(arms[:, 1], arms[:, 0]))
    one_way = bool((turns > 0.0).all() or (turns < 0.0).all())
    close = bool((np.abs(np.hypot(*arms.T) - radius) <= MAX_CIRCLE_ERROR).all())
    if not (close and one_way and (np.abs(turns) <= MAX_EDGE_ANGLE + 1e-9).all()):
        return None
    return PlanCircle((float(centre[0]), float(centre[1])), radius, float(np.abs(turns).sum()))


def straight_walls(segments: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
    """Segments that go straight on from one another are one wall.

    Returns:
        The wall of each segment, shape (n,), and the walls' lengths, shape (k,), metres.
    """
    along = segments[:, 2:] - segments[:, :2]
    pairs = (
        cKDTree(segments.reshape(-1, 2)).query_pairs(SAME_END_DISTANCE, output_type="ndarray") // 2
    )
    a, b = along[pairs[:, 0]], along[pairs[:, 1]]
    sines = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    straight = np.abs(sines) < math.sin(MAX_STRAIGHT_TURN) * np.hypot(*a.T) * np.hypot(*b.T)
    i, j = pairs[straight].T
    graph = coo_array((np.ones(len(i)), (i, j)), shape=(len(segments), len(segments)))
    _, walls = connected_components(graph, directed=False)
    lengths = np.bincount(walls, weights=np.hypot(*along.T))
    return walls.astype(np.intp), lengths.astype(np.float64)


def _turns(angles: FloatArray) -> FloatArray:
    return np.asarray((np.diff(angles) + math.pi) % (2.0 * math.pi) - math.pi)
