"""What a training on Ray costs: processor time a decision, and bytes an update."""

from __future__ import annotations

import pickle
import time
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from semnav_agents.learning.presets import preset
from semnav_agents.learning.rllib.options import RayOptions
from semnav_agents.learning.rllib.start import start_training

if TYPE_CHECKING:  # Ray is optional
    from semnav_agents.learning.rllib.trainer import RayTrainer
    from semnav_agents.learning.training import Trainer


@dataclass(frozen=True)
class Arguments:
    """Measure what a decision and an update of `semnav train --engine ray` cost.

    Processor time is told besides time on the clock, for it hardly depends on what else the
    machine does.

    Attributes:
        preset: what is learned.
        runners: processes that drive robots; 0 for `--engine local`.
        robots: robots of each runner.
        updates: number of updates that are measured, after two that are not.
    """

    preset: str = "hallway"
    runners: int = 1
    robots: int = 32
    updates: int = 6

    def run(self) -> int:
        """Measure, and print one row of a table."""
        wanted = replace(preset(self.preset), envs=self.robots * max(self.runners, 1))
        with TemporaryDirectory() as folder:
            if self.runners:
                options = RayOptions(runners=self.runners)
                trainer = start_training(wanted, Path(folder), 0, options)
                print(_row(trainer, self.updates, options))
                trainer.close()
            else:
                from semnav_agents.learning.training import Trainer

                local = Trainer(wanted, Path(folder), 0)
                print(_local_row(local, self.updates))
                local.close()
        return 0


def _local_row(trainer: Trainer, updates: int) -> str:
    for _ in range(2):
        trainer.advance()
    spent, start, steps = time.process_time(), time.perf_counter(), trainer.steps
    for _ in range(updates):
        trainer.advance()
    seconds, decisions = time.perf_counter() - start, trainer.steps - steps
    return (
        f"--engine local: {decisions / seconds:.0f} decisions a second; "
        f"processor time a decision {1e6 * (time.process_time() - spent) / decisions:.0f} us"
    )


def _row(trainer: RayTrainer, updates: int, options: RayOptions) -> str:
    for _ in range(2):
        trainer.advance()
    batches = _noted_batches(trainer)
    driven, learned = _runner_seconds(trainer), time.process_time()
    start, steps = time.perf_counter(), trainer.steps
    for _ in range(updates):
        trainer.advance()
    seconds, decisions = time.perf_counter() - start, trainer.steps - steps
    driven, learned = _runner_seconds(trainer) - driven, time.process_time() - learned
    weights = len(pickle.dumps(trainer.algorithm.learner_group.get_weights()))
    episodes = sum(len(pickle.dumps(batch)) for batch in batches) / decisions
    return (
        f"{options.runners} runners: {decisions / seconds:.0f} decisions"
        f" a second; processor time a decision {1e6 * driven / decisions:.0f} us in the runners, "
        f"{1e6 * learned / decisions:.0f} us in the learner; {weights / 1e3:.0f} kB of weights to "
        f"each runner and update, {episodes:.0f} bytes of episodes a decision"
    )


def _noted_batches(trainer: RayTrainer) -> list[Any]:
    """A list to which the episodes of each batch are added."""
    batches: list[Any] = []
    group = trainer.algorithm.learner_group
    update = group.update

    def noted(**options: Any) -> Any:
        batches.append(options["episodes"])
        return update(**options)

    group.update = noted
    return batches


def _runner_seconds(trainer: RayTrainer) -> float:
    """Processor time of all runners together, seconds."""
    runners = trainer.algorithm.env_runner_group
    spent = runners.foreach_env_runner(lambda _: time.process_time(), local_env_runner=False)
    return float(sum(spent))
