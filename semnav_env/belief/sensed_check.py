"""Checks what a real robot hands to the belief; a simulated one needs no check."""

from __future__ import annotations

import math
from collections.abc import Iterable

from semnav_env.features.validation import finite_floats, require


def check_sensed(
    odometry: object, velocity: object, bumps: Iterable[object], seconds: float
) -> None:
    """Check what comes with a scan; see `BeliefTracker.update`.

    Raises:
        ValueError: three numbers that are not finite, or a time that is not above 0; names it.
    """
    triples = [("odometry", odometry), *(("a bump", each) for each in bumps)]
    if velocity is not None:
        triples.append(("velocity", velocity))
    for name, value in triples:
        numbers = finite_floats(value)
        require(numbers is not None and len(numbers) == 3, name, value, "three finite numbers")
    require(0.0 < seconds < math.inf, "seconds", seconds, "finite and above 0")
