"""What becomes of canonical words, and how long a text takes."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np

from semnav_env.language.command import Command
from semnav_env.language.sampling import sample_command
from studies.chart_reader.reading import read

LONG_TEXT = "go past the second door on the left, turn right at the corner and "
"""Words of which a text of the greatest length is made."""


def changed_commands(count: int, code: str, rng: np.random.Generator) -> Iterator[Command]:
    """Sampled commands whose canonical words are read as something else."""
    for _ in range(count):
        command = sample_command(rng, 3, 5)
        rooms = tuple(c.name for c in command.clauses if hasattr(c, "name"))
        ranked = read(command.say(code), code, rooms).ranked
        if not ranked or ranked[0].command != command:
            yield command


def times(texts: list[str], code: str) -> np.ndarray:
    """How long each text takes, seconds of the processor; shape (texts,)."""
    found = []
    for text in texts:
        start = time.process_time()
        read(text, code)
        found.append(time.process_time() - start)
    return np.array(found)


def longest_text(words: int = 140) -> str:
    """A text of about so many words."""
    return (LONG_TEXT * (words // 14))[: -len(" and ")]
