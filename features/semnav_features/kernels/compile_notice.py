"""Tells a user who waits that kernels are being compiled."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

PATIENCE = 1.0
"""Seconds of compiling that pass without a word."""


class CompileNotice:
    """Says once in a process, on stderr, that kernels are compiled; not before it takes long."""

    def __init__(self) -> None:
        self._said = False
        self._spent = 0.0
        self._since: float | None = None

    def begin(self) -> None:
        """Count the time from now on, unless it is counted already."""
        if self._since is None:
            self._since = time.perf_counter()

    def end(self) -> None:
        """Count no more."""
        if self._since is not None:
            self._spent += time.perf_counter() - self._since
            self._since = None

    @contextmanager
    def while_compiling(self) -> Iterator[None]:
        """Count the time that passes inside; one thread may compile, and another wait for it."""
        is_first = self._since is None
        self.begin()
        try:
            yield
        finally:
            if is_first:
                self.end()

    def work_goes_on(self) -> None:
        """Say so, if the user has waited for long enough."""
        since = self._since
        if self._said or since is None:
            return
        if self._spent + time.perf_counter() - since > PATIENCE:
            self._said = True
            print(
                "semnav-env: compiling kernels used for the first time: about a minute on an "
                "idle machine, several on a busy one; `semnav doctor --warm` compiles all",
                file=sys.stderr,
                flush=True,
            )


NOTICE = CompileNotice()
"""Of this process."""
