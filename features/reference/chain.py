"""The chain from a scan to a scene, step by step."""

from __future__ import annotations

import math

from semnav_env.features.kernels.walls import point_variance
from semnav_env.features.reference.corners import find_corners
from semnav_env.features.reference.corridors import find_corridors
from semnav_env.features.reference.doors import find_doors
from semnav_env.features.reference.merging import merge_pieces
from semnav_env.features.reference.sweep import Sweep
from semnav_env.features.reference.walls import Piece, find_pieces, is_wall
from semnav_env.features.scan import Scan
from semnav_env.features.scene import Corner, Scene, Wall
from semnav_env.features.settings import ExtractorSettings


def extract_reference(scan: Scan, settings: ExtractorSettings | None = None) -> Scene:
    """What `extract` gives, computed slowly and without limits on the number of features.

    Args:
        scan: one sweep of a lidar.
        settings: every limit of the chain; the defaults if None.

    Returns:
        The scene in the lidar frame.
    """
    settings = settings or ExtractorSettings()
    sweep = Sweep.of(scan, settings)
    pieces = merge_pieces(find_pieces(sweep, settings), settings)
    walls = [piece for piece in pieces if is_wall(piece, settings)]
    corners = find_corners(walls, settings)
    return Scene(
        walls=tuple(_wall(piece, settings) for piece in walls),
        doors=tuple(find_doors(sweep, pieces, settings)),
        corners=tuple(Corner(found.point, found.kind) for found in corners),
        corridors=tuple(find_corridors(sweep, walls, corners, settings)),
    )


def _wall(piece: Piece, settings: ExtractorSettings) -> Wall:
    variance = point_variance(piece.scatter, len(piece.beams), settings.sigma)
    return Wall(
        start=(float(piece.start[0]), float(piece.start[1])),
        end=(float(piece.end[0]), float(piece.end[1])),
        start_rupture=piece.start_rupture,
        end_rupture=piece.end_rupture,
        start_break=piece.start_break,
        end_break=piece.end_break,
        beams=len(piece.beams),
        residual=math.sqrt(piece.scatter / len(piece.beams)),
        angle_deviation=math.sqrt(variance / piece.spread),
        offset_deviation=math.sqrt(variance / len(piece.beams)),
        centroid=(float(piece.mean[0]), float(piece.mean[1])),
    )
