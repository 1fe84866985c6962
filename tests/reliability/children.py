"""Runs a function in a child process with a limit of memory and time, and says how it ended."""

from __future__ import annotations

import contextlib
import os
import pickle
import resource
import signal
import time
import warnings
from collections.abc import Callable
from typing import Any, NamedTuple

MEMORY = 1 << 30
"""Largest memory that an input may take beside what is loaded already, bytes."""

PROCESSOR_SECONDS = 5.0
"""Largest processor time that an input may take: what waits for other processes costs nothing. A
nest of DXF blocks took 2.6 s on a machine that others kept busy."""

WALL_SECONDS = 600
"""Time after which a child must be waiting for what never comes: a batch of inputs takes seconds,
but on a busy machine minutes."""

LONGEST_MESSAGE = 1000


class Outcome(NamedTuple):
    """How an input ended.

    Attributes:
        fault: what was wrong with that; empty if it was read, or refused as it should be.
        message: of the refusal, or the error.
    """

    fault: str
    message: str = ""


def in_child(
    work: Callable[[], Any], named: str = "", seconds: float = PROCESSOR_SECONDS
) -> Outcome:
    """How a function ends: it may return, or refuse its input by a ValueError or an OSError.

    Args:
        work: the function.
        named: what a refusal must name, such as the file.
        seconds: processor time that it may take.
    """
    reading, writing = os.pipe()
    child = os.fork()
    if not child:
        _work_in_child(work, named, seconds, (reading, writing))
    os.close(writing)
    with os.fdopen(reading, "rb") as pipe:
        answer = pipe.read()
    _, status = os.waitpid(child, 0)
    if answer:
        outcome: Outcome = pickle.loads(answer)
        return outcome
    ended_by = {signal.SIGXCPU: "takes too long", signal.SIGALRM: "hangs", signal.SIGKILL: "killed"}
    number = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
    return Outcome(ended_by.get(number, f"crashes (status {status})"))


def _work_in_child(
    work: Callable[[], Any], named: str, seconds: float, pipe: tuple[int, int]
) -> None:
    try:
        os.close(pipe[0])
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(WALL_SECONDS)
        used = time.process_time()
        most = round(used + 5 * seconds) + 1
        resource.setrlimit(resource.RLIMIT_CPU, (most, most + 5))
        with open(os.devnull, "w") as null:
            os.dup2(null.fileno(), 1)
            os.dup2(null.fileno(), 2)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        outcome = outcome_of(work, named)
        grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) >> 10
        used = time.process_time() - used
        if grown > MEMORY >> 20:
            outcome = Outcome(f"takes {grown} MB", outcome.message)
        if used > seconds:
            outcome = Outcome(f"takes {used:.1f} s", outcome.message)
        os.write(pipe[1], pickle.dumps(outcome))
    finally:
        os._exit(0)


def outcome_of(work: Callable[[], Any], named: str = "") -> Outcome:
    """How a function ends, in this process; see `in_child`."""
    try:
        with warnings.catch_warnings(), contextlib.suppress(ImportError):
            warnings.simplefilter("ignore")
            work()
    except (ValueError, OSError) as error:
        return _refusal(error, named)
    except BaseException as error:
        return Outcome("traceback", f"{type(error).__name__}: {error}"[:LONGEST_MESSAGE])
    return Outcome("")


def _refusal(error: Exception, named: str) -> Outcome:
    said = str(error)
    if isinstance(error, UnicodeError) or not said:
        return Outcome("no message", repr(error)[:LONGEST_MESSAGE])
    if "\n" in said:
        return Outcome("several lines", said[:LONGEST_MESSAGE])
    if len(said) > LONGEST_MESSAGE:
        return Outcome("a long message", said[:LONGEST_MESSAGE])
    if named not in said:
        return Outcome("does not name the file", said)
    return Outcome("", said)
