"""Reasons why a straight piece is no wall."""

from __future__ import annotations

from collections.abc import Iterator

from semnav_features.elements import Rejection
from semnav_features.explain.trace import Trace, ends
from semnav_features.kernels.walls import PART_OF_ARC, TOO_FEW_BEAMS, TOO_SHORT, wall_fault


def rejected_walls(trace: Trace) -> Iterator[Rejection]:
    """Reject straight pieces that are no walls."""
    settings = trace.settings
    for piece in trace.pieces:
        if trace.beams_per_turn > 0 and trace.scratch.beams[piece["first"]] >= trace.beams_per_turn:
            return
        reasons = {
            TOO_FEW_BEAMS: f"{piece['points']} beams; wall_beams is {settings.wall_beams}",
            TOO_SHORT: f"{piece['length']:.3f} m long; wall_length is {settings.wall_length:g}",
            PART_OF_ARC: "part of an arc",
        }
        if fault := wall_fault(piece, trace.record):
            yield Rejection("wall", *ends(piece), reasons[fault])
