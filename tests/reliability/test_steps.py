"""Memory stays flat however long one drives; `make soak` drives for longer."""

from __future__ import annotations

from tests.reliability.steps import drive

STEPS = 2000
MOST_GROWTH = 30.0
"""On one floor, megabytes."""


def test_memory_stays_flat() -> None:
    *_, end = drive(STEPS, STEPS)
    assert end.steps == STEPS
    assert end.episodes > 2
    assert end.memory - end.warm < MOST_GROWTH, end
