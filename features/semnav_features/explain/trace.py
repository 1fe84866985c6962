"""The working memory of the kernels after a scan."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from semnav_features.frames import FloatArray, Point
from semnav_features.kernels.layout import PIECES, WALLS
from semnav_features.kernels.scratch import Features, Scratch
from semnav_features.settings import ExtractorSettings


@dataclass(frozen=True, eq=False)
class Trace:
    """Inputs, working memory and results of the last `extract_arrays`.

    Attributes:
        settings: every limit.
        scratch: with the scan, `pieces`, `joints`, `wall_piece` and so on.
        features: what was found.
    """

    settings: ExtractorSettings
    scratch: Scratch
    features: Features

    @property
    def beams_per_turn(self) -> int:
        """Beams of a full circle, else 0."""
        return int(self.scratch.beams_per_turn)

    @property
    def ranges(self) -> FloatArray:
        """Metres, shape (n,); of a full circle unrolled, twice over."""
        return self.scratch.ranges[: self.scratch.beam_count]

    @property
    def directions(self) -> FloatArray:
        """Cosine and sine of their beams, shape (n, 2)."""
        return self.scratch.directions[: self.scratch.beam_count]

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
