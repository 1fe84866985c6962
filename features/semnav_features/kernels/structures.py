"""Structures of arrays, which are handed to a kernel as one thing. Their fields are named once."""

from __future__ import annotations

from hashlib import sha256
from typing import Any, TypeVar

from numba import types
from numba.experimental import structref

from semnav_features.kernels.compiling import kernel

S = TypeVar("S", bound="Structure")


class ArraysType(types.StructRef):
    """Numba's type of a structure; its fields have general types, not those of literal values.

    It is named by a hash of its fields. Numba's own name spells out every field of every record,
    up to a million characters, and is a part of the name of each function that takes the structure.
    """

    def __init__(self, fields: Any) -> None:
        super().__init__(fields)
        self.name = f"{self._typename}.{sha256(self.name.encode()).hexdigest()[:16]}"

    def preprocess_fields(self, fields: Any) -> Any:
        """The fields as numba is to see them."""
        return tuple((name, types.unliteral(kind)) for name, kind in fields)


class Structure(structref.StructRefProxy):
    """Base of structures: a subclass annotates its fields, and `numba_type` makes it known.

    class Marks(Structure):
        seen: np.ndarray

    MarksType = numba_type(Marks)
    marks = Marks.of(seen=np.zeros(3))
    """

    _join: Any

    @classmethod
    def of(cls: type[S], **fields: Any) -> S:
        """The structure of these arrays, which are shared, not copied.

        Raises:
            TypeError: a field is missing, or there is no such field.
        """
        names = cls.__annotations__
        if fields.keys() != names.keys():
            raise TypeError(f"{cls.__name__} has the fields {', '.join(names)}, not {[*fields]}")
        made: S = cls._join(tuple(fields[name] for name in names))
        return made


def numba_type(structure: type[Structure]) -> type[ArraysType]:
    """Make a structure known to numba.

    Returns:
        How compiled code sees it. It is to stand in the module of the structure, named like it with
        "Type" at the end, because kept kernels refer to it by that name.
    """
    name = f"{structure.__name__}Type"
    made = type(name, (ArraysType,), {"__module__": structure.__module__, "__qualname__": name})
    structref.register(made)
    structref.define_proxy(structure, made, list(structure.__annotations__))

    @kernel
    def join(fields: Any) -> Any:
        return structure(*fields)

    structure._join = join
    return made
