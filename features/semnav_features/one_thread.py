"""Excludes a second thread from an object whose arrays compiled code reads and writes."""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar, cast

Method = TypeVar("Method", bound=Callable[..., Any])


class ThreadDoor:
    """Lets one thread in at a time: `enter(False)` says whether it did, then `leave()`.

    The thread that is inside may enter again, because Ctrl-C may come before it could leave. A copy
    is independent and has no thread inside.
    """

    __slots__ = ("enter", "leave")

    def __init__(self) -> None:
        lock = threading.RLock()
        self.enter, self.leave = lock.acquire, lock.release

    def __reduce__(self) -> tuple[type[ThreadDoor], tuple[()]]:
        return ThreadDoor, ()


def for_one_thread(method: Method) -> Method:
    """Decorate a method of an object with a `thread_door`: one thread at a time may be in it.

    Compiled code leaves Python's lock, so two threads would write the same arrays at once. A second
    one gets a `RuntimeError`.
    """

    @wraps(method)
    def guarded(self: Any, /, *args: Any, **kwargs: Any) -> Any:
        door = self.thread_door
        if not door.enter(False):
            used = f"another thread is using this {type(self).__name__}"
            raise RuntimeError(f"{used}: one at a time, or one of its own for each thread")
        try:
            return method(self, *args, **kwargs)
        finally:
            door.leave()

    return cast(Method, guarded)
