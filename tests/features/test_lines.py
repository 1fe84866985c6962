"""The line behind a wall: its parameters, and how far they may be trusted."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from semnav_features import ExtractorSettings, Scan, Wall, extract
from semnav_features.frames import Point
from tests.support.raycaster import polyline, scan_of

coordinates = st.floats(-10.0, 10.0)
points = st.tuples(coordinates, coordinates)
poses = st.tuples(coordinates, coordinates, st.floats(-math.pi, math.pi))
walls = st.builds(
    lambda x, y, heading, length: Wall(
        (x, y),
        (x + length * math.cos(heading), y + length * math.sin(heading)),
        angle_deviation=0.01,
        offset_deviation=0.005,
        centroid=(x + 0.4 * length * math.cos(heading), y + 0.4 * length * math.sin(heading)),
    ),
    coordinates,
    coordinates,
    st.floats(-math.pi, math.pi),
    st.floats(0.2, 5.0),
)


@given(walls)
def test_both_ends_of_a_wall_lie_on_its_line(wall: Wall) -> None:
    theta, distance = wall.line
    assert -math.pi < theta <= math.pi
    assert distance >= 0.0
    for x, y in (wall.start, wall.end):
        assert x * math.cos(theta) + y * math.sin(theta) == pytest.approx(distance, abs=1e-9)


def squared_errors(
    start: Point, end: Point, sigma: float, scans: int = 300, robust: bool = False
) -> np.ndarray:
    """Squared errors of direction and of offset at the centroid, in variances, shape (n, 2)."""
    rng = np.random.default_rng(17)
    true = math.atan2(end[1] - start[1], end[0] - start[0])
    along = np.array((math.cos(true), math.sin(true)))
    chosen, errors = ExtractorSettings(sigma=0.02, robust_fit=robust), []
    for _ in range(scans):
        scan = scan_of(polyline(start, end), (0.0, 0.0, 0.0), sigma=sigma, rng=rng)
        wall = max(extract(scan, chosen).walls, key=lambda w: w.length)
        assert wall.centroid is not None
        x, y = np.array(wall.centroid) - start
        turn = math.remainder(wall.heading - true, math.tau) / wall.angle_deviation
        errors.append((turn**2, ((along[0] * y - along[1] * x) / wall.offset_deviation) ** 2))
    return np.array(errors)


@pytest.mark.parametrize(
    "ends", [((2.0, -1.0), (2.0, 1.0)), ((6.0, -3.0), (6.0, 3.0)), ((3.0, -0.2), (3.0, 0.2))]
)
@pytest.mark.parametrize("robust", [False, True])
def test_the_deviations_of_a_facing_wall_are_those_of_its_errors(
    ends: tuple[Point, Point], robust: bool
) -> None:
    mean = squared_errors(*ends, sigma=0.02, robust=robust).mean(axis=0)
    assert ((mean > 0.75) & (mean < 1.3)).all()  # chi-square of 300: 1 with deviation 0.08


@pytest.mark.parametrize(
    ("ends", "sigma"),
    [
        (((-1.0, -1.0), (8.0, -1.0)), 0.02),  # the side of a corridor, seen ever more grazing
        (((1.0, -0.6), (8.0, -0.6)), 0.02),
        (((2.0, -1.0), (2.0, 1.0)), 0.005),  # a better scanner than the settings say
        (((3.0, -0.2), (3.3, 0.2)), 0.02),
    ],
)
def test_the_deviations_cover_the_errors_of_any_wall(
    ends: tuple[Point, Point], sigma: float
) -> None:
    covered = squared_errors(*ends, sigma).sum(axis=1) < 5.99  # chi-square of two, 95 percent
    assert covered.mean() > 0.9


def test_a_moulding_does_not_turn_a_wall_that_is_fitted_robustly() -> None:
    rng = np.random.default_rng(5)
    wall = polyline((2.0, -1.0), (2.0, 1.0))
    errors: dict[bool, list[float]] = {False: [], True: []}
    for _ in range(40):
        scan = scan_of(wall, (0.0, 0.0, 0.0), sigma=0.005, rng=rng)
        ranges = scan.ranges.copy()
        seen = np.flatnonzero(np.isfinite(ranges))
        proud = seen[len(seen) // 8 : len(seen) // 4]  # 6 cm before an eighth of the wall
        ranges[proud] -= 0.06 / np.cos(scan.angles[proud])
        stepped = Scan(ranges, scan.angle_min, scan.angle_increment)
        for robust, found in errors.items():
            chosen = ExtractorSettings(sigma=0.005, robust_fit=robust)
            walls = extract(stepped, chosen).walls
            longest = max(walls, key=lambda each: each.length)
            found.append(abs(math.remainder(longest.heading - math.pi / 2, math.tau)))
    assert np.median(errors[True]) < math.radians(0.1)
    assert np.median(errors[True]) < 0.2 * np.median(errors[False])


@given(st.integers(0, 2**32 - 1), st.floats(60.0, 120.0))
@settings(max_examples=60, deadline=None)
def test_the_border_of_two_walls_is_all_but_the_best_there_is(seed: int, opening: float) -> None:
    rng, sigma = np.random.default_rng(seed), 0.01
    half = math.radians(opening / 2)
    far = [(2.5 - 1.5 * math.cos(half), sign * 1.5 * math.sin(half)) for sign in (-1.0, 1.0)]
    scan = scan_of(polyline(far[0], (2.5, 0.0), far[1]), (0.0, 0.0, 0.0), sigma=sigma, rng=rng)
    seen = np.flatnonzero(np.isfinite(scan.ranges))
    points = scan.ranges[seen, None] * np.stack((np.cos(scan.angles), np.sin(scan.angles)), 1)[seen]
    walls = extract(scan, ExtractorSettings(sigma=sigma)).walls
    # else a few points at the border or the ends were given to neither
    assume(len(walls) == 2 and sum(wall.beams for wall in walls) == len(seen))
    border = walls[0].beams
    costs = {k: scatter(points[:k]) + scatter(points[k:]) for k in range(border - 8, border + 9)}
    assert costs[border] - min(costs.values()) < 8.0 * sigma**2


def scatter(points: np.ndarray) -> float:
    """Sum of squared distances to the best line."""
    return float(np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[1] ** 2)
