"""Places to look from: what each would show, what it costs to go there, and the best of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from semnav_env.agents.searching.search_map import FREE, LOOKED, SAFE, Mask, SearchMap
from semnav_env.features.frames import FloatArray, Point, Pose, wrap_angle
from semnav_env.features.kernels.compiling import kernel
from semnav_env.features.kernels.grid_search import least_costs

COMFORT = 0.8
"""Distance from everything solid beyond which a way costs no more than its length, metres."""

CROWDING = 2.0
"""Extra cost of a metre right beside something solid."""


@dataclass(frozen=True)
class View:
    """A pose to look from.

    Attributes:
        pose: odometry frame.
        gain: area that it is expected to show, m^2.
        cells: flat indices of the cells that it is expected to show.
    """

    pose: Pose
    gain: float
    cells: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Ways:
    """Where the robot can go from where it is.

    Attributes:
        costs: of the way to each cell, metres, shape (rows, columns); infinite where none leads.
        room: distance of each cell from everything solid, metres, same shape.
    """

    costs: FloatArray
    room: FloatArray


def ways_from(chart: SearchMap, place: Point, half_width: float) -> Ways:
    """The ways on floor that is safe, or that the plan says is floor.

    Args:
        chart: the map.
        place: where the robot is.
        half_width: of the robot, metres.
    """
    spacing, solid = chart.settings.spacing, chart.solid
    room = spacing * distance_transform_edt(~solid)
    passable = chart.has(SAFE) | (chart.rooms >= 0)
    row, column = chart.cell(place)
    open_ = passable & (room > half_width)
    open_[max(row - 6, 0) : row + 7, max(column - 6, 0) : column + 7] |= ~solid[
        max(row - 6, 0) : row + 7, max(column - 6, 0) : column + 7
    ]
    near = np.clip(1.0 - room / COMFORT, 0.0, 1.0)
    weight = np.where(open_, 1.0 + CROWDING * near, np.inf)
    source = np.array([[row, column]])
    costs = least_costs(source, np.zeros(1), weight, spacing, spacing * math.sqrt(2), True)
    return Ways(costs, room)


def wanted_cells(chart: SearchMap) -> Mask:
    """The cells still to be looked at: of rooms, or without a plan any that may be floor."""
    left = ~chart.has(LOOKED) & (chart.tries < chart.settings.tries) & ~chart.solid
    known = chart.rooms >= 0
    return np.asarray(left & known if known.any() else left)


def best_view(
    chart: SearchMap,
    ways: Ways,
    pose: Pose,
    fov: float,
    view_range: float,
    current: int,
    refused: Sequence[Point] = (),
) -> View | None:
    """The pose to look from that shows most for its cost; None where nothing is worth it.

    Args:
        chart: the map.
        ways: from where the robot is.
        pose: of the robot.
        fov: field of view of the detector, radians.
        view_range: of the detector, metres.
        current: number of the room that the robot is in; -1 for none.
        refused: places that could not be reached.
    """
    s, wanted = chart.settings, wanted_cells(chart)
    if not wanted.any():
        return None
    cells = _candidates(chart, ways, pose[:2], refused)
    args = *chart.lower, s.spacing, s.rays
    gains = ray_gains(chart.points(cells), wanted, chart.solid, *args, view_range)
    window = max(1, round(fov / math.tau * s.rays) - 2)
    sums = _window_sums(gains, window)
    seconds = _costs(chart, ways, cells, pose, current)
    headings = math.tau * (np.arange(s.rays) + (window - 1) / 2) / s.rays
    turns = np.abs(np.angle(np.exp(1j * (headings - pose[2])))) / s.turn_rate
    worth = np.where(sums > s.least_gain, sums / (seconds[:, None] + turns[None, :]), 0.0)
    k, best = np.unravel_index(int(np.argmax(worth)), worth.shape)
    if worth[k, best] <= 0.0:
        return None
    x, y = chart.points(cells[k : k + 1])[0].tolist()
    seen = np.zeros(wanted.shape, np.bool_)
    mark_wanted((x, y), int(best), window, wanted, chart.solid, *args, view_range, seen)
    there = wrap_angle(float(headings[best]))
    return View((x, y, there), float(sums[k, best]), np.flatnonzero(seen))


def place_before(chart: SearchMap, ways: Ways, person: Point, tried: list[Point]) -> Pose | None:
    """A pose near a person that looks at it and is reached soon; None where there is none.

    Args:
        chart: the map.
        ways: from where the robot is.
        person: where somebody may be.
        tried: places from which it was looked at before.
    """
    s, (least, most) = chart.settings, chart.settings.person_range
    cells = np.argwhere(np.isfinite(ways.costs) & (ways.room > s.clearance))
    points = chart.points(cells)
    away = np.hypot(*(points - person).T)
    good = (away > least) & (away < most)
    for place in tried:
        good &= np.hypot(*(points - place).T) > 0.6
    order = np.argsort(ways.costs[tuple(cells[good].T)])
    for x, y in points[good][order][:200].tolist():
        if _sees(chart, (x, y), person):
            return x, y, math.atan2(person[1] - y, person[0] - x)
    return None


def _sees(chart: SearchMap, eye: Point, person: Point) -> bool:
    """Whether nothing solid stands between, up to the body itself."""
    length = math.dist(eye, person)
    shares = np.arange(0.0, max(length - 0.6, 0.05), 0.05) / length
    points = np.array(eye) + shares[:, None] * (np.array(person) - eye)
    return not any(chart.solid_at((x, y)) for x, y in points.tolist())


def _candidates(
    chart: SearchMap, ways: Ways, here: Point, refused: Sequence[Point]
) -> NDArray[np.int64]:
    """Cells to look from: on a lattice, with room to stand; and where the robot is."""
    s = chart.settings
    step = max(1, round(s.candidate_spacing / s.spacing))
    lattice = np.zeros(ways.costs.shape, np.bool_)
    lattice[::step, ::step] = True
    standing = np.isfinite(ways.costs) & (ways.room > s.clearance)
    cells = np.argwhere(lattice & standing & (chart.has(FREE) | (chart.rooms >= 0)))
    points = chart.points(cells)
    kept = np.ones(len(cells), np.bool_)
    for place in refused:
        kept &= np.hypot(*(points - place).T) > s.refused_distance
    cells = cells[kept]
    return np.vstack((cells, [chart.cell(here)]))


def _costs(
    chart: SearchMap, ways: Ways, cells: NDArray[np.int64], pose: Pose, current: int
) -> FloatArray:
    """Seconds to each of the cells, other rooms dearer."""
    s = chart.settings
    seconds = ways.costs[tuple(cells.T)] / s.speed
    elsewhere = (chart.rooms[tuple(cells.T)] != current) & (current >= 0)
    return np.asarray(np.where(elsewhere, s.other_room, 1.0) * seconds + s.look_seconds)


def _window_sums(gains: FloatArray, window: int) -> FloatArray:
    """Sums of so many neighbouring rays, around the circle, by the first of them."""
    twice = np.hstack((np.zeros((len(gains), 1)), gains, gains[:, : window - 1]))
    summed = np.cumsum(twice, axis=1)
    return np.asarray(summed[:, window:] - summed[:, :-window])


@kernel(counts_references=True)
def ray_gains(
    places: FloatArray,
    wanted: Mask,
    solid: Mask,
    west: float,
    south: float,
    spacing: float,
    rays: int,
    view_range: float,
) -> FloatArray:
    """Area of wanted cells that rays from some places show, m^2, shape (places, rays).

    A ray stands for its sector of the circle: at a distance r a step dr shows r dr dphi.
    """
    gains = np.zeros((len(places), rays))
    rows, columns = wanted.shape
    for k in range(len(places)):
        for j in range(rays):
            angle = 2.0 * math.pi * j / rays
            dx, dy = math.cos(angle), math.sin(angle)
            for i in range(1, int(view_range / spacing)):
                away = i * spacing
                column = round((places[k, 0] + away * dx - west) / spacing)
                row = round((places[k, 1] + away * dy - south) / spacing)
                if not (0 <= row < rows and 0 <= column < columns) or solid[row, column]:
                    break
                if wanted[row, column]:
                    gains[k, j] += away * spacing * 2.0 * math.pi / rays
    return gains


@kernel
def mark_wanted(
    place: Point,
    first: int,
    window: int,
    wanted: Mask,
    solid: Mask,
    west: float,
    south: float,
    spacing: float,
    rays: int,
    view_range: float,
    seen: Mask,
) -> None:
    """Mark the wanted cells that a window of rays shows; four times as many rays are cast."""
    rows, columns = wanted.shape
    for j in range(4 * first, 4 * (first + window)):
        angle = 2.0 * math.pi * j / (4 * rays)
        dx, dy = math.cos(angle), math.sin(angle)
        for i in range(1, int(view_range / spacing)):
            column = round((place[0] + i * spacing * dx - west) / spacing)
            row = round((place[1] + i * spacing * dy - south) / spacing)
            if not (0 <= row < rows and 0 <= column < columns) or solid[row, column]:
                break
            if wanted[row, column]:
                seen[row, column] = True
