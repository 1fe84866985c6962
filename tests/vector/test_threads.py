"""Many threads share the robots of a vector: each robot is driven once, whoever takes it."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from semnav_env.vector import SemNavVectorEnv
from semnav_env.vector.marks import is_set, set_mark
from semnav_features.kernels.compiling import kernel

ROBOTS, STEPS = 40, 60


@kernel
def set_all(marks, counts):
    """Set all marks, and count those that this thread was the first to set."""
    for k in range(len(marks)):
        counts[0] += set_mark(marks, k)


def test_each_mark_is_set_first_by_exactly_one_thread():
    marks, counts = np.zeros(200_000, np.int64), np.zeros((4, 1), np.int64)
    with ThreadPoolExecutor(4) as threads:
        list(threads.map(lambda count: set_all(marks, count), counts))
    assert counts.sum() == len(marks)
    assert all(is_set(marks, k) for k in range(0, len(marks), 997))


def test_marks_mean_the_same_in_python():
    marks = np.zeros(2, np.int64)
    assert set_mark(marks, 1)
    assert not set_mark(marks, 1)
    assert [is_set(marks, 0), is_set(marks, 1)] == [False, True]


def driven(threads):
    """What the robots observe and are told, step by step."""
    envs = SemNavVectorEnv(ROBOTS, floor_plan="office_cross", threads=threads, max_seconds=3.0)
    envs.reset(seed=5)
    generator = np.random.default_rng(5)
    for _ in range(STEPS):
        actions = generator.uniform(-0.2, 1.0, (ROBOTS, 2)).astype(np.float32)
        rows, rewards, terminated, truncated, infos = envs.step(actions)
        yield [*rows.values(), rewards, terminated, truncated, infos["pose"]]


@pytest.mark.parametrize("threads", [2, 5])
def test_threads_that_help_each_other_drive_as_one_does(threads):
    for alone, together in zip(driven(1), driven(threads), strict=True):
        for one, other in zip(alone, together, strict=True):
            np.testing.assert_array_equal(one, other)
