"""`semnav train` of an agent that hears the command: rounds of driving and learning."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from rich.console import Console

from semnav_agents.hearing.presets import HEARING_PRESETS
from semnav_scripts.dispatch import exit_code_of
from semnav_scripts.progress import tracked


def train_hearing(name: str, folder: Path, seed: int, minutes: float | None) -> int:
    """Train, say how it goes, and save after each chunk of episodes and each epoch.

    Args:
        name: of the preset, one of `HEARING_PRESETS`.
        folder: of the agent; what was begun there is gone on with.
        seed: of weights, samples and their order.
        minutes: after which no other chunk or epoch is begun; None for no limit.
    """
    try:
        from semnav_agents.hearing.training import HearingTrainer
    except ModuleNotFoundError as error:
        raise ImportError(f'training needs {error.name}: pip install "semnav-env[rl]"') from None
    trainer = HearingTrainer(HEARING_PRESETS[name], folder, seed)
    console, start = Console(stderr=True), time.monotonic()
    total, code = trainer.steps, 0

    def done() -> int:
        return len(trainer.card.curve)

    rows = tracked(
        trainer.advance(), lambda _: f"{done()} of {total} steps", lambda: done() / total
    )
    try:
        for row in rows:
            console.print(_line(row, done(), total), highlight=False)
            if minutes is not None and time.monotonic() - start > 60.0 * minutes:
                break
    except KeyboardInterrupt as stop:
        code = exit_code_of(stop)
    ending = f"{done()} of {total} steps; saved in {folder}"
    print(f"interrupted; {ending}; go on with --resume" if code else ending)
    return code


def _line(row: dict[str, Any], number: int, steps: int) -> str:
    values = ", ".join(f"{name} {value}" for name, value in row.items())
    return f"{number} of {steps}: {values}"
