"""Ctrl-C and SIGTERM: an exception that says which it was, and moments in which they must wait."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import NoReturn

SIGNALS = (signal.SIGINT, signal.SIGTERM)
"""What asks a command to end."""


class Terminated(KeyboardInterrupt):
    """Somebody asked the process to end by SIGTERM, as a cluster does; it ends as after Ctrl-C."""


def interrupt(number: int, frame: FrameType | None) -> NoReturn:
    """Handle one of `SIGNALS` by an exception."""
    raise Terminated if number == signal.SIGTERM else KeyboardInterrupt


def interruption_in(error: BaseException | None) -> KeyboardInterrupt | None:
    """The interruption that an error is, or that it began with; None if there is none.

    Compiled code that is interrupted tells its caller only that something was raised, and so on up
    through all callers: of the interruption are left the causes of the causes of a `SystemError`.
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
    """Keep Ctrl-C, which a terminal sends to all, from processes that are started in the block."""
    if not hasattr(signal, "pthread_sigmask"):  # not on this system
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
