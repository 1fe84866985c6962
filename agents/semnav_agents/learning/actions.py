"""Actions of a policy for several bodies: those of the body with the most degrees of freedom."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


def for_body(actions: Array, size: int) -> Array:
    """Convert actions of a policy for a body; one that cannot move sideways ignores that part.

    Args:
        actions: of the policy, shape (..., 2 or 3).
        size: number of values that the body takes, at most as many.
    """
    return actions if actions.shape[-1] == size else actions[..., [0, -1]]


def from_body(action: Array, size: int) -> Array:
    """Convert an action of a body to an action of a policy; the inverse of `for_body`.

    Args:
        action: of the body, shape (2,) or (3,).
        size: number of values that the policy gives, at least as many.
    """
    return action if len(action) == size else np.insert(action, 1, 0.0)
