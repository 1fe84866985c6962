"""Moments in which Ctrl-C and SIGTERM must wait."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Delay an interruption until the end of the block, and then let it do what it does."""
    held: list[int] = []
    numbers = (signal.SIGINT, signal.SIGTERM)
    try:
        before = [signal.signal(each, lambda number, _: held.append(number)) for each in numbers]
    except ValueError:  # not the main thread, which alone gets interruptions
        yield
        return
    try:
        yield
    finally:
        for number, handler in zip(numbers, before, strict=True):
            signal.signal(number, handler)
        if held:
            signal.raise_signal(held[0])
