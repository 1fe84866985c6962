"""Writes rows of arrays number by number.

Numba compiles `array[row] = numbers` in a second and a half, for whatever shapes there may be.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from semnav_features.kernels.compiling import kernel


@kernel
def put_row(array: np.ndarray, row: int, numbers: Any) -> None:
    """Write a tuple or a row of as many numbers as the array has columns."""
    for i in range(len(numbers)):
        array[row, i] = numbers[i]
