"""The cases that the extractor is measured on."""

import numpy as np
import pytest
from shapely import LineString, Point

from semnav_env.world.maps import Material, bundled_names, load_floor_plan
from studies.features.clutter import cluttered
from studies.truth import TrueView
from studies.truth.shapes import fit_circle
from tests.support.evaluation_cases import OFFICE, cases
from tests.support.small_plans import empty_hall


def test_a_case_is_drawn_the_same_from_the_same_seed():
    first, second = cases(), cases()
    assert [case.pose for case in first] == [case.pose for case in second]
    assert all(
        np.array_equal(a[1].ranges, b[1].ranges)
        for one, other in zip(first, second, strict=True)
        for a, b in zip(one.scans, other.scans, strict=True)
    )


def test_noise_has_the_stated_size():
    for case in cases(clutter=False):
        (_, clean), (_, noisy) = case.scans
        both = clean.valid & noisy.valid & (clean.ranges < 9.5)
        exact = TrueView(OFFICE).scan(case.pose)
        assert np.array_equal(clean.ranges[both], exact.ranges[both])
        assert np.std(noisy.ranges[both] - clean.ranges[both]) == pytest.approx(0.02, rel=0.25)


@pytest.mark.parametrize("name", bundled_names())
def test_half_of_the_poses_are_in_corridors(name):
    plan = load_floor_plan(name)
    inside = [
        any(r.polygon.covers(Point(case.pose[:2])) for r in (*plan.corridors, *plan.intersections))
        for case in cases(plan, 6, (0.0,), clutter=False)
        if case.situation.place == "corridor"
    ]
    assert inside == [True] * 3


def test_a_plan_that_names_no_rooms_is_floor_all_over():
    for case in cases(empty_hall(), 4, (0.0,), clutter=False):
        assert 0.35 <= case.pose[0] <= 9.65
        assert 0.35 <= case.pose[1] <= 5.65


def test_clutter_stands_free_and_is_partly_round():
    filled = cluttered(OFFICE, np.random.default_rng(0))
    added = filled.surfaces[len(OFFICE.surfaces) :]
    assert len(added) > 10
    assert {surface.material for surface in added} == {Material.FURNITURE}
    assert 0 < sum(fit_circle(surface) is not None for surface in added) < len(added)
    for surface in added:
        assert not len(OFFICE.solids.query(LineString(surface.points), "intersects"))
