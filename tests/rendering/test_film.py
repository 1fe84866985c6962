"""Films that are made while an episode is driven."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from semnav_env.rendering.film import Film


class Counter:
    """An environment whose picture is the number of the step."""

    metadata: dict[str, Any] = {"render_fps": 15}  # noqa: RUF012 - as Gymnasium has it

    def __init__(self) -> None:
        self.step = 0

    def render(self) -> Any:
        return np.full((2, 2, 3), self.step)


def filmed(steps: int, most: int | None) -> list[int]:
    """The numbers of the steps that a film shows."""
    env = Counter()
    film = Film(env, steps_per_frame=3, most=most)
    for env.step in range(steps):
        film.note(env.step == steps - 1)
    return [int(frame[0, 0, 0]) for frame in film.frames]


def test_a_film_shows_every_third_step_and_the_last() -> None:
    assert filmed(11, None) == [0, 3, 6, 9, 10]


@pytest.mark.parametrize("steps", [1, 24, 25, 100, 1000])
def test_a_long_film_has_no_more_frames_and_stays_even(steps: int) -> None:
    found = filmed(steps, most=8)
    assert len(found) <= 8
    assert found[-1] == steps - 1
    assert len(set(np.diff(found[:-1]).tolist())) <= 1
