"""Structures of arrays, which are handed to a kernel as one thing."""

from __future__ import annotations

from typing import Any

from numba import types


class ArraysType(types.StructRef):
    """Numba's type of a structure; its fields have general types, not those of literal values."""

    def preprocess_fields(self, fields: Any) -> Any:
        """The fields as numba is to see them."""
        return tuple((name, types.unliteral(kind)) for name, kind in fields)
