"""Mirrors samples: exchanges left and right in inputs and labels."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.hearing.elements import ElementKind
from semnav_agents.hearing.tokens import CLAUSE_SIZE
from semnav_env.language.declarations import TokenVerb
from semnav_env.language.tokens import COLUMN_SIZES

Arrays = dict[str, NDArray[Any]]

_KINDS = len(ElementKind)
_SIDEWAYS = _KINDS + np.array((1, 3, 5, 7, 9, 11, 13))
"""Columns of an element that change their sign: y of both ends and the base, each twice, and a
sine."""

_EXTRAS = _KINDS + 14
_FLIPPED_EXTRAS = {ElementKind.OPENING: (0,), ElementKind.DOOR: (6,), ElementKind.PLACE: (3, 6)}
"""Extras that change their sign, by kind."""

_GAPS = _EXTRAS + 3
"""Where the shape of the corridor has the unseen stretches of its left and its right side."""

_TURNING = COLUMN_SIZES[0]
_SIDE = COLUMN_SIZES[0] + COLUMN_SIZES[1] + COLUMN_SIZES[2]


def mirrored(samples: Arrays) -> Arrays:
    """The samples with left and right exchanged; see `collecting.Samples.arrays`."""
    other = {name: values.copy() for name, values in samples.items()}
    other["elements"] = _mirrored_elements(samples["elements"])
    for name in ("bases", "robot"):
        other[name][..., 1:] *= -1.0
    other["jambs"] = _mirrored_doors(samples["jambs"])
    labels = other["labels"]
    for name in ("pose", "next"):
        labels[name][:, 1:] *= -1.0
    labels["door"] = _mirrored_doors(labels["door"])
    for start in (0, CLAUSE_SIZE):
        _mirror_clause(other["command"][:, start : start + CLAUSE_SIZE])
    return other


def _mirrored_elements(elements: NDArray[Any]) -> NDArray[Any]:
    values = elements.copy()
    values[..., _SIDEWAYS] *= -1.0
    for kind, columns in _FLIPPED_EXTRAS.items():
        rows = values[..., kind] > 0.5
        for column in columns:
            values[..., _EXTRAS + column][rows] *= -1.0
    doors = (values[..., ElementKind.DOOR] + values[..., ElementKind.TOLD_DOOR]) > 0.5
    exchanged = _KINDS + np.array((2, 3, 0, 1, 6, 7, 4, 5))
    values[..., _KINDS : _KINDS + 8][doors] = values[..., exchanged][doors]
    shaped = values[..., [ElementKind.AXIS, ElementKind.END, ElementKind.BEGIN]].sum(axis=-1) > 0.5
    values[..., _GAPS : _GAPS + 2][shaped] = values[..., _GAPS : _GAPS + 2][shaped][..., ::-1]
    return values


def _mirrored_doors(jambs: NDArray[Any]) -> NDArray[Any]:
    """Mirror jambs and keep their order: a robot before a door has its start on the same side."""
    other: NDArray[Any] = jambs[..., [2, 3, 0, 1]] * np.array((1, -1, 1, -1), jambs.dtype)
    return other


def _mirror_clause(clauses: NDArray[Any]) -> None:
    """Exchange left and right in clauses, in place."""
    turns = clauses[:, TokenVerb.TURN] > 0.5
    swapped = clauses[:, [_TURNING + 2, _TURNING + 1]]
    clauses[turns, _TURNING + 1 : _TURNING + 3] = swapped[turns]
    clauses[:, _SIDE + 1 : _SIDE + 3] = clauses[:, [_SIDE + 2, _SIDE + 1]]
