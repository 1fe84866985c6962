"""Cuts a connected group of points into straight pieces by the strategy of the settings."""

from __future__ import annotations

from typing import Any

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.curvature import cut_where_it_turns
from semnav_features.kernels.lines import split
from semnav_features.kernels.optimal_partition import PIECE_PRICE, partition
from semnav_features.strategies import Segmentation

_DYNAMIC = int(Segmentation.DYNAMIC)
_CURVATURE = int(Segmentation.CURVATURE)


@kernel
def cut(xs: FloatArray, ys: FloatArray, first: int, last: int, settings: Any, scratch: Any) -> int:
    """Cut points first to last; returns how many cuts were written to `scratch.vertices`.

    The first and the last entry are the group's ends; a point where it is cut belongs to neither
    side yet.
    """
    if settings.segmentation == _DYNAMIC:
        return int(partition(xs, ys, first, last, settings.sigma**2, PIECE_PRICE, scratch))
    if settings.segmentation == _CURVATURE:
        return int(cut_where_it_turns(xs, ys, first, last, settings, scratch))
    return int(split(xs, ys, first, last, settings.split_distance, scratch.stack, scratch.vertices))
