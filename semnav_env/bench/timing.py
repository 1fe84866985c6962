"""Times many parts in turn, so that all of them meet the same moods of the machine."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median
from typing import NamedTuple


class Part(NamedTuple):
    """Something to time.

    Attributes:
        name: of the part.
        seconds: does it many times; returns the mean of one time, seconds.
    """

    name: str
    seconds: Callable[[], float]


@dataclass(frozen=True)
class Timing:
    """How long one part takes.

    Attributes:
        name: of the part.
        microseconds: median over the runs of the mean of one call.
        ratio: how often it is done while the yardstick is done once.
    """

    name: str
    microseconds: float
    ratio: float

    @property
    def per_second(self) -> float:
        """Calls per second."""
        return 1e6 / self.microseconds


def timings(parts: Sequence[Part], runs: int) -> list[Timing]:
    """Time parts in turn, after each was done once; the first one is the yardstick.

    Args:
        parts: to time.
        runs: how often each part is timed; the median counts.
    """
    for part in parts:
        part.seconds()
    gc.collect()
    gc.freeze()  # what stands is not searched for garbage again and again
    rounds = [[part.seconds() for part in parts] for _ in range(runs)]
    gc.unfreeze()
    seconds = [median(column) for column in zip(*rounds, strict=True)]
    return [
        Timing(part.name, 1e6 * each, seconds[0] / each)
        for part, each in zip(parts, seconds, strict=True)
    ]


def seconds_per_call(call: Callable[[], object], times: int) -> float:
    """The mean over some calls."""
    begin = time.perf_counter()
    for _ in range(times):
        call()
    return (time.perf_counter() - begin) / times
