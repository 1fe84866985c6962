"""How well lines explain a scan: the measures of Schaefer et al., and their scans of real logs.

Alexander Schaefer, Daniel Buescher, Lukas Luft, Wolfram Burgard, "A Maximum Likelihood Approach to
Extract Polylines from 2-D Laser Range Scans" (IROS 2018), section IV; the measures are as in the
evaluation that the authors published with it.
"""

from __future__ import annotations

import csv
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import islice, pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from semnav_features import polylines
from semnav_features.frames import FloatArray
from semnav_features.readers import open_log
from semnav_features.scan import Scan
from studies.lines.line_baselines import MISSED_ERROR, Lines, end_point_fit, greedy_polylines

Extractor = Callable[[Scan, int], Lines]

EXTRACTORS: Mapping[str, Extractor] = {
    "polylines": polylines,
    "polylines, missed 0.5": partial(polylines, missed=0.5),
    "points only": partial(polylines, refine=False),
    "greedy (PLE)": greedy_polylines,
    "greedy, refined (PLE+)": partial(greedy_polylines, refine=True),
    "end-point fit (IEF)": end_point_fit,
}
"""What is compared, from a scan and a number of vertices to lines."""

VERTEX_COUNTS = (10, 20, 30, 40, 50)
"""Numbers of vertices of the published comparison."""

MAX_END_ANGLE = 1e-3
"""A beam that meets no line, but passes the end of one by less than this, meets it; radians."""


def predicted_ranges(scan: Scan, lines: Lines) -> FloatArray:
    """Where every beam first meets a line: metres, infinity where it meets none."""
    angles = scan.angles
    directions = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    inside, beside = np.full((2, len(angles)), np.inf)
    for line in lines:
        for a, b in pairwise(line):
            middle = np.arctan2(*(a / np.hypot(*a) + b / np.hypot(*b))[::-1])
            half = abs(np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b)) / 2
            off = np.abs(np.remainder(angles - middle + np.pi, 2 * np.pi) - np.pi) - half
            met = np.flatnonzero(off <= MAX_END_ANGLE)
            slope = directions[met] @ (b[1] - a[1], a[0] - b[0])
            with np.errstate(divide="ignore", invalid="ignore"):
                reach = (a[0] * b[1] - a[1] * b[0]) / slope
            reach[~(reach > 0)] = np.inf
            beside[met] = np.minimum(beside[met], reach)
            inside[met] = np.minimum(inside[met], np.where(off[met] <= 1e-9, reach, np.inf))
    return np.where(np.isfinite(inside), inside, beside)


@dataclass(frozen=True)
class LineQuality:
    """How well lines explain one scan, or the mean over scans; NaN where nothing counts.

    Attributes:
        rmse: root mean square difference between measured and predicted range over the returns
            that meet a line, metres.
        rmse_common: the same over the returns that meet a line of every extractor compared.
        rmse_charged: over all returns, those that meet no line counting half a metre: the root of
            the mean of what the paper's method makes least.
        explained: share of the returns that meet a line (f).
        quiet: share of the missing returns that meet no line (fnr).
        vertices: how many there are.
        seconds: what it took.
    """

    rmse: float
    rmse_common: float
    rmse_charged: float
    explained: float
    quiet: float
    vertices: float
    seconds: float


def compare(scan: Scan, vertices: int, extractors: Mapping[str, Extractor]) -> list[LineQuality]:
    """Extract lines with every extractor and measure them, in the order of the extractors."""
    found: list[tuple[Lines, float]] = []
    for extract in extractors.values():
        start = time.perf_counter()
        lines = extract(scan, vertices)
        found.append((lines, time.perf_counter() - start))
    ranges = [predicted_ranges(scan, lines) for lines, _ in found]
    common = scan.valid & np.isfinite(ranges).all(axis=0)
    return [
        _measured(scan, there, common, sum(map(len, lines)), seconds)
        for there, (lines, seconds) in zip(ranges, found, strict=True)
    ]


def _measured(
    scan: Scan, ranges: FloatArray, common: NDArray[np.bool_], vertices: int, seconds: float
) -> LineQuality:
    valid, met = scan.valid, np.isfinite(ranges)
    error = np.full(len(ranges), MISSED_ERROR)
    error[valid & met] = scan.ranges[valid & met] - ranges[valid & met]
    return LineQuality(
        _rms(error[valid & met]),
        _rms(error[common]),
        _rms(error[valid]),
        _share(met[valid]),
        _share(~met[~valid]),
        vertices,
        seconds,
    )


def _rms(differences: FloatArray) -> float:
    return float(np.sqrt(np.mean(differences**2))) if len(differences) else float("nan")


def _share(flags: NDArray[np.bool_]) -> float:
    return float(flags.mean()) if len(flags) else float("nan")


def mean_quality(rows: list[LineQuality]) -> LineQuality:
    """The mean of every measure over the scans that have it."""
    columns = np.array([list(vars(row).values()) for row in rows]).T
    return LineQuality(
        *(float(c[~np.isnan(c)].mean()) if (~np.isnan(c)).any() else np.nan for c in columns)
    )


RANDOM_STREAM = {
    "aces": 41,
    "csail": 122,
    "fhw": 204,
    "freiburg-079": 244,
    "freiburg-101": 284,
    "intel": 404,
}
"""Position of the random numbers with which the published evaluation drew each log's scans.

It draws 20 scans from each of 13 logs with one generator, MATLAB's default. The positions were
found with the lines that are published beside it: those of nine scans in these six logs fit
exactly one scan each, and every one of them is the scan that the generator says."""


def published_scans(log: Path, stream: int, count: int = 20) -> list[Scan]:
    """The scans of a log that the published evaluation drew, in its order.

    Args:
        log: the CARMEN log.
        stream: position of the log's random numbers, as in `RANDOM_STREAM`.
        count: how many were drawn.

    Raises:
        LogError: the file is not a log that can be read.
    """
    with open_log(log) as records:
        scans = [record.scan for record in records]
    numbers = np.random.RandomState(5489).random_sample(stream + 100 * count)[stream:]
    source = iter(numbers.tolist())
    drawn: set[int] = set()
    while len(drawn) < count:
        drawn |= {int(u * len(scans)) for u in islice(source, count - len(drawn))}
    order = np.argsort(list(islice(source, count)))
    return [scans[sorted(drawn)[k]] for k in order.tolist()]


def published_table(path: Path) -> dict[tuple[str, str], dict[int, float]]:
    """Published means on real scans: by measure and algorithm, the value for every n.

    Raises:
        OSError: the file cannot be opened.
        ValueError: it is not such a table.
    """
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    try:
        return {
            (row["metric"], row["algorithm"]): {n: float(row[f"n={n}"]) for n in VERTEX_COUNTS}
            for row in rows
            if row["dataset"] == "real"
        }
    except (KeyError, TypeError, ValueError):
        raise ValueError(f"{path} is not a table of metric, dataset, algorithm, n=10 ...") from None


def found_logs(folder: Path) -> Iterator[tuple[str, Path]]:
    """The logs in a folder whose published scans are known, by name."""
    for name in RANDOM_STREAM:
        path = folder / f"{name}-corrected.log.gz"
        if path.exists():
            yield name, path
