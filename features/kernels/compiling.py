"""How the kernels of a scan are compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

from numba import njit

_Function = TypeVar("_Function", bound=Callable[..., Any])

_OPTIONS: dict[str, Any] = {
    "cache": True,
    "error_model": "numpy",
    "nogil": True,
    "_nrt": False,
}


def kernel(function: _Function) -> _Function:
    """Compile a kernel that only works on its caller's arrays.

    Compiled code counts the references to every array that it touches, by atomic additions, and a
    scan's working memory is two dozen arrays: the counting took more time than the work, and much
    of the time that compiling takes. Such a kernel does not count (`_nrt`), so it can make no
    arrays (it would not compile), and returns none.
    """
    return cast(_Function, njit(**_OPTIONS)(function))
