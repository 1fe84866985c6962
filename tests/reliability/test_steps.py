"""Memory stays flat however long one drives; `make soak` drives for longer."""

from __future__ import annotations

from tests.reliability.steps import drive

STEPS = 3000
MOST_GROWTH = 30.0
"""After the warm-up, megabytes."""


def test_memory_stays_flat() -> None:
    *_, end = drive(STEPS, STEPS)
    assert end.steps == STEPS
    assert end.episodes > 3
    assert end.memory - end.warm < MOST_GROWTH, end
