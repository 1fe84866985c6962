"""The open leaf of a door, in plain NumPy; see `kernels.door_leaf`."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.elements import SceneLeaf
from tests.numpy_oracle.constants import LEAF
from tests.numpy_oracle.door_evidence import Gap
from tests.numpy_oracle.walls import Piece


def find_leaf(gap: Gap, pieces: list[Piece]) -> SceneLeaf | None:
    """The piece of about the door's width that ends nearest to a jamb, if it is no wall."""
    best, nearest = None, LEAF.hinge
    for piece in pieces:
        if not LEAF.shortest * gap.width <= piece.length <= LEAF.longest * gap.width:
            continue
        for at_start, jamb in ((True, gap.start), (False, gap.end)):
            for hinge, tip in ((piece.start, piece.end), (piece.end, piece.start)):
                distance = float(np.linalg.norm(hinge - jamb.point))
                closed = gap.along if at_start else -gap.along
                turn = _angle(tip - hinge, closed, np.array((gap.along[1], -gap.along[0])))
                flat = LEAF.narrowest
                if distance < nearest and flat <= abs(turn) <= math.pi - flat:
                    best, nearest = SceneLeaf(at_start, turn), distance
    return best


def _angle(leaf: np.ndarray, closed: np.ndarray, away: np.ndarray) -> float:
    return math.atan2(float(leaf @ away), float(leaf @ closed))
