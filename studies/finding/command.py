"""`python -m studies finding`: ways of finding somebody in a house, compared."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from semnav_env.rescue.settings import SearchRules
from semnav_scripts.progress import tracked
from studies.finding.houses import House
from studies.finding.ways import WAYS, WayResult

FIRST_SEED = 20_000
"""Seed of the first house; nothing was tuned on houses from here on."""


@dataclass(frozen=True)
class Arguments:
    """Let a robot find two people in generated houses, in each way.

    The robot stands at places and knows its pose: nothing is driven, and times follow from lengths
    of ways and usual speeds.

    Attributes:
        houses: how many.
        picture: file for a picture of the errors and times (.png); none if not given.
        json: print the figures as JSON.
    """

    houses: int = 200
    picture: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Find, and print the figures of each way."""
        if self.houses < 1:
            raise ValueError(f"houses is {self.houses}; it must be 1 or more")
        found: dict[str, list[WayResult]] = {name: [] for name in WAYS}
        seeds = range(FIRST_SEED, FIRST_SEED + self.houses)
        tried_last = found[list(WAYS)[-1]]
        for seed in tracked(seeds, lambda n: f"{n} houses", lambda: len(tried_last) / self.houses):
            house = House.of(seed)
            for name, way in WAYS.items():
                found[name].append(way(house, np.random.default_rng(seed)))
        rows = {name: summary(each) for name, each in found.items()}
        print(json.dumps(rows) if self.json else "\n".join(_lines(rows)))
        if self.picture is not None:
            from studies.finding.picture import save_finding

            save_finding(self.picture, found)
        return 0


def summary(findings: list[WayResult]) -> dict[str, str]:
    """The figures of one way over some houses."""
    errors = np.array([error for each in findings for error in each.errors])
    known = errors[np.isfinite(errors)]
    right = np.count_nonzero(known <= SearchRules().report_distance)
    seconds = np.array([each.seconds for each in findings])
    median, most = np.percentile(known, (50, 90)) if len(known) else (np.nan, np.nan)
    return {
        "people found within 1 m": f"{right} of {len(errors)}",
        "error of the place, m: median": f"{median:.2f}",
        "90th percentile": f"{most:.2f}",
        "false reports a house": f"{np.mean([each.false_reports for each in findings]):.2f}",
        "time, s: median": f"{np.median(seconds):.0f}",
        "floor seen": f"{np.mean([each.coverage for each in findings]):.3f}",
    }


def _lines(rows: dict[str, dict[str, str]]) -> list[str]:
    """A table of Markdown with a row for each way."""
    names = list(next(iter(rows.values())))
    lines = [f"| | {' | '.join(names)} |", "|---" * (len(names) + 1) + "|"]
    return lines + [f"| {way} | {' | '.join(row.values())} |" for way, row in rows.items()]
