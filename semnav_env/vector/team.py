"""The robots of a vector environment, as its compiled calls take them."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.env import SemNavEnv
from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.scratch import Scratch, allocate_scratch
from semnav_env.robot_loop import RobotArrays, join_robot
from semnav_env.vector.robot_list import list_of, put
from semnav_env.vector.tick import PERIOD, tick, write_command_rows, write_rows

LEAST_SHARE = 8
"""A thread is not worth starting for fewer robots."""

LOG_LENGTH = 256
"""Control periods after which commands are handed to the worlds, which need them to be pickled."""


class Team:
    """Drives the robots of several environments, each thread a part of them.

    Args:
        envs: that have been reset.
        threads: in which to run; as many as there are cores if not given.

    Attributes:
        periods: what became of each robot in the last control period, dtype `PERIOD`, shape (n,).
    """

    def __init__(self, envs: Sequence[SemNavEnv], threads: int | None = None) -> None:
        self._envs = envs
        count = len(envs)
        wanted = os.cpu_count() or 1 if threads is None else threads
        parts = max(1, min(wanted, count // LEAST_SHARE if threads is None else count))
        ends = np.linspace(0, count, parts + 1).round().astype(int).tolist()
        self._parts = list(pairwise(ends))
        self._pool = ThreadPoolExecutor(parts - 1) if parts > 1 else None
        self.periods = np.zeros(count, PERIOD)
        self._log = np.zeros((LOG_LENGTH, count, 3))
        self._logged = np.zeros((LOG_LENGTH, count), dtype=bool)
        self._log_length = 0
        self._beams, self._scratch = 0, list[Scratch]()
        self._make_room(max(env.lidar_spec.beams for env in envs))
        self._trackers = [env.tracker for env in envs]
        self._need_python = np.zeros(count, dtype=bool)
        self._robots = list_of(_arrays(envs[0]), count)
        for k in range(count):
            self.renew(k)

    def renew(self, index: int) -> None:
        """Take in a robot whose environment has been reset."""
        env = self._envs[index]
        self._make_room(env.lidar_spec.beams)
        env.tracker.use_scratch(self._scratch[index])
        self._trackers[index], self._need_python[index] = env.tracker, env.world.needs_python
        put(self._robots, index, _arrays(env))
        self.periods[index] = np.zeros(1, PERIOD)[0]
        self.periods["pose"][index] = env.world.pose
        self._logged[:, index] = False

    def drive(self, twists: FloatArray, driven: NDArray[np.bool_]) -> None:
        """Drive robots for one control period, let them understand, and judge them.

        Args:
            twists: demanded velocities, shape (n, 3).
            driven: which robots take part, shape (n,).
        """
        for k, tracker in enumerate(self._trackers):
            if driven[k]:
                tracker.let_go()
        by_python = self._need_python & driven
        for k in np.flatnonzero(by_python).tolist():
            self._envs[k].simulator.demand(tuple(twists[k].tolist()))
        self._note(twists, driven & ~by_python)
        seconds = 1.0 / self._envs[0].setup.control_hz
        self._in_parts(tick, twists, driven, seconds, self.periods)
        for k in np.flatnonzero(by_python).tolist():
            self._envs[k].world.arrive()

    def write_rows(self, rows: NDArray[np.float32], with_memory: bool = False) -> None:
        """Write what each robot observes, shape (n, columns), see `write_row`.

        Args:
            rows: to write.
            with_memory: what is remembered and was told as well, see `write_command_row`.
        """
        self._in_parts(write_command_rows if with_memory else write_rows, rows)

    def hand_over_log(self) -> None:
        """Give the worlds the commands that were carried out without them."""
        log, logged = self._log[: self._log_length], self._logged[: self._log_length]
        for k, env in enumerate(self._envs):
            env.world.note_commands(log[logged[:, k], k])
        self._log_length = 0

    def close(self) -> None:
        """Stop the threads."""
        if self._pool is not None:
            self._pool.shutdown()

    def _make_room(self, beams: int) -> None:
        """Working memory for scans of that many beams, which the robots of a thread share."""
        if beams > self._beams:
            self._beams, self._scratch = beams, []
            for first, last in self._parts:
                self._scratch += [allocate_scratch(beams)] * (last - first)

    def _note(self, twists: FloatArray, driven: NDArray[np.bool_]) -> None:
        if self._log_length == LOG_LENGTH:
            self.hand_over_log()
        self._log[self._log_length], self._logged[self._log_length] = twists, driven
        self._log_length += 1

    def _in_parts(self, call: Callable[..., None], *arguments: Any) -> None:
        """Call a kernel on every part of the robots, the first part in this thread."""
        waiting: list[Future[None]] = []
        for first, last in self._parts[1:]:
            assert self._pool is not None
            waiting.append(self._pool.submit(call, self._robots, first, last, *arguments))
        call(self._robots, *self._parts[0], *arguments)
        for each in waiting:
            each.result()


def _arrays(env: SemNavEnv) -> RobotArrays:
    return join_robot(env.simulator.arrays, env.tracker.senses, env.judge.verifier.record)
