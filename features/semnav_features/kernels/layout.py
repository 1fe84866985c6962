"""How kernels lay out a scene: one structured array for each kind, and how many entries are used.

Kernels write into arrays that the caller allocates once, so that a scan costs no allocation.
"""

from __future__ import annotations

import numpy as np

START_RUPTURE, END_RUPTURE, START_BREAK, END_BREAK = 1, 2, 4, 8
"""Bits of a wall's `flags`."""

ROUND = 16
"""Bit of the `flags` of a straight piece that is part of an arc and so no wall."""

_ENDS = [("start_x", "f8"), ("start_y", "f8"), ("end_x", "f8"), ("end_y", "f8")]

WALL = np.dtype(
    [*_ENDS, ("residual", "f8")]
    + [(name, "i8") for name in ("first", "last", "flags", "points")]
    + [(name, "f8") for name in ("mean_x", "mean_y", "spread", "variance")]
)
"""A wall; `first` and `last` are the beam indices of its end points (inclusive), `points` how
many beams support it, `mean` their centroid, `spread` their sum of squares along the line and
`variance` that of one point across it."""

DOOR = np.dtype([*_ENDS, ("confidence", "f8"), ("leaf_angle", "f8"), ("hinge", "i8")])
"""A door; `hinge` says which jamb its leaf hangs on."""

NO_LEAF, AT_START, AT_END = range(3)
"""Values of `hinge`."""

CORNER = np.dtype([("x", "f8"), ("y", "f8"), ("kind", "i8")])
"""A corner; `kind` is the number of a `CornerKind`."""

CORRIDOR = np.dtype(_ENDS)
"""A corridor probe, from its corner to the wall that it meets."""

ARC = np.dtype(
    [("centre_x", "f8"), ("centre_y", "f8"), ("radius", "f8"), *_ENDS, ("residual", "f8")]
    + [(name, "i8") for name in ("first", "last", "convex", "points")]
)
"""An arc; `first`, `last` and `points` as of a wall, `convex` is 1 or 0."""

CAPACITY = {"walls": 256, "doors": 64, "corners": 512, "corridors": 128, "arcs": 32}
"""Entries beyond these are dropped, in beam order."""

WALLS, DOORS, CORNERS, CORRIDORS, ARCS, PIECES = range(6)
"""Entries of the `counts` array, shape (`COUNTS_SIZE`,), int64: how many of each kind were found.
The last is the number of straight pieces, with those of a full circle that are repeated."""

COUNTS_SIZE = PIECES + 1
