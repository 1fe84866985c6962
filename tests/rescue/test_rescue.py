"""People on the floor, the detector, the map of people, coverage, and the judge of a search."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.rescue import (
    PersonDetectorSettings,
    PersonMap,
    PersonMapSettings,
    SearchRules,
)
from semnav_env.rescue.environment import search_and_rescue
from semnav_env.rescue.outcome import Report, judge_reports
from semnav_env.rescue.person_detector import PersonDetector
from semnav_env.rescue.room_coverage import RoomCoverage
from semnav_env.robots import SPOT
from semnav_env.world.dynamics import Dynamics, PlanSource
from semnav_env.world.dynamics.furniture import FurnitureMover, free_ways
from semnav_env.world.dynamics.victim_sight import in_sight
from semnav_env.world.dynamics.victims import VICTIM_SPACING, victims_of
from semnav_env.world.maps import FloorPlan, Material, Surface, generate_office
from semnav_features.lidars import TIM561

SURE = PersonDetectorSettings(
    hit_near=1.0, hit_far=1.0, look_alikes=0.0, clutter=0.0, range_std=0.0, bearing_std=0.0
)
ORIGIN = (0.0, 0.0, 0.0)


def hall(*things: Surface) -> FloorPlan:
    """A box of 10 m x 10 m around the origin, with things in it."""
    outline = shapely.box(-5.0, -5.0, 5.0, 5.0)
    walls = Surface(tuple(outline.exterior.coords))
    return FloorPlan("hall", (walls, *things), (), (), (), (), outline)


def body(x: float, y: float, material: Material = Material.PERSON) -> Surface:
    """Somebody who sits at a place."""
    box = shapely.box(x - 0.3, y - 0.3, x + 0.3, y + 0.3)
    return Surface(tuple(box.exterior.coords), material)


def detector(plan: FloorPlan, settings: PersonDetectorSettings = SURE) -> PersonDetector:
    return PersonDetector(plan, settings, ORIGIN, np.random.default_rng(0))


@pytest.mark.parametrize(
    ("behind", "seen"), [(True, False), (False, True)], ids=["behind", "beside"]
)
def test_who_lies_behind_a_long_cupboard_is_not_in_sight(behind: bool, seen: bool) -> None:
    """The robot's ways lie in the western half, the cupboard stands between the halves."""
    x = 1.0 if behind else -1.5
    cupboard = Surface(tuple(shapely.box(-0.2, -4.9, 0.2, 4.9).exterior.coords))
    plan = hall(body(x, 0.0), cupboard)
    assert in_sight(plan, victims_of(plan), shapely.box(-4.5, -4.5, -0.7, 4.5)) is seen


@pytest.mark.parametrize("seed", [10_153, 10_167, 10_252])
def test_a_victim_drawn_out_of_sight_is_laid_down_elsewhere(seed: int) -> None:
    """In these houses the first draw has a victim whom nobody can see from within 2 m."""
    env = search_and_rescue(robot="spot")
    env.reset(seed=seed)
    plan, half = env.floor_plan, FurnitureMover(env.floor_plan, SPOT, None).half_lane
    ways = max(free_ways(plan, half), key=lambda way: way.area)
    assert in_sight(plan, victims_of(plan), ways)


@pytest.mark.parametrize("seed", range(4))
def test_victims_lie_apart_in_rooms_and_on_nothing(seed: int) -> None:
    source = PlanSource(f"office:house:{seed}", Dynamics(victims=3), SPOT)
    plan = source.plan(rng=np.random.default_rng(seed))
    victims = victims_of(plan)
    rooms = shapely.union_all([region.polygon for region in (*plan.rooms, *plan.areas)])
    assert len(victims) == 3
    assert all(rooms.contains(victim.centroid) for victim in victims)
    gaps = [a.distance(b.centroid) for a in victims for b in victims if a is not b]
    assert min(gaps) >= VICTIM_SPACING
    assert sum(p.intersects(v) for p in plan.furniture.geometries for v in victims) == 3


@given(st.floats(-4.0, 4.0), st.floats(-4.0, 4.0))
def test_who_is_in_view_is_found_where_he_is(x: float, y: float) -> None:
    looks = detector(hall(body(x, y))).look(ORIGIN)
    clearly_in_view = abs(math.atan2(y, x)) < math.radians(50.0) and math.hypot(x, y) > 1.0
    clearly_outside = abs(math.atan2(y, x)) > math.radians(110.0) and math.hypot(x, y) > 1.0
    if clearly_in_view:
        assert looks == pytest.approx(np.array([[x, y]]))
    if clearly_outside:
        assert len(looks) == 0


@given(st.floats(1.5, 4.0))
def test_nobody_is_found_behind_a_wall(x: float) -> None:
    wall = Surface(((1.0, -4.9), (1.0, 4.9)))
    assert len(detector(hall(body(x, 0.0), wall)).look(ORIGIN)) == 0


def test_a_look_alike_is_taken_for_a_person_from_afar_only() -> None:
    settings = replace(SURE, look_alikes=1.0, false_far=1.0, false_near=0.0)
    chair = detector(hall(body(3.0, 0.0, Material.FURNITURE)), settings)
    assert len(chair.look(ORIGIN)) == 1
    assert len(chair.look((1.5, 0.0, 0.0))) == 0


@pytest.mark.parametrize("name", ["hit_near", "range_max", "rate_hz", "clutter"])
def test_a_bad_setting_is_named(name: str) -> None:
    with pytest.raises(ValueError, match=name):
        PersonDetectorSettings(**{name: -1.0})


def people() -> PersonMap:
    return PersonMap(PersonDetectorSettings(), PersonMapSettings(), TIM561, ORIGIN)


OPEN = np.full(TIM561.beams, np.inf)


def test_a_person_is_reported_from_near_and_once() -> None:
    known, here = people(), np.array([[1.5, 0.0]])
    new = [len(known.update(here, ORIGIN, OPEN)) for _ in range(20)]
    assert sum(new) == 1
    (track,) = known.tracks
    assert track.reported
    assert track.place == pytest.approx((1.5, 0.0))


def test_nobody_is_reported_from_afar() -> None:
    known = people()
    for _ in range(60):
        assert known.update(np.array([[4.0, 0.0]]), ORIGIN, OPEN) == []


def test_a_false_alarm_is_forgotten_when_looked_at() -> None:
    known, nothing = people(), np.empty((0, 2))
    known.update(np.array([[1.5, 0.0]]), ORIGIN, OPEN)
    for _ in range(20):
        known.update(nothing, ORIGIN, OPEN)
    assert known.tracks == []


def test_large_furniture_that_is_no_person_is_forgotten() -> None:
    known, outline = people(), np.full(TIM561.beams, 1.7)  # 0.8 m before its middle
    known.update(np.array([[2.2, 0.0]]), ORIGIN, OPEN)
    for _ in range(30):
        known.update(np.empty((0, 2)), ORIGIN, outline)
    assert known.tracks == []


def test_who_is_hidden_is_not_forgotten() -> None:
    known, near_wall = people(), np.full(TIM561.beams, 0.5)
    known.update(np.array([[2.5, 0.0]]), ORIGIN, OPEN)
    for _ in range(50):
        known.update(np.empty((0, 2)), ORIGIN, near_wall)
    assert len(known.tracks) == 1


@given(st.lists(st.tuples(st.floats(-3, 3), st.floats(-3, 3)), max_size=8))
def test_probabilities_stay_probabilities(places: list[tuple[float, float]]) -> None:
    known = people()
    for place in places * 5:
        known.update(np.array([place]), ORIGIN, OPEN)
    assert all(0.0 < track.probability < 1.0 for track in known.tracks)
    assert len(known.tracks) <= PersonMapSettings().capacity


def test_coverage_grows_from_nothing_to_nearly_all() -> None:
    plan = generate_office(1, "house")
    coverage = RoomCoverage(plan, SPOT, PersonDetectorSettings())
    assert coverage.shares.max() == 0.0
    eyes = detector(plan)
    rng, before = np.random.default_rng(0), 0.0
    west, south, east, north = plan.boundary.bounds
    for _ in range(400):
        pose = rng.uniform(west, east), rng.uniform(south, north), rng.uniform(-3.1, 3.1)
        eyes.look(pose)
        gained = coverage.look(pose, eyes.rays, eyes.ranges, 6.0)
        assert gained >= 0.0
        assert coverage.shares.sum() >= before
        before = coverage.shares.sum()
    assert coverage.shares.min() > 0.9
    assert coverage.shares.max() <= 1.0


def test_a_report_counts_for_who_is_near_it() -> None:
    victims = [(0.0, 0.0), (5.0, 0.0)]
    reports = [Report((0.3, 0.0), 3.0), Report((0.1, 0.0), 5.0), Report((9.0, 9.0), 7.0)]
    outcome = judge_reports({"a": 1.0}, {"a": 0.9}, victims, reports, SearchRules())
    assert (outcome.found, outcome.false_reports) == (1, 1)
    assert outcome.found_at == (3.0,)
    assert outcome.report_errors == (pytest.approx(0.1),)
    assert not outcome.fulfils(SearchRules())


def test_a_search_is_done_when_all_is_seen_and_all_are_found() -> None:
    reports = [Report((0.3, 0.0), 3.0)]
    for coverage, done in ((0.96, True), (0.94, False)):
        outcome = judge_reports({"a": 1.0, "b": coverage}, {}, [(0.0, 0.0)], reports, SearchRules())
        assert outcome.fulfils(SearchRules()) is done
