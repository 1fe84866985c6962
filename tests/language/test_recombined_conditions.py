"""Conditions behind clauses that are counted from: every combination is read or refused."""

from __future__ import annotations

from contextlib import suppress
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.language import CommandError, read, readings

FIRST = {
    "en": (
        "pass two doors on the left",
        "go past the first door",
        "go down the hallway until the first door on the left",
        "go past two intersections",
        "past the second corner",
        "through the second door, out",
        "turn left",
        "",
    ),
    "de": (
        "fahr an zwei Türen links vorbei",
        "geh an der ersten Tür vorbei",
        "fahr bis zur ersten Tür links",
        "fahr über zwei Kreuzungen",
        "an der zweiten Ecke vorbei",
        "durch die zweite Tür, raus",
        "bieg links ab",
        "",
    ),
}
CONDITION = {
    "en": (
        "if the third one is open",
        "if there is a third one",
        "if there is no third door on the left",
        "if the third door is closed",
        "unless you see the third intersection",
        "if you see the third corner",
        "once the third door is open",
        "if it is open",
        "is there a third door ?",
    ),
    "de": (
        "wenn die dritte offen ist",
        "falls es eine dritte gibt",
        "wenn links keine dritte Tür ist",
        "wenn die dritte Tür zu ist",
        "falls du keine dritte Kreuzung siehst",
        "wenn du die dritte Ecke siehst",
        "sobald die dritte Tür offen ist",
        "wenn sie offen ist",
        "gibt es eine dritte Tür ?",
    ),
}
DONE = {
    "en": (
        "go in",
        "go through the third door",
        "take the fourth one, otherwise stop",
        "turn right there, otherwise take the fourth door on the left",
        "face the third door",
        "go past the third door, in any case stop",
    ),
    "de": (
        "fahr rein",
        "fahr durch die dritte Tür",
        "nimm die vierte, sonst halt an",
        "bieg da rechts ab, sonst nimm die vierte Tür links",
        "schau zur dritten Tür",
        "fahr an der dritten Tür vorbei, auf jeden Fall halt an",
    ),
}
JOINTS = (" and ", ", ", ". ", " ")


def _only_command_errors(text: str) -> None:
    with suppress(CommandError):
        read(text)


@pytest.mark.parametrize("code", ["en", "de"])
def test_every_condition_behind_every_clause_is_read_or_refused(code: str) -> None:
    joint = {"en": " and ", "de": " und "}[code]
    for first, condition, done in product(FIRST[code], CONDITION[code], DONE[code]):
        _only_command_errors(f"{first}{joint if first else ''}{condition} {done}")


PARTS = [text for table in (FIRST, CONDITION, DONE) for some in table.values() for text in some]


@given(
    st.lists(st.sampled_from(PARTS), min_size=1, max_size=5),
    st.lists(st.sampled_from(JOINTS), min_size=5, max_size=5),
)
def test_any_order_of_conditions_and_clauses_is_read_or_refused(
    parts: list[str], joints: list[str]
) -> None:
    _only_command_errors("".join(map("".join, zip(parts, joints, strict=False))))


def test_a_condition_and_what_depends_on_it_are_counted_from_one_place() -> None:
    text = "pass two doors on the left and if the third one is open go in"
    assert {str(each) for each in readings(text)} == {
        "go down the hallway past the second door on the left, from there if you see the third "
        "door on the left, go through the third door on the left",
        "go down the hallway past the second door on the left, if you see the first door on the "
        "left, go through the first door on the left",
    }
    otherwise = "go past the first door, if you see the second door, stop, otherwise turn left"
    assert len(readings(otherwise)) == 2


def test_parse_answers_conditions_that_are_counted_on() -> None:
    for code in ("en", "de"):
        for condition, done in product(CONDITION[code][:3], DONE[code][:3]):
            with suppress(CommandError):
                read(f"{FIRST[code][0]}, {condition} {done}")
