"""Working memory of the extraction kernels, allocated once per scanner."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_features.door_scorer import default_scorer
from semnav_features.frames import FloatArray
from semnav_features.kernels.evidence_layout import EVIDENCE
from semnav_features.kernels.lanes import WIDTH
from semnav_features.kernels.layout import (
    ARC,
    CAPACITY,
    CORNER,
    CORRIDOR,
    COUNTS_SIZE,
    DOOR,
    WALL,
)

PIECE = np.dtype(
    [(name, "f8") for name in ("mean_x", "mean_y", "xx", "xy", "yy", "along_x", "along_y")]
    + [(name, "f8") for name in ("spread", "scatter", "start_x", "start_y", "end_x", "end_y")]
    + [("length", "f8")]
    + [
        (name, "i8")
        for name in ("points", "first", "last", "fitted_first", "fitted_last", "flags", "wall")
    ]
)
"""A straight piece of the scan: `mean` and central second-moment sums `xx`, `xy`, `yy` of its
points, unit direction `along`, sums of squares along (`spread`) and across (`scatter`) the line,
projected ends and their distance, first and last point now and at the last fit, `flags` as in
`layout`, and its wall's index or -1."""

CANDIDATE = np.dtype(
    [(name, "f8") for name in ("start_x", "start_y", "end_x", "end_y", "along_x", "along_y")]
    + [(name, "f8") for name in ("width", "distance", "start_spacing", "end_spacing")]
    + [("confidence", "f8")]
    + [(name, "i8") for name in ("first", "last", "start_piece", "end_piece", "state")]
)
"""A possible door: its last points, unit direction and width, the scanner's `distance` from its
line, the spacing of the beams at its jambs, the `first` and `last` beam between them, the pieces
beside them; `state` is 0 open, 1 kept, 2 suppressed."""

JAMB = np.dtype([("x", "f8"), ("y", "f8"), ("beam", "i8"), ("piece", "i8")])
"""A possible jamb, the beam that saw it, and the piece there or the next one beside it."""

JOINT = np.dtype(
    [("x", "f8"), ("y", "f8")] + [(name, "i8") for name in ("kind", "partner", "start_meets")]
)
"""The full corner at the end of a wall: place, kind and the wall that starts there, or -1; and
whether the wall's own start is part of one."""

MAX_JAMBS, MAX_DOOR_CANDIDATES = 1024, 128
"""Entries beyond these are left out, in beam order."""

MAX_MISSING_BEAMS = 10
"""Beams that a full circle may lack: the largest `dropout_beams`."""

MAX_MEDIAN_BEAMS = 4
"""Largest number of beams on either side in a median: fewer than a wall has."""


class Scratch(NamedTuple):
    """Working memory of the extraction; what it holds does not matter between calls.

    Below, n is the number of beams and `MAX_MISSING_BEAMS` more.

    Attributes:
        clear: ranges without mixed pixels, shape (n,).
        filtered: what the filters made of the ranges, shape (n,).
        window: ranges of one median in order, shape (9,).
        circle_ranges: a full circle unrolled twice over, shape (2 n,).
        circle_directions: unit vectors of its beams, shape (2 n, 2).
        beam_xs: x of each beam's point, metres, without a return anything, shape (n + `WIDTH`,).
        beam_ys: y of each beam's point.
        xs: x of the valid points in beam order, metres, shape (2 n + `WIDTH`,): in a full circle
            those of the first half turn come once more.
        ys: y of the valid points, shape (2 n + `WIDTH`,).
        beams: their beam indices, shape (2 n + `WIDTH`,).
        joined: whether a beam's point is joined to that before it, shape (8 k,) with 8 k > n.
        group_first: first point of each connected group, shape (n + 1,).
        stack: split points still to be visited, shape (n,).
        table: rows for one group's points, whose columns `kernels.optimal_partition` or
            `kernels.curvature` names, shape (n + 1, 8).
        vertices: the break points of one group, shape (n + 1,).
        pieces: straight pieces, dtype `PIECE`, shape (2 n,).
        start_jambs: where an opening may start, dtype `JAMB`.
        end_jambs: where an opening may end, dtype `JAMB`.
        candidates: possible doors, dtype `CANDIDATE`.
        evidence: what was measured of each candidate, dtype `EVIDENCE`.
        scorer: table that weighs the evidence, from `door_scorer.load_scorer`.
        wall_piece: the piece of each wall, shape of the wall array.
        near_pieces: the pieces of the walls near a corner, shape of the wall array.
        middle_xs: x of the middle of each wall, metres, with `WIDTH` more than the wall array.
        middle_ys: the same for y.
        half_lengths: half the length of each wall, likewise.
        joints: the corner at the end of each wall, dtype `JOINT`, shape of the wall array.
        corner_ends: the walls that end and start at each corner or -1, two columns.
    """

    clear: FloatArray
    filtered: FloatArray
    window: FloatArray
    circle_ranges: FloatArray
    circle_directions: FloatArray
    beam_xs: FloatArray
    beam_ys: FloatArray
    xs: FloatArray
    ys: FloatArray
    beams: NDArray[np.int64]
    joined: NDArray[np.bool_]
    group_first: NDArray[np.int64]
    stack: NDArray[np.int64]
    table: FloatArray
    vertices: NDArray[np.int64]
    pieces: np.ndarray
    start_jambs: np.ndarray
    end_jambs: np.ndarray
    candidates: np.ndarray
    evidence: np.ndarray
    scorer: FloatArray
    wall_piece: NDArray[np.int64]
    near_pieces: NDArray[np.int64]
    middle_xs: FloatArray
    middle_ys: FloatArray
    half_lengths: FloatArray
    joints: np.ndarray
    corner_ends: NDArray[np.int64]


class Features(NamedTuple):
    """Arrays the kernels write a scene into; see `layout`.

    Attributes:
        walls: dtype `WALL`.
        doors: dtype `DOOR`.
        corners: dtype `CORNER`.
        corridors: dtype `CORRIDOR`.
        arcs: dtype `ARC`.
        counts: how many of each are used, shape (`COUNTS_SIZE`,), int64; see `layout`.
    """

    walls: np.ndarray
    doors: np.ndarray
    corners: np.ndarray
    corridors: np.ndarray
    arcs: np.ndarray
    counts: NDArray[np.int64]


def allocate_scratch(beams: int, door_candidates: int = MAX_DOOR_CANDIDATES) -> Scratch:
    """Working memory for scans of up to that many beams; not filled, which would take longer."""
    beams += MAX_MISSING_BEAMS
    return Scratch(
        clear=np.empty(beams),
        filtered=np.empty(beams),
        window=np.empty(2 * MAX_MEDIAN_BEAMS + 1),
        circle_ranges=np.empty(2 * beams),
        circle_directions=np.empty((2 * beams, 2)),
        beam_xs=np.empty(beams + WIDTH),
        beam_ys=np.empty(beams + WIDTH),
        xs=np.empty(2 * beams + WIDTH),
        ys=np.empty(2 * beams + WIDTH),
        beams=np.empty(2 * beams + WIDTH, np.int64),
        joined=np.empty(beams + 8 - beams % 8, np.bool_),
        group_first=np.empty(beams + 1, np.int64),
        stack=np.empty(beams, np.int64),
        table=np.empty((beams + 1, 8)),
        vertices=np.empty(beams + 1, np.int64),
        pieces=np.empty(2 * beams, PIECE),
        start_jambs=np.empty(MAX_JAMBS, JAMB),
        end_jambs=np.empty(MAX_JAMBS, JAMB),
        candidates=np.empty(door_candidates, CANDIDATE),
        evidence=np.empty(door_candidates, EVIDENCE),
        scorer=default_scorer(),
        wall_piece=np.empty(CAPACITY["walls"], np.int64),
        near_pieces=np.empty(CAPACITY["walls"], np.int64),
        middle_xs=np.empty(CAPACITY["walls"] + WIDTH),
        middle_ys=np.empty(CAPACITY["walls"] + WIDTH),
        half_lengths=np.empty(CAPACITY["walls"] + WIDTH),
        joints=np.empty(CAPACITY["walls"], JOINT),
        corner_ends=np.empty((CAPACITY["corners"], 2), np.int64),
    )


def allocate_features() -> Features:
    """Empty arrays of the standard capacity."""
    return Features(
        walls=np.zeros(CAPACITY["walls"], WALL),
        doors=np.zeros(CAPACITY["doors"], DOOR),
        corners=np.zeros(CAPACITY["corners"], CORNER),
        corridors=np.zeros(CAPACITY["corridors"], CORRIDOR),
        arcs=np.zeros(CAPACITY["arcs"], ARC),
        counts=np.zeros(COUNTS_SIZE, np.int64),
    )
