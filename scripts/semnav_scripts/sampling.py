"""A few items spread evenly over a stream of unknown length."""

from __future__ import annotations

from typing import Generic, TypeVar

T = TypeVar("T")


class EvenSample(Generic[T]):
    """Keeps at most `2 * size` items of a stream, evenly spaced, and gives `size` of them.

    Args:
        size: how many items are wanted, at least 1.
    """

    def __init__(self, size: int) -> None:
        self._size = size
        self._kept: list[T] = []
        self._seen = 0
        self._stride = 1

    def offer(self, item: T) -> None:
        """Pass the next item of the stream."""
        if self._seen % self._stride == 0:
            self._kept.append(item)
        self._seen += 1
        if len(self._kept) > 2 * self._size:
            self._kept = self._kept[::2]
            self._stride *= 2

    def items(self) -> list[T]:
        """At most `size` of the items so far, evenly spaced, in order."""
        n = len(self._kept)
        count = min(self._size, n)
        return [self._kept[(2 * i + 1) * n // (2 * count)] for i in range(count)]
