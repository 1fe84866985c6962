"""The transforms of `frames` as kernels call them; imported, it makes them known to the compiler.

It is apart from `frames`, so that reading a floor plan or a scene does not load the compiler.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from numba.extending import overload, register_jitable

from semnav_features.frames import (
    compose,
    heading_between,
    middle_of,
    relative,
    to_local,
    to_parent,
    wrap_angle,
)

for _function in (to_parent, to_local, compose, relative, heading_between, middle_of):
    register_jitable(_function)


@overload(wrap_angle)
def _compiled_wrap_angle(angle: float) -> Callable[[float], float]:
    """What compiled code calls as `wrap_angle`: the same to the last bit.

    A remainder is exact, and so is each difference below: `rest` is the angle's distance from the
    whole turn before it, and `missing` that from the one behind it. Of two equally near ones the
    even turn counts, as in IEEE 754.
    """

    def wrap(angle: float) -> float:
        size = abs(angle)
        if size <= math.pi:
            return angle
        rest = size % math.tau
        missing = math.tau - rest
        if rest > missing:
            rest = -missing
        elif rest == missing:
            rest -= 2.0 * (0.5 * (size - rest) % math.tau)
        return math.copysign(1.0, angle) * rest

    return wrap
