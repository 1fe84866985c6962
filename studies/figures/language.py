"""The numbers of docs/lab/language.md: what is understood, and how long parsing takes."""

from __future__ import annotations

import statistics
import time
from contextlib import suppress

from semnav_env.language import CommandError, parse
from semnav_env.language.languages import languages
from semnav_env.language.normalise import MAX_WORDS
from semnav_scripts.evaluate_language import Arguments

COMMAND = parse(
    "go down the hallway past the second door, turn left at the second intersection and go through "
    "the third door on the right"
)
RUNS = 21


def main() -> None:
    """Print how much of the development sets is understood, and how long parsing takes."""
    Arguments().run()
    for code, language in sorted(languages().items()):
        words, milliseconds = parsing(code)
        print(f"{language.name}: {words} words in {milliseconds:.0f} ms")


def parsing(code: str) -> tuple[int, float]:
    """The words of a text of the greatest length, and the median processor time to read it."""
    said = COMMAND.say(code)
    text = ", ".join([said] * (MAX_WORDS // (said.count(" ") + 1)))
    times = []
    for _ in range(RUNS):
        start = time.process_time()
        with suppress(CommandError):  # it has more clauses than are carried out
            parse(text, code)
        times.append(time.process_time() - start)
    return text.count(" ") + 1, 1000.0 * statistics.median(times)
