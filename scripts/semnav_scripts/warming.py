"""Compiles the kernels of all commands before they are needed.

A kernel holds the code of all functions that it calls but of shared kernels, and kernels that are
compiled in one process share these parts. Therefore similar kernels, such as those for one robot
and for many, are compiled in one process. Other groups, which share little, are compiled in
parallel; kernels that two groups need are compiled by the first one.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import redirect_stderr, redirect_stdout
from itertools import islice
from pathlib import Path
from typing import NamedTuple

STEPS = 20
"""Control periods of a drive that calls every kernel of an environment."""

SEARCH_STEPS = 300
"""Control periods of a search that calls every kernel of the searching agents."""

SCANS = 12
"""Scans of the log that is read."""


class WarmedGroup(NamedTuple):
    """A group of kernels that are ready.

    Attributes:
        name: of the group.
        seconds: how long that took.
        fault: the last line of its process's output if it failed; otherwise empty.
    """

    name: str
    seconds: float
    fault: str


def warm() -> Iterator[WarmedGroup]:
    """Compile all groups, as many at once as there are cores; each is reported when it is ready."""
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        for group in as_completed([pool.submit(_warmed, name) for name in GROUPS]):
            yield group.result()


def _warmed(name: str) -> WarmedGroup:
    command = [sys.executable, "-m", "semnav_scripts.warming", name]
    begun = time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, errors="replace")
    said = (done.stderr.splitlines() or [f"it ended with {done.returncode}"])[-1]
    return WarmedGroup(name, time.perf_counter() - begun, said if done.returncode else "")


def environments() -> None:
    """One robot and many, with every kind of observation, and people of every model."""
    import numpy as np

    from semnav_env.env import SemNavEnv
    from semnav_env.vector import SemNavVectorEnv
    from semnav_env.world.dynamics import Dynamics
    from semnav_env.world.dynamics.settings import MODELS

    for observation in ("semantic", "command"):
        env = SemNavEnv(observation=observation)
        envs = SemNavVectorEnv(2, observation=observation)
        env.reset(seed=0)
        envs.reset(seed=0)
        for _ in range(STEPS):
            env.step(np.full(2, 0.3))
            envs.step(np.full((2, 2), 0.3))
    for model in MODELS:
        env = SemNavEnv(dynamics=Dynamics(pedestrians=4, model=model, changing_doors=0.5))
        env.reset(seed=0)
        for _ in range(STEPS):
            env.step([0.3, 0.0])


def agents() -> None:
    """Compile the kernels for planning paths and poses, for searches, and for describing routes."""
    from semnav_agents import make_agent
    from semnav_agents.base import steps
    from semnav_env.rescue.environment import search_and_rescue

    told = "go through the second door on the right"
    for robot in ("wheelchair", "spot"):
        for agent in ("scripted", "oracle"):
            _run("demo", told, "--robot", robot, "--agent", agent, "--seed", "3")
    searcher = make_agent("searcher")
    env = search_and_rescue(observation=searcher.observation)
    for _ in islice(steps(env, searcher, *env.reset(seed=1)), SEARCH_STEPS):
        pass
    _run("approach", "--map", "office_cross", "--door", "west_north_2")
    _run("describe", "--map", "office_cross", "--from", "3,11.5,0", "--to", "west_north_2")


def logs() -> None:
    """Compile the kernels for reading logs, building maps and checking floor plans."""
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "drive.log"
        log.write_text("".join(_lines()))
        for poses in ("log", "match"):
            out = str(Path(folder) / f"{poses}.geojson")
            _run("map", "build", str(log), "--out", out, "--poses", poses)
        _run("extract", str(log))
        _run("follow", str(log), "go through the second door on the right")
        _run("map", "check", "office_cross")


GROUPS: dict[str, Callable[[], None]] = {
    "environments": environments,
    "agents": agents,
    "logs": logs,
}
"""Groups that are compiled in parallel."""


def _run(*words: str) -> None:
    """Run a command without output; its exit code does not matter."""
    from semnav_scripts.main import main

    with open(os.devnull, "w") as nowhere, redirect_stdout(nowhere), redirect_stderr(nowhere):
        main(words)


def _lines() -> Iterator[str]:
    """The lines of a CARMEN log of a short drive."""
    from semnav_env.world.lidar import Lidar
    from semnav_env.world.maps import load_floor_plan

    lidar = Lidar(load_floor_plan("heidelberg_hallway"))
    for k in range(SCANS):
        ranges = lidar.scan((-2.5 + 0.1 * k, -0.3, 0.24), key=(1, 2, k)).ranges[::3][:181]
        said = " ".join(f"{r:.2f}" for r in ranges)
        place = f"{-2.5 + 0.1 * k:.3f} -0.300 0.240"
        yield f"FLASER {len(ranges)} {said} {place} {place} {k} robot {k}\n"


if __name__ == "__main__":
    GROUPS[sys.argv[1]]()
