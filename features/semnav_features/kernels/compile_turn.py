"""Of processes that need the same kernel at once, one compiles it and the others wait."""

from __future__ import annotations

import gc
import time
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from numba.core import event

from semnav_features.kernels.compile_notice import NOTICE
from semnav_features.sole_writer import sole_writer

LONGEST_WAIT, WAIT_STEP = 300.0, 0.05
"""Time for which another process is waited for, and between two looks, seconds. The largest
kernel takes half a minute of processor time."""


class CompileTurns(event.Listener):
    """The kernels that this process is compiling, each inside the one that calls it.

    Otherwise the processes that a training starts would each compile all kernels. What a process
    waits for is called by what it holds; as no kernel calls itself, no two wait for each other.
    """

    def __init__(self) -> None:
        self._held: dict[Path, ExitStack] = {}
        self._depth = 0
        self._collects_garbage = False

    def begin(self, path: Path) -> None:
        """Wait until the file of a kernel is there or nobody writes it; then let others wait."""
        held = ExitStack()
        until = time.monotonic() + LONGEST_WAIT
        while not path.exists() and time.monotonic() < until:
            try:
                held.enter_context(sole_writer(path))
                break
            except BlockingIOError:
                with NOTICE.while_compiling():
                    time.sleep(WAIT_STEP)
                    NOTICE.work_goes_on()
            except OSError:  # nothing can be kept here
                break
        self._held[path] = held

    def end(self, path: Path) -> None:
        """Let others go on: the file of a kernel is there, or cannot be."""
        self._held.pop(path, ExitStack()).close()

    def on_start(self, event: Any) -> None:
        """Numba begins to compile; collecting garbage meanwhile takes a tenth of the time."""
        if self._depth == 0:
            self._collects_garbage = gc.isenabled()
            gc.disable()
            NOTICE.begin()
        self._depth += 1
        NOTICE.work_goes_on()

    def on_end(self, event: Any) -> None:
        """Numba has compiled a function or has failed, after which nobody waits for this process.

        Inside a kernel it may fail and go on: it tries what NumPy's functions may stand for.
        """
        self._depth -= 1
        if self._depth > 0:
            return
        NOTICE.end()
        if self._collects_garbage:
            gc.enable()
        compiled = event.data["dispatcher"].overloads
        if tuple(event.data["args"]) not in compiled:
            for path in list(self._held):
                self.end(path)


TURNS = CompileTurns()
"""Of this process; numba compiles in one thread at a time."""

event.register("numba:compile", TURNS)
