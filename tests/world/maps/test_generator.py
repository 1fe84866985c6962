"""The generator of offices: the same from the same seed, and errors that help."""

from __future__ import annotations

import hashlib
import json
import math
import multiprocessing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.world.maps import (
    DISTRIBUTIONS,
    FloorPlanError,
    Material,
    OfficeSettings,
    generate_office,
    load_floor_plan,
    save_floor_plan,
)
from semnav_env.world.maps.generator.boxes import merged, without
from semnav_env.world.maps.writer import to_geojson
from tests.support.offices import every_distribution, names, seeds
from tests.support.paths import GOLDEN


def in_another_process(name: str) -> str:
    return to_geojson(load_floor_plan(name))


@every_distribution
def test_the_same_seed_gives_the_same_bytes(name: str) -> None:
    assert to_geojson(generate_office(17, name)) == to_geojson(generate_office(17, name))
    assert to_geojson(generate_office(17, name)) != to_geojson(generate_office(18, name))


@every_distribution
def test_offices_stay_what_they_were(name: str) -> None:
    """Episodes are kept by the names of their plans: a change of the generator breaks them."""
    digests = json.loads((GOLDEN / "offices.json").read_text())
    for seed in range(3):
        text = to_geojson(generate_office(seed, name))
        assert hashlib.sha256(text.encode()).hexdigest() == digests[f"office:{name}:{seed}"]


def test_a_spawned_process_gives_the_same_bytes_for_a_name() -> None:
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        there = pool.apply(in_another_process, ("office:small:5",))
    assert there == to_geojson(generate_office(5, "small"))


@given(seeds, names)
@settings(max_examples=10, deadline=None)
def test_a_plan_reads_back_equal(seed: int, name: str) -> None:
    plan = generate_office(seed, name)
    head = json.loads(to_geojson(plan))
    assert head["name"] == plan.name
    assert load_floor_plan(plan.name) == plan


def test_a_written_office_reads_back_equal_with_its_open_areas(tmp_path: Path) -> None:
    plan = next(p for p in map(generate_office, range(50)) if p.areas)
    save_floor_plan(plan, tmp_path / "office.geojson")
    assert load_floor_plan(tmp_path / "office.geojson") == plan
    assert plan.region(plan.areas[0].name) == plan.areas[0]


def test_settings_of_ones_own_are_kept_to_and_named_custom() -> None:
    wide = OfficeSettings(door_width=(1.1, 1.2), furniture=0.0, columns=0.0, open_areas=0.0)
    plan = generate_office(3, wide)
    assert plan.name == "office:custom:3"
    assert min(door.width for door in plan.doors) > 1.099
    assert plan.areas == ()
    assert Material.FURNITURE not in {surface.material for surface in plan.surfaces}
    assert generate_office(3, replace(DISTRIBUTIONS["hard"])).name == "office:hard:3"


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"door_width": (0.6, 1.2)}, "door_width.* is 0.6; it must be a number from 0.8 to 1.2"),
        ({"closed": 1.5}, "closed is 1.5; it must be a number from 0 to 1"),
        ({"bay": (20.0, 10.0)}, "bay is .* the least and then the most"),
        ({"room_depth": (math.nan, 5.0)}, "room_depth"),
        ({"rooms": (90, 100)}, "no office of 90 to 100 rooms came up"),
    ],
)
def test_settings_that_make_no_office_are_refused(change, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        generate_office(0, OfficeSettings(**change))


def test_a_seed_may_be_a_number_of_numpys() -> None:
    assert generate_office(np.int64(3), "small") == generate_office(3, "small")


@pytest.mark.parametrize("seed", [-1, 2**63, 1.5, True, "7"])
def test_a_seed_is_a_whole_number(seed) -> None:
    with pytest.raises(ValueError, match="give a whole number"):
        generate_office(seed)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("office", "write office:DISTRIBUTION:SEED"),
        ("office:medium", "write office:DISTRIBUTION:SEED"),
        ("office:medium:-1", "write office:DISTRIBUTION:SEED"),
        ("office:medium:07", "write office:DISTRIBUTION:SEED"),
        ("office:medum:7", "did you mean medium"),
        ("office:custom:7", "there are: small, medium, large, hard"),
        ("office:medium:9999999999999999999", "a whole number from 0 to"),
    ],
)
def test_a_name_of_no_office_is_refused_and_says_what_is_right(name: str, words: str) -> None:
    with pytest.raises(FloorPlanError, match=words):
        load_floor_plan(name)


spans = st.lists(st.tuples(st.integers(0, 30), st.integers(0, 30)).map(sorted).map(tuple))


@given(spans, spans)
def test_spans_minus_holes_are_what_no_hole_covers(given_spans, holes) -> None:
    left = without(given_spans, holes)
    for k in range(30):
        inside = any(a <= k < b for a, b in given_spans) and not any(a <= k < b for a, b in holes)
        assert any(a <= k < b for a, b in left) == inside
    assert merged(left) == left
