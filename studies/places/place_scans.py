"""Scans labelled by the place they were taken in: which of them are called a corridor."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from semnav_features import ExtractorSettings, extract
from semnav_features.readers import open_log
from studies.places.passage import PassageLimits, is_corridor
from studies.sheets import Cell, ResultSheet

CLUTTER_SLICES = Path("clutter_slices") / "clutter_slices.npz"
CORRIDOR_LABEL = "Corridor_main"
"""What the corridor is called in the labels."""


@dataclass(frozen=True)
class PlaceLabels:
    """Where the scans of a log were taken.

    Attributes:
        places: the place of each.
        positions: the position of each in its place.
    """

    places: tuple[str, ...]
    positions: tuple[str, ...]


def read_place_labels(path: Path) -> PlaceLabels:
    """The labels in an npz log of scans: its arrays place and position.

    Raises:
        ValueError: not such a file.
        OSError: it cannot be opened.
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            return PlaceLabels(tuple(file["place"].tolist()), tuple(file["position"].tolist()))
    except (KeyError, ValueError, BadZipFile, AttributeError) as error:
        raise ValueError(
            f"{path}: not scans of places ({error}); give an npz file with ranges, angle_min, "
            "angle_increment, place and position"
        ) from None


def called_corridor(
    path: Path, settings: ExtractorSettings, limits: PassageLimits | None = None
) -> list[bool]:
    """For each scan of a log whether its scene shows a corridor."""
    with open_log(path) as log:
        return [is_corridor(extract(record.scan, settings), limits) for record in log]


def place_sheets(labels: PlaceLabels, called: list[bool], corridor: str) -> Iterator[ResultSheet]:
    """How many scans of each place, and of each position in the corridor, are called one.

    Args:
        labels: of the scans.
        called: for each scan whether it is called a corridor.
        corridor: the place that is one.

    Raises:
        ValueError: no scan was taken there.
    """
    truth = np.array([place == corridor for place in labels.places])
    if not truth.any():
        names = ", ".join(sorted(set(labels.places)))
        raise ValueError(f"no scan was taken in {corridor!r}; there are: {names}")
    given = np.array(called)
    right = int((truth & given).sum())
    precision, recall = right / max(int(given.sum()), 1), right / int(truth.sum())
    f1 = 2.0 * right / int(truth.sum() + given.sum())
    row = (corridor, len(truth), int(truth.sum()), int(given.sum()), precision, recall, f1)
    columns = ("corridor", "scans", "of it", "called one", "precision", "recall", "F1")
    yield ResultSheet("Corridors told from other places", columns, [row])
    yield _shares("place", np.array(labels.places), given)
    yield _shares("position in it", np.array(labels.positions)[truth], given[truth])


def _shares(what: str, names: np.ndarray, given: np.ndarray) -> ResultSheet:
    rows: list[tuple[Cell, ...]] = []
    for name in dict.fromkeys(names.tolist()):
        there = names == name
        rows.append((name, int(there.sum()), int(given[there].sum())))
    return ResultSheet(f"By {what}", (what, "scans", "called a corridor"), rows)
