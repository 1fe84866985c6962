"""The cells of a grid that something solid passes through or comes near, or that areas cover."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel


@kernel
def clear_near(
    free: NDArray[np.bool_],
    segments: FloatArray,
    west: float,
    south: float,
    spacing: float,
    reach: float,
) -> None:
    """Clear the cells whose point lies nearer than `reach` to a segment.

    Args:
        free: written, shape (rows, columns); row 0 is the southernmost.
        segments: x1, y1, x2, y2, shape (n, 4), metres.
        west: x of the points of the first column.
        south: y of the points of the first row.
        spacing: spacing of the grid, metres.
        reach: metres.
    """
    rows, columns = free.shape
    for k in range(len(segments)):
        x1, y1, x2, y2 = segments[k]
        first_row = max(0, math.floor((min(y1, y2) - reach - south) / spacing))
        last_row = min(rows - 1, math.ceil((max(y1, y2) + reach - south) / spacing))
        dx, dy = x2 - x1, y2 - y1
        squared = dx * dx + dy * dy
        for row in range(first_row, last_row + 1):
            begin, end = 0.0, 1.0  # of the share of the segment that is near this row
            if dy != 0.0:
                one = (south + spacing * row - reach - y1) / dy
                other = (south + spacing * row + reach - y1) / dy
                begin, end = max(0.0, min(one, other)), min(1.0, max(one, other))
            low, high = x1 + begin * dx, x1 + end * dx
            low, high = min(low, high) - reach - west, max(low, high) + reach - west
            first = max(0, math.floor(low / spacing) - 1)  # one more, for rounding
            last = min(columns - 1, math.ceil(high / spacing) + 1)
            for column in range(first, last + 1):
                x, y = west + spacing * column - x1, south + spacing * row - y1
                share = min(1.0, max(0.0, (x * dx + y * dy) / squared)) if squared > 0.0 else 0.0
                if math.hypot(x - share * dx, y - share * dy) < reach:
                    free[row, column] = False


@kernel
def mark_segments(
    marked: NDArray[np.bool_], segments: FloatArray, west: float, south: float, spacing: float
) -> None:
    """Mark the cells that segments pass through; they are sampled eight times a cell.

    Args:
        marked: written, shape (rows, columns); row 0 is the southernmost.
        segments: x1, y1, x2, y2, shape (n, 4), metres.
        west: x of the first column, metres.
        south: y of the first row, metres.
        spacing: spacing of the grid, metres.
    """
    rows, columns = marked.shape
    for i in range(len(segments)):
        x1, y1 = (segments[i, 0] - west) / spacing, (segments[i, 1] - south) / spacing
        x2, y2 = (segments[i, 2] - west) / spacing, (segments[i, 3] - south) / spacing
        steps = max(1, math.ceil(8.0 * math.hypot(x2 - x1, y2 - y1)))
        for k in range(steps + 1):
            row = round(y1 + (y2 - y1) * k / steps)
            column = round(x1 + (x2 - x1) * k / steps)
            if 0 <= row < rows and 0 <= column < columns:
                marked[row, column] = True


@kernel
def mark_inside(
    marked: NDArray[np.bool_],
    edges: FloatArray,
    starts: NDArray[np.int64],
    west: float,
    south: float,
    spacing: float,
) -> None:
    """Mark the cells whose point lies in an area; on its edges, rounding decides.

    A row of cells crosses the closed outlines of an area an even number of times; what lies between
    an odd crossing and the next one is inside.

    Args:
        marked: written, shape (rows, columns); row 0 is the southernmost.
        edges: of the outlines of all areas, one after the other: x1, y1, x2, y2, shape (n, 4).
        starts: index of the first edge of each area, and n.
        west: x of the first column, metres.
        south: y of the first row, metres.
        spacing: spacing of the grid, metres.
    """
    rows, columns = marked.shape
    crossings = np.empty(len(edges))
    for area in range(len(starts) - 1):
        lowest, highest = np.inf, -np.inf
        for k in range(starts[area], starts[area + 1]):
            lowest, highest = min(lowest, edges[k, 1]), max(highest, edges[k, 1])
        if lowest > highest:
            continue
        first_row = max(0, math.ceil((lowest - south) / spacing))
        last_row = min(rows - 1, math.floor((highest - south) / spacing))
        for row in range(first_row, last_row + 1):
            y, count = south + spacing * row, 0
            for k in range(starts[area], starts[area + 1]):
                x1, y1, x2, y2 = edges[k]
                if (y1 > y) != (y2 > y):
                    x, place = x1 + (x2 - x1) * (y - y1) / (y2 - y1), count
                    while place > 0 and crossings[place - 1] > x:  # those so far are in order
                        crossings[place] = crossings[place - 1]
                        place -= 1
                    crossings[place] = x
                    count += 1
            for k in range(0, count - 1, 2):
                first = max(0, math.ceil((crossings[k] - west) / spacing))
                last = min(columns - 1, math.floor((crossings[k + 1] - west) / spacing))
                for column in range(first, last + 1):
                    marked[row, column] = True
