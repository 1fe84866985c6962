"""Numbers that no float holds, and numbers of 30 digits, are refused in one line everywhere."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from semnav_agents.evaluation.attempts import Attempt, read_attempts
from semnav_env.env import SemNavEnv
from semnav_env.language import parse
from semnav_env.mind.belief import BeliefTracker
from semnav_env.world.maps import load_floor_plan
from semnav_features import Scan
from semnav_features.readers import Geometry
from tests.reliability.children import outcome_of
from tests.reliability.long_runs import holes

HUGE = (10**400, -(10**400), 10**5000, 1e400, -math.inf, math.nan, "1e400", 1 + 2j, [10**400])
DIGITS = ("1" * 30, "1" * 400, "1" * 5000, "1e400", "-1e999", "1e-999", "0." + "3" * 400)

ANGLES = {"angle_min": -1.5, "angle_increment": 0.017}
RANGES = [2.0] * 181


RESULT: dict[str, Any] = {
    each.name: {"str": "a", "int": 1, "bool": True, "float": 0.5}[str(each.type)]
    for each in fields(Attempt)
}
"""A result of an evaluation."""


def tracker() -> BeliefTracker:
    made = BeliefTracker()
    made.begin(parse("stop"))
    return made


def updated(**sensed: Any) -> Any:
    made = tracker()
    ranges = [2.0] * made.lidar.beams
    return made.update(**{"ranges": ranges, "odometry": (0.0, 0.0, 0.0), **sensed})


CALLS: dict[str, Callable[[Any], Any]] = {
    **{name: lambda value, name=name: Scan(RANGES, **{**ANGLES, name: value}) for name in ANGLES},
    "range_max": lambda value: Scan(RANGES, **ANGLES, range_max=value),
    "stamp": lambda value: Scan(RANGES, **ANGLES, stamp=value),
    "geometry": lambda value: Geometry(range_max=value),
    "mount": lambda value: BeliefTracker(mount=(0.0, value, 0.0)),
    "odometry": lambda value: updated(odometry=(value, 0.0, 0.0)),
    "velocity": lambda value: updated(velocity=(value, 0.0, 0.0)),
    "seconds": lambda value: updated(seconds=value),
    "bumps": lambda value: updated(bumps=[(value, 0.0, 0.0)]),
    "no bumps": lambda value: updated(bumps=value),
    "pose": lambda value: SemNavEnv().reset(seed=1, options={"pose": (value, 0.0, 0.0)}),
    "command": lambda value: SemNavEnv().reset(seed=1, options={"command": [value]}),
}


@pytest.mark.parametrize("name", CALLS)
@pytest.mark.parametrize("value", HUGE, ids=lambda value: str(type(value)))
def test_a_value_that_is_no_finite_number_is_refused_in_one_line(name: str, value: Any) -> None:
    outcome = outcome_of(lambda: CALLS[name](value))
    assert not outcome.fault, outcome
    assert outcome.message


@pytest.mark.parametrize("value", [10**400, -(10**400), 10**5000], ids=("large", "small", "long"))
def test_ranges_that_no_float_holds_are_refused_in_one_line(value: int) -> None:
    for call in (lambda: Scan([value, 2.0, 2.0], **ANGLES), lambda: updated(ranges=[value] * 811)):
        outcome = outcome_of(call)
        assert not outcome.fault, outcome
        assert "real numbers in metres" in outcome.message


@pytest.mark.parametrize("value", [np.float32(0.5), 1, np.int64(2)])
def test_numbers_of_every_kind_are_taken(value: Any) -> None:
    assert Scan(RANGES, **ANGLES, stamp=value).stamp == value
    assert BeliefTracker(mount=(value, 0, 0)).mount == (value, 0.0, 0.0)


@pytest.mark.parametrize("digits", DIGITS, ids=lambda digits: f"{digits[:6]}, {len(digits)}")
def test_a_huge_number_anywhere_in_a_file_is_read_or_refused(tmp_path: Path, digits: str) -> None:
    for hole in holes(tmp_path):
        path = tmp_path / hole.name
        path.write_text(hole.text.replace("@", digits), encoding="utf-8")
        outcome = outcome_of(lambda read=hole.read, path=path: read(path), path.name)
        assert not outcome.fault, (hole.text[:200], outcome)


@pytest.mark.parametrize("digits", DIGITS[:3], ids=len)
def test_an_office_of_a_huge_seed_is_refused(digits: str) -> None:
    outcome = outcome_of(lambda: load_floor_plan(f"office:small:{digits}"))
    assert not outcome.fault, outcome
    assert outcome.message


@pytest.mark.parametrize("digits", DIGITS[:3], ids=len)
def test_an_episode_of_a_huge_number_is_unknown(digits: str) -> None:
    outcome = outcome_of(
        lambda: SemNavEnv().reset(seed=1, options={"episode": f"val_seen-{digits}"})
    )
    assert not outcome.fault, outcome
    assert outcome.message


@pytest.mark.parametrize("digits", [*DIGITS[:5], "-0.1", "1.5"], ids=lambda digits: digits[:4])
def test_a_share_beyond_one_in_results_is_refused(tmp_path: Path, digits: str) -> None:
    path = tmp_path / "results.jsonl"
    row = asdict(Attempt(**RESULT)) | {"spl": "@"}
    path.write_text(json.dumps(row).replace('"@"', digits) + "\n")
    outcome = outcome_of(lambda: read_attempts(path), path.name)
    assert not outcome.fault, outcome
    assert outcome.message
