"""Keeps the fields of distances that were used last."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable

from semnav_features.frames import FloatArray


class RecentFields:
    """Arrays by key; those used longest ago are dropped when all take too much memory.

    Args:
        max_bytes: for all arrays together.
    """

    def __init__(self, max_bytes: int) -> None:
        self.max_bytes, self.kept_bytes = max_bytes, 0
        self._fields: OrderedDict[Hashable, FloatArray] = OrderedDict()

    def get(self, key: Hashable, make: Callable[[], FloatArray]) -> FloatArray:
        """The array of that key; it is made if it is not kept."""
        field = self._fields.get(key)
        if field is None:
            field = self._fields[key] = make()
            self.kept_bytes += field.nbytes
        self._fields.move_to_end(key)
        while self.kept_bytes > self.max_bytes and len(self._fields) > 1:
            self.kept_bytes -= self._fields.popitem(last=False)[1].nbytes
        return field
