"""`python -m studies manner`: success and speed at each pace and along each wall."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from studies.manner.drives import MANNERS, drawn_cases, drive


@dataclass(frozen=True)
class Arguments:
    """Drive drawn commands as they are, slowly, fast, and along the wall of each side.

    Attributes:
        plans: names of floor plans.
        robots: bodies.
        episodes: commands on each plan; each of them follows a hallway.
        agent: the driver.
        failures: whether to print each drive that fails.
    """

    plans: tuple[str, ...] = ("office_cross", "office:medium:17")
    robots: tuple[str, ...] = ("wheelchair", "spot")
    episodes: int = 20
    agent: str = "scripted"
    failures: bool = False

    def run(self) -> int:
        """Drive, and print a row for each plan, body and manner."""
        for plan in self.plans:
            cases = list(drawn_cases(plan, self.episodes))
            for robot, manner in product(self.robots, MANNERS):
                found = [drive(robot, plan, case, manner, self.agent) for case in cases]
                done, contacts = sum(e.success for e in found), sum(e.contacts for e in found)
                speed = float(np.mean([each.speed for each in found]))
                row = f"{plan:18} {robot:10} {manner:6} {done:3} of {len(found)}"
                print(f"{row}  {speed:.2f} m/s  {contacts} contacts", flush=True)
                for case, each in zip(cases, found, strict=True):
                    if self.failures and not each.success:
                        print(f"    {case.seed} {case.command}: {each.verdicts}", flush=True)
        return 0
