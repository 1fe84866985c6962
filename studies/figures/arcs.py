"""Measure how well columns are seen, and draw docs/images/arcs.png.

Scans of a round column in a hall, ray cast exactly, sigma 20 mm; and, for false arcs, scans from
random free poses in the bundled plans, which have no round wall.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from semnav_env.robots import WHEELCHAIR
from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import bundled_names, load_floor_plan
from semnav_env.world.maps.placement import sample_pose
from semnav_features import Arc, Scan, extract
from semnav_features.frames import Point
from semnav_features.plot import save_page
from studies.figures import IMAGES

BEAMS, ANGLE_MIN, INCREMENT, SIGMA = 811, math.radians(-135), math.radians(270 / 810), 0.02
HALL = ((-3.0, 8.0), (-5.0, 5.0))
COLUMN_DIAMETERS = (0.3, 0.4, 0.6, 0.8, 1.0, 2.0)
"""Of the columns of the table, metres."""

DISTANCE_BINS = ((1.0, 2.0), (2.0, 3.0), (3.0, 4.0))
"""Nearest and farthest centre of a column in a row of the table, metres."""

Column = tuple[Point, float]


def column_scan(columns: list[Column], rng: np.random.Generator) -> Scan:
    """A scan of columns (centre and radius) in the hall, the scanner at the origin."""
    angles = ANGLE_MIN + INCREMENT * np.arange(BEAMS)
    directions = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    with np.errstate(divide="ignore"):
        walls = [np.max(np.divide(s, d), axis=0) for s, d in _sides(directions)]
    ranges = np.minimum(*walls)
    for centre, radius in columns:
        along = directions @ np.array(centre)
        square = along**2 - (math.hypot(*centre) ** 2 - radius**2)
        near = along - np.sqrt(np.where(square >= 0.0, square, np.nan))
        ranges = np.fmin(ranges, np.where(near > 0.0, near, np.nan))
    return Scan(ranges + rng.normal(0.0, SIGMA, BEAMS), ANGLE_MIN, INCREMENT)


def _sides(directions: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    for axis, (low, high) in enumerate(HALL):
        yield np.array([[low], [high]]), directions[:, axis][None]


def at(arcs: tuple[Arc, ...], column: Column) -> Arc | None:
    """The arc whose centre lies in a column."""
    return next((a for a in arcs if math.dist(a.centre, column[0]) < column[1]), None)


def table_row(diameter: float, nearest: float, farthest: float, scans: int) -> str:
    """Recall and radius errors for columns of one size at one distance."""
    rng = np.random.default_rng(0)
    errors = []
    for _ in range(scans):
        distance = rng.uniform(max(nearest, diameter / 2 + 0.3), farthest)
        bearing = rng.uniform(-2.0, 2.0)
        place = distance * math.cos(bearing), distance * math.sin(bearing)
        column = (place, diameter / 2)
        found = at(extract(column_scan([column], rng)).arcs, column)
        if found:
            errors.append(100.0 * abs(2.0 * found.radius / diameter - 1.0))
    middle, most = np.percentile(errors, [50, 90])
    share = len(errors) / scans
    where = f"{nearest:.0f} to {farthest:.0f} m"
    return f"| {diameter:.1f} m | {where} | {share:.2f} | {middle:.1f} % | {most:.1f} % |"


def false_arcs(scans: int) -> str:
    """Arcs found where every wall is straight."""
    rng = np.random.default_rng(0)
    rows = []
    for name in bundled_names():
        plan = load_floor_plan(name)
        lidar = Lidar(plan)
        poses = [sample_pose(plan, WHEELCHAIR, rng) for _ in range(scans)]
        found = sum(len(extract(lidar.scan(pose, (0, 0, i))).arcs) for i, pose in enumerate(poses))
        rows.append(f"{name}: {found} arcs in {scans} scans")
    return "\n".join(rows)


def main(scans: int = 300) -> None:
    """Measure how well columns are seen, and draw arcs.png.

    Args:
        scans: of each row of the table.
    """
    print("| diameter | distance | found | radius error, median | 90th percentile |")
    print("|---|---|---|---|---|")
    for diameter in COLUMN_DIAMETERS:
        for nearest, farthest in DISTANCE_BINS:
            print(table_row(diameter, nearest, farthest, scans))
    print(false_arcs(scans))
    rng = np.random.default_rng(1)
    columns: list[Column] = [((2.0, 1.2), 0.15), ((2.5, -1.0), 0.3), ((4.0, 0.6), 0.5)]
    scan = column_scan(columns, rng)
    round_end = column_scan([((7.0, -6.0), 4.0), ((1.5, 2.2), 0.2)], rng)
    panels = [("three columns", scan, extract(scan)), ("a curved wall", round_end, None)]
    save_page(
        IMAGES / "arcs.png",
        [(title, s, scene or extract(s)) for title, s, scene in panels],
    )
