"""The chain from a scan to a scene, step by step."""

from __future__ import annotations

import math
from dataclasses import replace

from semnav_env.features.kernels.walls import point_variance
from semnav_env.features.reference.arcs import find_arcs
from semnav_env.features.reference.corners import find_corners
from semnav_env.features.reference.corridors import find_corridors
from semnav_env.features.reference.doors import find_doors
from semnav_env.features.reference.filters import filtered
from semnav_env.features.reference.merging import merge_pieces
from semnav_env.features.reference.ring import (
    beams_of_turn,
    close_seam,
    find_seam,
    repeat_pieces,
    unroll,
)
from semnav_env.features.reference.robust import refit_robustly
from semnav_env.features.reference.sweep import Sweep
from semnav_env.features.reference.walls import Piece, find_pieces, is_wall
from semnav_env.features.scan import Scan
from semnav_env.features.scene import Corner, Scene, Wall
from semnav_env.features.settings import ExtractorSettings

_PER_BEAM = ("ranges", "directions", "returned")


def extract_reference(scan: Scan, settings: ExtractorSettings | None = None) -> Scene:
    """What `extract` gives, computed slowly and without limits on the number of features.

    Args:
        scan: one sweep of a lidar.
        settings: every limit of the chain; the defaults if None.

    Returns:
        The scene in the lidar frame.
    """
    settings = settings or ExtractorSettings()
    sweep, pieces = _unrolled(Sweep.of(scan, settings), settings)
    arcs, pieces = find_arcs(sweep, pieces, settings)
    if settings.robust_fit:
        pieces = refit_robustly(sweep, pieces, settings)
    walls = [piece for piece in pieces if is_wall(piece, settings)]
    around = repeat_pieces(pieces, sweep.turn)
    corners = find_corners(walls, sweep.is_ring, settings)
    return Scene(
        walls=tuple(_wall(piece, settings) for piece in walls),
        doors=tuple(find_doors(sweep, around, settings)),
        corners=tuple(Corner(found.point, found.kind) for found in corners),
        corridors=tuple(find_corridors(sweep, walls, corners, settings)),
        arcs=tuple(arcs),
    )


def _unrolled(sweep: Sweep, settings: ExtractorSettings) -> tuple[Sweep, list[Piece]]:
    """The sweep and its pieces; of a full circle, unrolled where no wall is cut."""
    turn = beams_of_turn(sweep, settings)
    sweep = filtered(sweep, turn, settings)
    once = replace(sweep, **{n: getattr(sweep, n)[: turn or None] for n in _PER_BEAM})
    pieces = _pieces(once, settings)
    if turn == 0:
        return sweep, pieces
    seam, is_break = find_seam(pieces)
    ring = unroll(sweep, turn, seam)
    pieces = _pieces(ring, settings)
    return ring, pieces if is_break else close_seam(pieces)


def _pieces(sweep: Sweep, settings: ExtractorSettings) -> list[Piece]:
    return merge_pieces(find_pieces(sweep, settings), settings)


def _wall(piece: Piece, settings: ExtractorSettings) -> Wall:
    variance = point_variance(piece.scatter, piece.count, settings.sigma)
    return Wall(
        start=(float(piece.start[0]), float(piece.start[1])),
        end=(float(piece.end[0]), float(piece.end[1])),
        start_rupture=piece.start_rupture,
        end_rupture=piece.end_rupture,
        start_break=piece.start_break,
        end_break=piece.end_break,
        beams=piece.count,
        residual=math.sqrt(piece.scatter / piece.count),
        angle_deviation=math.sqrt(variance / piece.spread),
        offset_deviation=math.sqrt(variance / piece.count),
        centroid=(float(piece.mean[0]), float(piece.mean[1])),
    )
