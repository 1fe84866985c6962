"""`python -m studies lines`: how well lines explain real scans, how true simulated walls are."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.table import Table

from semnav_env.world.maps import bundled_names, load_floor_plan
from semnav_scripts.progress import tracked
from studies.features.cases import Case, draw_cases
from studies.lines.line_accuracy import segmentations, wall_accuracy
from studies.lines.line_quality import (
    EXTRACTORS,
    RANDOM_STREAM,
    VERTEX_COUNTS,
    LineQuality,
    compare,
    found_logs,
    mean_quality,
    published_scans,
    published_table,
)

Means = dict[str, dict[int, LineQuality]]
Published = dict[tuple[str, str], dict[int, float]]

RANGE_SIGMAS = (0.01, 0.03)
"""Standard deviations of the simulated ranges, metres."""

MEASURES = {
    "rmse": ("rmse", "range error of the beams that meet a line, m"),
    "rmse_common": ("rmsec", "the same over the beams that meet a line of every extractor, m"),
    "rmse_charged": ("", "over all returns, half a metre for those that meet no line, m"),
    "explained": ("f", "share of the returns that meet a line"),
    "quiet": ("fnr", "share of the missing returns that meet no line"),
    "seconds": ("", "seconds a scan"),
}
"""Field of `LineQuality`: (what the published table calls it, what it is)."""


@dataclass(frozen=True)
class Arguments:
    """Measure lines on the scans of the published comparison, or walls on simulated scans.

    Attributes:
        data: folder with the CARMEN logs (aces-corrected.log.gz ...) and, if it should be shown
            beside, the published table ple_iros2018_eval_means.csv. Without it the walls that
            every segmentation finds in the bundled floor plans are held against the truth.
        poses: simulated poses in every floor plan.
        seed: of the simulated poses and noise.
        json: print JSON.
    """

    data: Path | None = None
    poses: int = 100
    seed: int = 0
    json: bool = False

    def run(self) -> int:
        """Measure, and print the means."""
        if self.data is None:
            self._simulated()
        else:
            self._published(self.data)
        return 0

    def _simulated(self) -> None:
        if self.poses < 1:
            raise ValueError(f"poses is {self.poses}; it must be at least 1")
        plans = [load_floor_plan(name) for name in bundled_names()]
        rng = np.random.default_rng(self.seed)
        drawn = (
            case
            for plan in plans
            for case in draw_cases(plan, self.poses, RANGE_SIGMAS, False, rng)
        )
        cases: list[Case] = []
        total = self.poses * len(plans)
        for case in tracked(drawn, lambda n: f"{n} of {total}", lambda: len(cases) / total):
            cases.append(case)
        rows = [
            (sigma, name, wall_accuracy(cases, sigma, settings))
            for sigma in RANGE_SIGMAS
            for name, settings in segmentations(sigma).items()
        ]
        if self.json:
            print(json.dumps([{"sigma": s, "segmentation": n} | asdict(row) for s, n, row in rows]))
            return
        table = Table(
            "sigma", "segmentation", "walls per scan", "off", "median", "90 %", "doors", "us"
        )
        for sigma, name, row in rows:
            angles = (f"{row.median:.3f}", f"{row.p90:.2f}")
            share, time = f"{100 * row.off:.1f} %", f"{row.microseconds:.0f}"
            cells = (f"{row.walls:.2f}", share, *angles, str(row.bridging), time)
            table.add_row(f"{1000 * sigma:.0f} mm", name, *cells)
        Console().print(table)

    def _published(self, folder: Path) -> None:
        logs = list(found_logs(folder))
        if not logs:
            names = ", ".join(f"{name}-corrected.log.gz" for name in RANDOM_STREAM)
            raise ValueError(f"{folder} holds none of {names}")
        scans = [scan for name, path in logs for scan in published_scans(path, RANDOM_STREAM[name])]
        done: list[list[LineQuality]] = []
        total = len(scans) * len(VERTEX_COUNTS)
        work = (compare(scan, n, EXTRACTORS) for n in VERTEX_COUNTS for scan in scans)
        for row in tracked(work, lambda n: f"{n} of {total}", lambda: len(done) / total):
            done.append(row)
        means: Means = {name: {} for name in EXTRACTORS}
        for k, n in enumerate(VERTEX_COUNTS):
            rows = done[k * len(scans) : (k + 1) * len(scans)]
            for name, column in zip(EXTRACTORS, zip(*rows, strict=True), strict=True):
                means[name][n] = mean_quality(list(column))
        table = folder / "ple_iros2018_eval_means.csv"
        published = published_table(table) if table.exists() else {}
        self._show(means, published, len(scans), [name for name, _ in logs])

    def _show(self, means: Means, published: Published, scans: int, logs: list[str]) -> None:
        if self.json:
            values = {m: {n: asdict(q) for n, q in by.items()} for m, by in means.items()}
            print(json.dumps({"scans": scans, "logs": logs, "means": values}))
            return
        console = Console()
        console.print(f"{scans} scans of {', '.join(logs)}; by number of vertices")
        for field, (metric, title) in MEASURES.items():
            table = Table("extractor", *map(str, VERTEX_COUNTS), title=title, title_justify="left")
            for name, by in means.items():
                table.add_row(name, *(f"{getattr(by[n], field):.4f}" for n in VERTEX_COUNTS))
            for (published_metric, algorithm), row in published.items():
                if published_metric == metric:
                    cells = (f"{row[n]:.4f}" for n in VERTEX_COUNTS)
                    table.add_row(f"published {algorithm}, 260 scans", *cells)
            console.print(table)
