"""The chain from a scan to a scene, step by step."""

from __future__ import annotations

import math
from dataclasses import replace

from semnav_features.scan import Scan
from semnav_features.scene import Corner, Scene, Wall
from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.arcs import find_arcs
from tests.numpy_oracle.constants import PRIOR_POINTS
from tests.numpy_oracle.corners import find_corners
from tests.numpy_oracle.corridors import find_corridors
from tests.numpy_oracle.doors import find_doors
from tests.numpy_oracle.filters import filtered
from tests.numpy_oracle.merging import merge_pieces
from tests.numpy_oracle.ring import (
    beams_of_turn,
    close_seam,
    find_seam,
    repeat_pieces,
    unroll,
)
from tests.numpy_oracle.robust import refit_robustly
from tests.numpy_oracle.sweep import Sweep
from tests.numpy_oracle.walls import Piece, find_pieces, is_wall

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
    prior = PRIOR_POINTS * settings.sigma**2
    variance = (piece.scatter + prior) / (piece.count - 2 + PRIOR_POINTS)
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
