"""`python -m studies latency`: the delay from scan to velocity of `semnav node`, and its load."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context

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

AIM = 5e-3
"""Delay that few scans should exceed, seconds."""

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
    else the machine does counts, too, unless both processes go before it (`chrt -f 10`).

    Attributes:
        over: what carries the messages: ros1 (with a master that runs), ros2 or dds.
        rounds: how often the three drives are driven.
    """

    over: WireName = "dds"
    rounds: int = 5

    def run(self) -> int:
        """Print one row."""
        fresh = get_context("spawn")  # rospy can be started once in a process
        with (
            running_node(self.over) as node,
            ProcessPoolExecutor(1, mp_context=fresh, max_tasks_per_child=1) as robots,
        ):
            told = [(self.over, node.pid, *each) for each in DRIVES * self.rounds]
            drives = list(robots.map(drive, told))
        delays = np.concatenate([each.delays for each in drives])
        median, late, later, most = 1e3 * np.percentile(delays, (50, 99, 99.9, 100))
        cells = (
            f"{len(drives)}",
            f"{sum(each.done for each in drives)}",
            f"{len(delays)}",
            *(f"{value:.1f}" for value in (median, late, later, most)),
            f"{100.0 * np.mean(delays > AIM):.2f} %",
            f"{100.0 * np.mean([each.share for each in drives]):.1f} %",
        )
        print(f"{HEADINGS}\n{'|---' * len(cells)}|\n| {' | '.join(cells)} |")
        return 0


@dataclass(frozen=True)
class Drive:
    """What one drive showed.

    Attributes:
        done: whether the command was carried out.
        delays: from scans to velocities, seconds.
        share: processor time of the node as a share of a core.
    """

    done: bool
    delays: list[float]
    share: float


def drive(told: tuple[WireName, int, str, str, Pose]) -> Drive:
    """Drive once: what carries the messages, process of the node, plan, command and start."""
    over, node, plan, text, pose = told
    wire = open_wire(over, "semnav_robot")
    try:
        shell = RobotShell(SimulatedRobot(plan, pose=pose), wire)
        begun, used = time.monotonic(), processor_seconds(node)
        outcome = shell.run(lambda: time.monotonic() < begun + LONGEST_DRIVE, text)
        share = (processor_seconds(node) - used) / (time.monotonic() - begun)
    finally:
        wire.close()
    return Drive(outcome is not None and bool(outcome["is_success"]), shell.delays, share)


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
