"""Picks the value of a given rank, without sorting all values."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel


@kernel
def finite_values(values: FloatArray) -> FloatArray:
    """A new array of those values that are finite, in the same order."""
    found = np.empty(len(values))
    count = 0
    for value in values:
        if math.isfinite(value):
            found[count] = value
            count += 1
    return found[:count]


@kernel
def value_of_rank(values: FloatArray, rank: int) -> float:
    """The value that would stand at place `rank` if the values were sorted (Hoare's quickselect).

    Before each round the value looked for is in values[low : high + 1]. A round moves what is below
    the pivot to its front and what is above to its end, and goes on with the part that holds the
    rank.

    Args:
        values: without NaN, shape (n,); their order is changed.
        rank: from 0 to n - 1.
    """
    low, high = 0, len(values) - 1
    while low < high:
        pivot = values[(low + high) // 2]
        i, j = low, high
        while i <= j:
            while values[i] < pivot:
                i += 1
            while values[j] > pivot:
                j -= 1
            if i <= j:
                values[i], values[j] = values[j], values[i]
                i, j = i + 1, j - 1
        if rank <= j:
            high = j
        elif rank >= i:
            low = i
        else:
            break
    return float(values[rank])
