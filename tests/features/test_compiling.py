"""Kernels: compiled once, and kept by what they are made of."""

import copy
import os
import pickle
import subprocess
import sys
import time
from weakref import ref

import numpy as np
import pytest
from numba import from_dtype, types

from semnav_features.kernels import cache_key
from semnav_features.kernels.compile_notice import PATIENCE, CompileNotice
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.linking import NUMBA_FITS, shared_kernels
from tests.support.paths import ROOT
from tests.support.small_kernels import (
    PairOfArraysType,
    counting,
    increased_twice,
    mean,
    paired,
    sum_of_pair,
    sum_of_twice,
    total,
    twice,
)


def test_a_kernel_gives_the_same_to_python_and_to_kernels():
    values = np.arange(4.0)
    assert sum_of_twice(values) == sum_of_twice.py_func(values)
    assert [twice(3), twice(2.5), increased_twice(1)] == [6, 5.0, 3]


def test_only_what_python_calls_becomes_callable_from_python():
    @kernel
    def inner(x):
        return x * 3

    @kernel
    def outer(x):
        return inner(x) + 1

    outer._cache.disable()
    assert outer(2) == 7
    assert (len(inner.body.overloads), len(inner.overloads)) == (1, 0)


def test_a_shared_kernel_is_called_where_it_is():
    values = np.arange(4.0)
    assert mean(values) == mean.py_func(values)
    [caller], [called] = mean.overloads.values(), total.overloads.values()
    name = called.fndesc.llvm_func_name
    assert [each[:2] for each in shared_kernels(caller.library)] == [(name, total)]
    with pytest.raises(ValueError, match="no values"):
        mean(values[:0])


def test_numba_offers_what_linking_needs():
    assert NUMBA_FITS


def test_a_literal_argument_needs_no_kernel_of_its_own():
    sum_of_twice(np.arange(4.0))
    assert len(twice.body.overloads) <= 2  # of floats and of integers


def test_an_inner_function_is_not_found_in_place_of_the_kernel_that_python_calls():
    """A caller may have changed its copy: it needs no arguments that are never read."""

    @kernel
    def inner(values, unread, k):
        total = 0.0
        for i in range(len(values)):
            total += values[i] * k
        return total

    @kernel
    def outer(values, unread):
        return inner(values, unread, 2.0) + inner(unread, values, 3.0)

    outer._cache.disable()
    inner._cache.disable()
    ones, twos = np.ones(3), np.full(4, 2.0)
    assert outer(ones, twos) == 6.0 + 24.0
    assert inner(ones, twos, 5.0) == 15.0


def test_arrays_and_errors_of_a_kernel_reach_python():
    kept = [counting(3) for _ in range(100)]
    assert all(array.tolist() == [0, 1, 2] for array in kept)
    with pytest.raises(ValueError, match="negative"):
        counting(-1)


def test_borrowed_arrays_live_as_long_as_their_structure():
    first, second = np.arange(3.0), np.full(1, 10.0)
    pair, watched = paired(first, second), ref(first)
    assert [sum_of_pair(pair) for _ in range(100)] == [sum_of_twice(first[1:]) + 10.0] * 100
    del first, second
    assert watched() is not None
    assert sum_of_pair(pair) == sum_of_twice(np.array((1.0, 2.0))) + 10.0
    del pair
    assert watched() is None


def test_the_name_of_a_structure_is_short_and_tells_its_fields():
    """It is a part of the name of each function that takes the structure."""

    def of(fields):
        record = from_dtype(np.dtype([(f"field_{k}", "f8") for k in range(fields)]))
        return PairOfArraysType([("first", types.Array(record, 1, "C")), ("both", types.int64)])

    assert of(200) == of(200) != of(201)
    assert of(200).name != of(201).name
    assert len(of(200).name) < 50 < len(str(of(200).field_dict["first"]))


def test_a_kernel_is_pickled_and_copied_by_its_name():
    assert pickle.loads(pickle.dumps(twice)) is twice
    assert copy.deepcopy([twice]) == [twice]


KERNELS = 7
"""How many the next process compiles: those that Python calls, and a shared one."""

USE_KERNELS = """
import numpy as np
from tests.support import small_kernels as small
print(small.sum_of_counting(4), small.counting(3))  # a caller first, then what it calls
print(small.mean(np.arange(4.0)))
print(small.sum_of_twice(np.arange(4.0)), small.twice(2.5), small.increased_twice(1))
kernels = [k for k in vars(small).values() if hasattr(k, "stats")]
print(sum(sum(kernel.stats.cache_misses.values()) for kernel in kernels))
"""


def use_kernels(folder, **settings):
    """A process that calls some kernels and prints what they return and how many it compiled."""
    environment = {**os.environ, "SEMNAV_CACHE_DIR": str(folder), **settings}
    command = [sys.executable, "-c", USE_KERNELS]
    return subprocess.Popen(
        command,
        cwd=ROOT,
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def outcome(process):
    out, err = process.communicate()
    assert process.returncode == 0, err
    *results, compiled = out.splitlines()
    return "\n".join(results), int(compiled), err


def test_of_processes_that_start_at_once_one_compiles_and_the_others_wait(tmp_path):
    first = [outcome(process) for process in [use_kernels(tmp_path) for _ in range(6)]]
    again, compiled, err = outcome(use_kernels(tmp_path))
    assert {results for results, _, _ in first} == {again}
    assert sum(compiled for _, compiled, _ in first) == KERNELS
    assert (compiled, err) == (0, "")


@pytest.mark.parametrize("content", [b"", bytes(5000), pickle.dumps(("key", ())), b"\x80\x05half"])
def test_a_damaged_file_is_compiled_anew(tmp_path, content):
    first, compiled, _ = outcome(use_kernels(tmp_path))
    files = sorted(tmp_path.rglob("*.bin"))
    assert len(files) == compiled == KERNELS
    files[0].write_bytes(content)
    files[1].write_bytes(files[1].read_bytes()[:-100])
    assert outcome(use_kernels(tmp_path))[:2] == (first, 2)
    assert outcome(use_kernels(tmp_path))[:2] == (first, 0)


def test_a_caller_fits_a_shared_kernel_that_was_compiled_anew(tmp_path):
    """The machine code that it calls may have another name then."""
    first, _, _ = outcome(use_kernels(tmp_path))
    [shared] = tmp_path.rglob("*.total-*.bin")
    shared.unlink()
    assert outcome(use_kernels(tmp_path))[0] == first
    assert outcome(use_kernels(tmp_path))[:2] == (first, 0)


@pytest.mark.parametrize("setting", [{"NUMBA_BOUNDSCHECK": "1"}, {"NUMBA_OPT": "1"}])
def test_a_setting_that_changes_the_code_has_kernels_of_its_own(tmp_path, setting):
    first, compiled, _ = outcome(use_kernels(tmp_path))
    assert outcome(use_kernels(tmp_path, **setting))[:2] == (first, compiled)
    assert outcome(use_kernels(tmp_path, **setting))[:2] == (first, 0)
    assert outcome(use_kernels(tmp_path))[:2] == (first, 0)


LOAD_A_KERNEL = """
import sys
from tests.support.small_kernels import counting
counting(3)
print({"numba.np.arraymath", "scipy.linalg"} & set(sys.modules))
"""


def test_loading_a_kept_kernel_imports_nothing_to_compile_with(tmp_path):
    outcome(use_kernels(tmp_path))
    environment = {**os.environ, "SEMNAV_CACHE_DIR": str(tmp_path)}
    command = [sys.executable, "-c", LOAD_A_KERNEL]
    assert subprocess.check_output(command, cwd=ROOT, env=environment, text=True) == "set()\n"


def test_a_place_that_cannot_be_written_to_is_replaced(tmp_path):
    blocked = tmp_path / "file"
    blocked.touch()
    _, _, err = outcome(use_kernels(blocked))
    assert sum("cannot be used" in line for line in err.splitlines()) == 1


KERNEL_MODULE = (
    "from semnav_features.kernels.compiling import kernel\n"
    "from semnav_env.world.lidar.limits import LIMIT\n"
)


def test_an_edit_counts_where_a_kernel_imports_it_and_nowhere_else(monkeypatch):
    def key(limit, unrelated):
        sources = {
            "semnav_env.a.kernels": KERNEL_MODULE,
            "semnav_env.world.lidar.limits": limit,
            "semnav_env.env": unrelated,
        }
        monkeypatch.setattr(cache_key, "installed_sources", lambda: iter(sources.items()))
        return cache_key.version_key()

    assert key("LIMIT = 1", "x") == key("LIMIT = 1", "y") != key("LIMIT = 2", "x")


def test_the_modules_behind_kernels_are_found():
    sources = dict(cache_key.installed_sources())
    behind = cache_key.behind_kernels(sources)
    assert {
        "semnav_agents.planning.search",
        "semnav_env.mind.belief.understand",
        "semnav_env.rules",
        "semnav_features.frames",
    } <= behind
    assert behind.isdisjoint({"semnav_env.env", "semnav_env.rendering.viewer"})


def test_long_compiling_is_announced_once_and_short_is_not(capsys, monkeypatch):
    now = 0.0
    monkeypatch.setattr(time, "perf_counter", lambda: now)
    notice = CompileNotice()
    notice.work_goes_on()
    for _ in range(4):
        with notice.while_compiling():
            now += 0.4 * PATIENCE
            notice.work_goes_on()
    assert len(capsys.readouterr().err.splitlines()) == 1


def test_a_thread_may_wait_while_another_one_compiles(capsys, monkeypatch):
    monkeypatch.setattr(time, "perf_counter", lambda: 0.0)
    notice = CompileNotice()
    with notice.while_compiling(), notice.while_compiling():
        notice.work_goes_on()
    notice.work_goes_on()
    assert capsys.readouterr().err == ""
