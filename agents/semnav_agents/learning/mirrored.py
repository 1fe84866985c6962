"""Mirrors decisions: exchanges left and right, which doubles the demonstrations."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.learning.room_memory import PROBED_MOVES, SECTORS

Array = NDArray[Any]


def _order() -> tuple[NDArray[np.intp], NDArray[np.float32]]:
    """Index and sign of the value from which each mirrored value is made."""
    # body, kind (4), place (2), heading (2), start and end of the door (4), has door, velocity (3)
    first = [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 12, 9, 10, 13, 14, 15, 16]
    negated = [6, 8, 10, 12, 15, 16]
    opposite = [
        int(np.argmin(np.abs(PROBED_MOVES - move * (1, -1, -1)).sum(axis=1)))
        for move in PROBED_MOVES
    ]
    sectors = len(first) + np.arange(SECTORS)[::-1]
    moves = len(first) + SECTORS + np.array(opposite)
    order = np.concatenate((first, sectors, moves))
    signs = np.ones(len(order), np.float32)
    signs[negated] = -1.0
    return order, signs


_ORDER, _SIGNS = _order()


def mirrored_observations(observations: Array) -> Array:
    """Compact observations as they would be with left and right exchanged, shape (n, size).

    The jambs of the door change places, so that the far side stays to the left of them.
    """
    mirrored: Array = observations[:, _ORDER] * _SIGNS
    return mirrored


def mirrored_actions(actions: Array) -> Array:
    """Actions (forward, left, turn) or (forward, turn) with left and right exchanged."""
    mirrored: Array = actions.copy()
    mirrored[:, 1:] *= -1.0
    return mirrored
