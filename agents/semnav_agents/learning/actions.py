"""Actions of a policy that drives several bodies: those of the one that can do most."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


def for_body(actions: Array, size: int) -> Array:
    """Actions as a body takes them; one that cannot move sideways leaves that part out.

    Args:
        actions: of the policy, shape (..., 2 or 3).
        size: number of values that the body takes, at most as many.
    """
    return actions if actions.shape[-1] == size else actions[..., [0, -1]]


def from_body(action: Array, size: int) -> Array:
    """An action of a body as a policy gives it; the opposite of `for_body`.

    Args:
        action: of the body, shape (2,) or (3,).
        size: number of values that the policy gives, at least as many.
    """
    return action if len(action) == size else np.insert(action, 1, 0.0)
