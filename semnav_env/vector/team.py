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
from semnav_env.judge.judge_state import PERIOD, Period
from semnav_env.mind.belief.tracker import BeliefTracker
from semnav_env.mind.belief.understand import Workbench
from semnav_env.vector.robot_list import list_of, put
from semnav_env.vector.tick import (
    TeamArrays,
    begin_period,
    report,
    tick,
    write_command_rows,
    write_others,
)
from semnav_features.frames import FloatArray
from semnav_features.kernels.scratch import scratch_array

LEAST_SHARE = 8
"""A thread is not worth starting for fewer robots."""

AT_A_TIME = 8
"""How many robots Python's thread drives before it thinks, where there are other threads."""

NO_ROWS = np.empty((0, 0), np.float32)
"""Where observations are not written while robots are driven."""

LOG_LENGTH = 256
"""Control periods after which commands are handed to the worlds, which need them to be pickled."""


class Team:
    """Drives the robots of several environments in threads, and lets them think.

    Python's own thread takes robots from the first one on, the others from the end of their parts
    down; who is done helps the others. Between its robots Python's thread thinks for those that are
    done, which the threads that only compute need not wait for.

    Args:
        envs: that have been reset.
        threads: in which to run; as many as there are cores if not given.

    Attributes:
        periods: what became of each robot in the last control period that it was driven in, dtype
            `PERIOD`, shape (n,).
        period: the same as a `Period` of arrays, which are views.
    """

    def __init__(self, envs: Sequence[SemNavEnv], threads: int | None = None) -> None:
        self._envs, self._count = envs, len(envs)
        count = len(envs)
        wanted = os.cpu_count() or 1 if threads is None else threads
        parts = max(1, min(wanted, count // LEAST_SHARE if threads is None else count))
        ends = np.linspace(0, count, parts + 1).round().astype(int).tolist()
        self._parts = list(pairwise(ends))
        self._pool: ThreadPoolExecutor | None = None
        self._pool_process = 0
        self.periods, events = np.zeros(count, PERIOD), np.zeros((count, 2), np.int64)
        self.period = Period(*(self.periods[name] for name in Period._fields))
        self._thoughtful, self._written, reported = np.zeros((3, count), dtype=bool)
        self._log = np.zeros((LOG_LENGTH, count, 3))
        self._logged = np.zeros((LOG_LENGTH, count), dtype=bool)
        self._log_length = 0
        self._beams, self._workbenches = 0, list[Workbench]()
        self._need_python = np.zeros(count, dtype=bool)
        self._asked = set[BeliefTracker]()
        self._robots = list_of(envs[0].loop.arrays, count)
        self._who = np.zeros((count, 3), np.int64)
        taken, done = np.zeros((2, count), np.int64)
        self._arrays = TeamArrays.of(
            robots=self._robots,
            periods=self.periods,
            events=events,
            thoughtful=self._thoughtful,
            taken=taken,
            done=done,
            reported=reported,
            written=self._written,
        )
        self._rows = NO_ROWS
        for k in range(count):
            self.renew(k)

    def renew(self, index: int) -> None:
        """Take in a robot whose environment has been reset."""
        env = self._envs[index]
        self._make_room(env.lidar_spec.beams)
        self._need_python[index] = env.world.needs_python
        env.tracker.asked = self._asked
        self._asked.add(env.tracker)  # it may have been asked before it joined
        self._thoughtful[index] = env.payload is not None or env.world.needs_python
        self._written[index] = False
        put(self._robots, index, env.loop.arrays)
        self.periods[index] = env.judge.row[0]
        self._logged[:, index] = False

    def drive(self, twists: FloatArray, driven: NDArray[np.bool_]) -> list[int]:
        """Drive robots for one control period, let them understand, judge them, let them think.

        Args:
            twists: demanded velocities, shape (n, 3).
            driven: which robots take part, shape (n,).

        Returns:
            Numbers of the robots whose judge thought.
        """
        for tracker in tuple(self._asked):
            tracker.let_go()
        by_python = self._need_python & driven
        for k in by_python.nonzero()[0].tolist():
            self._envs[k].simulator.demand(tuple(twists[k].tolist()))
        self._note(twists, driven & ~by_python)
        begin_period(self._arrays, driven)
        return self._tick(twists, 1.0 / self._envs[0].setup.control_hz)

    def prepare_rows(self, columns: int) -> None:
        """Let the observations of the next control period be written into rows of this length."""
        self._rows = np.empty((self._count, columns), np.float32)
        self._written[:] = False

    def rows(self, columns: int) -> NDArray[np.float32]:
        """What each robot observes, shape (n, columns), see `write_row`; fresh ones every time."""
        if self._rows.shape[1] != columns:
            self.prepare_rows(columns)
        rows, self._rows = self._rows, NO_ROWS
        write_others(self._arrays, rows)
        return rows

    def command_rows(self, columns: int) -> NDArray[np.float32]:
        """As `rows`, with what is remembered and was told, see `write_command_row`."""
        rows = np.empty((self._count, columns), np.float32)
        parts = self._parts[1:]
        waiting = [self._submit(write_command_rows, *part, rows) for part in parts]
        write_command_rows(self._arrays, *self._parts[0], rows)
        _wait_for(waiting)
        return rows

    def hand_over_log(self) -> None:
        """Give the worlds the commands that were carried out without them."""
        log, logged = self._log[: self._log_length], self._logged[: self._log_length]
        for k, env in enumerate(self._envs):
            env.world.note_commands(log[logged[:, k], k])
        self._log_length = 0

    def close(self) -> None:
        """Stop the threads."""
        if self._pool is not None and self._pool_process == os.getpid():
            self._pool.shutdown()

    def _make_room(self, beams: int) -> None:
        """A workbench for each thread, for scans of that many beams."""
        if beams > self._beams:
            self._beams = beams
            self._workbenches = [Workbench.of(scratch=scratch_array(beams)) for _ in self._parts]

    def _note(self, twists: FloatArray, driven: NDArray[np.bool_]) -> None:
        if self._log_length == LOG_LENGTH:
            self.hand_over_log()
        self._log[self._log_length], self._logged[self._log_length] = twists, driven
        self._log_length += 1

    def _tick(self, twists: FloatArray, seconds: float) -> list[int]:
        """Drive the robots that are ready, in all threads, and think meanwhile."""
        work = twists, seconds, self._rows
        benches = self._workbenches
        waiting = [
            self._submit(tick, bench, last - 1, -1, self._count, *work)
            for bench, (_, last) in zip(benches[1:], self._parts[1:], strict=True)
        ]
        thought: list[int] = []
        most = AT_A_TIME if waiting else self._count
        try:
            while tick(self._arrays, benches[0], 0, 1, most, *work):
                self._think(thought)
        finally:
            _wait_for(waiting)
        self._think(thought)
        return thought

    def _think(self, thought: list[int]) -> None:
        """Let the robots think that are done and have not yet; note whose judge did."""
        count = report(self._arrays, self._rows, self._who)
        for k, understood, judged in self._who[:count].tolist():
            env = self._envs[k]
            if self._need_python[k]:
                env.world.arrive()
            env.loop.think(understood, judged)
            if judged:
                self.periods[k] = env.judge.row[0]
                thought.append(k)

    def _submit(self, call: Callable[..., Any], *arguments: Any) -> Future[Any]:
        return self._threads().submit(call, self._arrays, *arguments)

    def _threads(self) -> ThreadPoolExecutor:
        """The other threads. A process that was forked gets none of its parent's, but new ones."""
        if self._pool is None or self._pool_process != os.getpid():
            self._pool_process = os.getpid()
            self._pool = ThreadPoolExecutor(len(self._parts) - 1)
        return self._pool


def _wait_for(futures: list[Future[Any]]) -> None:
    for each in futures:
        each.result()
