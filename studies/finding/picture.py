"""The picture of the study: how far off, and how fast."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from studies.finding.ways import WayResult


def save_finding(path: Path, found: dict[str, list[WayResult]]) -> None:
    """Draw, for each way, the share of people within a distance of their report, and the times."""
    figure = Figure(figsize=(10, 4), layout="constrained")
    shares, times = figure.subplots(1, 2, width_ratios=(3, 2))
    for name, each in found.items():
        errors = np.sort([error for one in each for error in one.errors])
        shares.step([0.0, *errors], np.arange(len(errors) + 1) / len(errors), label=name)
    shares.set(xlim=(0.01, 100), ylim=(0, 1), xscale="log", xlabel="error of the place, m")
    shares.set_ylabel("share of people")
    shares.legend(loc="lower right", fontsize="small")
    times.boxplot(
        [[one.seconds for one in each] for each in found.values()], orientation="horizontal"
    )
    times.set_yticklabels(list(found))
    times.set_xlabel("time, s")
    times.invert_yaxis()
    figure.savefig(path, dpi=100)
