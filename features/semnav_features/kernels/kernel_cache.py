"""Compiled kernels as files: one for each kernel and each types of its arguments."""

from __future__ import annotations

import io
import pickle
import zlib
from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext, suppress
from hashlib import sha256
from pathlib import Path
from typing import Any

from numba.core.caching import _Cache
from numba.core.compiler import CompileResult
from numba.core.environment import Environment, lookup_environment
from numba.core.runtime.nrt import rtsys
from numba.core.serialize import dumps

from semnav_features.kernels.cache_folder import cache_folder
from semnav_features.kernels.cache_key import compiler_settings

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


class KernelCache(_Cache):
    """Keeps one kernel between runs.

    Numba's own cache looks at the file of the kernel alone, not at what it calls, and counts its
    files in an index that two processes can spoil. Here the folder's name tells the version of all
    sources, and a file's name what is in it. No fault of a file is ever an error: what cannot be
    read is compiled anew, and what cannot be written is not kept.
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

    def turn_to_compile(self, sig: Any, codegen: Any) -> AbstractContextManager[None]:
        """What a kernel is compiled in: other processes that need it wait for the end."""
        path = self._entry(sig, codegen)[0]
        if not self._enabled or path.exists():
            return nullcontext()
        from semnav_features.kernels.compile_turn import compile_turn  # seldom needed

        return compile_turn(path)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The kernel compiled for a signature, or None."""
        if not self._enabled:
            return None
        rtsys.initialize(target_context)  # without what compiling needs, which takes long to import
        path, key = self._entry(sig, target_context.codegen())
        try:
            kept, payload = _KernelReader(io.BytesIO(unsealed(path.read_bytes()))).load()
            return CompileResult._rebuild(target_context, *payload) if kept == key else None
        except FileNotFoundError:
            return None
        except Exception:  # a damaged file may raise anything
            with suppress(OSError):
                path.unlink()
            return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep what was compiled for a signature, if it can be kept."""
        if not self._enabled or data.lifted or data.library.has_dynamic_globals:
            return
        from semnav_features.writing import write_file  # only what was compiled is written

        path, key = self._entry(sig, data.codegen)
        with suppress(Exception):  # a full disk, or what no pickle can hold
            write_file(path, sealed(dumps((key, data._reduce()))))

    def enable(self) -> None:
        """Use the files."""
        self._enabled = True

    def disable(self) -> None:
        """Do not use the files."""
        self._enabled = False

    def flush(self) -> None:
        """Remove the kernel's files."""
        for path in cache_folder().glob(f"{self._name}.*"):
            with suppress(OSError):
                path.unlink()

    def _entry(self, sig: Any, codegen: Any) -> tuple[Path, str]:
        """The file for a signature and these settings, and all that it depends on."""
        settings = *codegen.magic_tuple(), *compiler_settings()
        key = repr((self._name, sig, settings, self._code))
        return cache_folder() / f"{self._name}.{sha256(key.encode()).hexdigest()[:20]}.bin", key
