"""`python -m studies landmarks`: fused corners and columns, and what they add to pose estimates."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from semnav_env.world.maps import load_floor_plan
from semnav_features.frames import FloatArray
from semnav_features.mapping import KeyframeRule
from semnav_features.readers import open_log
from semnav_scripts.progress import tracked
from studies.figures.mapping import drive
from studies.landmarks import weerakoon
from studies.landmarks.columns import ColumnErrors, column_errors
from studies.landmarks.drift import (
    CORRECTIONS,
    ScannedDrive,
    drift_row,
    drive_in_plan,
    drive_of_log,
    followed,
    matched_motions,
    motions,
)
from studies.landmarks.far_pairs import far_shares
from studies.landmarks.room import LANDMARKS, SPREAD, fused, segments, views
from studies.matching.drift import drift_of
from studies.sheets import Cell, ResultSheet

FOUND = 0.1
"""A landmark is found within this distance, metres."""

CHI_SQUARE_95 = {2: 5.991, 3: 7.815}
"""95 % of a chi-square with so many degrees of freedom lies below this."""

FAR = ((0.1, 5.0), (0.5, 15.0), (1.0, 30.0), (1.5, 45.0))
"""Errors of first guesses, metres and degrees."""

_DRIFT = (
    *("drive", "odometry", "corrected by", "drift per 10 m, m", "p90", "degrees", "p90 "),
    *("place, m: mean", "largest"),
)


TableName = Literal["corners", "columns", "far", "drift", "matched", "lost"]


@dataclass(frozen=True)
class Arguments:
    """Fuse the landmarks of table II of Weerakoon et al., and columns; correct drift by them.

    Attributes:
        tables: which are made: the ten corners, columns, matches from far guesses, drift of
            simulated odometry, and of logs drift of matched scans, and scans without a match.
        trials: of the corridor and of each column.
        sigma: standard deviations of the ranges, metres.
        pairs: of each plan and error of the first guess.
        seeds: drives with simulated odometry, of the log and of the plan.
        data: folder with CARMEN logs; none are read if not given.
        json: print as JSON.
    """

    tables: tuple[TableName, ...] = ("corners", "columns", "far", "drift")
    trials: int = 100
    sigma: tuple[float, ...] = (0.01, 0.02)
    pairs: int = 100
    seeds: int = 3
    data: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Measure and print."""
        if min(self.trials, self.pairs, self.seeds) < 1:
            raise ValueError("--trials, --pairs and --seeds must be at least 1")
        sheets = list(tracked(self._sheets(), lambda n: f"{n} tables", lambda: None))
        if self.json:
            print(json.dumps({sheet.title: sheet.records() for sheet in sheets}))
        else:
            print("\n\n".join(sheet.markdown() for sheet in sheets))
        return 0

    def _sheets(self) -> Iterator[ResultSheet]:
        """The tables that are asked for."""
        for name in self.tables:
            yield from getattr(self, f"_{name}")()

    def _corners(self) -> Iterator[ResultSheet]:
        columns = ("landmark", "paper: two scans apart, mm", *_of_each(self.sigma))
        rows = [(name, 1e3 * SPREAD.get(name, math.nan)) for name in (*LANDMARKS, "all")]
        parts = [_table_two(sigma, self.trials) for sigma in self.sigma]
        joined: list[tuple[Cell, ...]] = [
            (name, apart, *[cell for part in parts for cell in part[name]]) for name, apart in rows
        ]
        yield ResultSheet("Ten landmarks", columns, joined)
        yield ResultSheet("Segments of three scans", _SEGMENTS, list(map(self._merged, self.sigma)))

    def _merged(self, sigma: float) -> tuple[Cell, ...]:
        counts = [segments(views(sigma, trial)) for trial in range(self.trials)]
        return 1e3 * sigma, *np.mean(counts, axis=0).tolist()

    def _columns(self) -> Iterator[ResultSheet]:
        yield ResultSheet("Columns", _COLUMNS, list(_columns(self.sigma, self.trials)))

    def _far(self) -> Iterator[ResultSheet]:
        yield ResultSheet("Far guesses", _FAR, list(_far(self.pairs)))

    def _drift(self) -> Iterator[ResultSheet]:
        plan = load_floor_plan("office_cross")
        drives = [drive_in_plan(plan, drive())]
        if self.data is not None:
            drives.append(drive_of_log(self.data / "freiburg-079-corrected.log.gz"))
        found = [row for each in drives for row in _simulated(each, self.seeds)]
        yield ResultSheet("Simulated odometry", _DRIFT, found)

    def _matched(self) -> Iterator[ResultSheet]:
        rows = [row for path in self._logs() for row in _matched(path)]
        yield ResultSheet("Matched scans", _DRIFT, rows)

    def _lost(self) -> Iterator[ResultSheet]:
        cases = [(path, wheels) for wheels in (False, True) for path in self._logs()]
        yield ResultSheet("Scans without a match", _LOST, [_lost(*case) for case in cases])

    def _logs(self) -> list[Path]:
        if self.data is None:
            raise ValueError("the tables matched and lost need --data, a folder with CARMEN logs")
        return sorted(self.data.glob("*-corrected.log.gz"))


_COLUMNS = (
    *("diameter, m", "sigma, mm", "scans", "columns in the map"),
    *("one arc: centre, mm", "radius", "refitted: centre", "radius "),
    *("fused: centre", "radius  ", "mean NEES of 3", "within 95 %"),
)
_SEGMENTS = ("sigma, mm", "before merging, mean", "after")
_FAR = ("plan", "guess off by, m", "degrees", "matched from the guess", "with corners")
_LOST = (
    *("log", "guess from", "scans", "not matched", "with corners"),
    *("drift per 10 m, m", "with corners ", "p90", "with corners  "),
)


def _of_each(sigmas: tuple[float, ...]) -> Iterator[str]:
    for sigma in sigmas:
        yield from (
            f"{1e3 * sigma:.0f} mm: {name}"
            for name in (
                *("found", "error, mm", "claimed, mm", "NEES of 2", "within 95 %"),
                "the paper's way: error, mm",
            )
        )


def _table_two(sigma: float, trials: int) -> dict[str, tuple[float, ...]]:
    """Cells of each landmark and of all: found, RMS error, claimed, NEES, and the baseline."""
    ours: dict[str, list[tuple[float, float, float]]] = {name: [] for name in LANDMARKS}
    theirs: dict[str, list[float]] = {name: [] for name in LANDMARKS}
    for trial in range(trials):
        seen = views(sigma, trial)
        estimates = fused(seen)
        plain = weerakoon.landmarks([(scene, pose) for scene, _, pose in seen])
        for name, true in LANDMARKS.items():
            place, covariance = min(estimates, key=lambda e: float(np.hypot(*(e[0] - true))))
            off = place - true
            if np.hypot(*off) < FOUND:
                nees = float(off @ np.linalg.solve(covariance, off))
                ours[name].append((float(off @ off), float(np.trace(covariance)), nees))
            nearest = min(float(np.hypot(*(place - true))) for place in plain)
            theirs[name] += [nearest**2] if nearest < FOUND else []
    rows = {name: _landmark_row(ours[name], theirs[name], trials) for name in LANDMARKS}
    every = [each for found in ours.values() for each in found]
    all_theirs = [each for found in theirs.values() for each in found]
    return rows | {"all": _landmark_row(every, all_theirs, trials * len(LANDMARKS))}


def _landmark_row(
    ours: list[tuple[float, float, float]], theirs: list[float], trials: int
) -> tuple[float, ...]:
    table: FloatArray = np.array(ours).reshape(-1, 3)
    error, claimed = 1e3 * np.sqrt(table[:, :2].mean(axis=0))
    inside = float(np.mean(table[:, 2] < CHI_SQUARE_95[2]))
    baseline = 1e3 * float(np.sqrt(np.mean(theirs)))
    nees = float(table[:, 2].mean())
    return len(ours) / trials, float(error), float(claimed), nees, inside, baseline


def _columns(sigmas: tuple[float, ...], trials: int) -> Iterator[tuple[Cell, ...]]:
    for radius in (0.15, 0.3, 0.5):
        for sigma in sigmas:
            for scans in (3, 6):
                tried = (column_errors(radius, scans, sigma, trial) for trial in range(trials))
                errors = [each for each in tried if each is not None]
                yield 2.0 * radius, 1e3 * sigma, scans, *_column_cells(errors)


def _column_cells(errors: list[ColumnErrors]) -> tuple[float, ...]:
    pairs = np.array([(*e.first, *e.refitted, *e.fused) for e in errors])
    nees = np.array([e.nees for e in errors])
    return (
        float(np.mean([e.columns for e in errors])),
        *(1e3 * np.median(pairs, axis=0)).tolist(),
        float(nees.mean()),
        float(np.mean(nees < CHI_SQUARE_95[3])),
    )


def _far(pairs: int) -> Iterator[tuple[Cell, ...]]:
    for name in ("office_cross", "villa_hall"):
        plan = load_floor_plan(name)
        for off, degrees in FAR:
            shares = far_shares(plan, off, math.radians(degrees), pairs, 0.01)
            yield name, off, degrees, shares.plain, shares.corners


def _simulated(drive: ScannedDrive, seeds: int) -> Iterator[tuple[Cell, ...]]:
    for name, landmarks in CORRECTIONS.items():
        rows = [
            drift_row(drive, followed(drive, motions(drive, seed), landmarks))
            for seed in range(seeds)
        ]
        yield drive.name, "simulated", name, *np.mean(rows, axis=0).tolist()


def _matched(path: Path) -> Iterator[tuple[Cell, ...]]:
    log, moved = matched_motions(path, wheels=True)
    for name, landmarks in CORRECTIONS.items():
        row = drift_row(log, followed(log, moved, landmarks)).tolist()
        yield log.name, "scans and wheels", name, *row


def _lost(path: Path, wheels: bool) -> tuple[Cell, ...]:
    found = []
    for corners in (False, True):
        with open_log(path) as log:
            found.append(drift_of(log, wheels, rule=KeyframeRule(corners=corners)))
    plain, guided = found
    drifts = np.array([np.percentile(each.position, (50, 90)) for each in found]).T
    name, guess = path.name.split("-corrected")[0], "wheels" if wheels else "the motion before"
    return name, guess, plain.scans, plain.lost, guided.lost, *drifts.ravel().tolist()
