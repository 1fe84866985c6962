"""The whole chain from a scan to a scene as one kernel."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.arcs import find_arcs
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.corners import find_corners
from semnav_features.kernels.corridor_probes import find_corridors
from semnav_features.kernels.doors import find_doors
from semnav_features.kernels.filters import filter_ranges
from semnav_features.kernels.full_circle import (
    close_seam,
    count_beams_per_turn,
    find_seam,
    renumber_beams,
    repeat_pieces,
    unroll,
)
from semnav_features.kernels.layout import ARCS, CORNERS, CORRIDORS, DOORS, PIECES, WALLS
from semnav_features.kernels.merging import merge_pieces
from semnav_features.kernels.robust import refit_robustly
from semnav_features.kernels.scratch import Features
from semnav_features.kernels.segmentation import group_points
from semnav_features.kernels.walls import fit_pieces, flag_pieces, select_walls


@kernel
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
        corners: dtype `CORNER`. Without room for one, neither corners nor corridors are looked for.
        corridors: dtype `CORRIDOR`.
        arcs: dtype `ARC`.
        counts: how many of each were found, shape (6,); see `layout`.
    """
    settings = record[0]
    limit = min(range_max, settings.rupture_range)
    features = Features(walls, doors, corners, corridors, arcs, counts)
    beams_per_turn = count_beams_per_turn(len(ranges), increment, settings.dropout_beams)
    if settings.veil_angle > 0.0 or settings.median_beams > 0:
        filter_ranges(ranges, increment, range_min, limit, beams_per_turn, settings, scratch)
        ranges = scratch.filtered[: len(ranges)]
    beams = beams_per_turn if beams_per_turn > 0 else len(ranges)
    sweep, rays = ranges[:beams], directions[:beams]
    groups, pieces = find_pieces(sweep, rays, increment, range_min, limit, 0, settings, scratch)
    seam, is_break = 0, True
    if beams_per_turn > 0:
        seam, is_break = find_seam(pieces, scratch)
        unroll(ranges, directions, increment, range_min, limit, beams_per_turn, seam, scratch)
        sweep, rays = (
            scratch.circle_ranges[: 2 * beams_per_turn],
            scratch.circle_directions[: 2 * beams_per_turn],
        )
        groups, pieces = find_pieces(
            sweep, rays, increment, range_min, limit, beams_per_turn, settings, scratch
        )
    if not is_break:
        close_seam(pieces, scratch)
    find_features(
        sweep,
        rays,
        increment,
        range_min,
        limit,
        beams_per_turn,
        groups,
        pieces,
        settings,
        scratch,
        features,
    )
    if beams_per_turn > 0:
        renumber_beams(walls, counts[WALLS], beams_per_turn, seam)
        renumber_beams(arcs, counts[ARCS], beams_per_turn, seam)


@kernel
def find_pieces(
    ranges: FloatArray,
    directions: FloatArray,
    increment: float,
    range_min: float,
    limit: float,
    beams_per_turn: int,
    settings: Any,
    scratch: Any,
) -> tuple[int, int]:
    """Straight pieces of the scan, or of the first `beams_per_turn` beams of an unrolled circle.

    Returns:
        How many groups of points and how many pieces were written to `scratch`.
    """
    beams = beams_per_turn if beams_per_turn > 0 else len(ranges)
    _, groups = group_points(
        ranges[:beams], directions, increment, range_min, limit, settings, scratch
    )
    pieces = fit_pieces(groups, settings, scratch)
    flag_pieces(ranges, range_min, limit, beams_per_turn, groups, pieces, scratch)
    return groups, merge_pieces(pieces, settings, scratch)


@kernel
def find_features(
    ranges: FloatArray,
    directions: FloatArray,
    increment: float,
    range_min: float,
    limit: float,
    beams_per_turn: int,
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
    if beams_per_turn > 0:
        pieces = repeat_pieces(pieces, scratch.group_first[groups], beams_per_turn, scratch)
    counts[PIECES] = pieces
    counts[DOORS] = find_doors(
        ranges,
        directions,
        increment,
        range_min,
        limit,
        beams_per_turn,
        groups,
        pieces,
        settings,
        scratch,
        features.doors,
    )
    counts[CORNERS] = counts[CORRIDORS] = 0
    if len(features.corners) == 0:
        return
    counts[CORNERS] = find_corners(
        counts[WALLS], beams_per_turn > 0, settings, scratch, features.corners
    )
    counts[CORRIDORS] = find_corridors(
        ranges,
        directions,
        increment,
        range_min,
        limit,
        counts[WALLS],
        counts[CORNERS],
        beams_per_turn > 0,
        settings,
        scratch,
        features.corners,
        features.corridors,
    )
