"""A progress bar on stderr for work that takes longer than two seconds."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from threading import Timer
from typing import TYPE_CHECKING, TypeVar

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

if TYPE_CHECKING:  # `semnav doctor` must start without the compiled kernels
    from semnav_env.judge import Judge

T = TypeVar("T")

NEARLY_DONE = 0.99
"""The largest share of an episode that is shown as driven before it ends."""

BAR_DELAY = 2.0
"""Time before the bar appears, seconds: shorter work needs no bar."""


class WorkBar:
    """What is being done, how much of it is done, and the time left.

    Args:
        progress: the bar on the terminal.
        label: words before the bar.
    """

    def __init__(self, progress: Progress, label: str) -> None:
        self._progress = progress
        self._task = progress.add_task(label, total=None)

    def show(self, label: str, fraction: float | None) -> None:
        """Show how far the work has come.

        Args:
            label: words before the bar.
            fraction: the share that is done, 0 to 1; None where it is not known.
        """
        self._progress.update(
            self._task,
            description=label,
            completed=fraction or 0.0,
            total=None if fraction is None else 1.0,
        )


@contextmanager
def work_bar(label: str) -> Iterator[WorkBar]:
    """A bar that appears once the work has taken longer than `BAR_DELAY`."""
    progress = progress_display(Console(stderr=True))
    with _shown_after(BAR_DELAY, progress):
        yield WorkBar(progress, label)


def progress_display(console: Console, disable: bool = False) -> Progress:
    """Words, a bar, the share that is done and the time left.

    Args:
        console: of stderr.
        disable: whether nothing is shown.
    """
    columns = (BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    return Progress(TextColumn("{task.description}"), *columns, console=console, disable=disable)


def tracked(
    items: Iterable[T], label: Callable[[int], str], fraction: Callable[[], float | None]
) -> Iterator[T]:
    """The items, with a progress bar once they have taken longer than `BAR_DELAY`.

    Args:
        items: to go through.
        label: gives the words before the bar for a number of items so far.
        fraction: gives the share that is done, 0 to 1, or None where it is not known.
    """
    with work_bar(label(0)) as bar:
        for count, item in enumerate(items, start=1):
            yield item
            bar.show(label(count), fraction())


def share_driven(judge: Judge) -> float | None:
    """About how much of an episode is driven: the path so far over the true route.

    None where there is no route, as in a search. A path that has grown as long as the route is
    taken to be nearly at its end.
    """
    route = judge.route_length
    return min(NEARLY_DONE, float(judge.period.path_length) / route) if route > 0.0 else None


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
