"""`semnav bench`: measure how fast the environment is on this machine."""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass
from typing import Any

from rich.console import Console
from rich.table import Table

from semnav_env.bench.suite import (
    growth_parts,
    start_up_parts,
    training_parts,
    usual_parts,
    with_compilation,
)
from semnav_env.bench.timing import Part, Timing, timings
from semnav_env.world.maps import load_floor_plan
from semnav_features.validation import check_count
from semnav_scripts.progress import work_bar


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
        episodes: time instead steps on the episodes of this split, such as train, resets included,
            beside the plain step.
        agents: time instead decisions of the scripted agent, processor time, on episodes of
            val_unseen or of --episodes.
        growth: time instead how a step grows with the building, the beams and the robots.
        start: measure instead the processor time of processes that import, ground, or make an
            environment.
        cold: with --start, also compile all kernels into an empty folder: about a minute on an
            idle machine, several on a busy one.
        runs: number of timings of each part, of which the median is shown.
        steps: number of calls in a timing.
        json: print as JSON.
    """

    map: str = "office_cross"
    robot: str = "wheelchair"
    observation: str = "semantic"
    robots: int = 64
    threads: int = min(2, os.cpu_count() or 1)
    episodes: str | None = None
    agents: bool = False
    growth: bool = False
    start: bool = False
    cold: bool = False
    runs: int = 9
    steps: int = 2000
    json: bool = False

    def run(self) -> int:
        """Measure and print."""
        for name in ("robots", "threads", "runs", "steps"):
            check_count(name, getattr(self, name))
        if self.cold and not self.start:
            raise ValueError("--cold is for --start; give both")
        found = self._measured()
        if self.json:
            rows = [{**asdict(timing), "per_second": timing.per_second} for timing in found]
            print(json.dumps(rows))
            return 0
        table = Table("part", "microseconds", "per second", "takes, in brute-force scans")
        for t in found:
            numbers = (f"{t.microseconds:,.1f}", _rate(t.per_second), _in_scans(t.ratio))
            table.add_row(t.name, *numbers)
        Console().print(table)
        return 0

    def _measured(self) -> list[Timing]:
        parts = self._parts()
        with work_bar("timing") as bar:
            found = timings(parts, self.runs, bar.show)
            if self.cold:
                bar.show("compiling all kernels", None)
                found = with_compilation(found)
        return found

    def _parts(self) -> list[Part]:
        if self.start:
            return start_up_parts()
        if self.agents:
            from semnav_agents.bench import agent_parts  # the environment alone needs no agent

            return agent_parts(self.robot, self.episodes or "val_unseen", self.robots, self.steps)
        plan = load_floor_plan(self.map)
        kind: dict[str, Any] = {"robot": self.robot, "observation": self.observation}
        if self.growth:
            return growth_parts(plan, self.threads, self.steps, **kind)
        counts = (self.robots, self.threads, self.steps)
        if self.episodes is not None:
            return training_parts(self.episodes, *counts, floor_plan=plan, **kind)
        return usual_parts(*counts, floor_plan=plan, **kind)


def _rate(per_second: float) -> str:
    return f"{per_second:,.0f}" if per_second >= 10.0 else f"{per_second:.2g}"


def _in_scans(ratio: float) -> str:
    """How long a part takes: "1/20" of a brute-force scan, or "1.7" of them.

    Args:
        ratio: how often it is done while the scan is done once.
    """
    return f"1/{ratio:,.1f}" if ratio > 1.0 else f"{1.0 / ratio:,.1f}"
