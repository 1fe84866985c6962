from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from semnav_features import ExtractorSettings, Scan, extract
from semnav_features.extraction import beam_directions, sensor_of
from semnav_features.kernels.chain import begin_sweep, copy_sweep
from semnav_features.kernels.scratch import allocate_scratch
from semnav_features.kernels.segmentation import group_points
from semnav_features.strategies import BreakpointRule, strategy_names
from tests.numpy_oracle.breakpoints import threshold
from tests.numpy_oracle.sweep import Sweep
from tests.support.raycaster import heidelberg, scan_of
from tests.support.strategies import Opening, awkward_scans, openings

RULES = strategy_names(BreakpointRule)
DIRECTED = "borges_aldon"
"""The one rule that asks which of two points came first."""

rules = st.sampled_from(RULES)
seeds = st.integers(0, 2**32 - 1)


def groups_of(scan: Scan, chosen: ExtractorSettings) -> list[list[int]]:
    """The beams of each group."""
    directions = beam_directions(len(scan.ranges), scan.angle_min, scan.angle_increment)
    scratch = allocate_scratch(len(directions))
    record, beams = chosen.as_record()[0], len(directions)
    begin_sweep(beams, sensor_of(scan), record, scratch)
    copy_sweep(scan.ranges.copy(), directions, beams, scratch)
    points, groups = group_points(beams, record, scratch)
    first = scratch.group_first[: groups + 1].tolist()
    assert first[-1] == points
    return [scratch.beams[a:b].tolist() for a, b in itertools.pairwise(first)]


def cuts_of(scan: Scan, chosen: ExtractorSettings) -> set[int]:
    """The beams that begin a group."""
    return {group[0] for group in groups_of(scan, chosen)}


def scaled(scan: Scan, scale: float) -> Scan:
    limits = scale * scan.range_min, scale * scan.range_max
    return Scan(scale * scan.ranges, scan.angle_min, scan.angle_increment, *limits)


def unequal(scan: Scan, seed: int) -> Scan:
    """The scan without ties, which rounding decides."""
    ranges = scan.ranges * (1.0 + np.random.default_rng(seed).uniform(0.0, 1e-3, len(scan.ranges)))
    return Scan(ranges, scan.angle_min, scan.angle_increment)


@settings(max_examples=200, deadline=None)
@given(awkward_scans(), rules)
def test_groups_are_the_valid_beams_in_order(scan: Scan, rule: str) -> None:
    chosen = ExtractorSettings(breakpoint_rule=rule)
    groups = groups_of(scan, chosen)
    turn = len(beam_directions(len(scan.ranges), scan.angle_min, scan.angle_increment))
    assert all(groups)
    assert [*itertools.chain(*groups)] == np.flatnonzero(scan.valid[:turn]).tolist()


@settings(max_examples=150, deadline=None)
@given(awkward_scans(), rules, seeds, st.floats(0.0, 0.05))
def test_groups_are_those_of_the_equations(scan: Scan, rule: str, seed: int, sigma: float) -> None:
    scan = unequal(scan, seed)
    chosen = ExtractorSettings(breakpoint_rule=rule, sigma=sigma)
    assert groups_of(scan, chosen) == Sweep.of(scan, chosen).connected_groups(chosen)


@settings(max_examples=60, deadline=None)
@given(openings(0.5, 2.5), rules, seeds)
def test_every_rule_agrees_with_the_reference_in_corridors(
    opening: Opening, rule: str, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    scan = scan_of(opening.segments, opening.pose, sigma=0.02, rng=rng)
    chosen = ExtractorSettings(breakpoint_rule=rule)
    assert groups_of(scan, chosen) == Sweep.of(scan, chosen).connected_groups(chosen)


@settings(max_examples=150, deadline=None)
@given(st.floats(0.1, 10.0), st.floats(0.1, 10.0), st.floats(1e-3, 0.2), st.floats(0.0, 0.9))
def test_lee_joins_ranges_whose_ratio_is_small(
    before: float, after: float, angle: float, ratio: float
) -> None:
    chosen = ExtractorSettings(breakpoint_rule="lee", breakpoint_ratio=ratio)
    measured = abs(before - after) / (before + after)
    distance = math.sqrt(before**2 + after**2 - 2.0 * before * after * math.cos(angle))
    if abs(measured - ratio) > 1e-6:
        assert (distance <= threshold(before, after, angle, chosen)) == (measured < ratio)


@settings(max_examples=100, deadline=None)
@given(awkward_scans(), seeds, st.sampled_from([rule for rule in RULES if rule != DIRECTED]))
def test_a_mirrored_scan_has_mirrored_groups(scan: Scan, seed: int, rule: str) -> None:
    scan = unequal(scan, seed)
    beams = len(beam_directions(len(scan.ranges), scan.angle_min, scan.angle_increment))
    scan = Scan(scan.ranges[:beams], scan.angle_min, scan.angle_increment)
    mirrored = Scan(scan.ranges[::-1], scan.angle_min, scan.angle_increment)
    chosen = ExtractorSettings(breakpoint_rule=rule)
    back = [[beams - 1 - beam for beam in group][::-1] for group in groups_of(mirrored, chosen)]
    assert back[::-1] == groups_of(scan, chosen)


@settings(max_examples=100, deadline=None)
@given(
    awkward_scans(),
    st.sampled_from(["borges_aldon", "certad", "santos", "weerakoon"]),
    st.floats(0.01, 1.5),
    st.floats(0.01, 1.5),
)
def test_a_steeper_worst_incidence_joins_less(scan: Scan, rule: str, a: float, b: float) -> None:
    flat = ExtractorSettings(breakpoint_rule=rule, breakpoint_angle=min(a, b))
    steep = replace(flat, breakpoint_angle=max(a, b))
    assert cuts_of(scan, flat) <= cuts_of(scan, steep)


@settings(max_examples=100, deadline=None)
@given(
    awkward_scans(),
    st.sampled_from(
        [
            ("constant", "breakpoint_distance"),
            ("dietmayer", "breakpoint_distance"),
            ("santos", "breakpoint_distance"),
            ("lee", "breakpoint_ratio"),
            ("borges_aldon", "sigma"),
            ("certad", "sigma"),
        ]
    ),
    st.floats(0.0, 0.9),
    st.floats(0.0, 0.9),
)
def test_a_larger_tolerance_joins_more(
    scan: Scan, rule_and_tolerance: tuple[str, str], a: float, b: float
) -> None:
    rule, tolerance = rule_and_tolerance
    chosen = ExtractorSettings(breakpoint_rule=rule)
    tight, wide = (replace(chosen, **{tolerance: pick(a, b)}) for pick in (min, max))
    assert cuts_of(scan, wide) <= cuts_of(scan, tight)


@pytest.mark.parametrize(
    ("finer", "coarser"),
    [("certad", "borges_aldon"), ("constant", "dietmayer"), ("dietmayer", "santos")],
)
@settings(max_examples=60, deadline=None)
@given(scan=awkward_scans())
def test_one_rule_cuts_wherever_another_does(scan: Scan, finer: str, coarser: str) -> None:
    """min(r_n, r_n+1) <= r_n; C0 <= C0 + C1 r; and a flat incidence is farther than a square.

    Beams 90 degrees and more apart have C0 alone under the rule of Santos.
    """
    assume(scan.angle_increment < math.pi / 2)
    fine = ExtractorSettings(breakpoint_rule=finer)
    assert cuts_of(scan, replace(fine, breakpoint_rule=coarser)) <= cuts_of(scan, fine)


@settings(max_examples=100, deadline=None)
@given(awkward_scans(), seeds, rules, st.sampled_from([0.5, 2.0, 4.0]))
def test_groups_do_not_depend_on_the_unit_of_length(
    scan: Scan, seed: int, rule: str, scale: float
) -> None:
    """Scaling by powers of two, which is exact; Weerakoon's sigma is a share and stays."""
    scan = unequal(scan, seed)
    chosen = ExtractorSettings(breakpoint_rule=rule, rupture_range=20.0)
    lengths = {"breakpoint_distance", "rupture_range", "merge_gap", "door_width_min"}
    lengths |= {"door_width_max", *(set() if rule == "weerakoon" else {"sigma"})}
    other = replace(chosen, **{name: scale * getattr(chosen, name) for name in lengths})
    assert groups_of(scaled(scan, scale), other) == groups_of(scan, chosen)


@pytest.mark.parametrize("rule", RULES)
def test_a_wall_met_squarely_is_one_group(rule: str) -> None:
    angles = np.radians(np.arange(-30.0, 30.0, 1 / 3))
    scan = Scan(2.0 / np.cos(angles), angles[0], math.radians(1 / 3))
    assert len(groups_of(scan, ExtractorSettings(breakpoint_rule=rule))) == 1


@pytest.mark.parametrize("rule", RULES)
def test_a_wall_behind_another_is_another_group(rule: str) -> None:
    angles = np.radians(np.arange(-30.0, 30.0, 1 / 3))
    scan = Scan(np.where(angles < 0.1, 2.0, 3.0) / np.cos(angles), angles[0], math.radians(1 / 3))
    assert len(groups_of(scan, ExtractorSettings(breakpoint_rule=rule))) == 2


@pytest.mark.parametrize("gone", [0.0, math.nan, math.inf, -math.inf, -1.0, 10.0, 12.0, 0.01])
@pytest.mark.parametrize("rule", RULES)
def test_whatever_is_no_return_is_a_rupture(rule: str, gone: float) -> None:
    angles = np.radians(np.arange(-30.0, 30.0, 1 / 3))
    ranges = 2.0 / np.cos(angles)
    ranges[60:120] = gone
    scan = Scan(ranges, angles[0], math.radians(1 / 3))
    chosen = ExtractorSettings(breakpoint_rule=rule)
    assert [(g[0], g[-1]) for g in groups_of(scan, chosen)] == [(0, 59), (120, len(ranges) - 1)]
    walls = extract(scan, chosen).walls
    assert [(w.start_rupture, w.end_rupture) for w in walls] == [(False, True), (True, False)]


@pytest.mark.parametrize("degrees", [0.5, 1.0])
@pytest.mark.parametrize("rule", RULES)
def test_coarse_lidars_see_the_hallway_with_every_rule(rule: str, degrees: float) -> None:
    segments, _ = heidelberg()
    rng = np.random.default_rng(0)
    chosen = ExtractorSettings(breakpoint_rule=rule)
    for x in (-2.0, 0.0, 3.0):
        pose = (x, -0.2 + 0.24 * (x + 2.5), 0.24)
        beams = int(180 / degrees) + 1
        scan = scan_of(segments, pose, beams, math.pi, sigma=0.01, rng=rng)
        assert groups_of(scan, chosen) == Sweep.of(scan, chosen).connected_groups(chosen)
        assert len(extract(scan, chosen).walls) >= 2
