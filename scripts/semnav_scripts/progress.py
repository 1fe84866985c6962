"""A progress bar on stderr for work that takes longer than two seconds."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from threading import Timer
from typing import TypeVar

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

T = TypeVar("T")

BAR_DELAY = 2.0
"""Time before the bar appears, seconds: shorter work needs no bar."""


def tracked(
    items: Iterable[T], label: Callable[[int], str], fraction: Callable[[], float | None]
) -> Iterator[T]:
    """The items, with a progress bar once they have taken longer than `BAR_DELAY`.

    Args:
        items: to go through.
        label: gives the words before the bar for a number of items so far.
        fraction: gives the share that is done, 0 to 1, or None where it is not known.
    """
    columns = (BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    progress = Progress(TextColumn("{task.description}"), *columns, console=Console(stderr=True))
    task = progress.add_task(label(0), total=None)
    with _shown_after(BAR_DELAY, progress):
        for count, item in enumerate(items, start=1):
            yield item
            done = fraction()
            progress.update(
                task,
                description=label(count),
                completed=done or 0.0,
                total=None if done is None else 1.0,
            )


@contextmanager
def _shown_after(seconds: float, progress: Progress) -> Iterator[None]:
    timer = Timer(seconds, progress.start)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        timer.join()
        if progress.live.is_started:
            progress.stop()
