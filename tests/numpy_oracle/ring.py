"""A scan of a full circle: unrolled from a place where no wall is cut."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.constants import FEWEST_BEAMS
from tests.numpy_oracle.sweep import Sweep
from tests.numpy_oracle.walls import Piece


def beams_of_turn(sweep: Sweep, settings: ExtractorSettings) -> int:
    """How many beams a full turn has if the sweep covers it, else 0."""
    turn = 2.0 * math.pi / sweep.increment
    missing = turn - len(sweep.ranges)
    covered = turn >= FEWEST_BEAMS and missing <= settings.dropout_beams + 0.5
    return int(turn + 0.5) if covered else 0


def find_seam(pieces: list[Piece]) -> tuple[int, bool]:
    """The first beam of a piece, at a break if there is one, and whether there is one."""
    for piece in pieces[1:]:
        if piece.start_break or piece.start_rupture:
            return piece.beams[0], True
    return (pieces[len(pieces) // 2].beams[0], False) if len(pieces) > 1 else (0, True)


def unroll(sweep: Sweep, turn: int, seam: int) -> Sweep:
    """The circle twice over from the beam at the seam on; missing beams have no return."""
    ranges, returned = np.full(turn, np.nan), np.zeros(turn, bool)
    given = min(turn, len(sweep.ranges))
    ranges[:given], returned[:given] = sweep.ranges[:given], sweep.returned[:given]
    if len(sweep.ranges) > turn and not returned[0]:
        ranges[0], returned[0] = sweep.ranges[turn], sweep.returned[turn]
    angles = sweep.angle_min + sweep.increment * np.arange(turn)
    order = (np.arange(2 * turn) + seam) % turn
    directions = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    return replace(
        sweep,
        ranges=ranges[order],
        directions=directions[order],
        returned=returned[order],
        angle_min=sweep.angle_min + seam * sweep.increment,
        turn=turn,
    )


def close_seam(pieces: list[Piece]) -> list[Piece]:
    """Take back the flags of a break where the circle was cut at a corner."""
    if pieces:
        pieces = [replace(pieces[0], start_break=False, start_rupture=False), *pieces[1:]]
        pieces[-1] = replace(pieces[-1], end_break=False, end_rupture=False)
    return pieces


def repeat_pieces(pieces: list[Piece], turn: int) -> list[Piece]:
    """The pieces and those of the first half turn once more, a turn later."""
    half = [piece for piece in pieces if 2 * piece.beams[0] < turn]
    return [*pieces, *(replace(p, beams=[beam + turn for beam in p.beams]) for p in half)]
