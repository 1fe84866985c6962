"""Working memory of the extraction kernels, allocated once per scanner."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, Protocol, cast

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
    + [(name, "f8") for name in ("start_slack", "end_slack", "confidence")]
    + [(name, "i8") for name in ("first", "last", "start_piece", "end_piece", "state")]
)
"""A possible door: its last points, unit direction and width, the scanner's `distance` from its
line, the spacing of the beams at its jambs, the slack (how far these may lie inside), the `first`
and `last` beam between them, the pieces beside them; `state` is 0 open, 1 kept, 2 suppressed."""

JAMB = np.dtype([("x", "f8"), ("y", "f8"), ("beam", "i8"), ("piece", "i8"), ("is_reveal", "i8")])
"""A possible jamb, the beam that saw it, the piece there or the next one beside it, and whether it
is the near end of a reveal, which is the jamb itself."""

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


SWEEP_CAPACITY = 2048
"""Beams for which working memory has room at least. Its shape belongs to the compiled kernels, so
all lidars of up to so many beams share theirs; twice as many are compiled anew."""


class Scratch(Protocol):
    """Working memory of the extraction of one scan; what it holds does not matter between calls.

    It is one record, which kernels hand on as one pointer. Below, n is the number of beams for
    which it has room, with `MAX_MISSING_BEAMS` more.

    Attributes:
        angle_min: direction of the first beam, radians.
        increment: angle between the beams of the scan, radians.
        range_min: shortest valid range, metres.
        limit: returns at or beyond it do not count, metres.
        beam_count: how many of `ranges` and `directions` are used.
        known_directions: how many rows of `directions` are those of the beams from `angle_min` on.
        beams_per_turn: beams of a full circle, which is looked at from its seam on; else 0.
        ranges: what features are looked for in, metres, shape (2 n,); a full circle twice over.
        directions: unit vectors of its beams, shape (2 n, 2).
        clear: ranges without mixed pixels, shape (n,).
        filtered: what the filters made of the ranges, shape (n,).
        window: ranges of one median in order, shape (9,).
        beam_xs: x of each beam's point, metres, without a return anything, shape (n + `WIDTH`,).
        beam_ys: y of each beam's point.
        xs: x of the valid points in beam order, metres, shape (2 n + `WIDTH`,): in a full circle
            those of the first half turn come once more.
        ys: y of the valid points, shape (2 n + `WIDTH`,).
        beams: their beam indices, shape (2 n + `WIDTH`,).
        joined: 1 where a beam's point is joined to that before it, shape (8 k,) with 8 k > n.
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

    angle_min: float
    increment: float
    range_min: float
    limit: float
    beam_count: int
    known_directions: int
    beams_per_turn: int
    ranges: FloatArray
    directions: FloatArray
    clear: FloatArray
    filtered: FloatArray
    window: FloatArray
    beam_xs: FloatArray
    beam_ys: FloatArray
    xs: FloatArray
    ys: FloatArray
    beams: NDArray[np.int64]
    joined: NDArray[np.uint8]
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


class Features(Protocol):
    """The arrays into which kernels write a scene, as one record, dtype `FEATURES`; see `layout`.

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


FEATURES = np.dtype(
    [
        ("walls", WALL, CAPACITY["walls"]),
        ("doors", DOOR, CAPACITY["doors"]),
        ("corners", CORNER, CAPACITY["corners"]),
        ("corridors", CORRIDOR, CAPACITY["corridors"]),
        ("arcs", ARC, CAPACITY["arcs"]),
        ("counts", "i8", COUNTS_SIZE),
    ]
)
"""Of `Features`."""


@lru_cache(maxsize=16)
def scratch_dtype(beams: int, door_candidates: int) -> np.dtype[Any]:
    """Of `Scratch` with room for that many beams and candidates; every field is aligned to 8 bytes.

    Args:
        beams: of a scan; the room is the next power of two, so that few kernels are compiled.
        door_candidates: entries of `candidates`.
    """
    n = max(SWEEP_CAPACITY, 1 << (beams - 1).bit_length()) + MAX_MISSING_BEAMS
    walls, padded = CAPACITY["walls"], 2 * n + WIDTH
    numbers, counts = (
        ("angle_min", "increment", "range_min", "limit"),
        ("beam_count", "known_directions", "beams_per_turn"),
    )
    return np.dtype(
        [(name, "f8") for name in numbers]
        + [(name, "i8") for name in counts]
        + [("ranges", "f8", 2 * n), ("directions", "f8", (2 * n, 2))]
        + [(name, "f8", n) for name in ("clear", "filtered")]
        + [("window", "f8", 2 * MAX_MEDIAN_BEAMS + 1)]
        + [(name, "f8", n + WIDTH) for name in ("beam_xs", "beam_ys")]
        + [("xs", "f8", padded), ("ys", "f8", padded), ("beams", "i8", padded)]
        + [("joined", "u1", n + 8 - n % 8), ("group_first", "i8", n + 1), ("stack", "i8", n)]
        + [("table", "f8", (n + 1, 8)), ("vertices", "i8", n + 1), ("pieces", PIECE, 2 * n)]
        + [(name, JAMB, MAX_JAMBS) for name in ("start_jambs", "end_jambs")]
        + [("candidates", CANDIDATE, door_candidates), ("evidence", EVIDENCE, door_candidates)]
        + [("scorer", "f8", default_scorer().shape)]
        + [(name, "i8", walls) for name in ("wall_piece", "near_pieces")]
        + [(name, "f8", walls + WIDTH) for name in ("middle_xs", "middle_ys", "half_lengths")]
        + [("joints", JOINT, walls), ("corner_ends", "i8", (CAPACITY["corners"], 2))]
    )


def scratch_array(beams: int, door_candidates: int = MAX_DOOR_CANDIDATES) -> np.recarray:
    """One `Scratch` in an array, shape (1,), for scans of up to that many beams.

    Its tables are not filled, which would take longer than a scan.
    """
    scratch = np.recarray(1, scratch_dtype(beams, door_candidates))
    scratch.known_directions, scratch.scorer[0] = 0, default_scorer()
    return scratch


def allocate_scratch(beams: int, door_candidates: int = MAX_DOOR_CANDIDATES) -> Scratch:
    """Working memory for scans of up to that many beams."""
    return cast(Scratch, scratch_array(beams, door_candidates)[0])


def features_of(array: np.ndarray) -> Features:
    """What stands in an array of dtype `FEATURES`, shape (1,); it is shared."""
    return cast(Features, array.view(np.recarray)[0])


def allocate_features() -> Features:
    """Empty arrays of the standard capacity."""
    return features_of(np.zeros(1, FEATURES))
