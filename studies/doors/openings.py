"""Openings that were labelled by hand in the map of a real log."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

from semnav_features.scene import Door

LABELS_FOLDER = Path(__file__).with_name("labels")
"""Where the labelled openings lie."""


@dataclass(frozen=True)
class LabelledOpening:
    """A labelled opening.

    Attributes:
        door: the opening, in the frame of the log; its name is the label's.
        group: which doors it belongs with, such as "north".
        certain: False where the data cannot decide whether it is one.
        note: what was seen.
    """

    door: Door
    group: str
    certain: bool
    note: str


def read_openings(path: str | Path) -> tuple[LabelledOpening, ...]:
    """The openings of a label file; lines that begin with # say how it was made.

    Args:
        path: a CSV file with columns id, group, x1, y1, x2, y2 (metres), certain, note.

    Raises:
        ValueError: a row that is not complete; the message names it.
        OSError: the file cannot be opened.
    """
    with open(path, encoding="utf-8", newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return tuple([_opening(row) for row in rows])


def _opening(row: dict[str, str]) -> LabelledOpening:
    try:
        x1, y1, x2, y2 = (float(row[name]) for name in ("x1", "y1", "x2", "y2"))
        certain = {"yes": True, "no": False}[row["certain"]]
        return LabelledOpening(
            Door((x1, y1), (x2, y2), row["id"]), row["group"], certain, row["note"]
        )
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(f"the opening {row} lacks or misspells a field: {error}") from None
