"""A session of training: learning until a limit or a stop, with checkpoints."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, NamedTuple, Protocol

from semnav_env.features.checked_fields import Bounds, check_fields

if TYPE_CHECKING:  # stable-baselines3 is optional
    from semnav_env.agents.learning.training import TrainingReport


@dataclass(frozen=True)
class TrainingLimits:
    """When a session ends.

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
    """A training, whatever it runs on."""

    @property
    def steps(self) -> int:
        """Number of decisions so far."""
        ...

    @property
    def is_resumable(self) -> bool:
        """Whether a checkpoint can be made now."""
        ...

    def prepare(self) -> Iterator[float]:
        """Do what comes before the first rollout; yields the share that is done."""
        ...

    def advance(self) -> TrainingReport:
        """Drive one rollout and learn from it."""
        ...

    def save(self) -> None:
        """Write the files of the agent, each in one move."""
        ...

    def close(self) -> None:
        """Finish the curves and close the environments."""
        ...


class SessionProgress(NamedTuple):
    """The state of a session after an update.

    Attributes:
        fraction: share of the session that is done, at most 1.
        report: of the training; None while demonstrations are driven.
        saved: whether a checkpoint was just written.
    """

    fraction: float
    report: TrainingReport | None
    saved: bool


def train(
    trainer: Training, limits: TrainingLimits, stopped: Callable[[], bool]
) -> Iterator[SessionProgress]:
    """Learn until a limit is reached or `stopped` says so.

    A checkpoint is written at the end of each stretch, and the agent as it is at the end.
    """
    first, start = trainer.steps, time.monotonic()

    def fraction() -> float:
        return limits.fraction(first, trainer.steps, time.monotonic() - start)

    trainer.save()
    for share in trainer.prepare():
        if stopped():
            return
        yield SessionProgress(share, None, False)
    while not stopped() and fraction() < 1.0:
        report = trainer.advance()
        if trainer.is_resumable:
            trainer.save()
        yield SessionProgress(min(fraction(), 1.0), report, trainer.is_resumable)
    trainer.save()
