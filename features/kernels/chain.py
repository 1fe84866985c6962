"""The whole chain from a scan to a scene as one kernel."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.arcs import find_arcs
from semnav_env.features.kernels.corners import find_corners
from semnav_env.features.kernels.corridor_probes import find_corridors
from semnav_env.features.kernels.doors import find_doors
from semnav_env.features.kernels.filters import filter_ranges
from semnav_env.features.kernels.layout import ARCS, CORNERS, CORRIDORS, DOORS, PIECES, WALLS
from semnav_env.features.kernels.merging import merge_pieces
from semnav_env.features.kernels.ring import (
    beams_of_turn,
    close_seam,
    find_seam,
    repeat_pieces,
    turn_back,
    unroll,
)
from semnav_env.features.kernels.robust import refit_robustly
from semnav_env.features.kernels.scratch import Features
from semnav_env.features.kernels.segmentation import group_points
from semnav_env.features.kernels.walls import fit_pieces, flag_pieces, select_walls


@njit(cache=True, error_model="numpy")
def extract_arrays(
    ranges: FloatArray,
    directions: FloatArray,
    increment: float,
    range_min: float,
    range_max: float,
    record: np.ndarray,
    scratch: Any,
    walls: np.ndarray,
    doors: np.ndarray,
    corners: np.ndarray,
    corridors: np.ndarray,
    arcs: np.ndarray,
    counts: NDArray[np.int64],
) -> None:
    """Walls, doors, corners, corridors and arcs of one scan, written into the caller's arrays.

    Args:
        ranges: metres, shape (n,); anything outside [range_min, range_max) is no return.
        directions: cosine and sine of every beam, shape (n, 2), counter-clockwise; beams
            beyond a full turn are ignored.
        increment: angle between beams, radians.
        range_min: shortest valid range, metres.
        range_max: longest valid range, metres; `rupture_range` may be shorter.
        record: `ExtractorSettings.as_record()`.
        scratch: `allocate_scratch(n)` or larger.
        walls: dtype `WALL`, any length, like the next four.
        doors: dtype `DOOR`.
        corners: dtype `CORNER`.
        corridors: dtype `CORRIDOR`.
        arcs: dtype `ARC`.
        counts: how many of each were found, shape (6,); see `layout`.
    """
    settings = record[0]
    limit = min(range_max, settings.rupture_range)
    features = Features(walls, doors, corners, corridors, arcs, counts)
    turn = beams_of_turn(len(ranges), increment, settings.dropout_beams)
    if settings.veil_angle > 0.0 or settings.median_beams > 0:
        ranges = filter_ranges(ranges, increment, range_min, limit, turn, settings, scratch)
    beams = turn if turn > 0 else len(ranges)
    sweep, rays = ranges[:beams], directions[:beams]
    groups, pieces = find_pieces(sweep, rays, increment, range_min, limit, 0, settings, scratch)
    seam, is_break = 0, True
    if turn > 0:
        seam, is_break = find_seam(pieces, scratch)
        unroll(ranges, directions, increment, range_min, limit, turn, seam, scratch)
        sweep, rays = scratch.ring_ranges[: 2 * turn], scratch.ring_directions[: 2 * turn]
        groups, pieces = find_pieces(
            sweep, rays, increment, range_min, limit, turn, settings, scratch
        )
    if not is_break:
        close_seam(pieces, scratch)
    find_features(
        sweep,
        rays,
        increment,
        range_min,
        limit,
        turn,
        groups,
        pieces,
        settings,
        scratch,
        features,
    )
    if turn > 0:
        turn_back(walls, counts[WALLS], turn, seam)
        turn_back(arcs, counts[ARCS], turn, seam)


@njit(cache=True, error_model="numpy")
def find_pieces(
    ranges: FloatArray,
    directions: FloatArray,
    increment: float,
    range_min: float,
    limit: float,
    turn: int,
    settings: Any,
    scratch: Any,
) -> tuple[int, int]:
    """Straight pieces of the scan, or of the first `turn` beams of an unrolled circle.

    Returns:
        How many groups of points and how many pieces were written to `scratch`.
    """
    beams = turn if turn > 0 else len(ranges)
    _, groups = group_points(
        ranges[:beams], directions, increment, range_min, limit, settings, scratch
    )
    pieces = fit_pieces(groups, settings, scratch)
    flag_pieces(ranges, range_min, limit, turn, groups, pieces, scratch)
    return groups, merge_pieces(pieces, settings, scratch)


@njit(cache=True, error_model="numpy")
def find_features(
    ranges: FloatArray,
    directions: FloatArray,
    increment: float,
    range_min: float,
    limit: float,
    turn: int,
    groups: int,
    pieces: int,
    settings: Any,
    scratch: Any,
    features: Any,
) -> None:
    """Write what the pieces make; see `extract_arrays` and `find_pieces`."""
    counts = features.counts
    counts[ARCS] = find_arcs(directions, groups, pieces, settings, scratch, features.arcs)
    if settings.robust_fit:
        refit_robustly(pieces, settings, scratch)
    counts[WALLS] = select_walls(pieces, settings, scratch, features.walls)
    if turn > 0:
        pieces = repeat_pieces(pieces, scratch.group_first[groups], turn, scratch)
    counts[PIECES] = pieces
    counts[DOORS] = find_doors(
        ranges,
        directions,
        increment,
        range_min,
        limit,
        turn,
        groups,
        pieces,
        settings,
        scratch,
        features.doors,
    )
    counts[CORNERS] = find_corners(counts[WALLS], turn > 0, settings, scratch, features.corners)
    counts[CORRIDORS] = find_corridors(
        ranges,
        directions,
        increment,
        range_min,
        limit,
        counts[WALLS],
        counts[CORNERS],
        settings,
        scratch,
        features.corners,
        features.corridors,
    )
