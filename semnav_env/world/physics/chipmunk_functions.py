"""Chipmunk's functions for compiled code, without Python in between.

Pymunk calls Chipmunk through cffi, which knows the addresses of its functions. Their names are
given to LLVM, so that compiled code finds them, also when it comes out of a cache.
"""

from __future__ import annotations

from typing import Any

import llvmlite.binding
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from pymunk._chipmunk import ffi, lib

NUMBER, ADDRESS, INDEX = types.float64, types.uint64, types.int32
"""Types of arguments and results; an object of Chipmunk is given by its address."""


def address(pointer: Any) -> int:
    """The address to which a cffi pointer points."""
    return int(ffi.cast("uintptr_t", pointer))


def simple_function(name: str, result: Any, *arguments: Any) -> Any:
    """A function whose arguments and result are numbers and addresses."""
    _make_known(name)
    return types.ExternalFunction(name, result(*arguments))


def vector_of(name: str) -> Any:
    """A function from an object to a vector."""
    found = _vector_function(name, ADDRESS)

    @intrinsic
    def call(typing_context: Any, thing: Any) -> Any:
        return found

    return call


def vector_at(name: str) -> Any:
    """A function from an object and an index to a vector."""
    found = _vector_function(name, ADDRESS, INDEX)

    @intrinsic
    def call(typing_context: Any, thing: Any, index: Any) -> Any:
        return found

    return call


def pair_of(name: str) -> Any:
    """A function from an object to two others, whose addresses it writes into its arguments."""
    _make_known(name)

    def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        (thing,) = values
        places = [cgutils.alloca_once(builder, thing.type) for _ in range(2)]
        kind = ir.FunctionType(ir.VoidType(), [thing.type, *(place.type for place in places)])
        builder.call(cgutils.get_or_insert_function(builder.module, kind, name), [thing, *places])
        return cgutils.pack_array(builder, [builder.load(place) for place in places])

    @intrinsic
    def call(typing_context: Any, thing: Any) -> Any:
        return types.UniTuple(ADDRESS, 2)(ADDRESS), generate

    return call


def _vector_function(name: str, *arguments: Any) -> Any:
    """Signature and code of a call that returns a vector."""
    _make_known(name)

    def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        vector = context.get_value_type(signature.return_type)
        kind = ir.FunctionType(vector, [value.type for value in values])
        return builder.call(cgutils.get_or_insert_function(builder.module, kind, name), values)

    return types.UniTuple(NUMBER, 2)(*arguments), generate


def _make_known(name: str) -> None:
    llvmlite.binding.add_symbol(name, address(ffi.addressof(lib, name)))
