"""`python -m studies exits`: how often each rule gets a robot out through a named door."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from semnav_agents.evaluation.intervals import wilson_interval
from semnav_env.approach import Surroundings, plan_approach
from semnav_env.robots import ROBOTS, RobotSpec, robot_spec
from semnav_env.world.maps.placement import placement_error
from studies.exits.cases import SEED, ExitCase, exit_cases
from studies.exits.drives import driven
from studies.exits.exit_rules import exit_via_door, lining_up, one_metre

RULES = {each.__name__: each for each in (one_metre, lining_up, exit_via_door)}
"""The rules by name."""


@dataclass(frozen=True)
class Arguments:
    """Drive the frozen cases by a rule, and say how often it got the robot out.

    Attributes:
        cases: how many of the frozen cases, from the first.
        rules: which rules: one_metre, lining_up, exit_via_door.
        robots: which bodies.
        out: file to add one line of JSON for each drive to; what is in it is not driven again, so
            that a long run can be stopped and taken up again.
        poses: also check that the best pose before each door touches nothing.
    """

    cases: int = 2000
    rules: tuple[str, ...] = tuple(RULES)
    robots: tuple[str, ...] = tuple(ROBOTS)
    out: Path | None = None
    poses: bool = False

    def run(self) -> int:
        """Drive the cases and print a table."""
        unknown = set(self.rules) - set(RULES)
        if unknown:
            raise ValueError(f"no rule {', '.join(unknown)}; there are: {', '.join(RULES)}")
        robots, rows = [robot_spec(name) for name in self.robots], self._known()
        done = {(row["number"], row["rule"], row["robot"]) for row in rows}
        for case in islice(exit_cases(SEED), self.cases):
            for row in self._rows(case, robots, done):
                rows.append(row)
                if self.out is not None:
                    with self.out.open("a", encoding="utf-8") as file:
                        print(json.dumps(row), file=file)
        print(table([row for row in rows if row["number"] < self.cases]))
        return 0

    def _known(self) -> list[dict[str, Any]]:
        if self.out is None or not self.out.exists():
            return []
        return [json.loads(line) for line in self.out.read_text(encoding="utf-8").splitlines()]

    def _rows(
        self, case: ExitCase, robots: list[RobotSpec], done: set[tuple[int, str, str]]
    ) -> Iterator[dict[str, Any]]:
        for robot in robots:
            said = {"number": case.number, "plan": case.plan.name, "robot": robot.name}
            if self.poses and (case.number, "pose", robot.name) not in done:
                yield {**said, "rule": "pose", **judged_pose(case, robot)}
            for rule in self.rules:
                if (case.number, rule, robot.name) not in done:
                    yield {**said, "rule": rule, **asdict(driven(case, robot, RULES[rule]))}


def judged_pose(case: ExitCase, robot: RobotSpec) -> dict[str, Any]:
    """Whether there is a best pose before the door, and whether the body touches anything there."""
    found = plan_approach(case.side, Surroundings.of_plan(case.plan), robot, start=case.start).best
    hit = found is not None and placement_error(case.plan, robot, found) is not None
    return {"passed": found is not None, "contact": hit, "seconds": 0.0}


def table(rows: list[dict[str, Any]]) -> str:
    """A line for each rule and body: shares with Wilson's intervals of 95 %, mean seconds."""
    columns = f"{'passed':>9}{'95 %':>16}{'contact':>9}{'95 %':>16}{'mean s':>8}"
    lines = [f"{'rule':<15}{'body':<12}{'cases':>6}{columns}"]
    for rule, robot in dict.fromkeys((row["rule"], row["robot"]) for row in rows):
        mine = [row for row in rows if (row["rule"], row["robot"]) == (rule, robot)]
        shares = [float(np.mean([row[name] for row in mine])) for name in ("passed", "contact")]
        seconds = np.mean([row["seconds"] for row in mine if row["passed"]] or [np.nan])
        numbers = "".join(_with_interval(share, len(mine)) for share in shares)
        lines.append(f"{rule:<15}{robot:<12}{len(mine):>6}{numbers}{seconds:>8.1f}")
    return "\n".join(lines)


def _with_interval(share: float, count: int) -> str:
    low, high = wilson_interval(share, count)
    return f"{share:>9.4f}{f'{low:.3f} to {high:.3f}':>16}"
