"""`python -m studies latency`: the delay from scan to velocity of `semnav node`, and its load."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from semnav_features.frames import Pose
from semnav_ros.opening import WireName, open_wire
from semnav_ros.robot_shell import RobotShell
from semnav_ros.simulated_robot import SimulatedRobot
from studies.page.command import processor_seconds

DRIVES: tuple[tuple[str, str, Pose], ...] = (
    ("heidelberg_hallway", "go through the second door on the right", (1.0, 0.3, 0.24)),
    ("office_cross", "turn left at the intersection, then go down the hallway", (1.3, 9.1, 0.0)),
    ("office_cross", "take the second door on the left", (1.3, 9.1, 0.0)),
)
"""Floor plans, commands and starts of the drives."""

LONGEST_DRIVE = 90.0
"""Time after which a drive is given up, seconds."""

HEADINGS = (
    "| drives | done | scans answered | median, ms | 99 of 100 | 999 of 1000 | most | over 5 ms "
    "| of a core |"
)


@dataclass(frozen=True)
class Arguments:
    """Measure a node of its own process, with simulated robots of this process, in real time.

    A delay lasts from publishing a scan of 811 beams to receiving the velocity that it led to. What
    else the machine does counts, too; the share of a core is that of the node while it drives.

    Attributes:
        over: what carries the messages: ros1 (with a master that runs), ros2 or dds.
        rounds: how often the three drives are driven.
    """

    over: WireName = "dds"
    rounds: int = 5

    def run(self) -> int:
        """Print one row."""
        delays: list[float] = []
        shares, done = [], 0
        with running_node(self.over) as node:
            for _ in range(self.rounds):
                for plan, text, pose in DRIVES:
                    begun, used = time.perf_counter(), processor_seconds(node.pid)
                    done += self._drive(plan, text, pose, delays)
                    passed = time.perf_counter() - begun
                    shares.append((processor_seconds(node.pid) - used) / passed)
        median, late, later, most = 1e3 * np.percentile(delays, (50, 99, 99.9, 100))
        cells = (
            f"{len(shares)}",
            f"{done}",
            f"{len(delays)}",
            *(f"{value:.1f}" for value in (median, late, later, most)),
            f"{100.0 * np.mean(np.array(delays) > 5e-3):.2f} %",
            f"{100.0 * np.mean(shares):.1f} %",
        )
        print(f"{HEADINGS}\n{'|---' * len(cells)}|\n| {' | '.join(cells)} |")
        return 0

    def _drive(self, plan: str, text: str, pose: Pose, delays: list[float]) -> bool:
        """Drive once, and add the delays; returns whether the command was carried out."""
        wire = open_wire(self.over, "semnav_robot")
        try:
            shell = RobotShell(SimulatedRobot(plan, pose=pose), wire)
            end = time.monotonic() + LONGEST_DRIVE
            outcome = shell.run(lambda: time.monotonic() < end, text)
        finally:
            wire.close()
        delays += shell.delays
        return outcome is not None and bool(outcome["is_success"])


@contextmanager
def running_node(over: WireName) -> Iterator[subprocess.Popen[str]]:
    """A node in a process of its own."""
    command = [sys.executable, "-m", "semnav", "node", "--over", over]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as node:
        try:
            assert node.stdout is not None
            assert node.stdout.readline(), "the node did not start"
            yield node
        finally:
            node.terminate()
