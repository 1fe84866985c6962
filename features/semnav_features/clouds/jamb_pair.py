"""The two edges of a wall that are the jambs of a door."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, NamedTuple

import numpy as np

from semnav_features.checked_fields import Bounds, Count, Length, check_fields
from semnav_features.clouds.evidence import Strips
from semnav_features.frames import FloatArray
from semnav_features.rules import DoorRules


@dataclass(frozen=True)
class JambRules:
    """Rules for a pair of edges that counts as a door, and for an edge that counts as a jamb.

    Attributes:
        wall: length of the wall outside an edge that is evaluated, metres.
        gap: length of the opening inside an edge that is evaluated, metres: more than a reveal
            hides.
        solid: least balance of the wall outside a jamb.
        open: largest balance of the opening inside a jamb.
        levels: fewest cells of a jamb, one above the other.
        width_sigma: standard deviation of a door's width about the expected one, metres.
        width_tolerance: largest difference of a width from the expected one, metres: beyond it the
            jamb that shows less does not count as seen.
        prior: weight of the expected door relative to the evidence.
    """

    wall: Length = 0.10
    gap: Length = 0.20
    solid: float = 0.2
    open: float = -0.2
    levels: Count = 5
    width_sigma: Annotated[float, Bounds(0.001, 100.0, "m")] = 0.08
    width_tolerance: Length = 0.08
    prior: float = 0.15

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class Jamb:
    """An edge of a wall that may be a jamb.

    Attributes:
        place: metres along the wall's line.
        seen: whether there is evidence for the jamb; if not, it is placed by the width of the door.
        step: difference of the balance outside and inside, at most 2.
    """

    place: float
    seen: bool
    step: float = 0.0


@dataclass(frozen=True)
class JambPair:
    """Two edges of a wall.

    Attributes:
        start: the one with the smaller place.
        end: the other one.
        confidence: 0 to 1.
        score: agreement with the jambs of a door, at most 6.
    """

    start: Jamb
    end: Jamb
    confidence: float
    score: float


class Sides(NamedTuple):
    """Balance of the wall outside an edge, and of the opening inside it; of one edge or many."""

    wall: FloatArray
    gap: FloatArray

    @property
    def step(self) -> FloatArray:
        """Difference of the balance outside and inside."""
        return self.wall - self.gap


def best_pair(
    strips: Strips, width: float, sigma: float, widths: DoorRules, rules: JambRules
) -> JambPair | None:
    """The pair of edges that agrees best with the jambs of a door.

    A pair is the better the more solid the wall beside both edges is, the more open the strips
    between them are, and the less its width and its middle differ from what is expected.

    Args:
        strips: evidence along the line; the door is expected in the middle.
        width: expected, metres.
        sigma: standard deviation of the expected place, metres.
        widths: of doors.
        rules: what counts.

    Returns:
        None where no pair has such a width.
    """
    wall, gap = round(rules.wall / strips.size), round(rules.gap / strips.size)
    edges = np.arange(gap, len(strips.solid) - gap + 1)
    starts = Sides(strips.balance(edges - wall, edges), strips.balance(edges, edges + gap))
    ends = Sides(strips.balance(edges, edges + wall), strips.balance(edges - gap, edges))
    i, j = np.triu_indices(len(edges), 1)
    found = strips.size * (j - i)
    fits = (found >= widths.narrowest) & (found <= widths.widest)
    i, j, found = i[fits], j[fits], found[fits]
    if len(i) == 0:
        return None
    middle = strips.left + 0.5 * strips.size * (edges[i] + edges[j])
    place = middle**2 / (sigma**2 + rules.width_sigma**2)
    surprise = (found - width) ** 2 / rules.width_sigma**2 + place
    opening = strips.mean_balance(edges[i], edges[j])
    scores = starts.step[i] + ends.step[j] - 2.0 * opening - rules.prior * surprise
    k = int(scores.argmax())
    start = _jamb(strips, int(edges[i[k]]), -1, Sides(*(each[i[k]] for each in starts)), rules)
    end = _jamb(strips, int(edges[j[k]]), 1, Sides(*(each[j[k]] for each in ends)), rules)
    confidence = 0.25 * min(start.step, end.step) - 0.5 * float(opening[k])
    return JambPair(start, end, min(max(confidence, 0.0), 1.0), float(scores[k]))


def _jamb(strips: Strips, edge: int, outward: int, sides: Sides, rules: JambRules) -> Jamb:
    """The jamb at an edge.

    It is the outer side of the first strip, from inside the opening outward, that is part of it:
    errors of depth widen a jamb by about a strip.
    """
    wall = round(rules.wall / strips.size)
    inner = edge + wall - 1 if outward < 0 else edge - wall
    looked_at = inner + outward * np.arange(2 * wall)
    cells = strips.solid[looked_at]
    first = int(looked_at[(cells >= max(2.0, 0.3 * cells.max())).argmax()])
    place = strips.left + strips.size * (first + (outward > 0))
    shows = sides.wall >= rules.solid and sides.gap <= rules.open and cells.max() >= rules.levels
    return Jamb(place, bool(shows), float(sides.step))


def settled(pair: JambPair, width: float, rules: JambRules) -> JambPair | None:
    """The pair, in which an edge without evidence is placed by the width of the door.

    Args:
        pair: edges.
        width: expected, metres.
        rules: what counts.

    Returns:
        None where neither edge is a jamb.
    """
    start, end = pair.start, pair.end
    fits = abs(end.place - start.place - width) <= rules.width_tolerance
    stronger = start.step >= end.step
    start_seen = start.seen and (fits or stronger or not end.seen)
    end_seen = end.seen and (fits or not stronger or not start.seen)
    if start_seen and end_seen:
        return pair
    if start_seen:
        return replace(pair, end=Jamb(start.place + width, False))
    return replace(pair, start=Jamb(end.place - width, False)) if end_seen else None
