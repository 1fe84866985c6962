"""The scenes of Mes 2021, chapter 8: the hall of the villa, from the poses of her table 7.2."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely

from semnav_env.robots import SPOT, DepthRig
from semnav_env.world.depth import Closet, PlanWindow, RaisedPlan, RigHits, raise_plan, rig_hits
from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan, Material, PlanDoor, load_floor_plan
from semnav_env.world.maps.floor_plan import Surface
from semnav_features.clouds import PointCloud
from semnav_features.elements import Door
from semnav_features.frames import Point, Pose, compose, to_local, to_parent
from semnav_features.scan import Scan

POSES: dict[str, tuple[tuple[str, Pose], ...]] = {
    "A": (
        ("parents", (-5.57, 4.35, 0.5 * math.pi)),
        ("living", (1.77, 1.65, -0.5 * math.pi)),
        ("kitchen", (1.35, 0.63, math.pi)),
    ),
    "B": (
        ("living", (1.85, 1.96, -0.75 * math.pi)),
        ("kitchen", (1.03, 0.55, -0.75 * math.pi)),
        ("daughter", (-4.49, 4.35, 0.25 * math.pi)),
        ("daughter", (-5.11, 4.35, -0.25 * math.pi)),
    ),
    "C": (
        ("parents", (-5.57, 4.35, 0.75 * math.pi)),
        ("parents", (-5.57, 4.35, 0.25 * math.pi)),
    ),
    "D": (
        ("living", (2.08, 2.2, math.pi)),
        ("kitchen", (0.8, 0.31, -0.5 * math.pi)),
        ("daughter", (-4.25, 4.59, 0.5 * math.pi)),
    ),
}
"""The twelve clouds of her chapter 8: the best three poses of each door in table 7.2, by category.
Her heading 0 looks along +y."""

SHUT: dict[str, Material] = {"glass": Material.GLASS, "wood": Material.LEAF}
"""Categories of doors that are shut, by what fills them; they are seen from the poses of A and B.
Mes 2021 has none."""

PLACE_SIGMA, HEADING_SIGMA = 0.05, math.radians(3.0)
"""How exactly SPOT goes to a planned pose: standard deviation, metres and radians. Assumed."""

DRIFT_SIGMA, DRIFT_HEADING_SIGMA = 0.10, math.radians(3.0)
"""How far the believed pose is off, the same way. Assumed."""

SHOWN_POINTS, SHOWN_HEIGHT = 30, 0.30
"""A cloud shows a jamb if so many of its points lie on that jamb's frame, and nine tenths of them
span so much height, metres. Fixed before any detector was run."""

LEAF_SHARE, WINDOW_SHARE, CLOSET_SHARE = 0.5, 0.4, 0.3
"""How often a door has a leaf, a window beside it, a closet beside it."""


@dataclass(frozen=True, eq=False)
class CloudScene:
    """A robot before a door.

    Attributes:
        category: A to D, or one of `SHUT`.
        raised: the plan with leaves, windows and closets.
        door: of the plan.
        pose: true pose, world frame.
        believed: believed pose, world frame.
        seed: of the sensors' errors.
    """

    category: str
    raised: RaisedPlan
    door: PlanDoor
    pose: Pose
    believed: Pose
    seed: int

    @cached_property
    def hits(self) -> RigHits:
        """What SPOT's cameras measure."""
        return self.look(DepthRig.spot())

    def look(self, rig: DepthRig) -> RigHits:
        """What the cameras of a rig measure."""
        return rig_hits(rig, self.raised, self.pose, np.random.default_rng(self.seed))

    def scan(self) -> Scan:
        """What SPOT's lidar measures, lidar frame."""
        return Lidar(self.raised.plan, mount=SPOT.lidar_mount).scan(self.pose, (self.seed, 0, 0))

    @property
    def expected(self) -> Door:
        """Where the robot expects the door, robot frame."""
        return _seen(self.door, self.believed)

    @property
    def truth(self) -> Door:
        """Where the door is, robot frame."""
        return _seen(self.door, self.pose)

    def shows(self, hits: RigHits) -> tuple[bool, bool]:
        """Whether a cloud shows the start and the end of the door."""
        index = self.raised.plan.doors.index(self.door)
        heights = [hits.cloud.points_robot[hits.jambs == 2 * index + k, 2] for k in (0, 1)]
        start, end = (_is_shown(each) for each in heights)
        return start, end


def merged(hits: Sequence[RigHits]) -> RigHits:
    """Hits of several poses as one; each point stays in the robot frame of its pose."""
    points = np.concatenate([each.cloud.points_robot for each in hits])
    jambs = np.concatenate([each.jambs for each in hits])
    kinds = np.concatenate([each.kinds for each in hits])
    return RigHits(PointCloud(points), jambs, kinds)


def _is_shown(heights: np.ndarray) -> bool:
    if len(heights) < SHOWN_POINTS:
        return False
    low, high = np.quantile(heights, (0.05, 0.95))
    return bool(high - low >= SHOWN_HEIGHT)


def _seen(door: PlanDoor, pose: Pose) -> Door:
    return Door(to_local(pose, door.start), to_local(pose, door.end))


def draw_scenes(category: str, count: int, seed: int) -> Iterator[CloudScene]:
    """Scenes of one category, the poses in turn."""
    plan = load_floor_plan("villa_hall")
    for number in range(count):
        rng = np.random.default_rng((seed, ord(category[0]), number))
        poses = POSES["A"] + POSES["B"] if category in SHUT else POSES[category]
        name, (x, y, heading) = poses[number % len(poses)]
        planned = x, y, heading + 0.5 * math.pi
        pose = compose(planned, _error(rng, PLACE_SIGMA, HEADING_SIGMA))
        believed = compose(pose, _error(rng, DRIFT_SIGMA, DRIFT_HEADING_SIGMA))
        raised = _furnished(plan, plan.door(name), pose, rng, SHUT.get(category))
        yield CloudScene(
            category, raised, plan.door(name), pose, believed, int(rng.integers(2**31))
        )


def _error(rng: np.random.Generator, place: float, heading: float) -> Pose:
    dx, dy, turn = (rng.standard_normal(3) * (place, place, heading)).tolist()
    return dx, dy, turn


def _furnished(
    plan: FloorPlan, door: PlanDoor, pose: Pose, rng: np.random.Generator, filled: Material | None
) -> RaisedPlan:
    """The plan with a leaf in the room, and a window and a closet beside the door.

    A door that is filled with a material is shut: its leaf stands in the opening.
    """
    frame = (*door.start, math.atan2(door.end[1] - door.start[1], door.end[0] - door.start[0]))
    robots_side = math.copysign(1.0, to_local(frame, pose[:2])[1])
    leaf_draw, window_draw, closet_draw = rng.random(3).tolist()
    if filled is not None:
        shut = Surface((door.start, door.end), filled)
        plan = replace(plan, surfaces=(*plan.surfaces, shut))
    elif leaf_draw < LEAF_SHARE:
        surface = Surface(_leaf(frame, door.width, -robots_side, rng), Material.LEAF)
        plan = replace(plan, surfaces=(*plan.surfaces, surface))
    window = _window(plan, frame, door.width, rng)
    windows = (window,) if window is not None and window_draw < WINDOW_SHARE else ()
    closet = _closet(plan, frame, door.width, robots_side, pose, rng)
    closets = (closet,) if closet is not None and closet_draw < CLOSET_SHARE else ()
    return raise_plan(plan, windows=windows, closets=closets)


def _leaf(frame: Pose, width: float, side: float, rng: np.random.Generator) -> tuple[Point, Point]:
    """An open leaf on one of the jambs."""
    angle, at_start = math.radians(float(rng.uniform(75.0, 110.0))), rng.random() < 0.5
    hinge = 0.0 if at_start else width
    towards = 1.0 if at_start else -1.0
    tip = hinge + towards * width * math.cos(angle), side * width * math.sin(angle)
    return to_parent(frame, (hinge, 0.0)), to_parent(frame, tip)


def _beside(
    width: float, gap: float, length: float, rng: np.random.Generator
) -> tuple[float, float]:
    """A stretch of the wall line beside the door, from its start."""
    if rng.random() < 0.5:
        return -gap - length, -gap
    return width + gap, width + gap + length


def _window(
    plan: FloorPlan, frame: Pose, width: float, rng: np.random.Generator
) -> PlanWindow | None:
    """A window in the wall beside the door, where there is wall enough."""
    span = _beside(width, float(rng.uniform(0.2, 0.5)), float(rng.uniform(0.4, 0.8)), rng)
    start, end = (to_parent(frame, (along, 0.0)) for along in span)
    sill = float(rng.uniform(0.2, 0.9))
    pane = shapely.LineString((start, end))
    walls = [
        shapely.LineString(ends)
        for surface in plan.surfaces
        for ends in zip(surface.points, surface.points[1:], strict=False)
    ]
    holds = any(wall.buffer(0.01).covers(pane) for wall in walls)
    return PlanWindow(start, end, sill) if holds else None


def _closet(
    plan: FloorPlan,
    frame: Pose,
    width: float,
    side: float,
    pose: Pose,
    rng: np.random.Generator,
) -> Closet | None:
    """A closet before the wall beside the door, clear of walls, doors and the robot."""
    low, high = _beside(width, float(rng.uniform(0.15, 0.4)), float(rng.uniform(0.4, 0.8)), rng)
    depth, height = side * float(rng.uniform(0.2, 0.35)), float(rng.uniform(0.8, 2.0))
    ring = ((low, side * 0.01), (high, side * 0.01), (high, depth), (low, depth))
    corners = tuple(to_parent(frame, corner) for corner in ring)
    outline = shapely.Polygon(corners)
    body = shapely.Point(pose[:2]).buffer(0.62)
    doors = [shapely.LineString((door.start, door.end)) for door in plan.doors]
    free = not outline.intersects(body) and not any(outline.distance(d) < 0.1 for d in doors)
    clear = not len(plan.solids.query(outline, "intersects"))
    return Closet(corners, height) if free and clear else None
