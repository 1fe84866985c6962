"""The arrays of NumPy's npz archives, without unpickling anything."""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

import numpy as np
from numpy.lib import format as npy

from semnav_env.features.frames import FloatArray
from semnav_env.features.readers.log import DamageError, LogError


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
        array = self._whole(name)
        if array is None:
            return None
        if array.size != 1:
            raise self._error(name, f"has shape {array.shape}; it must be one number")
        return float(array.reshape(-1)[0])

    def table(self, name: str, shape: tuple[int, ...]) -> FloatArray | None:
        """A whole array; None if there is no such array.

        Raises:
            LogError: it has another shape, or holds no numbers.
        """
        array = self._whole(name)
        if array is not None and array.shape != shape:
            raise self._error(name, f"has shape {array.shape}; it must be {shape}")
        return array

    def shape(self, name: str) -> tuple[int, ...]:
        """Shape of an array.

        Raises:
            LogError: there is no such array, or it holds no numbers.
        """
        if name not in self._names:
            there = ", ".join(sorted(self._names)) or "nothing"
            raise LogError(f"{self.path} has no array {name!r}; it holds {there}")
        with self._member(name) as file:
            return self._header(name, file)[0]

    def rows(self, name: str) -> Iterator[FloatArray]:
        """The rows of an array, one at a time unless it is stored by columns.

        Raises:
            LogError: it has not two dimensions, or holds no numbers.
            DamageError: its data end too early or are damaged.
        """
        with _damage(), self._member(name) as file:
            (rows, columns), by_columns, dtype = self._header(name, file)
            size = columns * dtype.itemsize
            if by_columns:
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
            raise self._error(name, f"has dtype {dtype}; it must be real numbers")
        return shape, by_columns, dtype

    def _whole(self, name: str) -> FloatArray | None:
        if name not in self._names:
            return None
        with _damage(), self._member(name) as file:
            shape, by_columns, dtype = self._header(name, file)
            data = _exactly(file, int(np.prod(shape)) * dtype.itemsize)
        flat = np.frombuffer(data, dtype).astype(np.float64)
        return flat.reshape(shape[::-1]).T if by_columns else flat.reshape(shape)

    def _error(self, name: str, fault: str) -> LogError:
        return LogError(f"{self.path}: array {name!r} {fault}")


@contextmanager
def _damage() -> Iterator[None]:
    try:
        yield
    except (EOFError, zipfile.BadZipFile, zlib.error):
        raise DamageError from None


def _exactly(file: IO[bytes], size: int) -> bytes:
    data = file.read(size)
    if len(data) != size:
        raise EOFError
    return data
