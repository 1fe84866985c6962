"""Damaged floor plan files: they load or are refused, whatever is in them."""

from __future__ import annotations

import json
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.world.maps import FloorPlan, FloorPlanError
from semnav_env.world.maps.library import BUNDLED_FOLDER
from semnav_env.world.maps.reader import parse_plan
from semnav_env.world.maps.writer import to_geojson
from tests.support.plan_documents import hall


def _nodes(value: Any, path: tuple[str | int, ...] = ()) -> list[tuple[str | int, ...]]:
    items = value.items() if isinstance(value, dict) else enumerate(value)
    children = [(item, (*path, key)) for key, item in items]
    deeper = [_nodes(item, p) for item, p in children if isinstance(item, dict | list)]
    return [p for _, p in children] + [p for found in deeper for p in found]


NODES = _nodes(hall())
odd_values = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(10**30), 10**30),
    st.floats(),
    st.text(max_size=5),
    st.lists(st.floats(), max_size=3),
    st.just({}),
    st.sampled_from(["wall", "door", "room", "boundary", "Polygon", "LineString", "closed"]),
)


@settings(max_examples=250, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(NODES), odd_values), min_size=1, max_size=3))
def test_damaged_documents_load_or_are_refused(
    damage: list[tuple[tuple[str | int, ...], object]],
) -> None:
    document: Any = hall()
    for path, value in damage:
        _replace(document, path, value)
    plan = _plan_or_error(json.dumps(document))
    if isinstance(plan, FloorPlan):
        assert parse_plan(to_geojson(plan), "again", "hall") == plan
    else:
        assert plan.startswith("damaged: ")
        assert "\n" not in plan


def _replace(target: Any, path: tuple[str | int, ...], value: object) -> None:
    try:
        for key in path[:-1]:
            target = target[key]
        target[path[-1]] = value
    except (TypeError, KeyError, IndexError):
        return  # an earlier change removed the place


@settings(max_examples=100, deadline=None)
@given(st.data())
def test_damaged_bytes_load_or_are_refused(data: st.DataObject) -> None:
    text = (BUNDLED_FOLDER / "villa_hall.geojson").read_text("utf-8")
    start = data.draw(st.integers(0, len(text)))
    cut = data.draw(st.integers(0, 40))
    patch = data.draw(st.text(max_size=5))
    plan = _plan_or_error(text[:start] + patch + text[start + cut :])
    assert isinstance(plan, FloorPlan) or plan.startswith("damaged: ")


def _plan_or_error(text: str) -> FloorPlan | str:
    try:
        return parse_plan(text, "damaged", "name")
    except FloorPlanError as error:
        return str(error)
