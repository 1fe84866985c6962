"""The cells of a grid that the rays of a sensor pass through: what is in view."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel

Cells = NDArray[np.uint8]
"""A grid of flags, shape (rows, columns): row by y, column by x."""


@kernel
def mark_in_view(
    cells: Cells,
    west: float,
    south: float,
    spacing: float,
    eye: Pose,
    directions: FloatArray,
    ranges: FloatArray,
    range_max: float,
) -> None:
    """Set the cells that rays pass through, up to where each of them ends.

    Rays are sampled every half cell, so no cell between the eye and the end is stepped over.

    Args:
        cells: written; 1 for a cell in view.
        west: x of the middle of the first column, metres.
        south: y of the middle of the first row, metres.
        spacing: between neighbouring cells, metres.
        eye: pose of the sensor in the frame of the grid.
        directions: unit vectors of the rays in the sensor frame, shape (n, 2).
        ranges: where the rays end, metres, shape (n,); inf for no end.
        range_max: farther cells are not seen, metres.
    """
    rows, columns = cells.shape
    c, s = np.cos(eye[2]), np.sin(eye[2])
    step = 0.5 * spacing
    for k in range(len(ranges)):
        limit = range_max if ranges[k] == np.inf else min(ranges[k], range_max)
        dx = c * directions[k, 0] - s * directions[k, 1]
        dy = s * directions[k, 0] + c * directions[k, 1]
        for i in range(int(limit / step) if limit > 0.0 else 0):
            column = round((eye[0] + i * step * dx - west) / spacing)
            row = round((eye[1] + i * step * dy - south) / spacing)
            if 0 <= row < rows and 0 <= column < columns:
                cells[row, column] = 1
