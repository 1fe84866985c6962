"""Collects garbage where there is time for it, and not between a scan and its velocity."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager

FULL_EVERY = 64
"""Number of small collections after which a full one is made."""


@contextmanager
def garbage_when_idle() -> Iterator[Callable[[], None]]:
    """Stop automatic collections; gives a function to call in idle moments.

    What exists now, such as modules and compiled kernels, is never looked at again: a full
    collection would take some 70 ms for it.
    """
    was_enabled = gc.isenabled()
    gc.collect()
    gc.freeze()
    gc.disable()
    count = 0

    def collect() -> None:
        nonlocal count
        count += 1
        gc.collect(2 if count % FULL_EVERY == 0 else 0)

    try:
        yield collect
    finally:
        gc.unfreeze()
        if was_enabled:
            gc.enable()
