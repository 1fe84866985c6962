"""The small scorer that tells doors from other gaps, as plain numbers in a file beside it.

One layer of hidden units on the evidence x of `kernels.door_evidence`:

    confidence = 1 / (1 + exp(-(c + sum_j v_j s(b_j + w_j . x)))),  s(t) = t / (1 + |t|)

It was trained on simulated scans of random offices; `python -m studies train_doors` makes the
file anew.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.door_evidence import EVIDENCE

SCORER_FILE = Path(__file__).with_name("door_scorer.json")


@cache
def default_scorer() -> FloatArray:
    """The scorer that comes with the package, as `load_scorer`; do not write."""
    return load_scorer(SCORER_FILE)


def load_scorer(path: Path) -> FloatArray:
    """A scorer as the kernels take it, shape (inputs + 3, hidden units).

    A row for every input holds its weight in each unit; then come the rows of the biases b_j, of
    the weights v_j in the sum, and one that begins with c.

    Raises:
        ValueError: the file was made for other evidence; says which.
    """
    data = json.loads(path.read_text(encoding="utf-8"))
    if tuple(data["inputs"]) != EVIDENCE:
        raise ValueError(f"{path.name} weighs {data['inputs']}, but the evidence is {EVIDENCE}")
    rest = np.zeros((3, len(data["bias"])))
    rest[0], rest[1], rest[2, 0] = data["bias"], data["output"], data["offset"]
    return np.concatenate((np.array(data["weights"]).T, rest))
