"""How kernels are compiled: each body once, and a door for Python only where Python calls it.

Numba makes each function callable from Python, optimises it and turns it into machine code, and
then does the same again for every function that calls it, whose code contains it. Of the time
that compiling takes that is half. Here the body of a kernel stays intermediate code; only a kernel
that Python calls is linked with all that it calls, optimised and turned into machine code.
"""

from __future__ import annotations

import gc
import os
from collections.abc import Callable, Iterator, Set
from contextlib import contextmanager
from copy import copy
from functools import partial
from importlib import import_module
from inspect import signature
from operator import attrgetter
from typing import Any, TypeVar, overload

from numba import njit, types
from numba.core import compiler, config, dispatcher
from numba.core.ccallback import CFunc
from numba.core.codegen import JITCodeLibrary
from numba.core.cpu import CPUContext
from numba.core.environment import Environment
from numba.core.registry import CPUDispatcher
from numba.core.runtime.context import NRTContext

from semnav_features.kernels import frames_in_kernels  # noqa: F401 - kernels call them
from semnav_features.kernels.cache_folder import cache_folder
from semnav_features.kernels.kernel_cache import KernelCache

NUMBA_FITS = not os.environ.get("SEMNAV_PLAIN_NUMBA") and (
    all(
        hasattr(JITCodeLibrary, name)
        for name in (
            "_optimize_final_module",
            "_finalize_final_module",
            "_finalize_dynamic_globals",
        )
    )
    and "library" in signature(compiler.compile_extra).parameters
    and hasattr(CPUContext, "create_cpython_wrapper")
)
"""Whether numba has the inner parts that `Kernel` uses, as versions 0.61 to 0.68 have. Otherwise
kernels are numba's own, which take longer to compile."""


Function = TypeVar("Function", bound=Callable[..., Any])


@overload
def kernel(function: Function) -> Function: ...
@overload
def kernel(
    *, counts_references: bool = False, borrows: bool = False, inline: bool = False
) -> Callable[[Function], Function]: ...
def kernel(
    function: Callable[..., Any] | None = None,
    *,
    counts_references: bool = False,
    borrows: bool = False,
    inline: bool = False,
) -> Any:
    """Decorate a kernel: a function of plain numbers, tuples, arrays and structures.

    Args:
        function: the function; without it, as in `@kernel(inline=True)`, a decorator is returned.
        counts_references: the kernel makes or returns arrays, or changes structures. Others work on
            their caller's arrays alone and need not count the references to these, by atomic
            additions, which takes twice as long as the work of a scan.
        borrows: the kernel takes structures and only reads their fields; likewise.
        inline: put the kernel's statements in place of each call, before types are known.
    """
    if function is None:
        options = {"counts_references": counts_references, "borrows": borrows}
        return partial(kernel, **options, inline=inline)
    if inline:
        return njit(function, error_model="numpy", nogil=True, inline="always")
    if getattr(config, "DISABLE_JIT", False) or not NUMBA_FITS:
        # Numba's own folder may be one where nothing can be written.
        config.CACHE_DIR = str(cache_folder())  # type: ignore[attr-defined]
        return njit(function, error_model="numpy", nogil=True, cache=True)
    return Kernel(function, counts_references, borrows)


class Kernel(CPUDispatcher):
    """A compiled function that Python and other kernels call."""

    def __init__(
        self, function: Callable[..., Any], counts_references: bool, borrows: bool
    ) -> None:
        options = {
            "nopython": True,
            "boundscheck": None,
            "error_model": "numpy",
            "nogil": True,
            "_nrt": counts_references,
            "no_cpython_wrapper": True,
            "no_cfunc_wrapper": True,
        }
        super().__init__(function, targetoptions=options)
        self.body = KernelBody(function, options, borrows)
        self._compiler = _LinkingCompiler(self.body)
        self._cache = KernelCache(function)

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """What another kernel needs to know to call this one; a literal counts as its type."""
        args = [types.unliteral(arg) for arg in args]
        return self.body.get_call_template(args, {k: types.unliteral(v) for k, v in kws.items()})

    def get_overload(self, sig: Any) -> Any:
        """What another kernel calls."""
        return self.body.get_overload(sig)

    def __reduce__(self) -> tuple[Any, ...]:
        """A kernel is pickled, and copied, by its name."""
        return _kernel_named, (self.py_func.__module__, self.py_func.__qualname__)

    def compile(self, sig: Any) -> Any:
        """Compile for a signature, or load what was compiled before."""
        context: Any = self.targetctx
        with self._cache.turn_to_compile(sig, context.codegen()), _no_garbage_collection():
            return super().compile(sig)


def callback_address(function: Callable[..., Any], arguments: tuple[Any, ...], result: Any) -> int:
    """Address of a function, compiled for these types and kept like a kernel, for C to call it."""
    callback: Any = CFunc(function, (arguments, result), {}, {"error_model": "numpy"})
    callback._cache = KernelCache(function)
    callback.compile()
    return int(callback.address or 0)


def _kernel_named(module: str, name: str) -> Any:
    return attrgetter(name)(import_module(module))


class KernelBody(CPUDispatcher):
    """A kernel as other kernels call it."""

    def __init__(
        self, function: Callable[..., Any], targetoptions: dict[str, Any], borrows: bool
    ) -> None:
        super().__init__(function, targetoptions=targetoptions)
        self._compiler = _BodyCompiler(
            function, self.targetdescr, targetoptions, {}, compiler.Compiler
        )
        self._compiler.borrows = borrows


_FunctionCompiler: Any = getattr(dispatcher, "_FunctionCompiler", object)


class _BodyLibrary(JITCodeLibrary):
    """Intermediate code to be linked into that of a caller."""

    def _optimize_final_module(self) -> None:
        """Leave it to the caller's library."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """Null: there is no machine code."""
        return 0

    @property
    def codegen(self) -> Any:
        """Asked for by numba in order to set the environment of machine code."""
        return _NoEnvironments()


class _LinkedLibrary(JITCodeLibrary):
    """Machine code of which only some functions can be called from outside.

    The compiler may then put the others in place of their calls, and hand over to them only what
    they use, not all arrays of a structure. They lose their names: a function is looked up by its
    name in all modules, and such a copy would be found in place of the one that can be called.

    Attributes:
        exported: names of the functions that can be called.
    """

    exported: Set[str] = frozenset()

    def _optimize_final_module(self) -> None:
        for k, function in enumerate(self._final_module.functions):
            if not function.is_declaration and function.name not in self.exported:
                function.linkage, function.name = "internal", f"inner.{k}"
        super()._optimize_final_module()


class _NoEnvironments:
    def set_env(self, env_name: str, env: Any) -> None:
        """Do nothing, for there is no machine code."""


class _BorrowingContext(CPUContext):
    """Reads the fields of structures, though it counts no references."""

    @property
    def nrt(  # pyright: ignore[reportIncompatibleVariableOverride]
        self,
    ) -> Any:
        """What reads structures."""
        return NRTContext(self, True)


class _BodyCompiler(_FunctionCompiler):
    """Compiles to intermediate code."""

    borrows = False

    def _compile_core(self, args: Any, return_type: Any) -> Any:
        from semnav_features.kernels.compile_notice import NOTICE  # kept kernels need none

        NOTICE.work_goes_on()
        flags = compiler.Flags()
        self.targetdescr.options.parse_as_flags(flags, self.targetoptions)
        context = self.targetdescr.target_context
        if self.borrows:
            context = copy(context)
            context.__class__ = _BorrowingContext
        return compiler.compile_extra(
            self.targetdescr.typing_context,
            context,
            self.py_func,
            args=args,
            return_type=return_type,
            flags=flags,
            locals=self.locals,
            library=_BodyLibrary(context.codegen(), self.py_func.__qualname__),
            pipeline_class=self.pipeline_class,
        )


class _LinkingCompiler(_FunctionCompiler):
    """Links the body of a kernel with all that it calls, and makes it callable from Python."""

    def __init__(self, body: KernelBody) -> None:
        super().__init__(body.py_func, body.targetdescr, body.targetoptions, {}, compiler.Compiler)
        self._body = body

    def _compile_core(self, args: Any, return_type: Any) -> Any:
        from semnav_features.kernels.compile_notice import NOTICE

        with NOTICE.while_compiling():
            self._body.compile(args if return_type is None else return_type(*args))
            return _linked(self._body.overloads[tuple(args)])


def _linked(body: Any) -> Any:
    """A body's compile result with machine code.

    What makes it callable from Python has an environment of its own, for that of the body is also
    kept with each caller, which does not know what Python's types need.
    """
    context, door = body.target_context, copy(body.fndesc)
    if isinstance(context, _BorrowingContext):  # Python hands over structures with a reference
        context = context.subtarget(enable_nrt=True)
        context.__class__ = CPUContext  # pyright: ignore[reportAttributeAccessIssue]
    door.env_name += ".python"
    environment = Environment.from_fndesc(door)
    library: Any = _LinkedLibrary(context.codegen(), door.qualname)
    library.exported = {door.llvm_func_name, door.llvm_cpython_wrapper_name}
    library.enable_object_caching()
    library.add_linking_library(body.library)
    context.create_cpython_wrapper(library, door, environment, body.call_helper, release_gil=True)
    function = context.get_executable(library, door, environment)
    context.insert_user_function(function, door, [library])
    linked = body._replace(
        library=library,
        entry_point=function,
        fndesc=door,
        environment=environment,
        metadata={**body.metadata, "timers": {}},
    )
    for referenced in linked._find_referenced_environments():
        library.codegen.set_env(referenced.env_name, referenced)
    return linked


@contextmanager
def _no_garbage_collection() -> Iterator[None]:
    """Compiling makes millions of objects that stay; looking through them takes a tenth of it."""
    if not gc.isenabled():
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.enable()
