"""Keeps the fields of distances that were used last."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from itertools import count
from queue import SimpleQueue
from threading import Lock
from weakref import finalize

from semnav_features.frames import FloatArray


class RecentFields:
    """Arrays by owner and key, for all threads of a process.

    Those used longest ago are dropped when all take too much memory, and those of an owner that
    is gone when the next array is asked for.

    Args:
        max_bytes: for all arrays together.
    """

    def __init__(self, max_bytes: int) -> None:
        self.max_bytes, self.kept_bytes = max_bytes, 0
        self._fields: OrderedDict[tuple[int, Hashable], FloatArray] = OrderedDict()
        self._numbers, self._gone = count(), SimpleQueue[int]()
        self._lock = Lock()

    def number(self, owner: object) -> int:
        """A number for an owner of arrays, which are kept no longer than the owner lives."""
        number = next(self._numbers)
        # Only into a queue, because the garbage collector may call this at any moment.
        finalize(owner, self._gone.put, number).atexit = False
        return number

    def get(self, owner: int, key: Hashable, make: Callable[[], FloatArray]) -> FloatArray:
        """The array of that owner and key; it is made if it is not kept."""
        with self._lock:
            field = self._fields.get((owner, key))
        made = make() if field is None else field
        with self._lock:
            self._drop_of_the_gone()
            return self._keep((owner, key), made)

    def _keep(self, key: tuple[int, Hashable], made: FloatArray) -> FloatArray:
        """Note the use of an array; of two that were made at the same time the first is kept."""
        if key not in self._fields:
            self._fields[key] = made
            self.kept_bytes += made.nbytes
        self._fields.move_to_end(key)
        field = self._fields[key]
        while self.kept_bytes > self.max_bytes and len(self._fields) > 1:
            self.kept_bytes -= self._fields.popitem(last=False)[1].nbytes
        return field

    def _drop_of_the_gone(self) -> None:
        gone = set[int]()
        while not self._gone.empty():
            gone.add(self._gone.get())
        for key in [key for key in self._fields if key[0] in gone] if gone else ():
            self.kept_bytes -= self._fields.pop(key).nbytes
