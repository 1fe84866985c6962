"""`python -m studies ranker`: learn the weights of the ranker, and show what each limit gives."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from semnav_env.language.translating.interpreter import AskingLimits
from semnav_env.language.translating.network import TRAINED_FOLDER
from semnav_env.language.translating.ranking import RANKER_FILE
from semnav_env.networks.card import CARD_FILE
from semnav_features.writing import write_file
from studies.corpora import author_of, learned_corpora
from studies.translating.command import Recipe
from studies.translating.ranker import RankedText, learned, paraphrased, ranked_texts, shares_of
from studies.translating.training import TranslatorTraining

FIRST_STRANGER = 11
"""The first author with whose texts the lexicon was not written."""

LIGHTER = Recipe(disturbed=48000, training=TranslatorTraining(steps=9000))
"""What the two translators learn from: less than the bundled one, as they know fewer authors."""

PARAPHRASES = 400
"""Of the generator, from which the ranker learns, too."""

ACTING = (0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95)
"""The limits that are shown."""


@dataclass(frozen=True)
class Arguments:
    """Learn the weights of the ranker from texts whose authors the translator does not know.

    The authors are parted in halves, but for those with whom the lexicon was written. A translator
    learns without each half, and translates its texts. The table is of weights that were learned
    from the other half; the weights that are written were learned from both.

    Attributes:
        folder: of the two translators; those that are there are not trained again.
        out: folder to which the weights are written; by default that of the package.
        recipe: what the translators learn from.
    """

    folder: Path = Path("out/halves")
    out: Path = TRAINED_FOLDER
    recipe: Recipe = field(default_factory=lambda: LIGHTER)

    def run(self) -> int:
        """Learn and write the weights."""
        halves = [self._texts(number) for number in range(2)]
        crossed = [
            (text, shares_of(text, weights))
            for known, asked in (halves, reversed(halves))
            for weights in [learned(known)]
            for text in asked
        ]
        for language in ("english", "german", "generated"):
            _show(language, [pair for pair in crossed if pair[0].language == language])
        weights = learned([text for half in halves for text in half])
        write_file(self.out / RANKER_FILE, json.dumps(weights, indent=1) + "\n")
        print(f"wrote {self.out / RANKER_FILE}")
        return 0

    def _texts(self, number: int) -> list[RankedText]:
        """The texts of a half, as a stranger to their authors translates them."""
        folder = self.folder / f"without_half_{number}"
        if not (folder / CARD_FILE).exists():
            half = half_of_authors(number)
            self.recipe.train([each for each in learned_corpora() if each not in half], folder)
        said = [t for path in half_of_authors(number) for t in ranked_texts(path, folder)]
        return [*said, *paraphrased(PARAPHRASES, folder)]


def half_of_authors(number: int) -> tuple[Path, ...]:
    """Files of authors who are ranked together; the translator of their texts learned from others.

    Args:
        number: 0 or 1.
    """
    strangers = (each for each in learned_corpora() if author_of(each) >= FIRST_STRANGER)
    return tuple(each for each in strangers if author_of(each) % 2 == number)


def _show(language: str, texts: Sequence[tuple[RankedText, Iterable[float]]]) -> None:
    """A row for each limit: what becomes of the feasible texts, and of the infeasible ones."""
    print(
        f"| {language}, acts from | n | done | asked | asked wrongly | refused | misread |", end=""
    )
    print(" infeasible | taken | asked |\n|---|---|---|---|---|---|---|---|---|---|")
    for acting in ACTING:
        limits = AskingLimits(acting=acting)
        counts = Counter((text.kind, outcome(text, shares, limits)) for text, shares in texts)
        feasible = {key: n for (kind, key), n in counts.items() if kind == "feasible"}
        infeasible = {key: n for (kind, key), n in counts.items() if kind == "infeasible"}
        cells = [
            *(acting, sum(feasible.values())),
            *(feasible.get(k, 0) for k in ("done", "asked", "asked wrongly", "refused", "misread")),
            *(sum(infeasible.values()), infeasible.get("misread", 0)),
            infeasible.get("asked wrongly", 0),
        ]
        print("| " + " | ".join(map(str, cells)) + " |")


def outcome(text: RankedText, shares: Iterable[float], limits: AskingLimits) -> str:
    """What becomes of a text: done, asked, asked wrongly, refused or misread."""
    ranks = sorted(zip(list(shares)[:-1], text.right, strict=True), key=lambda each: -each[0])
    if ranks and ranks[0][0] >= limits.acting:
        return "done" if ranks[0][1] else "misread"
    likely = ranks[: limits.choices]
    if sum(share for share, _ in likely) < limits.asking:
        return "refused"
    return "asked" if any(right for _, right in likely) else "asked wrongly"
