"""How kernels are compiled: linked, or by numba's own `njit`; kept between runs in files.

What a kernel works on is handed over as few things: records with nested arrays, such as `Scratch`,
are one pointer each, where a tuple of the same arrays is some 200 numbers for each call.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar, overload

from numba import njit, types
from numba.core import config
from numba.core.ccallback import CFunc

from semnav_features.kernels import frames_in_kernels  # noqa: F401 - kernels call them
from semnav_features.kernels.kernel_cache import keep_in_files
from semnav_features.kernels.linking import NUMBA_FITS, LinkedKernel, SharedKernel

LINKS = NUMBA_FITS and not os.environ.get("SEMNAV_PLAIN_NUMBA")
"""Whether kernels are linked by `linking`, which compiles them faster."""

Function = TypeVar("Function", bound=Callable[..., Any])


@overload
def kernel(function: Function) -> Function: ...
@overload
def kernel(*, inline: bool = False, shared: bool = False) -> Callable[[Function], Function]: ...
def kernel(
    function: Callable[..., Any] | None = None, *, inline: bool = False, shared: bool = False
) -> Any:
    """Decorate a kernel: a function of plain numbers, tuples, arrays and structures.

    Args:
        function: the function; without it, as in `@kernel(inline=True)`, a decorator is returned.
        inline: put the kernel's statements in place of each call, before types are known.
        shared: let kernels that call it use one copy of its machine code. For large kernels that
            Python calls as well.
    """
    if function is None:
        return partial(kernel, inline=inline, shared=shared)
    if inline:
        return njit(function, error_model="numpy", nogil=True, inline="always")
    options: Any = {"error_model": "numpy", "nogil": True}
    if getattr(config, "DISABLE_JIT", False):
        return njit(function, **options)
    linked = SharedKernel if shared else LinkedKernel
    compiled = linked(function, options) if LINKS else _plain(function, options)
    keep_in_files(compiled, function)
    return compiled


def callback_address(function: Callable[..., Any], arguments: tuple[Any, ...], result: Any) -> int:
    """Address of a function, compiled for these types and kept like a kernel, for C to call it."""
    callback: Any = CFunc(function, (arguments, result), {}, {"error_model": "numpy"})
    keep_in_files(callback, function)
    callback.compile()
    return int(callback.address or 0)


def _plain(function: Callable[..., Any], options: dict[str, Any]) -> Any:
    """Numba's own, but compiled once for all literals, as in f(x, 1) and f(x, 2).

    Numba compiles a kernel for each literal, a third more of them in all.
    """
    compiled: Any = njit(function, **{**options, "no_cfunc_wrapper": True})
    template = compiled.get_call_template

    def of_types(args: Any, kws: Any) -> Any:
        by_name = {name: types.unliteral(kind) for name, kind in kws.items()}
        return template([types.unliteral(kind) for kind in args], by_name)

    compiled.get_call_template = of_types
    return compiled
