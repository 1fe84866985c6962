"""How kernels are compiled: by numba's `njit`, and kept between runs in files of our own.

What a kernel works on is handed over as few things: records with nested arrays, such as `Scratch`,
are one pointer each, where a tuple of the same arrays is some 200 numbers for each call.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar, overload

from numba import njit, types
from numba.core import config
from numba.core.ccallback import CFunc

from semnav_features.kernels import frames_in_kernels  # noqa: F401 - kernels call them
from semnav_features.kernels.kernel_cache import keep_in_files

Function = TypeVar("Function", bound=Callable[..., Any])


@overload
def kernel(function: Function) -> Function: ...
@overload
def kernel(*, inline: bool = False) -> Callable[[Function], Function]: ...
def kernel(function: Callable[..., Any] | None = None, *, inline: bool = False) -> Any:
    """Decorate a kernel: a function of plain numbers, tuples, arrays and structures.

    Args:
        function: the function; without it, as in `@kernel(inline=True)`, a decorator is returned.
        inline: put the kernel's statements in place of each call, before types are known.
    """
    if function is None:
        return partial(kernel, inline=inline)
    if inline:
        return njit(function, error_model="numpy", nogil=True, inline="always")
    options: Any = {"error_model": "numpy", "nogil": True, "no_cfunc_wrapper": True}
    compiled = njit(function, **options)
    if not getattr(config, "DISABLE_JIT", False):
        _take_literals_by_type(compiled)
        keep_in_files(compiled, function)
    return compiled


def callback_address(function: Callable[..., Any], arguments: tuple[Any, ...], result: Any) -> int:
    """Address of a function, compiled for these types and kept like a kernel, for C to call it."""
    callback: Any = CFunc(function, (arguments, result), {}, {"error_model": "numpy"})
    keep_in_files(callback, function)
    callback.compile()
    return int(callback.address or 0)


def _take_literals_by_type(compiled: Any) -> None:
    """Let a kernel that is called with literals, as in f(x, 1) and f(x, 2), be compiled once.

    Numba compiles a kernel for each literal, a third more of them in all.
    """
    template = compiled.get_call_template

    def of_types(args: Any, kws: Any) -> Any:
        by_name = {name: types.unliteral(kind) for name, kind in kws.items()}
        return template([types.unliteral(kind) for kind in args], by_name)

    compiled.get_call_template = of_types
