"""The numbers of docs/language.md: what is understood of the corpus, and how long parsing takes."""

from __future__ import annotations

import csv
import statistics
import time
from pathlib import Path

from semnav_env.commands import CommandError, parse, readings
from semnav_env.commands.grammar import find_clauses
from semnav_env.commands.languages import languages
from semnav_env.commands.normalise import MAX_WORDS, normalise

CORPUS = Path(__file__).resolve().parents[2] / "tests" / "corpus"
ROOMS = ("kitchen", "printer room", "3.508", "204", "12", "101", "kueche", "druckerraum")
COMMAND = parse(
    "go down the hallway past the second door, turn left at the second intersection and go through "
    "the third door on the right"
)
RUNS = 21


def main() -> None:
    """Print how much of the corpus is understood, and how long parsing takes."""
    for code, language in sorted(languages().items()):
        understood, refused, wrong = corpus(language.name, code)
        words, milliseconds = parsing(code)
        print(
            f"{language.name}: {understood} of {understood + refused + wrong} commands understood, "
            f"{refused} refused, {wrong} misunderstood; {words} words in {milliseconds:.0f} ms"
        )


def corpus(name: str, code: str) -> tuple[int, int, int]:
    """How many commands of the corpus are understood, refused, and taken for something else."""
    with (CORPUS / f"{name}.csv").open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file, delimiter=";") if row["program"]]
    counts = [0, 0, 0]
    for row in rows:
        meant = set(map(parse, row["program"].split(" / ")))
        try:
            counts[0 if set(readings(row["text"], code, ROOMS)) == meant else 2] += 1
        except CommandError:
            counts[1] += 1
    return counts[0], counts[1], counts[2]


def parsing(code: str) -> tuple[int, float]:
    """The words of a text of the greatest length, and the median processor time to read it."""
    language = languages()[code]
    said = COMMAND.say(language)
    text = ", ".join([said] * (MAX_WORDS // (said.count(" ") + 1)))
    times = []
    for _ in range(RUNS):
        start = time.process_time()
        find_clauses(language, normalise(text, language).text)
        times.append(time.process_time() - start)
    return text.count(" ") + 1, 1000.0 * statistics.median(times)
