"""Scans labelled by the place they were taken in: which of them are called a corridor."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from zipfile import BadZipFile

import numpy as np

from semnav_env.evaluation.sheets import Cell, Sheet
from semnav_env.features import ExtractorSettings, Scan, extract
from semnav_env.features.frames import FloatArray
from semnav_env.features.passage import PassageLimits, is_corridor

CLUTTER_SLICES = Path("clutter_slices") / "clutter_slices.npz"
CORRIDOR = "Corridor_main"
RANGE_MAX = 30.0
"""Of the lidar that took the scans, metres."""


@dataclass(frozen=True, eq=False)
class PlaceScans:
    """Labelled scans.

    Attributes:
        ranges: shape (n, beams), metres; NaN for no return.
        places: where each was taken, n names.
        positions: in that place, n names.
        angle_min: direction of the first beam, radians.
        angle_increment: between beams, radians.
    """

    ranges: FloatArray
    places: tuple[str, ...]
    positions: tuple[str, ...]
    angle_min: float
    angle_increment: float

    def scans(self) -> Iterator[Scan]:
        """The scans in order."""
        for ranges in self.ranges:
            yield Scan(ranges, self.angle_min, self.angle_increment, range_max=RANGE_MAX)


def read_place_scans(path: Path) -> PlaceScans:
    """The scans of an npz file with ranges, place, position, angle_min and angle_increment.

    Raises:
        ValueError: not such a file.
        OSError: it cannot be opened.
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            return PlaceScans(
                np.asarray(file["ranges"], dtype=np.float64),
                tuple(file["place"].tolist()),
                tuple(file["position"].tolist()),
                float(file["angle_min"]),
                float(file["angle_increment"]),
            )
    except (KeyError, ValueError, BadZipFile, AttributeError) as error:
        raise ValueError(
            f"{path}: not scans of places ({error}); give an npz file with ranges, place, "
            "position, angle_min and angle_increment"
        ) from None


def called_corridor(
    scans: PlaceScans, settings: ExtractorSettings, limits: PassageLimits
) -> list[bool]:
    """For each scan whether its scene shows a corridor."""
    return [is_corridor(extract(scan, settings), limits) for scan in scans.scans()]


def place_sheets(scans: PlaceScans, called: list[bool], corridor: str) -> Iterator[Sheet]:
    """How many scans of each place, and of each position in the corridor, are called one.

    Args:
        scans: the scans.
        called: for each whether it is called a corridor.
        corridor: the place that is one.

    Raises:
        ValueError: no scan was taken there.
    """
    truth = np.array([place == corridor for place in scans.places])
    if not truth.any():
        names = ", ".join(sorted(set(scans.places)))
        raise ValueError(f"no scan was taken in {corridor!r}; there are: {names}")
    given = np.array(called)
    right = int((truth & given).sum())
    precision, recall = right / max(int(given.sum()), 1), right / int(truth.sum())
    f1 = 2.0 * right / int(truth.sum() + given.sum())
    row = (corridor, len(truth), int(truth.sum()), int(given.sum()), precision, recall, f1)
    columns = ("corridor", "scans", "of it", "called one", "precision", "recall", "F1")
    yield Sheet("Corridors told from other places", columns, [row])
    yield _shares("place", np.array(scans.places), given)
    yield _shares("position in it", np.array(scans.positions)[truth], given[truth])


def _shares(what: str, names: np.ndarray, given: np.ndarray) -> Sheet:
    rows: list[tuple[Cell, ...]] = []
    for name in dict.fromkeys(names.tolist()):
        there = names == name
        rows.append((name, int(there.sum()), int(given[there].sum())))
    return Sheet(f"By {what}", (what, "scans", "called a corridor"), rows)
