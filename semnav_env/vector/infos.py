"""Infos of many robots, as Gymnasium's vector environments give them.

Beside the array NAME stands the mask `_NAME`: which robots have that entry. A dictionary in an info
becomes a dictionary of arrays.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Infos = dict[str, Any]


def step_infos(known: Infos, terms: dict[str, Any], driven: NDArray[np.bool_]) -> Infos:
    """The infos of the driven robots after a control period.

    Args:
        known: values of all robots, see `control_period.info_of`.
        terms: of the rewards.
        driven: which robots were driven.
    """
    all_driven = np.count_nonzero(driven) == len(driven)
    entries = {
        name: values.copy() if all_driven else _where(driven, values)
        for name, values in known.items()
    }
    return masked(entries | {"reward_terms": masked(terms, driven)}, driven)


def masked(entries: Infos, mask: NDArray[np.bool_]) -> Infos:
    """Entries with the same mask beside each of them."""
    found: Infos = {}
    for name, value in entries.items():
        found[name], found[f"_{name}"] = value, mask.copy()
        if isinstance(value, np.ma.MaskedArray):
            found[name] = value.filled(0.0)
            found[f"_{name}"] &= ~np.ma.getmaskarray(value)
    return found


def plain_info(infos: Infos, index: int) -> Infos:
    """The info of one robot, in plain values."""
    return {
        name: _plain(value, index)
        for name, value in infos.items()
        if f"_{name}" in infos and infos[f"_{name}"][index]
    }


def without(infos: Infos, mask: NDArray[np.bool_]) -> Infos:
    """Infos in which some robots have no entries."""
    left: Infos = {}
    for name, value in infos.items():
        kept = infos[f"_{name}"] & ~mask if f"_{name}" in infos else mask & ~mask
        if kept.any():
            left[name] = without(value, mask) if isinstance(value, dict) else _where(kept, value)
            left[f"_{name}"] = kept
    return left


def _where(mask: NDArray[np.bool_], values: NDArray[Any]) -> NDArray[Any]:
    """The values where the mask holds; zeros, or None, elsewhere."""
    kept: NDArray[Any] = np.full(values.shape, None if values.dtype == object else 0, values.dtype)
    kept[mask] = values[mask]
    return kept


def _plain(value: Any, index: int) -> Any:
    if isinstance(value, dict):
        return plain_info(value, index)
    item = value[index]
    if isinstance(item, np.ndarray):
        return tuple(item.tolist())
    return item.item() if isinstance(item, np.generic) else item
