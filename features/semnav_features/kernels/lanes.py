"""Eight numbers of an array at once, for kernels whose inner loops are short.

What the compiler makes of a loop over an array takes the last numbers, up to 31, one by one, and
asks beforehand whether arrays overlap. Where most loops are shorter than that, these take all the
time. With lanes a kernel says itself what becomes of eight neighbours:

    for i in range(first, last, WIDTH):
        store(ys, i, 2.0 * load(xs, i) + 1.0)

In plain Python lanes are NumPy arrays of shape (8,).
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import lower_builtin, models, register_model, type_callable

from semnav_features.frames import FloatArray

WIDTH = 8
"""How many numbers lanes hold."""

Lanes: TypeAlias = Any
"""Eight numbers; what they are added to or multiplied with may be one number for all."""

Mask: TypeAlias = Any
"""Eight truth values."""


def load(array: FloatArray, place: int) -> Lanes:
    """The numbers of a contiguous array from a place on; there must be eight."""
    return array[place : place + WIDTH].copy()


def store(array: FloatArray, place: int, lanes: Lanes) -> None:
    """Write eight numbers into a contiguous array, from a place on."""
    array[place : place + WIDTH] = lanes


def spread(number: float) -> Lanes:
    """The same number eight times."""
    return np.full(WIDTH, number)


def first_lanes(count: int) -> Mask:
    """A mask that holds in the first `count` lanes."""
    return np.arange(WIDTH) < count


def select(mask: Mask, lanes: Lanes, others: Lanes) -> Lanes:
    """Numbers where the mask holds, and others elsewhere."""
    return np.where(mask, lanes, others)


def bits(mask: Mask) -> Any:
    """A number in which bit k is set where the mask holds in lane k."""
    return np.uint64(np.packbits(mask, bitorder="little")[0])


def larger(one: Any, other: Any) -> Any:
    """The larger of two numbers or in each lane, never NaN; of two zeros the sign may be either.

    Written as `a if a > b else b` in a loop over arrays, where b is read from the place in which
    the result is stored, LLVM 20 and later store under a mask, which takes four times as long on
    processors of AMD.
    """
    return np.maximum(one, other)


def smaller(one: Lanes, other: Lanes) -> Lanes:
    """The smaller one in each lane; as `larger`."""
    return np.minimum(one, other)


def largest(lanes: Lanes) -> float:
    """The largest of the eight."""
    return float(lanes.max())


def smallest(lanes: Lanes) -> float:
    """The smallest of the eight."""
    return float(lanes.min())


_VECTOR, _PLACE = ir.VectorType(ir.DoubleType(), WIDTH), ir.IntType(32)


class LanesType(types.Type):
    """Eight numbers in compiled code: a vector of the processor, or a few."""


class MaskType(types.Type):
    """Eight truth values in compiled code."""


LANES, MASK = LanesType("lanes"), MaskType("mask")


@register_model(LanesType)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _VECTOR)


@register_model(MaskType)
class _MaskModel(models.PrimitiveModel):
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, ir.VectorType(ir.IntType(1), WIDTH))


class _Row:
    """Stands for contiguous arrays of 64-bit floats among the kinds of arguments."""


def _fits(kind: Any, given: Any) -> bool:
    """Whether a type is of a kind."""
    if kind is _Row:
        is_row = isinstance(given, types.Array) and (given.ndim, given.layout) == (1, "C")
        return bool(is_row and given.dtype == types.float64)
    return bool(isinstance(given, kind))


def _compiled(function: Callable[..., Any], result: Any, *kinds: Any) -> Callable[..., Any]:
    """Decorate what builds the code of a function of these kinds of arguments."""

    def typed(*given: Any) -> Any:
        return result if all(map(_fits, kinds, given)) else None

    def register(build: Callable[..., Any]) -> Callable[..., Any]:
        def lower(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            if kinds[0] is _Row:
                array = context.make_array(signature.args[0])(context, builder, values[0])
                first = builder.gep(array.data, [values[1]])
                values = builder.bitcast(first, _VECTOR.as_pointer()), *values[2:]
            elif result in (LANES, MASK):
                values = [_spread(builder, each) for each in values]
            return build(builder, *values)

        typers = typed, lambda a: typed(a), lambda a, b: typed(a, b), lambda a, b, c: typed(a, b, c)
        type_callable(function)(lambda context: typers[len(kinds)])
        classes = [types.Array if kind is _Row else kind for kind in kinds]
        lower_builtin(function, *classes)(lower)
        return build

    return register


def _spread(builder: Any, value: Any) -> Any:
    """One value in all lanes; lanes as they are."""
    if isinstance(value.type, ir.VectorType):
        return value
    nothing = ir.Constant(ir.VectorType(value.type, WIDTH), ir.Undefined)
    one = builder.insert_element(nothing, value, _PLACE(0))
    return builder.shuffle_vector(one, nothing, _places([0] * WIDTH))


def _places(numbers: Sequence[int]) -> Any:
    """Which lanes to take."""
    return ir.Constant(ir.VectorType(_PLACE, len(numbers)), list(numbers))


@_compiled(load, LANES, _Row, types.Integer)
def _load(builder: Any, pointer: Any) -> Any:
    return builder.load(pointer, align=8)


@_compiled(store, types.void, _Row, types.Integer, LanesType)
def _store(builder: Any, pointer: Any, lanes: Any) -> Any:
    builder.store(lanes, pointer, align=8)
    return ir.Constant(ir.IntType(8).as_pointer(), None)


@_compiled(spread, LANES, types.Float)
def _spread_number(builder: Any, lanes: Any) -> Any:
    return lanes


@_compiled(first_lanes, MASK, types.Integer)
def _first_lanes(builder: Any, count: Any) -> Any:
    numbers = ir.Constant(ir.VectorType(count.type.element, WIDTH), list(range(WIDTH)))
    return builder.icmp_signed("<", numbers, count)


@_compiled(select, LANES, MaskType, LanesType, LanesType)
def _select(builder: Any, mask: Any, lanes: Any, others: Any) -> Any:
    return builder.select(mask, lanes, others)


def _extreme(name: str) -> Callable[..., Any]:
    """The code of the processor's own instruction, for numbers that are not NaN."""

    def build(builder: Any, one: Any, other: Any) -> Any:
        kind, suffix = one.type, "f64"
        if isinstance(kind, ir.VectorType):
            suffix = f"v{kind.count}f64"
        function = cgutils.get_or_insert_function(
            builder.module, ir.FunctionType(kind, (kind, kind)), f"llvm.{name}.{suffix}"
        )
        return builder.call(function, (one, other), fastmath=("nnan", "nsz"))

    return build


_LARGER, _SMALLER = _extreme("maxnum"), _extreme("minnum")
_compiled(larger, types.float64, types.Float, types.Float)(_LARGER)
_compiled(larger, LANES, LanesType, LanesType)(_LARGER)
_compiled(smaller, LANES, LanesType, LanesType)(_SMALLER)


def _folded(join: Callable[..., Any]) -> Callable[..., Any]:
    """The code that joins lanes four apart, then two, then one."""

    def build(builder: Any, lanes: Any) -> Any:
        for half in (4, 2, 1):
            low, high = (
                builder.shuffle_vector(lanes, lanes, _places(range(first, first + half)))
                for first in (0, half)
            )
            lanes = join(builder, low, high)
        return builder.extract_element(lanes, _PLACE(0))

    return build


_compiled(largest, types.float64, LanesType)(_folded(_LARGER))
_compiled(smallest, types.float64, LanesType)(_folded(_SMALLER))


def _fabs(builder: Any, lanes: Any) -> Any:
    kind = ir.FunctionType(_VECTOR, (_VECTOR,))
    function = cgutils.get_or_insert_function(builder.module, kind, "llvm.fabs.v8f64")
    return builder.call(function, (lanes,))


_compiled(abs, LANES, LanesType)(_fabs)


@_compiled(bits, types.uint64, MaskType)
def _bits(builder: Any, mask: Any) -> Any:
    return builder.zext(builder.bitcast(mask, ir.IntType(WIDTH)), ir.IntType(64))


def _comparison(sign: str) -> Callable[..., Any]:
    """The code that compares lanes; a NaN compares with nothing."""
    return lambda builder, one, other: builder.fcmp_ordered(sign, one, other)


_compiled(operator.and_, MASK, MaskType, MaskType)(ir.IRBuilder.and_)
_compiled(operator.or_, MASK, MaskType, MaskType)(ir.IRBuilder.or_)
for _kinds in ((LanesType, LanesType), (LanesType, types.Float), (types.Float, LanesType)):
    _compiled(operator.add, LANES, *_kinds)(ir.IRBuilder.fadd)
    _compiled(operator.sub, LANES, *_kinds)(ir.IRBuilder.fsub)
    _compiled(operator.mul, LANES, *_kinds)(ir.IRBuilder.fmul)
    _compiled(operator.ge, MASK, *_kinds)(_comparison(">="))
    _compiled(operator.gt, MASK, *_kinds)(_comparison(">"))
    _compiled(operator.le, MASK, *_kinds)(_comparison("<="))
    _compiled(operator.lt, MASK, *_kinds)(_comparison("<"))
