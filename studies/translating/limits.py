"""`python -m studies limits`: show what becomes of texts with each limit of probability to act.

No text is one from which its translator has learned.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from semnav_env.language.command import room_of
from semnav_env.language.corpora import load_sentences
from semnav_env.language.corpora.meanings import key_of, normal
from semnav_env.language.corpora.measure import rooms_in
from semnav_env.language.errors import CommandError
from semnav_env.language.rewording import paraphrases
from semnav_env.language.sampling import sample_command
from semnav_env.language.stops import is_stop
from semnav_env.language.translating.interpreter import AskingLimits
from semnav_env.language.translating.network import TRAINED_FOLDER, load_translator
from semnav_env.language.translating.translator import translate
from studies.corpora import tuned_corpora
from studies.translating.command import TEACHERS_FOLDER, Recipe, strangers, teachers_in

PARAPHRASES = 200
"""Texts of the generator for each teacher; people say such long routes rarely."""

ACTING = (0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95)
"""The limits that are shown."""


@dataclass(frozen=True)
class TranslatedCase:
    """A text as a translator takes it.

    Attributes:
        kind: feasible, ambiguous or infeasible.
        candidates: the probability of each command, the highest first, and whether it is right.
        language: "english" or "german", or "generated".
    """

    kind: str
    candidates: tuple[tuple[float, bool], ...]
    language: str


@dataclass(frozen=True)
class Arguments:
    """Show what becomes of texts of strangers with each limit.

    Each teacher translates the texts of the quarter of the authors whom it does not know, and the
    translator those of the authors from whom only the limits were chosen.

    Attributes:
        teachers: folder of the teachers, see `python -m studies translator`.
        translator: folder of the translator.
        recipe: what teachers that are not there learn from.
    """

    teachers: Path = TEACHERS_FOLDER
    translator: Path = TRAINED_FOLDER
    recipe: Recipe = field(default_factory=Recipe)

    def run(self) -> int:
        """Translate, and show the tables."""
        cases: list[TranslatedCase] = []
        for teacher, folder in enumerate(teachers_in(self.teachers, self.recipe)):
            cases += (case for path in strangers(teacher) for case in cases_of(path, folder))
            cases += generated_cases(PARAPHRASES, folder, teacher)
        for language in ("english", "german", "generated"):
            _show(f"teachers, {language}", [each for each in cases if each.language == language])
        own = (case for path in tuned_corpora() for case in cases_of(path, self.translator))
        _show("translator", list(own))
        return 0


def cases_of(path: Path, folder: Path) -> Iterator[TranslatedCase]:
    """The texts of a corpus as a translator takes them, but for calls to stop.

    Args:
        path: of the corpus.
        folder: of the translator.
    """
    sentences = load_sentences(path)
    rooms = tuple(dict.fromkeys(rooms_in(each.meanings for each in sentences)))
    language = path.stem.partition("_")[2]
    for each in sentences:
        if not is_stop(each.text):
            meant = tuple(map(normal, each.meanings))
            yield _case(each.kind, each.text, rooms, meant, folder, language)


def generated_cases(count: int, folder: Path, seed: int) -> Iterator[TranslatedCase]:
    """Paraphrases of the generator, half of them German, with one to six clauses each."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        command, code = sample_command(rng, 6, 5), ("en", "de")[number % 2]
        text = paraphrases(command, rng, 1, code)[0]
        rooms = tuple(filter(None, map(room_of, command.clauses)))
        yield _case("feasible", text, rooms, (key_of(command),), folder, "generated")


def _case(
    kind: str,
    text: str,
    rooms: Sequence[str],
    meant: Sequence[object],
    folder: Path,
    language: str,
) -> TranslatedCase:
    try:
        found = translate(text, rooms, load_translator(folder))
    except CommandError:
        found = None
    translations = found.translations if found else ()
    candidates = ((each.likeness, key_of(each.command) in meant) for each in translations)
    return TranslatedCase(kind, tuple(candidates), language)


def outcome(case: TranslatedCase, limits: AskingLimits) -> str:
    """What becomes of a text: done, asked, asked wrongly, refused or misread.

    Unlike the interpreter this does not ask whether the text speaks of each choice.
    """
    if case.candidates and case.candidates[0][0] >= limits.acting:
        return "done" if case.candidates[0][1] else "misread"
    likely = case.candidates[: limits.choices]
    if sum(share for share, _ in likely) < limits.asking:
        return "refused"
    return "asked" if any(right for _, right in likely) else "asked wrongly"


def _show(title: str, cases: Sequence[TranslatedCase]) -> None:
    """A row for each limit: what becomes of the feasible texts, and of the infeasible ones."""
    print(f"| {title}, acts from | n | done | asked | asked wrongly | refused | misread |", end="")
    print(" infeasible | taken | asked |\n|---|---|---|---|---|---|---|---|---|---|")
    for acting in ACTING:
        limits = AskingLimits(acting=acting)
        counts = Counter((case.kind, outcome(case, limits)) for case in cases)
        feasible = {key: n for (kind, key), n in counts.items() if kind == "feasible"}
        infeasible = {key: n for (kind, key), n in counts.items() if kind == "infeasible"}
        cells = [
            *(acting, sum(feasible.values())),
            *(feasible.get(k, 0) for k in ("done", "asked", "asked wrongly", "refused", "misread")),
            *(sum(infeasible.values()), infeasible.get("misread", 0)),
            infeasible.get("asked wrongly", 0),
        ]
        print("| " + " | ".join(map(str, cells)) + " |")
