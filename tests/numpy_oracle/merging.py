"""Joining straight pieces that are one line."""

from __future__ import annotations

import itertools
import math

import numpy as np

from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.constants import MERGE_CHI_SQUARE
from tests.numpy_oracle.walls import Piece


def merge_pieces(pieces: list[Piece], settings: ExtractorSettings) -> list[Piece]:
    """Pieces in beam order, joined until no two successive ones are one line."""
    while True:
        merged = _merged_across_spikes(_merged_neighbours(pieces, settings), settings)
        if len(merged) == len(pieces):
            return merged
        pieces = merged


def _merged_neighbours(pieces: list[Piece], settings: ExtractorSettings) -> list[Piece]:
    """Successive pieces joined where they are one line, each with the one that it fits better."""
    joined: list[Piece] = []
    for piece, following in itertools.zip_longest(pieces, pieces[1:]):
        cost = _merge_cost(joined[-1], piece, settings) if joined else math.inf
        other = _merge_cost(piece, following, settings) if following else math.inf
        if cost < math.inf and cost <= other:
            joined[-1] = _joined(joined[-1], piece)
        else:
            joined.append(piece)
    return joined


def _merged_across_spikes(pieces: list[Piece], settings: ExtractorSettings) -> list[Piece]:
    """Two pieces that are one line joined with the few noisy points between them."""
    joined, rest = pieces[:1], pieces[1:]
    while rest:
        if len(rest) > 1 and _is_spike(joined[-1], rest[0], rest[1], settings):
            joined[-1] = _joined(_joined(joined[-1], rest[0]), rest[1])
            rest = rest[2:]
        else:
            joined.append(rest[0])
            rest = rest[1:]
    return joined


def _is_spike(before: Piece, piece: Piece, after: Piece, settings: ExtractorSettings) -> bool:
    if len(piece.beams) >= settings.wall_beams or _merge_cost(before, after, settings) == math.inf:
        return False
    line = before if len(before.beams) >= len(after.beams) else after
    farthest = settings.split_distance + settings.sigma
    return all(abs(line.offset(point)) <= farthest for point in piece.points)


def _merge_cost(a: Piece, b: Piece, settings: ExtractorSettings) -> float:
    """What joining two pieces adds to the squared residuals; infinite if not one line."""
    if np.linalg.norm(b.start - a.end) > settings.merge_gap:
        return math.inf
    allowed = MERGE_CHI_SQUARE * settings.sigma**2
    allowed += min(len(a.beams), len(b.beams)) * settings.merge_offset**2
    cost = _joined(a, b).scatter - a.scatter - b.scatter
    return cost if cost <= allowed else math.inf


def _joined(a: Piece, b: Piece) -> Piece:
    return Piece(
        a.beams + b.beams,
        np.concatenate((a.points, b.points)),
        start_rupture=a.start_rupture,
        end_rupture=b.end_rupture,
        start_break=a.start_break,
        end_break=b.end_break,
    )
