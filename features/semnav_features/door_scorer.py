"""The small scorer that tells doors from other gaps, as plain numbers in a file beside it.

One layer of hidden units j on the evidence x of `kernels.evidence_layout`:

    confidence = 1 / (1 + exp(-(c + sum_j v_j s(b_j + w_j . x)))),  s(t) = t / (1 + |t|)

It was trained on simulated scans of random offices; `python -m studies train_doors` makes the
file anew. The file is JSON, unlike those of the networks of agents, because this package needs
NumPy and Numba only; and a kernel runs the scorer, not a network in NumPy.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.evidence_layout import (
    BIAS_ROW,
    EVIDENCE_NAMES,
    OFFSET_ROW,
    OUTPUT_ROW,
    SCORER_ROWS,
)

SCORER_FILE = Path(__file__).with_name("door_scorer.json")


@cache
def default_scorer() -> FloatArray:
    """The scorer that comes with the package, as `load_scorer`; do not write."""
    return load_scorer(SCORER_FILE)


def load_scorer(path: Path) -> FloatArray:
    """The table of a scorer as the kernels take it, shape (`SCORER_ROWS`, hidden units).

    Each of the first rows holds the weights w_j of one input in every hidden unit j; `BIAS_ROW`
    holds the biases b_j, `OUTPUT_ROW` the weights v_j, and `OFFSET_ROW` begins with c.

    Raises:
        ValueError: the file was made for other evidence; names both.
    """
    data = json.loads(path.read_text(encoding="utf-8"))
    if tuple(data["inputs"]) != EVIDENCE_NAMES:
        raise ValueError(
            f"{path.name} weighs {data['inputs']}, but the evidence is {EVIDENCE_NAMES}"
        )
    table = np.zeros((SCORER_ROWS, len(data["bias"])))
    table[:BIAS_ROW] = np.array(data["weights"]).T
    table[BIAS_ROW], table[OUTPUT_ROW] = data["bias"], data["output"]
    table[OFFSET_ROW, 0] = data["offset"]
    return table
