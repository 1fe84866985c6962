"""`semnav evaluate lines`: how well lines explain the scans of real logs."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table

from semnav_env.evaluation.line_quality import (
    EXTRACTORS,
    STREAM,
    VERTICES,
    LineQuality,
    compare,
    found_logs,
    mean_quality,
    published_scans,
    published_table,
)
from semnav_env.scripts.progress import tracked

Means = dict[str, dict[int, LineQuality]]

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
    """Extract lines from the scans of the published comparison and measure them the same way.

    Attributes:
        data: folder with the CARMEN logs (aces-corrected.log.gz ...) and, if it should be shown
            beside, the published table ple_iros2018_eval_means.csv.
        json: print the means as JSON.
    """

    data: Path
    json: bool = False

    def run(self) -> int:
        """Measure every extractor at every number of vertices, and print the means."""
        logs = list(found_logs(self.data))
        if not logs:
            names = ", ".join(f"{name}-corrected.log.gz" for name in STREAM)
            raise ValueError(f"{self.data} holds none of {names}")
        scans = [scan for name, path in logs for scan in published_scans(path, STREAM[name])]
        done: list[list[LineQuality]] = []
        total = len(scans) * len(VERTICES)
        work = (compare(scan, n, EXTRACTORS) for n in VERTICES for scan in scans)
        for row in tracked(work, lambda n: f"{n} of {total}", lambda: len(done) / total):
            done.append(row)
        means: Means = {name: {} for name in EXTRACTORS}
        for k, n in enumerate(VERTICES):
            rows = done[k * len(scans) : (k + 1) * len(scans)]
            for name, column in zip(EXTRACTORS, zip(*rows, strict=True), strict=True):
                means[name][n] = mean_quality(list(column))
        self._show(means, len(scans), [name for name, _ in logs])
        return 0

    def _show(self, means: Means, scans: int, logs: list[str]) -> None:
        if self.json:
            values = {m: {n: asdict(q) for n, q in by.items()} for m, by in means.items()}
            print(json.dumps({"scans": scans, "logs": logs, "means": values}))
            return
        console = Console()
        console.print(f"{scans} scans of {', '.join(logs)}; by number of vertices")
        table_file = self.data / "ple_iros2018_eval_means.csv"
        published = published_table(table_file) if table_file.exists() else {}
        for field, (metric, title) in MEASURES.items():
            table = Table("extractor", *map(str, VERTICES), title=title, title_justify="left")
            for name, by in means.items():
                table.add_row(name, *(f"{getattr(by[n], field):.4f}" for n in VERTICES))
            for (published_metric, algorithm), row in published.items():
                if published_metric == metric:
                    cells = (f"{row[n]:.4f}" for n in VERTICES)
                    table.add_row(f"published {algorithm}, 260 scans", *cells)
            console.print(table)
