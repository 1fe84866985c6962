"""The arrays of NumPy's npz archives, without unpickling anything."""

from __future__ import annotations

import math
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

import numpy as np
from numpy.lib import format as npy

from semnav_features.frames import FloatArray
from semnav_features.readers.log import DamageError, LogError
from semnav_features.validation import clipped, shown

MAX_BEAMS = 100_000
"""Largest number of beams of a scan."""

MAX_BYTES = 200_000_000
"""Size of the largest array that is read as a whole, bytes."""


class NpzArrays:
    """An open archive.

    Args:
        path: the file.

    Raises:
        DamageError: it is no whole archive.
        OSError: it cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        with _damage():
            self._archive = zipfile.ZipFile(path)
        self._names = {name.removesuffix(".npy") for name in self._archive.namelist()}

    def number(self, name: str) -> float | None:
        """The only number of an array; None if there is no such array.

        Raises:
            LogError: it is not one number.
        """
        array = self.whole(name)
        if array is None:
            return None
        if array.size != 1:
            raise self._error(name, f"has shape {shown(array.shape)}; it must be one number")
        return float(array.reshape(-1)[0])

    def table(self, name: str, shape: tuple[int, ...]) -> FloatArray | None:
        """A whole array; None if there is no such array.

        Raises:
            LogError: it has another shape, or holds no numbers.
        """
        array = self.whole(name)
        if array is not None and array.shape != shape:
            raise self._error(name, f"has shape {shown(array.shape)}; it must be {shape}")
        return array

    def whole(self, name: str) -> FloatArray | None:
        """An array of any shape; None if there is no such array.

        Raises:
            LogError: it holds no numbers, or more than `MAX_BYTES`.
            DamageError: its data end too early or are damaged.
        """
        if name not in self._names:
            return None
        with _damage(), self._member(name) as file:
            shape, by_columns, dtype = self._header(name, file)
            size = math.prod(shape) * dtype.itemsize
            self._check_size(name, size)
            data = _exactly(file, size)
        flat = np.frombuffer(data, dtype).astype(np.float64)
        return flat.reshape(shape[::-1]).T if by_columns else flat.reshape(shape)

    def shape(self, name: str) -> tuple[int, ...]:
        """Shape of an array.

        Raises:
            LogError: there is no such array, or it holds no numbers.
        """
        if name not in self._names:
            there = clipped(", ".join(sorted(self._names)) or "nothing", 200)
            raise LogError(f"{self.path} has no array {name!r}; it holds {there}")
        with _damage(), self._member(name) as file:
            return self._header(name, file)[0]

    def rows(self, name: str) -> Iterator[FloatArray]:
        """The rows of an array, one at a time unless it is stored by columns.

        Raises:
            LogError: it has not two dimensions, or holds no numbers.
            DamageError: its data end too early or are damaged.
        """
        with _damage(), self._member(name) as file:
            (rows, columns), by_columns, dtype = self._header(name, file)
            if not 0 < columns <= MAX_BEAMS:
                raise self._error(name, f"has {shown(columns)} columns, not 1 to {MAX_BEAMS:,}")
            size = columns * dtype.itemsize
            if by_columns:
                self._check_size(name, rows * size)
                data = _exactly(file, rows * size)
                yield from np.frombuffer(data, dtype).reshape(columns, rows).T.astype(np.float64)
                return
            for _ in range(rows):
                yield np.frombuffer(_exactly(file, size), dtype).astype(np.float64)

    def close(self) -> None:
        """Close the file."""
        self._archive.close()

    def _member(self, name: str) -> IO[bytes]:
        stored = f"{name}.npy" if f"{name}.npy" in self._archive.namelist() else name
        return self._archive.open(stored)

    def _header(self, name: str, file: IO[bytes]) -> tuple[tuple[int, ...], bool, np.dtype]:
        with _damage():
            try:
                version = npy.read_magic(file)
                read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
                shape, by_columns, dtype = read(file)
            except ValueError:
                raise self._error(name, "is no NumPy array") from None
        if dtype.kind not in "fiu":
            raise self._error(name, f"has dtype {clipped(str(dtype))}; it must be real numbers")
        return shape, by_columns, dtype

    def _check_size(self, name: str, size: int) -> None:
        if size > MAX_BYTES:
            raise self._error(name, f"has {shown(size)} bytes; at most {MAX_BYTES:,} are read")

    def _error(self, name: str, fault: str) -> LogError:
        return LogError(f"{self.path}: array {name!r} {fault}")


@contextmanager
def _damage() -> Iterator[None]:
    try:
        yield
    except (LogError, DamageError, FileNotFoundError, PermissionError):
        raise
    except Exception:  # damaged bytes raise whatever the parser of the moment stumbles over
        raise DamageError from None


def _exactly(file: IO[bytes], size: int) -> bytes:
    data = file.read(size)
    if len(data) != size:
        raise EOFError
    return data
