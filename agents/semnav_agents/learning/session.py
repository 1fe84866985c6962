"""A session of training: learning until a limit or a stop, with checkpoints."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Annotated, NamedTuple, Protocol

from semnav_agents.learning.reports import Preparation, TrainingReport, TrainingState
from semnav_features.checked_fields import Bounds, check_fields


@dataclass(frozen=True)
class TrainingLimits:
    """Limits at which a session ends.

    Attributes:
        steps: number of decisions in all, those of earlier sessions included.
        minutes: time limit of the session; None for none.
    """

    steps: Annotated[int, Bounds(0, 10**15)]
    minutes: Annotated[float | None, Bounds(0.0, 1e6, "min")]

    def __post_init__(self) -> None:
        check_fields(self)

    def fraction(self, first: int, steps: int, seconds: float) -> float:
        """Share of the session that is done; 1 or more when it is time to end.

        Args:
            first: number of decisions at the start of the session.
            steps: number of decisions now.
            seconds: since the start of the session.
        """
        by_steps = 1.0 if steps >= self.steps else (steps - first) / (self.steps - first)
        return max(by_steps, seconds / (60 * self.minutes) if self.minutes else 0.0)


class Training(Protocol):
    """A training, on any engine."""

    @property
    def steps(self) -> int:
        """Number of decisions so far."""
        ...

    @property
    def is_resumable(self) -> bool:
        """Whether a checkpoint can be made now."""
        ...

    def prepare(self) -> Iterator[Preparation]:
        """Make the preparation before the first rollout, and save its result."""
        ...

    def advance(self) -> TrainingReport:
        """Drive one rollout and learn from it."""
        ...

    def save(self) -> None:
        """Write the files of the agent, each in one atomic step."""
        ...

    def close(self) -> None:
        """Finish the curves and close the environments."""
        ...


class SessionProgress(NamedTuple):
    """The state of a session.

    Attributes:
        fraction: share of the preparation, or of the learning, that is done, at most 1.
        state: after a part of the preparation, or after an update.
    """

    fraction: float
    state: TrainingState


def train(
    trainer: Training, limits: TrainingLimits, stopped: Callable[[], bool]
) -> Iterator[SessionProgress]:
    """Learn until a limit is reached or `stopped` says so.

    A checkpoint is written after the preparation and at the end of each stretch, and the agent as
    it is at the end.
    """
    first, start = trainer.steps, time.monotonic()

    def fraction() -> float:
        return limits.fraction(first, trainer.steps, time.monotonic() - start)

    trainer.save()
    for preparation in trainer.prepare():
        yield SessionProgress(preparation.done / preparation.total, preparation)
        if stopped():
            return
    while not stopped() and fraction() < 1.0:
        report = trainer.advance()
        if trainer.is_resumable:
            trainer.save()
        yield SessionProgress(min(fraction(), 1.0), report)
    trainer.save()
