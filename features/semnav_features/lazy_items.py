"""Features whose objects are made on first access."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeVar, overload

import numpy as np

_Item = TypeVar("_Item", covariant=True)


class LazyItems(Sequence[_Item]):
    """A tuple whose items are made at the first access to one of them.

    Making the objects of a scene takes longer than finding it in the scan. It equals the tuple of
    its items, and is pickled as that tuple.

    Args:
        rows: a structured array with one entry for each item; copied.
        make: makes an item of the fields of its entry.
    """

    __slots__ = ("_items", "_make", "_rows")

    def __init__(self, rows: np.ndarray, make: Callable[..., _Item]) -> None:
        self._rows, self._make = rows.copy(), make
        self._items: tuple[_Item, ...] | None = None

    def _all(self) -> tuple[_Item, ...]:
        if self._items is None:
            self._items = tuple([self._make(*row) for row in self._rows.tolist()])
        return self._items

    @overload
    def __getitem__(self, index: int) -> _Item: ...

    @overload
    def __getitem__(self, index: slice) -> tuple[_Item, ...]: ...

    def __getitem__(self, index: int | slice) -> _Item | tuple[_Item, ...]:
        return self._all()[index]

    def __len__(self) -> int:
        return len(self._rows)

    def __iter__(self) -> Iterator[_Item]:
        return iter(self._all())

    def __add__(self, other: Sequence[Any]) -> tuple[Any, ...]:
        return self._all() + tuple(other)

    def __radd__(self, other: Sequence[Any]) -> tuple[Any, ...]:
        return tuple(other) + self._all()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and self._all() == tuple(other)

    def __hash__(self) -> int:
        return hash(self._all())

    def __repr__(self) -> str:
        return repr(self._all())

    def __reduce__(self) -> tuple[type[tuple[Any, ...]], tuple[tuple[_Item, ...]]]:
        return tuple, (self._all(),)
