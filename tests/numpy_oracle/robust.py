"""A second fit of every line that lets go of points which do not belong to it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.constants import ROBUST
from tests.numpy_oracle.sweep import Sweep
from tests.numpy_oracle.walls import Piece


def refit_robustly(sweep: Sweep, pieces: list[Piece], settings: ExtractorSettings) -> list[Piece]:
    """The pieces that could be walls with Tukey's biweight for their points."""
    return [
        _refitted(sweep, piece, settings)
        if len(piece.beams) >= settings.wall_beams and not piece.is_round
        else piece
        for piece in pieces
    ]


def _refitted(sweep: Sweep, piece: Piece, settings: ExtractorSettings) -> Piece:
    between = np.arange(piece.beams[0], piece.beams[-1] + 1)
    beams = between[sweep.returned[between]].tolist()
    points = sweep.points(beams)
    for _ in range(ROBUST.steps):
        deviation = min(settings.sigma, math.sqrt(piece.scatter / piece.count))
        farthest = ROBUST.biweight * max(deviation, 1e-3 * settings.split_distance)
        offsets = np.array([piece.offset(point) for point in points])
        weights = np.maximum(1.0 - (offsets / farthest) ** 2, 0.0) ** 2
        if np.count_nonzero(weights) < settings.wall_beams:
            break
        piece = replace(piece, beams=beams, points=points, weights=weights)
    return piece
