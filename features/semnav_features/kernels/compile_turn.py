"""Of processes that need the same kernel at once, one compiles it and the others wait."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from semnav_features.kernels.compile_notice import NOTICE
from semnav_features.sole_writer import sole_writer

LONGEST_WAIT, WAIT_STEP = 300.0, 0.05
"""Time for which another process is waited for, and between two looks, seconds. The largest
kernel takes half a minute of processor time."""


@contextmanager
def compile_turn(path: Path) -> Iterator[None]:
    """Wait until the file of a kernel is there or nobody writes it; then let others wait.

    Otherwise the processes that a training starts would each compile all kernels.
    """
    with ExitStack() as held:
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
        yield
