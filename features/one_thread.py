"""Keeps a second thread out of an object whose arrays compiled code reads and writes."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import wraps
from typing import Concatenate, ParamSpec, Protocol, TypeVar


class ThreadDoor:
    """Lets one thread in at a time. A copy is a door of its own, with nobody inside.

    Attributes:
        enter: called with False, enters if no other thread is inside; whether it did.
        leave: called once for each time that `enter` did.
    """

    __slots__ = ("enter", "leave")

    def __init__(self) -> None:
        # The thread that is inside may enter again: Ctrl-C may come before it could leave.
        lock = threading.RLock()
        self.enter, self.leave = lock.acquire, lock.release

    def __reduce__(self) -> tuple[type[ThreadDoor], tuple[()]]:
        return ThreadDoor, ()


class OneThreaded(Protocol):
    """An object of which one thread at a time may run the guarded methods."""

    thread_door: ThreadDoor


Self = TypeVar("Self", bound=OneThreaded)
P = ParamSpec("P")
R = TypeVar("R")


def for_one_thread(method: Callable[Concatenate[Self, P], R]) -> Callable[Concatenate[Self, P], R]:
    """Decorate a method: a `RuntimeError` if another thread runs such a method of the object.

    Compiled code leaves Python's lock, so two threads would write the same arrays at once.
    """

    @wraps(method)
    def guarded(self: Self, /, *args: P.args, **kwargs: P.kwargs) -> R:
        door = self.thread_door
        if not door.enter(False):
            raise RuntimeError(
                f"another thread is using this {type(self).__name__}: one at a time, or one of its "
                "own for each thread"
            )
        try:
            return method(self, *args, **kwargs)
        finally:
            door.leave()

    return guarded
