"""Compiled kernels as files: one for each kernel and each types of its arguments."""

from __future__ import annotations

import io
import os
import pickle
import zlib
from collections.abc import Callable
from contextlib import suppress
from hashlib import sha256
from pathlib import Path
from typing import Any

from numba.core import config
from numba.core.compiler import CompileResult
from numba.core.environment import Environment, lookup_environment
from numba.core.runtime.nrt import rtsys
from numba.core.serialize import dumps

from semnav_features.kernels.cache_folder import cache_folder
from semnav_features.kernels.cache_key import compiler_settings
from semnav_features.kernels.linking import shared_kernels

CHECKSUM_BYTES = 4
"""Size of the checksum that a file begins with."""


def sealed(content: bytes) -> bytes:
    """The bytes of a file with some content: a checksum, then the content.

    One wrong bit in machine code raises nothing; it would end the process, or give wrong numbers.
    """
    return zlib.crc32(content).to_bytes(CHECKSUM_BYTES, "little") + content


def unsealed(data: bytes) -> bytes:
    """The content of a file.

    Raises:
        ValueError: it is damaged.
    """
    content = data[CHECKSUM_BYTES:]
    if sealed(content) != data:
        raise ValueError("the checksum does not fit")
    return content


class _KernelReader(pickle.Unpickler):
    """Reads a kept kernel without the modules of the functions in it, among them numba's own."""

    def find_class(self, module: str, name: str) -> Any:
        """What a pickle names."""
        if (module, name) == ("numba.core.environment", "_rebuild_env"):
            return _environment
        return super().find_class(module, name)


def _environment(module: str, constants: list[Any], name: str) -> Environment:
    """A function's environment as numba makes it, but without globals: machine code uses none."""
    found: Environment | None = lookup_environment(name)
    if found is None:
        found = Environment({"__name__": module})
        found.consts[:] = constants
        found.env_name = name
        Environment._memo[name] = found
    return found


def keep_in_files(compiled: Any, function: Callable[..., Any]) -> None:
    """Keep a function that numba compiles between runs.

    Args:
        compiled: numba's dispatcher or callback of it.
        function: as it stands in its module.
    """
    if os.environ.get("SEMNAV_PLAIN_NUMBA"):
        # numba's own folder may be one where nothing can be written
        config.CACHE_DIR = str(cache_folder())  # type: ignore[attr-defined]
        compiled.enable_caching()
    else:
        compiled._cache = KernelCache(function)


class KernelCache:
    """Keeps one kernel between runs, in the place of numba's own cache.

    That looks at the file of the kernel alone, not at what it calls, and counts its files in an
    index that two processes can spoil; and it loads all that compiling needs. Here the folder's
    name tells the version of all sources, and a file's name what is in it. No fault of a file is
    ever an error: what cannot be read is compiled anew, and what cannot be written is not kept.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        code = function.__code__
        name = f"{function.__module__}.{function.__qualname__}-{code.co_firstlineno}"
        self._name = name.replace("<", "").replace(">", "")
        cells = tuple(cell.cell_contents for cell in function.__closure__ or ())
        self._code = (code.co_code, dumps(cells) if cells else b"")
        self._enabled = True

    @property
    def cache_path(self) -> Any:
        """Folder of the files."""
        return str(cache_folder())

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The kernel compiled for a signature; None if it is to be compiled, by this process."""
        if not self._enabled:
            return None
        rtsys.initialize(target_context)  # without what compiling needs, which takes long to import
        path, key = self._entry(sig, target_context.codegen())
        found = _loaded(path, key, target_context)
        if found is None:
            from semnav_features.kernels.compile_turn import TURNS  # seldom needed

            TURNS.begin(path)  # others may have compiled it meanwhile
            found = _loaded(path, key, target_context)
            if found is not None:
                TURNS.end(path)
        return found

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep what was compiled for a signature, if it can be kept."""
        if not self._enabled:
            return
        from semnav_features.kernels.compile_turn import TURNS
        from semnav_features.writing import write_file  # only what was compiled is written

        path, key = self._entry(sig, data.codegen)
        if not data.lifted and not data.library.has_dynamic_globals:
            with suppress(Exception):  # a full disk, or what no pickle can hold
                called = shared_kernels(data.library)
                write_file(path, sealed(dumps((key, called, data._reduce()))))
        TURNS.end(path)

    def disable(self) -> None:
        """Do not use the files."""
        self._enabled = False

    def _entry(self, sig: Any, codegen: Any) -> tuple[Path, str]:
        """The file for a signature and these settings, and all that it depends on."""
        settings = *codegen.magic_tuple(), *compiler_settings()
        key = repr((self._name, sig, settings, self._code))
        return cache_folder() / f"{self._name}.{sha256(key.encode()).hexdigest()[:20]}.bin", key


def _is_there(name: str, kernel: Any, types: tuple[Any, ...]) -> bool:
    """Load or compile a shared kernel; whether its machine code has the name that callers use."""
    kernel.compile(types)
    return bool(kernel.overloads[types].fndesc.llvm_func_name == name)


def _loaded(path: Path, key: str, target_context: Any) -> Any:
    """The kernel in a file; None if there is none, and if it is damaged, which removes it."""
    try:
        kept, called, payload = _KernelReader(io.BytesIO(unsealed(path.read_bytes()))).load()
        if kept == key and all(_is_there(*each) for each in called):
            return CompileResult._rebuild(target_context, *payload)
        return None
    except FileNotFoundError:
        return None
    except Exception:  # a damaged file may raise anything
        with suppress(OSError):
            path.unlink()
        return None
