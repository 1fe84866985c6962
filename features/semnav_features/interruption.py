"""Ctrl-C and SIGTERM as exceptions, and blocks of code in which they are delayed."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

SIGNALS = (signal.SIGINT, signal.SIGTERM)
"""Signals that ask a command to end."""


class Terminated(KeyboardInterrupt):
    """The process got SIGTERM, as from a cluster; it ends as after Ctrl-C."""


def interrupt(number: int, frame: FrameType | None) -> NoReturn:
    """Handle one of `SIGNALS` by an exception."""
    raise Terminated if number == signal.SIGTERM else KeyboardInterrupt


def interruption_in(error: BaseException | None) -> KeyboardInterrupt | None:
    """The interruption that an error is, or that caused it; None if there is none.

    Compiled code that is interrupted reports to its caller only that something was raised, and so
    on through all callers. The interruption is then a cause in the chain of a `SystemError`.
    """
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Delay `SIGNALS` until the end of the block."""
    held: list[int] = []
    before = {number: signal.getsignal(number) for number in SIGNALS}
    known = {number: handler for number, handler in before.items() if handler is not None}
    try:
        for number in known:
            signal.signal(number, lambda number, _: held.append(number))
    except ValueError:  # not the main thread, which alone gets interruptions
        yield
        return
    try:
        yield
    finally:
        for number, handler in known.items():
            signal.signal(number, handler)
        if held:
            signal.raise_signal(held[0])


@contextmanager
def for_this_process_alone() -> Iterator[None]:
    """Keep Ctrl-C, which a terminal sends to all processes, from those started in the block."""
    if not hasattr(signal, "pthread_sigmask"):  # not on this system
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
