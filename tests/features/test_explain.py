"""The reasons for what was turned down."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_features import CornerKind, ExtractorSettings, Rejection, Scan, Scene, extract
from semnav_features.frames import FloatArray
from tests.support.raycaster import polyline, scan_of
from tests.support.strategies import Opening, Room, awkward_scans, openings, rooms

HERE = (0.0, 0.0, 0.0)
seeds = st.integers(0, 2**32 - 1)


def of_kind(scene: Scene, kind: str) -> list[Rejection]:
    return [rejection for rejection in scene.rejections if rejection.kind == kind]


def explained(segments: FloatArray, chosen: ExtractorSettings | None = None) -> Scene:
    return extract(scan_of(segments, HERE), chosen or ExtractorSettings(), explain=True)


@settings(max_examples=30, deadline=None)
@given(st.one_of(openings(0.5, 2.5), rooms()), seeds, st.booleans())
def test_explaining_changes_nothing_else(place: Opening | Room, seed: int, is_circle: bool) -> None:
    field = 2.0 * math.pi * 810 / 811 if is_circle else 4.7
    rng = np.random.default_rng(seed)
    scan = scan_of(place.segments, place.pose, 811, field, sigma=0.02, rng=rng)
    scene = extract(scan, explain=True)
    assert replace(scene, rejections=()) == extract(scan)
    assert all(rejection.reason for rejection in scene.rejections)


@settings(max_examples=60, deadline=None)
@given(awkward_scans())
def test_any_scan_can_be_explained(scan: Scan) -> None:
    for rejection in extract(scan, explain=True).rejections:
        assert rejection.kind in ("wall", "door", "corner", "corridor", "arc")
        assert np.isfinite((*rejection.start, *rejection.end)).all()


@settings(max_examples=30, deadline=None)
@given(openings(0.5, 2.5), seeds)
def test_each_corner_has_two_probes_found_or_explained(opening: Opening, seed: int) -> None:
    rng = np.random.default_rng(seed)
    scene = extract(scan_of(opening.segments, opening.pose, sigma=0.02, rng=rng), explain=True)
    probed = [corner for corner in scene.corners if corner.kind is not CornerKind.OUTER]
    assert len(scene.corridors) + len(of_kind(scene, "corridor")) == 2 * len(probed)


def test_without_being_asked_there_are_no_reasons() -> None:
    assert extract(scan_of(polyline((2.0, -0.05), (2.0, 0.05)), HERE)).rejections == ()


@pytest.mark.parametrize(
    ("ends", "beams", "reason"),
    [
        (((2.0, -0.05), (2.0, 0.05)), 5, "m long; wall_length is 0.2"),
        (((8.0, -0.15), (8.0, 0.15)), 40, "7 beams; wall_beams is 40"),
    ],
)
def test_a_piece_that_is_no_wall_says_what_it_lacks(
    ends: tuple[tuple[float, float], tuple[float, float]], beams: int, reason: str
) -> None:
    chosen = ExtractorSettings(wall_beams=beams)
    found = of_kind(explained(polyline(*ends), chosen), "wall")
    assert len(found) == 1
    assert reason in found[0].reason
    assert found[0].start == pytest.approx(ends[0], abs=0.05)
    assert found[0].end == pytest.approx(ends[1], abs=0.05)


@pytest.mark.parametrize(
    ("points", "reason"),
    [
        ([(2.0, -1.5), (2.0, 0.0), (1.5, 1.0)], "turn by 26.6 degrees; corner_angle is 50"),
        ([(3.0, -1.5), (3.0, 0.5), (2.0, 1.5)], "turn by 45.0 degrees; corner_angle is 50"),
    ],
)
def test_a_flat_corner_says_how_flat_it_is(points: list[tuple[float, float]], reason: str) -> None:
    scene = explained(polyline(*points))
    assert [c.kind for c in scene.corners] == [CornerKind.POTENTIAL] * 2
    assert any(reason in rejection.reason for rejection in of_kind(scene, "corner"))
    sharper = explained(polyline(*points), ExtractorSettings(corner_angle=math.radians(20.0)))
    assert CornerKind.OUTER in [corner.kind for corner in sharper.corners]


def test_walls_too_far_apart_for_a_corner_say_how_far() -> None:
    walls = np.concatenate((polyline((2.0, -1.5), (2.0, 0.5)), polyline((1.3, 1.2), (-1.0, 1.2))))
    reasons = [rejection.reason for rejection in of_kind(explained(walls), "corner")]
    assert len(reasons) == 1
    assert "twice corner_gap is 0.6" in reasons[0]
    assert float(reasons[0].split()[3]) == pytest.approx(math.hypot(0.7, 0.7), abs=0.02)


def test_a_wall_that_goes_on_behind_the_other_says_so() -> None:
    walls = np.concatenate((polyline((0.8, 0.4), (0.8, 0.8)), polyline((3.0, 1.0), (-3.0, 1.0))))
    reasons = [rejection.reason for rejection in of_kind(explained(walls), "corner")]
    assert any("goes on behind the other" in reason for reason in reasons)


def test_a_probe_that_meets_nothing_says_so() -> None:
    reasons = {r.reason for r in of_kind(explained(polyline((2.0, -1.0), (2.0, 1.0))), "corridor")}
    assert reasons == {"no wall within corridor_probe, 2.5 m"}


def test_a_narrow_passage_says_how_narrow_it_is() -> None:
    sides = np.concatenate(
        (polyline((-1.0, -0.25), (2.0, -0.25)), polyline((3.0, 0.25), (-1.0, 0.25)))
    )
    scene = explained(sides)
    assert scene.corridors == ()
    reasons = {rejection.reason for rejection in of_kind(scene, "corridor")}
    assert "0.500 m wide; twice corridor_half_width is 0.6" in reasons


def gap(width: float, recess: float | None = None) -> FloatArray:
    """A wall before the lidar with a gap, open or closed by a second wall behind it."""
    walls = [polyline((2.0, -3.0), (2.0, -width / 2)), polyline((2.0, width / 2), (2.0, 3.0))]
    if recess is not None:
        walls.append(polyline((2.0 + recess, -3.0), (2.0 + recess, 3.0)))
    return np.concatenate(walls)


def reasons_of_doors(segments: FloatArray, **limits: Any) -> list[str]:
    scene = explained(segments, ExtractorSettings(**limits))
    assert not scene.doors
    return [rejection.reason for rejection in of_kind(scene, "door")]


@pytest.mark.parametrize(
    ("width", "recess", "limits", "reason"),
    [
        (0.5, None, {}, "m wide; door_width_min less door_width_tolerance is"),
        (2.0, None, {}, "m wide; door_width_max and door_width_tolerance are 1.25"),
        (0.9, 0.1, {}, "no beam gets deeper than 0.1"),
        (0.9, 1.0, {"door_clear_fraction": 1.0, "door_depth": 1.5}, "door_clear_fraction is 1"),
        (0.9, None, {"door_confidence_min": 1.0}, "door_confidence_min is 1"),
        (0.9, None, {"door_beams": 500}, "beams pass; door_beams is 500"),
    ],
)
def test_a_gap_that_is_no_door_says_which_limit_it_failed(
    width: float, recess: float | None, limits: dict[str, Any], reason: str
) -> None:
    assert any(reason in found for found in reasons_of_doors(gap(width, recess), **limits))


def test_a_gap_in_the_shadow_of_something_says_so() -> None:
    pillar, wall = polyline((1.0, -0.23), (1.0, 0.23)), polyline((2.0, -3.0), (2.0, 3.0))
    scene = explained(np.concatenate((wall, pillar)))
    assert any("m in front of it; door_shadow" in r.reason for r in of_kind(scene, "door"))


def test_a_measured_width_is_that_of_the_gap() -> None:
    (reason,) = [each for each in reasons_of_doors(gap(2.0)) if "door_width_max" in each]
    assert float(reason.split()[0]) == pytest.approx(2.0, abs=0.05)


@settings(max_examples=30, deadline=None)
@given(openings(0.75, 1.2), seeds, st.booleans())
def test_no_door_that_was_found_is_explained_away(
    opening: Opening, seed: int, is_circle: bool
) -> None:
    """What was accepted, and not suppressed by a better one, is a door and has no reason."""
    field = 2.0 * math.pi * 810 / 811 if is_circle else 4.7
    rng = np.random.default_rng(seed)
    scan = scan_of(opening.segments, opening.pose, 811, field, sigma=0.02, rng=rng)
    scene = extract(scan, explain=True)
    suppressed = [r for r in of_kind(scene, "door") if "has its middle" in r.reason]
    for rejection in suppressed:
        middle = np.add(rejection.start, rejection.end) / 2
        near = [math.dist(middle, door.midpoint) for door in scene.doors]
        assert min(near) < 0.8
    for rejection in of_kind(scene, "door"):
        ends = {rejection.start, rejection.end}
        assert rejection in suppressed or not any(
            max(min(math.dist(a, b) for b in ends) for a in (d.start, d.end)) < 1e-6
            for d in scene.doors
        )
