"""Two threads in one environment, and forks: an error in one sentence, never a crash or a hang."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.language import parse
from semnav_env.mind.belief import BeliefTracker
from semnav_env.vector import SemNavVectorEnv
from semnav_env.world.simulator import Simulator
from semnav_features.one_thread import ThreadDoor
from tests.support.episodes import START
from tests.support.paths import ROOT

SECONDS = 600
"""Time after which a process must be waiting for what never comes: compiling takes less."""


class Waiting:
    """Rewards that wait in the middle of a step."""

    def __init__(self) -> None:
        self.inside, self.go_on = threading.Event(), threading.Event()

    def terms(self, tick: Any) -> dict[str, float]:
        self.inside.set()
        assert self.go_on.wait(SECONDS)
        return {"none": 0.0}

    def __deepcopy__(self, memo: object) -> Waiting:
        return self


def in_the_middle(
    step: Callable[[], object], rewards: Waiting, other: Callable[[], object]
) -> None:
    """Call something while another thread is in the middle of a step."""
    rewards.go_on.set()
    step()  # compiles
    rewards.inside.clear()
    rewards.go_on.clear()
    thread = threading.Thread(target=step)
    thread.start()
    assert rewards.inside.wait(SECONDS)
    try:
        with pytest.raises(RuntimeError, match="another thread is using this"):
            other()
    finally:
        rewards.go_on.set()
        thread.join()
    other()


@pytest.mark.parametrize("call", ["reset", "step"])
def test_a_second_thread_is_kept_out_of_an_environment(call: str) -> None:
    env = SemNavEnv(rewards=(rewards := Waiting()))
    env.reset(seed=0, options=START)
    calls = {"reset": lambda: env.reset(options=START), "step": lambda: env.step([1.0, 0.0])}
    in_the_middle(lambda: env.step([1.0, 0.0]), rewards, calls[call])


@pytest.mark.parametrize("call", ["reset", "step"])
def test_a_second_thread_is_kept_out_of_a_vector(call: str) -> None:
    envs = SemNavVectorEnv(2, rewards=(rewards := Waiting()))
    envs.reset(seed=0, options=START)
    actions = np.zeros((2, 2))
    calls = {"reset": lambda: envs.reset(seed=1), "step": lambda: envs.step(actions)}
    in_the_middle(lambda: envs.step(actions), rewards, calls[call])


def test_a_second_thread_is_kept_out_of_a_tracker() -> None:
    class WaitingRanges(Waiting):
        def __array__(self, *_: object, **__: object) -> np.ndarray:
            self.terms(None)
            return np.full(tracker.lidar.beams, 3.0)

    tracker, ranges = BeliefTracker(), WaitingRanges()
    tracker.begin(parse("stop"))
    calls = ranges, (0.0, 0.0, 0.0)
    in_the_middle(lambda: tracker.update(*calls), ranges, lambda: tracker.update(*calls))


def test_a_second_thread_is_kept_out_of_a_simulator() -> None:
    env = SemNavEnv()
    env.reset(seed=0, options=START)
    simulator: Simulator = env.simulator
    simulator.thread_door.enter(False)
    found: list[BaseException] = []

    def drive() -> None:
        try:
            simulator.step((0.1, 0.0, 0.0))
        except RuntimeError as error:
            found.append(error)

    thread = threading.Thread(target=drive)
    thread.start()
    thread.join()
    simulator.thread_door.leave()
    assert "another thread is using this Simulator" in str(found[0])


def test_an_interrupted_step_locks_nobody_out() -> None:
    class Interrupting:
        def terms(self, tick: Any) -> dict[str, float]:
            raise KeyboardInterrupt

    env = SemNavEnv(rewards=Interrupting())
    env.reset(seed=0, options=START)
    with pytest.raises(KeyboardInterrupt):
        env.step([1.0, 0.0])
    thread = threading.Thread(target=lambda: env.reset(options=START))
    thread.start()
    thread.join()
    assert env.simulator.steps == 0


def test_a_copy_has_a_door_of_its_own() -> None:
    door = ThreadDoor()
    assert door.enter(False)
    copy = pickle.loads(pickle.dumps(door))
    entered: list[bool] = []
    for each in (door, copy):
        thread = threading.Thread(target=lambda each=each: entered.append(each.enter(False)))
        thread.start()
        thread.join()
    assert entered == [False, True]


HAMMER = """
import sys, threading
import numpy as np
from semnav_env.env import SemNavEnv
from semnav_env.vector import SemNavVectorEnv
count = int(sys.argv[1])
env = SemNavVectorEnv(count, threads=2) if count else SemNavEnv()
actions = np.full((count, 2) if count else 2, 0.5)
env.reset(seed=0)
refused = []

def drive():
    for _ in range(300):
        try:
            ended = np.any(env.step(actions)[2:4])
            if ended and not count:
                env.reset()
        except RuntimeError as error:
            refused.append(str(error))

threads = [threading.Thread(target=drive) for _ in range(4)]
[thread.start() for thread in threads]
[thread.join() for thread in threads]
assert all("another thread is using this" in said for said in refused), set(refused)
env.step(actions)
"""


@pytest.mark.parametrize("count", [0, 32])
def test_threads_that_hammer_an_environment_end_no_process(count: int) -> None:
    command = [sys.executable, "-c", HAMMER, str(count)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=SECONDS)
    assert (done.returncode, done.stderr) == (0, "")


def test_a_forked_vector_drives_on_as_its_parent() -> None:
    envs = SemNavVectorEnv(4, threads=2)
    envs.reset(seed=0)
    actions = np.full((4, 2), 0.5)
    envs.step(actions)
    reading, writing = os.pipe()
    if not (child := os.fork()):
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(SECONDS)
        try:
            os.write(writing, driven(envs, actions))
            envs.close()
        finally:
            os._exit(0)
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        answer = pipe.read()
    _, status = os.waitpid(child, 0)
    assert (status, answer) == (0, driven(envs, actions))
    envs.close()


def driven(envs: SemNavVectorEnv, actions: np.ndarray) -> bytes:
    """The bits of some steps of a vector."""
    steps = [envs.step(actions) for _ in range(5)]
    return b"".join(np.ascontiguousarray(step[4]["pose"]).tobytes() for step in steps)
