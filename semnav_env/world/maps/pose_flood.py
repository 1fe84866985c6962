"""The kernels of a flood fill over the poses of a rectangular body on a grid of solid cells."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semnav_features.kernels.compiling import kernel

TRIED, REACHED = 1, 2
"""What becomes of a pose: the body does not fit, or it can be there."""


@kernel
def flood(
    blocked: NDArray[np.bool_],
    starts: NDArray[np.int64],
    run_rows: NDArray[np.int64],
    run_firsts: NDArray[np.int64],
    run_lengths: NDArray[np.int64],
    far: int,
    row: int,
    column: int,
    heading: int,
) -> tuple[NDArray[np.bool_], NDArray[np.uint8]]:
    """The cells and the poses that the centre reaches, by a flood fill over cells and headings.

    Where nothing solid is within `far` cells, all headings are free and the cell is visited once;
    elsewhere each heading is a state of its own.

    Args:
        blocked: the solid cells.
        starts: index of the first run of each heading, as `reach` gives it.
        run_rows: rows of the runs, as `reach` gives them.
        run_firsts: first columns of the runs.
        run_lengths: lengths of the runs, cells.
        far: distance of the next solid cell beyond which every heading is free, cells.
        row: row of the start.
        column: column of the start.
        heading: index of the heading at the start, -1 for all.
    """
    rows, columns = blocked.shape
    headings = len(starts) - 1
    ahead = _free_ahead(blocked)
    wide = _wide(blocked, far)
    states = np.zeros((rows, columns, headings), dtype=np.uint8)
    reached = np.zeros((rows, columns), dtype=np.bool_)
    stack = [(row, column, k) for k in range(headings) if heading < 0 or k == heading]
    while len(stack) > 0:
        r, c, k = stack.pop()
        if states[r, c, k]:
            continue
        if wide[r, c]:
            states[r, c] = REACHED
        else:
            states[r, c, k] = TRIED
            free = r >= far and c >= far and r < rows - far and c < columns - far
            for i in range(starts[k], starts[k + 1]):
                free = free and (ahead[r + run_rows[i], c + run_firsts[i]] >= run_lengths[i])
                if not free:
                    break
            if not free:
                continue
            states[r, c, k] = REACHED
            stack.append((r, c, (k + 1) % headings))
            stack.append((r, c, (k - 1) % headings))
        reached[r, c] = True
        for dr, dc in ((0, 1), (1, 0), (0, -1), (-1, 0)):
            if not wide[r, c] or wide[r + dr, c + dc]:
                if not states[r + dr, c + dc, k]:
                    stack.append((r + dr, c + dc, k))
            else:
                for other in range(headings):
                    stack.append((r + dr, c + dc, other))
    return reached, states


@kernel
def _free_ahead(blocked: NDArray[np.bool_]) -> NDArray[np.int16]:
    """How many successive cells are free from each cell to the right, itself included."""
    rows, columns = blocked.shape
    ahead = np.zeros((rows, columns), dtype=np.int16)
    for r in range(rows):
        run = 0
        for c in range(columns - 1, -1, -1):
            run = 0 if blocked[r, c] else min(run + 1, 30_000)
            ahead[r, c] = run
    return ahead


@kernel
def _wide(blocked: NDArray[np.bool_], far: int) -> NDArray[np.bool_]:
    """Whether nothing solid is in the square of `far` cells to all sides of each cell.

    `total` is the summed-area table of the solid cells: the count in any rectangle is a sum of
    four of its entries.
    """
    rows, columns = blocked.shape
    total = np.zeros((rows + 1, columns + 1), dtype=np.int32)
    for r in range(rows):
        run = 0
        for c in range(columns):
            run += blocked[r, c]
            total[r + 1, c + 1] = total[r, c + 1] + run
    wide = np.zeros((rows, columns), dtype=np.bool_)
    for r in range(far, rows - far):
        for c in range(far, columns - far):
            a, b, left, right = r - far, r + far + 1, c - far, c + far + 1
            solid = total[b, right] - total[a, right] - total[b, left] + total[a, left]
            wide[r, c] = solid == 0
    return wide
