"""What is measured of a gap that may be a door: the inputs of the door scorer, in order.

Each is declared once, here; the record that the kernels write, the scorer's file and its training
take names and order from this declaration.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


class EvidenceField(NamedTuple):
    """One measured quantity.

    Attributes:
        name: field of the record.
        unit: "m", or "1" for a number without a unit.
        meaning: what is measured.
    """

    name: str
    unit: str
    meaning: str


EVIDENCE_FIELDS = (
    EvidenceField("missing_wall_more", "m", "length without a wall beside a jamb, the longer one"),
    EvidenceField("missing_wall_less", "m", "the shorter one"),
    EvidenceField("misfit_more", "1", "jambs off their supporting wall over what is allowed"),
    EvidenceField("misfit_less", "1", "the same for the better one of both walls"),
    EvidenceField("clear_share", "1", "share of the beams between the jambs beyond the chord"),
    EvidenceField("deep_share", "1", "share of them that get deeper than a recess"),
    EvidenceField("front_share", "1", "share of them that end in front of the chord"),
    EvidenceField("mean_depth", "m", "mean depth behind the chord, each at most MAX_DEPTH"),
    EvidenceField("log_beams", "1", "natural logarithm of the number of beams between the jambs"),
    EvidenceField("width_below", "m", "by how much the width is below the usual ones"),
    EvidenceField("width_above", "m", "by how much the width is above the usual ones"),
    EvidenceField("incidence_cosine", "1", "of the beam through the middle, 1 where it is square"),
    EvidenceField("distance", "m", "from the scanner to the middle"),
    EvidenceField("jump_less", "m", "the range beside a jamb beyond the chord, the smaller one"),
    EvidenceField("jump_more", "m", "the larger one; both are limited to MIN_JUMP and MAX_JUMP"),
    EvidenceField("beam_spacing", "m", "between neighbouring hits, the sum of both jambs"),
    EvidenceField("wall_length_more", "m", "of the longer supporting wall, at most MAX_SUPPORT"),
    EvidenceField("wall_length_less", "m", "of the shorter one"),
    EvidenceField("skew_sine", "1", "sine of twice the angle to the scan's longest wall"),
    EvidenceField("longest_wall", "m", "length of that wall, at most MAX_WALL_LENGTH"),
)
"""Every measured quantity, in the order of the scorer's inputs.

Of two sides the larger value is "more" and the smaller one "less", so that mirroring a scan changes
nothing. The limits are constants of `kernels.door_evidence`."""

EVIDENCE_NAMES = tuple(field.name for field in EVIDENCE_FIELDS)

EVIDENCE = np.dtype([(name, "f8") for name in EVIDENCE_NAMES])
"""The record of one gap; all fields are floats, so it can be read as a row of numbers."""

BIAS_ROW = len(EVIDENCE_FIELDS)
"""Row of the scorer's table with the bias of each hidden unit; before it is one row per input."""

OUTPUT_ROW = BIAS_ROW + 1
"""Row with the weight of each hidden unit in the sum."""

OFFSET_ROW = BIAS_ROW + 2
"""Row that begins with the offset of the sum; the rest of it is unused."""

SCORER_ROWS = BIAS_ROW + 3
