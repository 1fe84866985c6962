"""`semnav bench`: measure how fast the environment is on this machine."""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass
from typing import Any

from rich.console import Console
from rich.table import Table

from semnav_env.bench.suite import benchmark, growth
from semnav_env.features.validation import check_count
from semnav_env.maps import load_floor_plan


@dataclass(frozen=True)
class Arguments:
    """Time a step of the environment, its parts and a reset, beside a scan by brute force.

    All parts are timed in turn, several times: ratios hold although the machine's speed varies.

    Attributes:
        map: a floor plan: a name (office_cross, or office:medium:17, generated) or a path.
        robot: wheelchair or spot.
        observation: semantic, raw, truth or all.
        robots: number of robots in the vector environment.
        threads: most threads to drive them in.
        growth: time instead how a step grows with the building, the beams and the robots.
        runs: number of timings of each part, of which the median is shown.
        steps: number of calls in a timing.
        json: print as JSON.
    """

    map: str = "office_cross"
    robot: str = "wheelchair"
    observation: str = "semantic"
    robots: int = 64
    threads: int = min(2, os.cpu_count() or 1)
    growth: bool = False
    runs: int = 9
    steps: int = 2000
    json: bool = False

    def run(self) -> int:
        """Measure and print."""
        for name in ("robots", "threads", "runs", "steps"):
            check_count(name, getattr(self, name))
        plan = load_floor_plan(self.map)
        kind: dict[str, Any] = {"robot": self.robot, "observation": self.observation}
        if self.growth:
            found = growth(plan, self.threads, self.runs, self.steps, **kind)
        else:
            counts = (self.robots, self.threads, self.runs, self.steps)
            found = benchmark(*counts, floor_plan=plan, **kind)
        if self.json:
            rows = [{**asdict(timing), "per_second": timing.per_second} for timing in found]
            print(json.dumps(rows))
            return 0
        table = Table("part", "microseconds", "per second", "times as fast as brute force")
        for t in found:
            numbers = (f"{t.microseconds:.1f}", f"{t.per_second:,.0f}", f"{t.ratio:.1f}")
            table.add_row(t.name, *numbers)
        Console().print(table)
        return 0
