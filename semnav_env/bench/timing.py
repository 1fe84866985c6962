"""Times many parts in turn, so that a change of the machine's speed affects all of them."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import count
from statistics import median
from typing import NamedTuple


class Part(NamedTuple):
    """A function to time.

    Attributes:
        name: of the part.
        seconds: calls the function many times; returns the mean duration of a call, seconds.
    """

    name: str
    seconds: Callable[[], float]


@dataclass(frozen=True)
class Timing:
    """The measured duration of one part.

    Attributes:
        name: of the part.
        microseconds: median over the runs of the mean of one call.
        ratio: number of calls in the time of one call of the yardstick.
    """

    name: str
    microseconds: float
    ratio: float

    @property
    def per_second(self) -> float:
        """Calls per second."""
        return 1e6 / self.microseconds


def timings(
    parts: Sequence[Part], runs: int, tell: Callable[[str, float], None] = lambda name, share: None
) -> list[Timing]:
    """Time parts in turn, after one call of each; the first one is the yardstick.

    Args:
        parts: to time.
        runs: how often each part is timed; the median counts.
        tell: is told each part before it is timed, and the share of all calls that are done.
    """
    calls = len(parts) * (runs + 1)
    done = count()

    def timed(part: Part) -> float:
        tell(part.name, next(done) / calls)
        return part.seconds()

    for part in parts:
        timed(part)
    gc.collect()
    gc.freeze()  # what stands is not searched for garbage again and again
    rounds = [[timed(part) for part in parts] for _ in range(runs)]
    gc.unfreeze()
    seconds = [median(column) for column in zip(*rounds, strict=True)]
    return [
        Timing(part.name, 1e6 * each, seconds[0] / each)
        for part, each in zip(parts, seconds, strict=True)
    ]


def seconds_per_call(
    call: Callable[[], object], times: int, clock: Callable[[], float] = time.perf_counter
) -> float:
    """The mean over some calls, by wall time or another clock."""
    begin = clock()
    for _ in range(times):
        call()
    return (clock() - begin) / times
