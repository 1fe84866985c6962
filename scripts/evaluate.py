"""`semnav evaluate`: many episodes, one table."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table
from tyro.conf import Positional

from semnav_env.agents.evaluation import Result, Summary, run_suite, suite, summarise
from semnav_env.scripts.progress import tracked


@dataclass(frozen=True)
class Arguments:
    """Run a suite of commands many times and count.

    Attributes:
        suite: heidelberg, office_cross, or "all".
        agent: scripted, oracle, or the path of a trained agent.
        robot: wheelchair or spot.
        seeds: how many start poses and noises per command.
        first_seed: of them.
        workers: processes.
        out: file for every episode, one JSON object a line.
        json: print the table as JSON.
    """

    suite: Positional[str] = "heidelberg"
    agent: str = "scripted"
    robot: str = "wheelchair"
    seeds: int = 20
    first_seed: int = 0
    workers: int = 1
    out: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Run, and print success and contacts per command."""
        if self.seeds < 1 or self.workers < 1:
            raise ValueError("seeds and workers must be at least 1")
        if self.first_seed < 0:
            raise ValueError(f"first_seed is {self.first_seed}; it must be 0 or more")
        trials = suite(self.suite)
        seeds = range(self.first_seed, self.first_seed + self.seeds)
        total = len(trials) * len(seeds)
        results: list[Result] = []
        episodes = run_suite(trials, self.agent, self.robot, seeds, self.workers)
        for result in tracked(episodes, lambda n: f"{n} episodes", lambda: len(results) / total):
            results.append(result)
        results.sort(
            key=lambda result: ([t.command for t in trials].index(result.command), result.seed)
        )
        if self.out is not None:
            self.out.parent.mkdir(parents=True, exist_ok=True)
            self.out.write_text("".join(json.dumps(asdict(r)) + "\n" for r in results))
        self._show([_summary(trial.command, results) for trial in trials], results)
        if self.out is not None and not self.json:
            print(f"wrote {self.out}")
        return 0

    def _show(self, summaries: list[Summary], results: list[Result]) -> None:
        everything = summarise("all", results)
        if self.json:
            print(json.dumps([asdict(summary) for summary in (*summaries, everything)]))
            return
        table = Table("command", "episodes", "success", "no contact", "SPL", "seconds")
        for row in (*summaries, everything):
            shares = (f"{row.success:.3f}", f"{row.contact_free:.3f}", f"{row.spl:.3f}")
            table.add_row(row.name, str(row.episodes), *shares, f"{row.seconds:.1f}")
        console = Console()
        console.print(table)
        for row in summaries:
            for failure in row.failures:
                console.print(f"{row.name}: {failure}", highlight=False, soft_wrap=True)


def _summary(command: str, results: list[Result]) -> Summary:
    return summarise(command, [result for result in results if result.command == command])
