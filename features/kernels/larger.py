"""The larger of two numbers, in a form that a loop over arrays carries out for many at once.

Written as `a if a > b else b`, where b is read from an array and the result is stored in its place,
LLVM 20 and later store under a mask, which takes four times as long on processors of AMD.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic, overload


def larger(a: float, b: float) -> float:
    """The larger of two numbers, neither of which is NaN; of two zeros the sign may be either."""
    return a if a > b else b


def _code(typing_context: Any, a: Any, b: Any) -> Any:
    """Signature and code of the processor's own instruction."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        double = ir.DoubleType()
        kind = ir.FunctionType(double, (double, double))
        function = builder.module.declare_intrinsic("llvm.maxnum", (double,), kind)
        return builder.call(function, arguments, fastmath=("nnan", "nsz"))

    return types.float64(types.float64, types.float64), generate


_maximum: Any = intrinsic(_code)


@overload(larger)
def _compiled_larger(a: float, b: float) -> Callable[[float, float], float]:
    """What compiled code calls as `larger`."""

    def maximum(a: float, b: float) -> float:
        return float(_maximum(a, b))

    return maximum
