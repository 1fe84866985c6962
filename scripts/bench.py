"""`semnav bench`: measure how fast the environment is on this machine."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass

from rich.console import Console
from rich.table import Table

from semnav_env.benchmark import benchmark


@dataclass(frozen=True)
class Arguments:
    """Time a step of the environment and its parts, on one core.

    Attributes:
        map: a floor plan: a name (office_cross, or office:medium:17, generated) or a path.
        robot: wheelchair or spot.
        observation: semantic, raw, truth or all.
        runs: number of timings of each part, of which the median is shown.
        steps: number of calls in a timing.
        json: print as JSON.
    """

    map: str = "office_cross"
    robot: str = "wheelchair"
    observation: str = "all"
    runs: int = 9
    steps: int = 2000
    json: bool = False

    def run(self) -> int:
        """Measure and print."""
        timings = benchmark(self.map, self.robot, self.observation, self.runs, self.steps)
        if self.json:
            rows = [{**asdict(timing), "per_second": timing.per_second} for timing in timings]
            print(json.dumps(rows))
            return 0
        table = Table("part", "microseconds", "share of a step", "per second")
        for t in timings:
            table.add_row(t.name, f"{t.microseconds:.1f}", f"{t.share:.2f}", f"{t.per_second:,.0f}")
        Console().print(table)
        return 0
