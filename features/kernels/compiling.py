"""How the kernels of a scan are compiled."""

from __future__ import annotations

from numba import njit

kernel = njit(cache=True, error_model="numpy", nogil=True, _nrt=False)
"""Decorator of a kernel that only works on its caller's arrays.

Compiled code counts the references to every array that it touches, by atomic additions, and a
scan's working memory is two dozen arrays: the counting took twice as long as the work, and most of
the time that compiling takes. Such a kernel does not count, so it can make no arrays (it would not
compile), and returns none.
"""
