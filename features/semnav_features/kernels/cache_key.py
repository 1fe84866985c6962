"""Which kernels belong together: those of the same sources and of the same compiler."""

from __future__ import annotations

import hashlib
import os
import re
import sys
from collections.abc import Iterator, Mapping
from importlib.util import find_spec

import llvmlite
import numba
import numpy as np
from numba.core import config

_PACKAGES = ("semnav_features", "semnav_env", "semnav_agents")
"""The packages whose modules hold kernels, or what kernels are made of."""

_KERNEL_IMPORT = "kernels.compiling import kernel"
_IMPORT = re.compile(r"^from (semnav_[\w.]+) import (\([^)]*\)|[^\n]*)", re.MULTILINE)

CODE_SETTINGS = (
    "BOUNDSCHECK",
    "OPT",
    "LOOP_VECTORIZE",
    "SLP_VECTORIZE",
    "LLVM_REFPRUNE_PASS",
    "LLVM_REFPRUNE_FLAGS",
    "DISABLE_INTEL_SVML",
    "DEBUGINFO_DEFAULT",
    "EXTEND_VARIABLE_LIFETIMES",
)
"""Settings of numba, `NUMBA_...` in the environment, that change machine code. Those of the
processor stand in a kernel's `magic_tuple`."""


def compiler_settings() -> tuple[tuple[str, str], ...]:
    """The values of `CODE_SETTINGS` now."""
    return tuple((name, repr(getattr(config, name, None))) for name in CODE_SETTINGS)


def version_key() -> str:
    """Hash of every module that a kernel may be made of, and of the compiler's version.

    A kernel holds the code and the constants of all that it calls, wherever they stand; so no
    edit leaves a stale kernel, and two copies of the same sources share their kernels. Edits of
    modules that no kernel's module imports leave the kernels as they are.
    """
    versions = (sys.version, numba.__version__, llvmlite.__version__, np.__version__)
    key = hashlib.sha256("\n".join(versions).encode())
    sources = dict(installed_sources())
    for name in sorted(behind_kernels(sources)):
        key.update(f"{name}\n{sources[name]}".encode())
    return key.hexdigest()[:20]


def installed_sources() -> Iterator[tuple[str, str]]:
    """Every module of the installed packages: its dotted name and its text."""
    for package in _PACKAGES:
        found = find_spec(package)
        for top in (found and found.submodule_search_locations) or ():
            yield from _modules_below(top, package)


def _modules_below(top: str, package: str) -> Iterator[tuple[str, str]]:
    for folder, folders, files in os.walk(top):
        folders[:] = [f for f in folders if f != "__pycache__"]
        for file in files:
            if file.endswith(".py"):
                path = os.path.join(folder, file)
                place = package + path[len(top) : -len(".py")].replace(os.sep, ".")
                with open(path, "rb") as source:
                    yield place.removesuffix(".__init__"), source.read().decode()


def behind_kernels(sources: Mapping[str, str]) -> set[str]:
    """The modules with kernels, and all that they import, directly or not."""
    found = {name for name, text in sources.items() if _KERNEL_IMPORT in text}
    waiting = list(found)
    while waiting:
        fresh = set(_imports(sources[waiting.pop()])).intersection(sources) - found
        found |= fresh
        waiting += fresh
    return found


def _imports(text: str) -> Iterator[str]:
    """Dotted names of the modules that a module's first lines may import."""
    for module, names in _IMPORT.findall(text):
        yield module
        yield from (f"{module}.{name}" for name in re.findall(r"\w+", names))
