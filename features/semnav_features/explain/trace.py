"""The working memory of the kernels after a scan."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from semnav_features.frames import FloatArray, Point
from semnav_features.kernels.filters import filter_ranges
from semnav_features.kernels.full_circle import count_beams_per_turn
from semnav_features.kernels.layout import PIECES, WALLS
from semnav_features.kernels.scratch import Features, Scratch
from semnav_features.scan import Scan
from semnav_features.settings import ExtractorSettings


@dataclass(frozen=True, eq=False)
class Trace:
    """Inputs, working memory and results of `extract_arrays` for one scan.

    Attributes:
        ranges: metres; of a full circle unrolled, twice over.
        directions: cosine and sine of their beams.
        increment: angle between beams, radians.
        range_min: shortest valid range, metres.
        limit: returns at or beyond it do not count, metres.
        beams_per_turn: beams of a full circle, else 0.
        settings: every limit.
        scratch: with `pieces`, `joints`, `wall_piece` and so on.
        features: what was found.
    """

    ranges: FloatArray
    directions: FloatArray
    increment: float
    range_min: float
    limit: float
    beams_per_turn: int
    settings: ExtractorSettings
    scratch: Scratch
    features: Features

    @classmethod
    def of(
        cls,
        scan: Scan,
        directions: FloatArray,
        settings: ExtractorSettings,
        scratch: Scratch,
        features: Features,
    ) -> Trace:
        """The trace of a scan that was just extracted with these arrays."""
        beams, increment = len(directions), scan.angle_increment
        beams_per_turn = count_beams_per_turn(beams, increment, settings.dropout_beams)
        limit = min(scan.range_max, settings.rupture_range)
        if beams_per_turn > 0:
            ranges = scratch.circle_ranges[: 2 * beams_per_turn]
            directions = scratch.circle_directions[: 2 * beams_per_turn]
        else:
            given, record = scan.ranges[:beams].copy(), settings.as_record()[0]
            filter_ranges(given, increment, scan.range_min, limit, 0, record, scratch)
            ranges = scratch.filtered[:beams]
        found = (beams_per_turn, settings, scratch, features)
        return cls(ranges, directions, increment, scan.range_min, limit, *found)

    @cached_property
    def record(self) -> Any:
        """The settings as the kernels read them."""
        return self.settings.as_record()[0]

    @cached_property
    def pieces(self) -> np.ndarray:
        """The straight pieces in the end, dtype `PIECE`, as doors were looked for among them.

        In a full circle those of its first half come once more at the end.
        """
        return self.scratch.pieces[: self.features.counts[PIECES]]

    @cached_property
    def walls(self) -> list[Any]:
        """The pieces that are walls."""
        chosen = self.scratch.wall_piece[: self.features.counts[WALLS]]
        return [self.scratch.pieces[k] for k in chosen]


def ends(item: Any) -> tuple[Point, Point]:
    """Start and end of a piece, a door or a corridor of the kernels."""
    start = float(item["start_x"]), float(item["start_y"])
    return start, (float(item["end_x"]), float(item["end_y"]))
