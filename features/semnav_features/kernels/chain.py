"""The whole chain from a scan to a scene as one kernel."""

from __future__ import annotations

from typing import Any

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
from semnav_features.kernels.segmentation import group_points
from semnav_features.kernels.walls import fit_pieces, flag_pieces, select_walls


@kernel(shared=True)
def extract_arrays(
    ranges: FloatArray,
    directions: FloatArray,
    sensor: Any,
    settings: Any,
    scratch: Any,
    features: Any,
    all_of_them: bool,
) -> None:
    """Walls, doors, corners, corridors and arcs of one scan, written into the caller's arrays.

    Args:
        ranges: metres, shape (n,); anything outside the sensor's limits is no return.
        directions: cosine and sine of the sensor's beams, shape (n, 2), counter-clockwise; beams
            beyond a full turn are ignored.
        sensor: entry of `LidarSpec.sensor`; `rupture_range` may be shorter than its range.
        settings: entry of `ExtractorSettings.as_record()`.
        scratch: `allocate_scratch(n)` or larger.
        features: written, dtype `FEATURES`.
        all_of_them: whether corners and corridors are looked for.
    """
    beams = begin_sweep(len(ranges), sensor, settings, scratch)
    if settings.veil_angle > 0.0 or settings.median_beams > 0:
        filter_ranges(ranges, settings, scratch)
        ranges = scratch.filtered[: len(ranges)]
    copy_sweep(ranges, directions, beams, scratch)
    groups, pieces = find_pieces(0, settings, scratch)
    seam, is_break = 0, True
    if scratch.beams_per_turn > 0:
        # A wall that the first beam cuts is whole where the circle is cut at a break instead.
        seam, is_break = find_seam(pieces, scratch)
        unroll(ranges, directions, seam, scratch)
        groups, pieces = find_pieces(scratch.beams_per_turn, settings, scratch)
    if not is_break:
        close_seam(pieces, scratch)
    find_features(groups, pieces, settings, scratch, features, all_of_them)
    if scratch.beams_per_turn > 0:
        counts = features.counts
        renumber_beams(features.walls, counts[WALLS], scratch.beams_per_turn, seam)
        renumber_beams(features.arcs, counts[ARCS], scratch.beams_per_turn, seam)


@kernel
def begin_sweep(beams: int, sensor: Any, settings: Any, scratch: Any) -> int:
    """Note the limits of a scan; returns how many of its beams belong to one turn.

    Args:
        beams: of the scan.
        sensor: entry of `LidarSpec.sensor`.
        settings: of the extractor.
        scratch: written.
    """
    if scratch.angle_min != sensor.angle_min or scratch.increment != sensor.angle_increment:
        scratch.known_directions = 0
    scratch.angle_min, scratch.increment = sensor.angle_min, sensor.angle_increment
    scratch.range_min = sensor.range_min
    scratch.limit = min(sensor.range_max, settings.rupture_range)
    beams_per_turn = count_beams_per_turn(beams, sensor.angle_increment, settings.dropout_beams)
    scratch.beams_per_turn = beams_per_turn
    return beams_per_turn if beams_per_turn > 0 else beams


@kernel
def copy_sweep(ranges: FloatArray, directions: FloatArray, beams: int, scratch: Any) -> None:
    """Copy the first beams of a scan, so that all that follows works on one record.

    The directions of the last scan by the same sensor are still there.
    """
    scratch.beam_count = beams
    for i in range(beams):
        scratch.ranges[i] = ranges[i]
    for i in range(scratch.known_directions, beams):
        scratch.directions[i, 0], scratch.directions[i, 1] = directions[i, 0], directions[i, 1]
    scratch.known_directions = max(beams, scratch.known_directions)


@kernel
def find_pieces(beams_per_turn: int, settings: Any, scratch: Any) -> tuple[int, int]:
    """Straight pieces of the scan, or of the first `beams_per_turn` beams of an unrolled circle.

    Returns:
        How many groups of points and how many pieces were written to `scratch`.
    """
    beams = beams_per_turn if beams_per_turn > 0 else scratch.beam_count
    _, groups = group_points(beams, settings, scratch)
    pieces = fit_pieces(groups, settings, scratch)
    flag_pieces(groups, pieces, beams_per_turn, scratch)
    return groups, merge_pieces(pieces, settings, scratch)


@kernel
def find_features(
    groups: int, pieces: int, settings: Any, scratch: Any, features: Any, all_of_them: bool
) -> None:
    """Write what the pieces make; see `extract_arrays` and `find_pieces`."""
    counts = features.counts
    counts[ARCS] = find_arcs(groups, pieces, settings, scratch, features.arcs)
    if settings.robust_fit:
        refit_robustly(pieces, settings, scratch)
    counts[WALLS] = select_walls(pieces, settings, scratch, features.walls)
    if scratch.beams_per_turn > 0:
        pieces = repeat_pieces(pieces, scratch.group_first[groups], scratch)
    counts[PIECES] = pieces
    counts[DOORS] = find_doors(groups, pieces, settings, scratch, features.doors)
    counts[CORNERS] = counts[CORRIDORS] = 0
    if not all_of_them:
        return
    is_ring = scratch.beams_per_turn > 0
    counts[CORNERS] = find_corners(counts[WALLS], is_ring, settings, scratch, features.corners)
    counts[CORRIDORS] = find_corridors(
        counts[WALLS], counts[CORNERS], settings, scratch, features.corners, features.corridors
    )
