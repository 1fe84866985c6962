"""Viewpoints of a search: the floor that each would show, its travel cost, and the best one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_agents.searching.outlines import Mask
from semnav_agents.searching.search_map import FREE, LOOKED, SearchMap
from semnav_agents.searching.view_kernels import (
    fits,
    mark_wanted,
    ray_gains,
    seconds_to_look,
)
from semnav_agents.searching.ways import Ways
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Point, Pose, compose, relative, wrap_angle

EDGE = 0.1
"""Share of the field of view at its edge that is not counted on: a look may be turned a little."""

Circle = tuple[float, float, float]
"""x, y and radius, metres."""


@dataclass(frozen=True)
class View:
    """A viewpoint: a pose of the robot, and the cells that its detector should see from there.

    Attributes:
        pose: odometry frame.
        gain: area that it is expected to show, m^2.
        cells: flat indices of the cells that it is expected to show.
    """

    pose: Pose
    gain: float
    cells: NDArray[np.int64]


@dataclass(frozen=True)
class Looker:
    """A body with a detector.

    Attributes:
        robot: the body, with the mount of the detector.
        fov: field of view of the detector, radians.
        view_range: of the detector, metres.
    """

    robot: RobotSpec
    fov: float
    view_range: float

    @property
    def half_angle(self) -> float:
        """Angle to each side of the heading within which the detector is relied on, radians."""
        return 0.5 * (1.0 - EDGE) * self.fov

    def half_size(self, margin: float) -> tuple[float, float]:
        """Half of length and width of the body with a margin around it, metres."""
        return self.robot.length / 2 + margin, self.robot.width / 2 + margin


@dataclass(frozen=True)
class ViewGrid:
    """The resolution of the search for a viewpoint.

    Attributes:
        spacing: between places of the detector, metres.
        rays: directions in which the gain of a place is estimated.
        room: number of the only room of the plan that is searched, from inside it; None for all.
        thorough: whether a small gain counts in a small room.
    """

    spacing: float
    rays: int
    room: int | None = None
    thorough: bool = False


def wanted_cells(chart: SearchMap) -> Mask:
    """The cells still to be searched: of rooms, or without a plan any that may be floor."""
    left = ~chart.has(LOOKED) & (chart.tries < chart.settings.tries) & ~chart.solid
    known = chart.rooms >= 0
    return np.asarray(left & known if known.any() else left)


def best_view(
    chart: SearchMap,
    ways: Ways,
    pose: Pose,
    looker: Looker,
    grid: ViewGrid,
    refused: Sequence[Circle] = (),
) -> View | None:
    """The viewpoint with the largest gain for its cost; None if no gain is large enough.

    Args:
        chart: the map.
        ways: from where the robot is.
        pose: of the robot.
        looker: body and detector of the robot.
        grid: of places and directions to try.
        refused: around places that could not be reached, or that showed less than expected.
    """
    s, wanted, rays = chart.settings, wanted_cells(chart), grid.rays
    if grid.room is not None:
        wanted &= chart.rooms == grid.room
    if not wanted.any():
        return None
    window = max(1, round(looker.half_angle / math.pi * rays))
    headings = math.tau * (np.arange(rays) + (window - 1) / 2) / rays
    where = chart.grid.frame
    eyes = _eyes(chart, grid)
    back = relative(looker.robot.lidar_mount, (0.0, 0.0, 0.0))
    seconds = _seconds(chart, ways, grid, pose, refused)
    costs = seconds_to_look(
        eyes, headings, back, looker.half_size(s.clearance), seconds, ways.room, *where
    )
    x, y, turned = _bodies(eyes, headings, back)
    costs[~ways.lead_to(x, y, turned)] = np.inf
    some = np.isfinite(costs).any(axis=1)
    eyes, costs = eyes[some], costs[some]
    if not len(eyes):
        return None
    gains = ray_gains(eyes, wanted, *chart.sight(), *where, rays, looker.view_range)
    sums = _window_sums(gains, window)
    turns = np.abs(np.angle(np.exp(1j * (headings + back[2] - pose[2])))) / s.turn_rate
    least = _least_gains(chart, eyes, grid.thorough)[:, None]
    worth = np.where(sums > least, sums / (costs + turns[None, :]), 0.0)
    k, best = np.unravel_index(int(np.argmax(worth)), worth.shape)
    if worth[k, best] <= 0.0:
        return None
    place = compose((*eyes[k].tolist(), wrap_angle(float(headings[best]))), back)
    shown = np.flatnonzero(shown_from(chart, place, looker) & wanted)
    return View(place, float(sums[k, best]), shown)


def _bodies(
    eyes: FloatArray, headings: FloatArray, back: Pose
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Poses x, y and heading of the body for places and headings of its detector."""
    c, s = np.cos(headings)[None, :], np.sin(headings)[None, :]
    x, y = eyes[:, :1] + c * back[0] - s * back[1], eyes[:, 1:] + s * back[0] + c * back[1]
    return x, y, np.broadcast_to(headings + back[2], x.shape)


def _least_gains(chart: SearchMap, eyes: FloatArray, thorough: bool) -> FloatArray:
    """Smallest area for which a viewpoint is used, m^2, shape (n,).

    A thorough search accepts a smaller area in small rooms.
    """
    s = chart.settings
    least = np.full(len(eyes), s.least_gain)
    if thorough:
        seen = chart.rooms[chart.has(LOOKED) & ~chart.solid & (chart.rooms >= 0)]
        areas = s.spacing**2 * np.bincount(seen, minlength=int(chart.rooms.max()) + 1)
        rooms = np.array([chart.rooms[chart.grid.cell((x, y))] for x, y in eyes.tolist()])
        inside = rooms >= 0
        least[inside] = np.minimum(s.least_gain, s.least_share * areas[rooms[inside]])
    return least


def shown_from(chart: SearchMap, pose: Pose, looker: Looker) -> Mask:
    """The cells still to be searched that the detector should see from a pose of the robot."""
    seen, eye = np.zeros(chart.hits.shape, np.bool_), compose(pose, looker.robot.lidar_mount)
    where = chart.grid.frame
    wanted, sight = wanted_cells(chart), chart.sight()
    mark_wanted(eye, looker.half_angle, wanted, *sight, *where, looker.view_range, seen)
    return seen


def place_before(
    chart: SearchMap, ways: Ways, looker: Looker, person: Point, tried: list[Point]
) -> Pose | None:
    """A pose near a person that faces the person and is reached soon; None if there is none.

    Args:
        chart: the map.
        ways: from where the robot is.
        looker: body and detector.
        person: place of the suspected person.
        tried: places from which the robot has observed the person before.
    """
    s, (least, most) = chart.settings, chart.settings.person_range
    cells = np.argwhere(np.isfinite(ways.costs))
    points = chart.grid.points(cells)
    away = np.hypot(*(points - person).T)
    good = (away > least) & (away < most)
    for place in tried:
        good &= np.hypot(*(points - place).T) > 0.6
    order = np.argsort(ways.costs[tuple(cells[good].T)])
    size = looker.half_size(s.clearance)
    for x, y in points[good][order][:400].tolist():
        pose = x, y, math.atan2(person[1] - y, person[0] - x)
        if not fits(pose, size, ways.room, *chart.grid.frame):
            continue
        if ways.lead_to(*np.array(pose)[:, None]).all() and _sees(chart, (x, y), person):
            return pose
    return None


def place_towards(
    chart: SearchMap, ways: Ways, looker: Looker, person: Point, tried: list[Point]
) -> Pose | None:
    """The pose nearest to a person to whom no way leads, facing the person; see `place_before`."""
    s = chart.settings
    cells = np.argwhere(np.isfinite(ways.costs) & (chart.rooms >= 0))
    points = chart.grid.points(cells)
    away = np.hypot(*(points - person).T)
    good = away > s.person_range[0]
    for place in tried:
        good &= np.hypot(*(points - place).T) > 0.6
    size = looker.half_size(s.clearance)
    for x, y in points[good][np.argsort(away[good])][:4000].tolist():
        pose = x, y, math.atan2(person[1] - y, person[0] - x)
        if fits(pose, size, ways.room, *chart.grid.frame):
            return pose
    return None


def _sees(chart: SearchMap, eye: Point, person: Point) -> bool:
    """Whether no solid cell lies on the line of sight, except near the person."""
    length = math.dist(eye, person)
    shares = np.arange(0.0, max(length - 0.6, 0.05), 0.05) / length
    points = np.array(eye) + shares[:, None] * (np.array(person) - eye)
    return not any(chart.solid_at((x, y)) for x, y in points.tolist())


def _eyes(chart: SearchMap, grid: ViewGrid) -> FloatArray:
    """Places for the detector, on a lattice of floor that may be free, shape (n, 2)."""
    step = max(1, round(grid.spacing / chart.settings.spacing))
    lattice = np.zeros(chart.hits.shape, np.bool_)
    lattice[::step, ::step] = True
    lattice &= (chart.has(FREE) | (chart.rooms >= 0)) & ~chart.solid
    return chart.grid.points(np.argwhere(lattice))


def _seconds(
    chart: SearchMap, ways: Ways, grid: ViewGrid, pose: Pose, refused: Sequence[Circle]
) -> FloatArray:
    """Cost of a viewpoint in each cell, seconds, higher in other rooms; infinite if unreachable."""
    s, current = chart.settings, chart.rooms[chart.grid.cell(pose[:2])]
    elsewhere = (chart.rooms != current) & (current >= 0)
    factor = np.where(elsewhere, s.other_room, 1.0)
    seconds = ways.costs / s.speed * factor + s.look_seconds
    if grid.room is not None:
        seconds[chart.rooms != grid.room] = np.inf
    rows, columns = np.ogrid[: seconds.shape[0], : seconds.shape[1]]
    for x, y, radius in refused:
        row, column = chart.grid.cell((x, y))
        near = (rows - row) ** 2 + (columns - column) ** 2 <= (radius / s.spacing) ** 2
        seconds[near] = np.inf
    return np.asarray(seconds)


def _window_sums(gains: FloatArray, window: int) -> FloatArray:
    """Sums over windows of neighbouring rays around the circle, by the first ray of each."""
    twice = np.hstack((np.zeros((len(gains), 1)), gains, gains[:, : window - 1]))
    summed = np.cumsum(twice, axis=1)
    return np.asarray(summed[:, window:] - summed[:, :-window])
