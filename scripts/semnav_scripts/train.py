"""`semnav train`: teach an agent, and keep what it learned."""

from __future__ import annotations

import math
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Literal

from tyro.conf import Positional

from semnav_agents.hearing.presets import HEARING_PRESETS
from semnav_agents.learning.cost import noted_cost
from semnav_agents.learning.files import CURVES_FOLDER
from semnav_agents.learning.presets import Preset, preset
from semnav_agents.learning.reports import TrainingReport
from semnav_agents.learning.rllib.options import RayOptions
from semnav_agents.learning.rllib.start import start_training
from semnav_agents.learning.session import Training, TrainingLimits, train
from semnav_env.networks.card import CARD_FILE
from semnav_features.sole_writer import sole_writer
from semnav_scripts.train_hearing import train_hearing
from semnav_scripts.training_progress import training_display


@dataclass(frozen=True)
class Arguments:
    """Train an agent on a preset with proximal policy optimisation (extra `rl`).

    Training ends when --steps or --minutes is reached, whichever comes first. Ctrl-C or SIGTERM
    ends it after the current update; what was learned is saved, and --resume continues from the
    last checkpoint.

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
        hears = self.preset in HEARING_PRESETS
        wanted = None if hears else preset(self.preset)
        self._check()
        folder.parent.mkdir(parents=True, exist_ok=True)
        with sole_writer(folder):
            self._check_unused(folder)
            with noted_cost(folder):
                if wanted is None:
                    return train_hearing(self.preset, folder, self.seed, self.minutes)
                return self._train(wanted, folder)

    def _train(self, wanted: Preset, folder: Path) -> int:
        trainer = self._trainer(wanted, folder)
        print(f"curves: tensorboard --logdir {folder / CURVES_FOLDER}", file=sys.stderr)
        limits = TrainingLimits(wanted.steps if self.steps is None else self.steps, self.minutes)
        report: TrainingReport | None = None
        with _stopped_by_signals() as stop, training_display() as display:
            for progress in train(trainer, limits, lambda: bool(stop)):
                display.show(progress)
                report = progress.state if isinstance(progress.state, TrainingReport) else None
        trainer.close()
        print(_ending(trainer.steps, report, folder, bool(stop)))
        return 128 + stop[0] if stop else 0

    def _check(self) -> None:
        if self.steps is not None and self.steps < 0:
            raise ValueError(f"--steps is {self.steps}; it must be at least 0")
        if self.minutes is not None and not 0 < self.minutes < float("inf"):
            raise ValueError(f"--minutes is {self.minutes}; it must be positive and finite")
        if self.seed < 0:
            raise ValueError(f"--seed is {self.seed}; it must be at least 0")

    def _check_unused(self, folder: Path) -> None:
        if not self.resume and (folder / CARD_FILE).exists():
            raise ValueError(
                f"{folder} holds a trained agent; go on with it by --resume, or give another --out"
            )

    def _trainer(self, wanted: Preset, folder: Path) -> Training:
        if self.engine == "ray":
            return start_training(wanted, folder, self.seed, self.ray, self.resume)
        try:
            from semnav_agents.learning.training import Trainer
        except ModuleNotFoundError as error:
            raise ImportError(
                f'training needs {error.name}: pip install "semnav-env[rl]"'
            ) from None
        return Trainer.resume(wanted, folder) if self.resume else Trainer(wanted, folder, self.seed)


def _ending(steps: int, report: TrainingReport | None, folder: Path, stopped: bool) -> str:
    """The last line: what was learned, where it is, and how to go on."""
    learned = f"{steps} decisions{'' if report is None else _success(report)}; saved in {folder}"
    return f"interrupted; {learned}; go on with --resume" if stopped else learned


def _success(report: TrainingReport) -> str:
    if math.isnan(report.success):
        return ", no episode has ended yet"
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
