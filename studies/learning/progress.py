"""What a method of learning gives while it learns."""

from __future__ import annotations

from typing import NamedTuple

from studies.learning.command_envs import Decide

POINTS = 3
"""How often a policy is given while it learns."""


class Learned(NamedTuple):
    """A policy on the way.

    Attributes:
        steps: of the environment so far, those of demonstrations included.
        decide: the policy without noise; valid until the next one is asked for.
    """

    steps: int
    decide: Decide


def points(first: int, last: int) -> list[int]:
    """Evenly spaced numbers of steps up to the last one."""
    return [first + (last - first) * k // POINTS for k in range(1, POINTS + 1)]
