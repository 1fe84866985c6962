"""Compiles kernels in 0.6 of the time that numba takes by itself, by its inner parts.

Numba optimises each function and turns it into machine code, and does so again in every function
that calls it, whose code contains it. Here the body of a kernel stays intermediate code; only a
kernel that Python calls is linked with all that it calls, optimised and turned into machine code.
`SEMNAV_PLAIN_NUMBA=1` does without this. docs/lab/speed.md compares both ways.
"""

from __future__ import annotations

from collections.abc import Callable, Set
from copy import copy
from importlib import import_module
from inspect import signature
from operator import attrgetter
from typing import Any

from numba import types
from numba.core import compiler, dispatcher
from numba.core.codegen import JITCodeLibrary
from numba.core.environment import Environment
from numba.core.registry import CPUDispatcher
from numba.core.sigutils import normalize_signature

_INNER = ("_optimize_final_module", "_finalize_final_module", "_finalize_dynamic_globals")
NUMBA_FITS = (
    all(hasattr(JITCodeLibrary, name) for name in _INNER)
    and "library" in signature(compiler.compile_extra).parameters
)
"""Whether numba has the inner parts that are used here, as versions 0.61 to 0.68 have."""

_FunctionCompiler: Any = getattr(dispatcher, "_FunctionCompiler", object)


class LinkedKernel(CPUDispatcher):
    """A compiled function that Python and other kernels call."""

    def __init__(self, function: Callable[..., Any], options: dict[str, Any]) -> None:
        inner = {**options, "nopython": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        super().__init__(function, targetoptions=inner)
        body: Any = CPUDispatcher(function, targetoptions=inner)
        arguments: tuple[Any, ...] = function, self.targetdescr, inner, {}, compiler.Compiler
        body._compiler = _BodyCompiler(*arguments)
        self._compiler = _LinkingCompiler(*arguments)
        self._compiler.body = self.body = body

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """What another kernel needs to know to call this one; a literal counts as its type."""
        by_name = {name: types.unliteral(kind) for name, kind in kws.items()}
        return self._template([types.unliteral(kind) for kind in args], by_name)

    def _template(self, args: Any, kws: Any) -> Any:
        """The same, for types that are no literals."""
        return self.body.get_call_template(args, kws)

    def get_overload(self, sig: Any) -> Any:
        """What another kernel calls."""
        return self.body.get_overload(sig)

    def __reduce__(self) -> tuple[Any, ...]:
        """A kernel is pickled, and copied, by its name."""
        return _kernel_named, (self.py_func.__module__, self.py_func.__qualname__)


def _kernel_named(module: str, name: str) -> Any:
    return attrgetter(name)(import_module(module))


class SharedKernel(LinkedKernel):
    """A kernel whose machine code is called by other kernels, which hold no copy of it.

    It is optimised once, and a process that compiles one of its callers may load it from a file.
    """

    _template = CPUDispatcher.get_call_template

    def get_overload(self, sig: Any) -> Any:
        """What another kernel calls: the name of the machine code."""
        arguments = tuple(normalize_signature(sig)[0])
        made: Any = self.overloads[arguments]
        name = made.fndesc.llvm_func_name
        if name not in _SHARED:
            _SHARED[name] = self, arguments
            self.targetctx.insert_user_function(name, made.fndesc)
        return name


_SHARED: dict[str, tuple[SharedKernel, tuple[Any, ...]]] = {}
"""Shared kernels and types of their arguments by the name of their machine code."""


def shared_kernels(library: JITCodeLibrary) -> list[tuple[str, SharedKernel, tuple[Any, ...]]]:
    """Names, kernels and types of arguments of the shared kernels that a library calls."""
    functions = library._final_module.functions
    names = [function.name for function in functions if function.is_declaration]
    return [(name, *_SHARED[name]) for name in names if name in _SHARED]


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


class _NoEnvironments:
    def set_env(self, env_name: str, env: Any) -> None:
        """Do nothing, for there is no machine code."""


class _LinkedLibrary(JITCodeLibrary):
    """Machine code of which only the `exported` functions can be called from outside.

    The compiler may then inline the others. They lose their names: numba looks functions up by name
    in all modules, and would find such a copy in place of the one that can be called.
    """

    exported: Set[str] = frozenset()

    def _optimize_final_module(self) -> None:
        for k, function in enumerate(self._final_module.functions):
            if not function.is_declaration and function.name not in self.exported:
                function.linkage, function.name = "internal", f"inner.{k}"
        super()._optimize_final_module()


class _BodyCompiler(_FunctionCompiler):
    """Compiles to intermediate code."""

    def _compile_core(self, args: Any, return_type: Any) -> Any:
        flags = compiler.Flags()
        self.targetdescr.options.parse_as_flags(flags, self.targetoptions)
        context = self.targetdescr.target_context
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

    body: Any

    def _compile_core(self, args: Any, return_type: Any) -> Any:
        self.body.compile(args if return_type is None else return_type(*args))
        body = self.body.overloads[tuple(args)]
        context, door = body.target_context, copy(body.fndesc)
        door.env_name += ".python"  # the body's, kept with each caller, lacks what Python needs
        environment = Environment.from_fndesc(door)
        library: Any = _LinkedLibrary(context.codegen(), door.qualname)
        library.exported = {door.llvm_func_name, door.llvm_cpython_wrapper_name}
        library.enable_object_caching()
        library.add_linking_library(body.library)
        context.create_cpython_wrapper(
            library, door, environment, body.call_helper, release_gil=True
        )
        function = context.get_executable(library, door, environment)
        context.insert_user_function(function, door, [library])
        made = {"library": library, "entry_point": function, "fndesc": door}
        metadata = {**body.metadata, "timers": {}}
        linked = body._replace(**made, environment=environment, metadata=metadata)
        for referenced in linked._find_referenced_environments():
            library.codegen.set_env(referenced.env_name, referenced)
        return linked
