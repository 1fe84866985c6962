"""Actions and poses that are no numbers are refused, one by one and in vectors."""

from __future__ import annotations

import datetime
import math
import re
from typing import Any

import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.robots import SPOT, WHEELCHAIR
from semnav_env.robots.actions import Actions
from semnav_env.vector import SemNavVectorEnv
from tests.support.episodes import START

HOSTILE: list[Any] = [
    np.array(["2020-01-01", "2021-01-01"], "M8[D]"),
    np.array(["NaT", "NaT"], "M8[D]"),
    np.array([1, 2], "m8[s]"),
    np.array([1 + 5j, 0.0]),
    np.ma.masked_array([1.0, 0.5], [True, False]),
    {"forward": 1.0},
    {1.0, 0.5},
    object(),
    [object(), object()],
    "10",
    ["1", "0"],
    b"10",
    None,
    [None, None],
    [10**400, 0],
    [[1.0], 0.0],
    [math.nan, 0.0],
    [0.0, math.inf],
    [1.0],
    [1.0, 0.0, 0.0],
    [[1.0, 0.0]],
    [True, False],
    [datetime.datetime(2020, 1, 1), 0],
]


def named(value: object) -> str:
    """The value in few words; without addresses, which differ from one process to the next."""
    return re.sub(r" at 0x[0-9a-f]+", "", repr(value))[:30]


@pytest.mark.parametrize("action", HOSTILE, ids=named)
def test_what_is_no_action_is_refused(action: Any) -> None:
    with pytest.raises(ValueError, match="the action") as error:
        Actions(WHEELCHAIR).twist(action)
    assert len(str(error.value)) < 300


@pytest.mark.parametrize("action", HOSTILE, ids=named)
def test_a_vector_refuses_what_is_no_action(action: Any) -> None:
    envs = SemNavVectorEnv(1)
    envs.reset(seed=0)
    with pytest.raises(ValueError, match="the action"):
        envs.step(np.ma.stack([action]) if isinstance(action, np.ma.MaskedArray) else [action])
    envs.close()


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.float64, np.int8, np.uint8, list])
def test_numbers_of_every_kind_drive(kind: Any) -> None:
    action = kind([1, 0, 0]) if kind is list else np.array([1, 0, 0], kind)
    assert Actions(SPOT).twist(action) == (SPOT.max_speed, 0.0, 0.0)
    assert Actions(SPOT).twist(np.ma.masked_array(action)) == (SPOT.max_speed, 0.0, 0.0)


@pytest.mark.parametrize(
    "pose",
    [
        (10**400, 0, 0),
        (0, 0, 10**400),
        (1e308, 0.0, 0.0),
        ("1", "2", "3"),
        "123",
        {1.0, 2.0, 3.0},
        {1.0: 0, 2.0: 0, 3.0: 0},
        (True, False, True),
        (1 + 1j, 0.0, 0.0),
        np.array(["NaT"] * 3, "M8[D]"),
        np.ma.masked_array([1.0, 2.0, 3.0], [True, False, False]),
        [[1.0, 2.0, 3.0]],
        object(),
        7,
    ],
    ids=named,
)
def test_what_is_no_pose_is_refused(pose: Any) -> None:
    with pytest.raises(ValueError, match="pose") as error:
        SemNavEnv().reset(seed=0, options=START | {"pose": pose})
    assert len(str(error.value)) < 300
