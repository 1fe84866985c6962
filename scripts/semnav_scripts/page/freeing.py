"""Gives memory that is used no more back to the system."""

from __future__ import annotations

import ctypes
import gc


def free_memory() -> None:
    """Collect what only itself refers to, and return what the allocator keeps.

    Worlds are cycles of large arrays, and films take much memory for a while. The allocator of the
    GNU C library keeps what each thread has freed, so the server would grow with every session.
    """
    gc.collect()
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)  # other libraries have no such thing
    if trim is not None:
        trim(0)
