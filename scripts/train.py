"""`semnav train`: teach an agent, and keep what it learned."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Literal

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn
from tyro.conf import Positional

from semnav_env.agents.hearing.card import CARD_FILE
from semnav_env.agents.hearing.presets import HEARING_PRESETS
from semnav_env.agents.learning.files import AGENT_FILE
from semnav_env.agents.learning.presets import Preset, preset
from semnav_env.agents.learning.rllib.options import RayOptions
from semnav_env.agents.learning.rllib.start import start_training
from semnav_env.agents.learning.session import Training, TrainingLimits, train
from semnav_env.scripts.dispatch import INTERRUPTED
from semnav_env.scripts.train_hearing import train_hearing

if TYPE_CHECKING:
    from semnav_env.agents.learning.training import TrainingReport


@dataclass(frozen=True)
class Arguments:
    """Train an agent on a preset with proximal policy optimisation (extra `rl`).

    Training ends when --steps or --minutes is reached, whichever comes first. Ctrl-C ends it after
    the current update; what was learned is saved, and --resume continues from there.

    Attributes:
        preset: what to learn: hallway, quick, drive, or listener, which hears the command.
        out: folder of the agent; runs/PRESET if not given.
        steps: number of decisions in all, at the end; that of the preset if not given. The length
            of listener is fixed.
        minutes: time limit of this run.
        seed: of weights, trials, noise and exploration; a resumed training keeps its own.
        resume: continue the training in the folder.
        engine: local for stable-baselines3 in this process, ray for RLlib (extras `rl` and `ray`).
        ray: where and in how many processes robots are driven with --engine ray.
    """

    preset: Positional[str] = "quick"
    out: Path | None = None
    steps: int | None = None
    minutes: float | None = None
    seed: int = 0
    resume: bool = False
    engine: Literal["local", "ray"] = "local"
    ray: RayOptions = RayOptions()

    def run(self) -> int:
        """Train, save and say how it went."""
        folder = self.out or Path("runs") / self.preset
        if self.preset in HEARING_PRESETS:
            self._check(folder, CARD_FILE)
            return train_hearing(self.preset, folder, self.seed, self.minutes)
        wanted = preset(self.preset)
        self._check(folder, AGENT_FILE)
        trainer = self._trainer(wanted, folder)
        console = Console(stderr=True)
        limits = TrainingLimits(wanted.steps if self.steps is None else self.steps, self.minutes)
        with _stopped_by_signals() as stop, _bar(console) as bar:
            report = _train(trainer, limits, stop, bar)
        trainer.close()
        interrupted = "interrupted; " if stop else ""
        print(f"{interrupted}{trainer.steps} decisions{_learned(report)}; saved in {folder}")
        return INTERRUPTED if stop else 0

    def _check(self, folder: Path, file: str) -> None:
        if self.steps is not None and self.steps < 0:
            raise ValueError(f"--steps is {self.steps}; it must be at least 0")
        if self.minutes is not None and not 0 < self.minutes < float("inf"):
            raise ValueError(f"--minutes is {self.minutes}; it must be positive and finite")
        if self.seed < 0:
            raise ValueError(f"--seed is {self.seed}; it must be at least 0")
        if not self.resume and (folder / file).exists():
            raise ValueError(
                f"{folder} holds a trained agent; go on with it by --resume, or give another --out"
            )

    def _trainer(self, wanted: Preset, folder: Path) -> Training:
        if self.engine == "ray":
            return start_training(wanted, folder, self.seed, self.ray, self.resume)
        try:
            from semnav_env.agents.learning.training import Trainer
        except ModuleNotFoundError as error:
            raise ImportError(
                f'training needs {error.name}: pip install "semnav-env[rl]"'
            ) from None
        return Trainer.resume(wanted, folder) if self.resume else Trainer(wanted, folder, self.seed)


def _train(
    trainer: Training, limits: TrainingLimits, stop: list[int], bar: Progress
) -> TrainingReport | None:
    """Learn, show how far it is, and return the last report."""
    task = bar.add_task("learning", total=1.0)
    report: TrainingReport | None = None
    for fraction, report, saved in train(trainer, limits, lambda: bool(stop)):
        bar.update(task, completed=fraction, description=_line(report))
        if saved and not bar.console.is_terminal:
            bar.console.print(_line(report), highlight=False)
    return report


def _bar(console: Console) -> Progress:
    columns = (BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    return Progress(TextColumn("{task.description}"), *columns, console=console)


def _line(report: TrainingReport | None) -> str:
    if report is None:
        return "driving demonstrations"
    return (
        f"{report.steps} decisions, {report.rate:.0f}/s, "
        f"success {report.success:.0%}, no contact {report.contact_free:.0%}, "
        f"SPL {report.spl:.2f}, reward {report.reward:.1f}"
    )


def _learned(report: TrainingReport | None) -> str:
    if report is None:
        return ""
    return (
        f", success {report.success:.0%} and no contact {report.contact_free:.0%} while exploring"
    )


@contextmanager
def _stopped_by_signals() -> Iterator[list[int]]:
    """A list that the first Ctrl-C or SIGTERM fills; the second one ends the process."""
    stop: list[int] = []
    names = (signal.SIGINT, signal.SIGTERM)
    before = {name: signal.getsignal(name) for name in names}

    def note(number: int, frame: FrameType | None) -> None:
        stop.append(number)
        for name in names:
            signal.signal(name, before[name])

    for name in names:
        signal.signal(name, note)
    try:
        yield stop
    finally:
        for name in names:
            signal.signal(name, before[name])
