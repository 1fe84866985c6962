"""Points are grouped for many beams at once, which changes no bit of the result."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features import ExtractorSettings, Scan
from semnav_features.extraction import beam_directions, sensor_of
from semnav_features.frames import FloatArray
from semnav_features.kernels.breakpoints import breakpoint_terms
from semnav_features.kernels.chain import begin_sweep, copy_sweep
from semnav_features.kernels.lanes import WIDTH
from semnav_features.kernels.lines import farthest
from semnav_features.kernels.scratch import allocate_scratch
from semnav_features.kernels.segmentation import group_points
from semnav_features.strategies import BreakpointRule, strategy_names

RANGE_MIN, LIMIT, INCREMENT = 0.05, 10.0, math.radians(0.5)

chosen_settings = st.builds(
    ExtractorSettings,
    breakpoint_rule=st.sampled_from(strategy_names(BreakpointRule)),
    dropout_beams=st.integers(0, 10),
)


@st.composite
def rough_sweeps(draw: st.DrawFn) -> FloatArray:
    """Ranges along rough walls, with jumps and with beams that have no return."""
    beams = draw(st.integers(1, 300))
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    jumps = random.random(beams) < draw(st.sampled_from([0.0, 0.02, 0.3]))
    walls = 2.0 + np.cumsum(np.where(jumps, random.normal(0.0, 0.5, beams), 0.0))
    ranges = np.abs(walls) + random.normal(0.0, draw(st.sampled_from([0.0, 0.02, 0.1])), beams)
    missing = random.random(beams) < draw(st.sampled_from([0.0, 0.02, 0.5]))
    ranges[missing] = random.choice([math.inf, -math.inf, math.nan, 0.0, LIMIT], missing.sum())
    return np.asarray(ranges)


Points = tuple[list[float], list[float], list[int], list[int]]
"""x, y and beam of each point, and the first point of each group and one more."""


def grouped_one_by_one(ranges: FloatArray, directions: FloatArray, record: np.void) -> Points:
    """What `group_points` writes, found beam by beam."""
    nearer, farther, previous, offset = breakpoint_terms(INCREMENT, record)
    xs, ys, beams, first = list[float](), list[float](), list[int](), list[int]()
    for beam, distance in enumerate(ranges.tolist()):
        if not (distance >= RANGE_MIN and distance < LIMIT):
            continue
        x, y = distance * directions[beam, 0], distance * directions[beam, 1]
        before, step = (ranges[beams[-1]], beam - beams[-1]) if beams else (0.0, 1000)
        reach = math.nan
        if step == 1:
            low, high = min(before, distance), max(before, distance)
            reach = nearer * low + offset + (farther * high + previous * before)
        elif step <= record["dropout_beams"] + 1:
            a, b, c, d = breakpoint_terms(step * INCREMENT, record)
            reach = a * min(before, distance) + b * max(before, distance) + c * before + d
            reach = min(reach, record["merge_gap"])
        if not (beams and (x - xs[-1]) ** 2 + (y - ys[-1]) ** 2 <= reach * reach):
            first.append(len(xs))
        xs.append(x)
        ys.append(y)
        beams.append(beam)
    return xs, ys, beams, [*first, len(xs)]


@given(rough_sweeps(), chosen_settings)
def test_groups_are_those_found_beam_by_beam(ranges: FloatArray, chosen: ExtractorSettings) -> None:
    directions, scratch = beam_directions(len(ranges), -1.0, INCREMENT), allocate_scratch(300)
    record = chosen.as_record()[0]
    scan = Scan(ranges, -1.0, INCREMENT, RANGE_MIN, LIMIT)
    begin_sweep(len(ranges), sensor_of(scan), record, scratch)
    copy_sweep(ranges, directions, len(ranges), scratch)
    points, groups = group_points(len(ranges), record, scratch)
    xs, ys, beams, first = grouped_one_by_one(ranges, directions, record)
    assert scratch.xs[:points].tolist() == xs
    assert scratch.ys[:points].tolist() == ys
    assert scratch.beams[:points].tolist() == beams
    assert scratch.group_first[: groups + 1].tolist() == first


@given(st.lists(st.tuples(*[st.integers(-9, 9)] * 2), min_size=2, max_size=300), st.floats(0, 9))
def test_the_first_of_the_farthest_points_is_cut(
    points: list[tuple[int, int]], limit: float
) -> None:
    """Whole numbers: many points are equally far from the chord."""
    xs, ys = np.array(points, dtype=float).T.copy()
    dx, dy = xs[-1] - xs[0], ys[-1] - ys[0]
    distances = np.abs(dx * ys - dy * xs - (dx * ys[0] - dy * xs[0]))[1:-1]
    is_far = len(distances) > 0 and distances.max() > limit * math.sqrt(dx * dx + dy * dy)
    expected = 1 + int(distances.argmax()) if is_far else -1
    beyond = np.full(WIDTH, np.nan)
    xs, ys = np.append(xs, beyond), np.append(ys, beyond)
    assert farthest(xs, ys, 0, len(points) - 1, limit) == expected


@pytest.mark.parametrize("beams", [0, 1, 7, 8, 9])
def test_scratch_has_room_for_the_beam_after_the_last(beams: int) -> None:
    joined = allocate_scratch(beams).joined
    assert len(joined) > beams
    assert len(joined) % 8 == 0
