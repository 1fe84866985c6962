"""What speaks for and against a gap being a door, in plain NumPy; see `kernels.door_evidence`."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.constants import EVIDENCE
from tests.numpy_oracle.sweep import Sweep
from tests.numpy_oracle.walls import Piece, is_wall


@dataclass(frozen=True, eq=False)
class Jamb:
    """A possible jamb, the beam that saw it, and the piece there or the next one beside it."""

    point: FloatArray
    beam: int
    piece: int
    is_reveal: bool = False


@dataclass(frozen=True, eq=False)
class Gap:
    """A possible door.

    Attributes:
        start: the jamb where it starts.
        end: where it ends.
        along: unit direction from start to end.
        width: metres.
        distance: of the scanner from the chord's line, metres.
        start_spacing: between the hits of neighbouring beams on that line, metres.
        end_spacing: the same at the end.
        slack: how far the jambs at start and end may lie inside the gap, metres.
        confidence: how likely it is a door.
    """

    start: Jamb
    end: Jamb
    along: FloatArray
    width: float
    distance: float
    start_spacing: float
    end_spacing: float
    slack: tuple[float, float]
    confidence: float = 0.0

    @property
    def beams(self) -> slice:
        """Those between the jambs."""
        return slice(self.start.beam + 1, self.end.beam)

    @property
    def middle(self) -> FloatArray:
        """Between the last points that were seen, shape (2,)."""
        return 0.5 * (self.start.point + self.end.point)

    def beyond(self, sweep: Sweep, beams: slice) -> tuple[FloatArray, FloatArray]:
        """How far beams reach past the chord's line: along the beam and across the line, metres."""
        slant = _cross(sweep.directions[beams], self.along)
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            across = sweep.ranges[beams] * slant - self.distance
            beyond = across / slant
        missing = ~sweep.returned[beams]
        far = EVIDENCE.deepest
        return np.where(missing, far, beyond), np.where(missing, far, across)


def _cross(directions: FloatArray, along: FloatArray) -> FloatArray:
    slant: FloatArray = directions[..., 0] * along[1] - directions[..., 1] * along[0]
    return slant


def is_open(gap: Gap, sweep: Sweep, settings: ExtractorSettings) -> bool:
    """Whether a gap is deep, clear and no shadow."""
    beyond, _ = gap.beyond(sweep, gap.beams)
    is_deep = bool(deep_beams(gap, sweep, settings).any())
    clear = np.count_nonzero(beyond >= settings.door_depth)
    is_clear = clear >= settings.door_clear_fraction * len(beyond)
    in_shadow = min(beyond[0], beyond[-1]) < -settings.door_shadow
    return bool(is_deep and is_clear and not in_shadow)


def deep_beams(gap: Gap, sweep: Sweep, settings: ExtractorSettings) -> NDArray[np.bool_]:
    """Which beams get deeper than a recess; if none does, which ones end at the far jamb's side."""
    _, across = gap.beyond(sweep, gap.beams)
    deep = across >= settings.door_recess
    if deep.any():
        return deep
    hits = sweep.ranges[gap.beams, None] * sweep.directions[gap.beams]
    near, far = sorted((gap.start.point, gap.end.point), key=lambda jamb: float(jamb @ jamb))
    past = (hits - far) @ (far - near) / gap.width
    at_reveal = np.abs(past) <= EVIDENCE.at_reveal
    is_filled = bool((past < -EVIDENCE.at_reveal).any())
    is_seen = np.count_nonzero(at_reveal) >= EVIDENCE.reveal_hits and not is_filled
    return at_reveal if is_seen else np.zeros_like(deep)


def evidence_of(
    gap: Gap, sweep: Sweep, pieces: list[Piece], settings: ExtractorSettings
) -> dict[str, float]:
    """Everything in the scorer's list of inputs, by name."""
    beyond, across = gap.beyond(sweep, gap.beams)
    jumps = np.clip(beyond[[0, -1]], -0.5, 1.0)
    width = gap.width - 0.5 * sum(gap.slack)
    away = float(np.linalg.norm(gap.middle))
    walls = [_best_wall(gap, step, pieces, settings) for step in (-1, 1)]
    missing = [_missing_wall(gap, step, sweep) for step in (-1, 1)]
    longest = max(pieces, key=lambda piece: piece.length, default=None)
    main = longest.along if longest is not None else np.array((1.0, 0.0))
    return {
        **_more_or_less("missing_wall", missing),
        **_more_or_less("misfit", [misfit for misfit, _ in walls]),
        "clear_share": float(np.mean(beyond >= settings.door_depth)),
        "deep_share": float(np.mean(deep_beams(gap, sweep, settings))),
        "front_share": float(np.mean(beyond < -EVIDENCE.front)),
        "mean_depth": float(np.mean(np.clip(across, 0.0, EVIDENCE.deepest))),
        "log_beams": math.log(len(beyond)),
        "width_below": max(EVIDENCE.narrow - width, 0.0),
        "width_above": max(width - EVIDENCE.wide, 0.0),
        "incidence_cosine": gap.distance / away,
        "distance": away,
        **_more_or_less("jump", jumps.tolist()),
        "beam_spacing": gap.start_spacing + gap.end_spacing,
        **_more_or_less("wall_length", [length for _, length in walls]),
        "skew_sine": 2.0 * abs(float(main @ gap.along) * float(_cross(main, gap.along))),
        "longest_wall": min(longest.length if longest is not None else 0.0, EVIDENCE.longest_wall),
    }


def _more_or_less(name: str, sides: list[float]) -> dict[str, float]:
    return {f"{name}_more": max(sides), f"{name}_less": min(sides)}


def _missing_wall(gap: Gap, step: int, sweep: Sweep) -> float:
    """Metres of the chord's line beside a jamb that beams pass, so that no wall is there."""
    jamb, spacing = (gap.start, gap.start_spacing) if step < 0 else (gap.end, gap.end_spacing)
    stride = step * max(int(EVIDENCE.finest / spacing), 1)
    beam, missing, reached = jamb.beam, 0.0, 0.0
    while 0 <= beam < len(sweep.ranges) and reached < EVIDENCE.beside:
        slant = float(_cross(sweep.directions[beam], gap.along))
        if slant <= EVIDENCE.flattest:
            break
        line = gap.distance / slant * sweep.directions[beam]
        place = step * float((line - jamb.point) @ gap.along)
        if place > reached:
            across = sweep.ranges[beam] * slant - gap.distance
            band = EVIDENCE.band + EVIDENCE.band_slope * place
            if not sweep.returned[beam] or across > band:
                missing += min(place, EVIDENCE.beside) - reached
            reached = place
        beam += stride
        beam += sweep.turn if beam < 0 else 0
    return missing


def _best_wall(
    gap: Gap, step: int, pieces: list[Piece], settings: ExtractorSettings
) -> tuple[float, float]:
    """Misfit and length of the wall that best supports a jamb; see `wall_misfit`."""
    near, far = (gap.start, gap.end) if step < 0 else (gap.end, gap.start)
    best, length = EVIDENCE.no_wall, 0.0
    for k in range(near.piece, near.piece + EVIDENCE.support_pieces * step, step):
        if not 0 <= k < len(pieces):
            break
        wall = pieces[k]
        end = wall.end if step < 0 else wall.start
        away = np.linalg.norm(end - near.point) > settings.door_wall_gap
        if away or not is_wall(wall, settings) or wall.along @ gap.along <= 0.0:
            continue
        slack = settings.door_angle_tolerance * gap.width
        misfit = max(
            _misfit(wall, far.point, slack, settings), _misfit(wall, near.point, 0.0, settings)
        )
        if misfit < best:
            best, length = misfit, min(wall.length, EVIDENCE.longest_support)
    return best, length


def _misfit(wall: Piece, point: FloatArray, slack: float, settings: ExtractorSettings) -> float:
    """Distance from a wall's line as a share of what is allowed there."""
    allowed = settings.door_point_tolerance + slack
    allowed += settings.confidence * wall.deviation(point, settings.sigma)
    return abs(wall.offset(point)) / max(allowed, 1e-9)
