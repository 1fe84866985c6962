"""Atomic marks of threads: which robots a thread has taken, and which are done."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic, overload
from numpy.typing import NDArray

Marks = NDArray[np.int64]
"""1 where a mark is set, else 0; shape (n,)."""


def set_mark(marks: Marks, place: int) -> bool:
    """Set a mark; returns whether it was not set before, which is True for one thread only.

    A thread that finds the mark set also sees everything that the other thread wrote before.
    """
    before, marks[place] = marks[place], 1
    return bool(before == 0)


def is_set(marks: Marks, place: int) -> bool:
    """Whether a mark is set."""
    return bool(marks[place] != 0)


def _pointer(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
    array = context.make_array(signature.args[0])(context, builder, arguments[0])
    return builder.gep(array.data, [arguments[1]])


def _code_of_exchange(typing_context: Any, marks: Any, place: Any) -> Any:
    """Signature and code: put 1 in a place, and give what was there, in one step."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        pointer = _pointer(context, builder, signature, arguments)
        return builder.atomic_rmw("xchg", pointer, ir.Constant(ir.IntType(64), 1), "seq_cst")

    return types.int64(marks, types.int64), generate


def _code_of_load(typing_context: Any, marks: Any, place: Any) -> Any:
    """Signature and code: what stands in a place, read before all that is read afterwards."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        pointer = _pointer(context, builder, signature, arguments)
        return builder.load_atomic(pointer, "acquire", 8)

    return types.int64(marks, types.int64), generate


_exchange: Any = intrinsic(_code_of_exchange)
_load: Any = intrinsic(_code_of_load)


@overload(set_mark)
def _compiled_set_mark(marks: Marks, place: int) -> Callable[[Marks, int], bool]:
    """The implementation of `set_mark` in compiled code."""

    def exchange(marks: Marks, place: int) -> bool:
        return bool(_exchange(marks, place) == 0)

    return exchange


@overload(is_set)
def _compiled_is_set(marks: Marks, place: int) -> Callable[[Marks, int], bool]:
    """The implementation of `is_set` in compiled code."""

    def load(marks: Marks, place: int) -> bool:
        return bool(_load(marks, place) != 0)

    return load
