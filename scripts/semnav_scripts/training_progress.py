"""Shows the progress of a training: a bar on a terminal, lines in a log file."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import timedelta

from rich.console import Console
from rich.progress import Progress

from semnav_agents.learning.reports import Preparation, TrainingReport, TrainingState
from semnav_agents.learning.session import SessionProgress
from semnav_scripts.progress import progress_display

LINES_A_PHASE = 10
"""Lines in a log file for each phase of the preparation."""


class TrainingDisplay:
    """Shows one session of training on stderr.

    Args:
        console: of stderr.
        bar: that is shown on a terminal.
    """

    def __init__(self, console: Console, bar: Progress) -> None:
        self._console, self._bar = console, bar
        self._task = bar.add_task("beginning", total=1.0)
        self._phase, self._begin, self._latest = "", 0.0, time.monotonic()

    def show(self, progress: SessionProgress) -> None:
        """Show the session as it is now."""
        state, left = progress.state, self._time_left(progress)
        if self._console.is_terminal:
            self._bar.update(self._task, completed=progress.fraction, description=state_line(state))
        elif _is_told(state):
            self._console.print(
                f"{state_line(state)}, {left} left", highlight=False, soft_wrap=True
            )

    def _time_left(self, progress: SessionProgress) -> timedelta:
        """Time until the end of the current phase, estimated from its time so far."""
        state, fraction = progress.state, progress.fraction
        phase = state.phase if isinstance(state, Preparation) else "learning"
        if phase != self._phase:
            self._phase, self._begin = phase, self._latest
        self._latest = time.monotonic()
        left = (self._latest - self._begin) * (1.0 - fraction) / fraction if fraction else 0.0
        return timedelta(seconds=round(left))


@contextmanager
def training_display() -> Iterator[TrainingDisplay]:
    """The display of a session that begins now; on a terminal with a bar."""
    console = Console(stderr=True)
    bar = progress_display(console, disable=not console.is_terminal)
    with bar:
        yield TrainingDisplay(console, bar)


def state_line(state: TrainingState) -> str:
    """The progress of a training in one line."""
    if isinstance(state, TrainingReport):
        told = f"{state.steps} decisions, {state.rate:.0f}/s, "
        if math.isnan(state.success):
            return f"{told}no episode has ended yet"
        return (
            f"{told}success {state.success:.0%}, no contact {state.contact_free:.0%}, "
            f"SPL {state.spl:.2f}, reward {state.reward:.1f}"
        )
    if state.loss is None:
        return f"demonstrations: {state.done} of {state.total} driven"
    return f"cloning: pass {state.done} of {state.total}, loss {state.loss:.4f}"


def _is_told(state: TrainingState) -> bool:
    """Whether to write a line to a log file: at each update, and at each tenth of a phase."""
    if isinstance(state, TrainingReport) or state.done == 1:
        return True
    before, now = (LINES_A_PHASE * done // state.total for done in (state.done - 1, state.done))
    return before < now
