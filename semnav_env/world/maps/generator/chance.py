"""Random numbers of generated offices, on a grid of centimetres."""

from __future__ import annotations

from numpy.random import Generator

from semnav_env.world.maps.generator.settings import Range


def chance(rng: Generator, probability: float) -> bool:
    """Draw whether something happens."""
    return bool(rng.random() < probability)


def centimetres(rng: Generator, metres: Range, step: int = 5) -> int:
    """Draw a multiple of `step` centimetres within a range of metres."""
    low, high = (round(100 * value / step) for value in metres)
    return step * int(rng.integers(low, high + 1))
