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

LIGHTER = Recipe(disturbed=64000, training=TranslatorTraining(steps=10000))
"""What its translator learns from: less than the bundled one, as it knows fewer authors."""

PARAPHRASES = 400
"""Of the generator, from which the ranker learns, too."""

ACTING = (0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95)
"""The limits that are shown."""


@dataclass(frozen=True)
class Arguments:
    """Learn the weights of the ranker from texts whose authors the translator does not know.

    A translator learns without every second author, and translates their texts. The table is of
    weights that were learned from half of these authors and asked about the others; the weights
    that are written were learned from all of them.

    Attributes:
        folder: of the translator; one that is there is not trained again.
        out: folder to which the weights are written; by default that of the package.
        recipe: what the translator learns from.
    """

    folder: Path = Path("out/half")
    out: Path = TRAINED_FOLDER
    recipe: Recipe = field(default_factory=lambda: LIGHTER)

    def run(self) -> int:
        """Learn and write the weights."""
        if not (self.folder / CARD_FILE).exists():
            known = [each for each in learned_corpora() if each not in strangers()]
            self.recipe.train(known, self.folder)
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
        """The texts of every second stranger, and paraphrases, as the translator takes them."""
        paths = strangers()[number * 2 :: 4], strangers()[number * 2 + 1 :: 4]
        said = [t for each in paths for path in each for t in ranked_texts(path, self.folder)]
        return [*said, *paraphrased(PARAPHRASES, self.folder, number)]


def strangers() -> tuple[Path, ...]:
    """The files of the authors whom the translator of the ranker does not know."""
    known = (each for each in learned_corpora() if author_of(each) >= FIRST_STRANGER)
    return tuple(each for each in known if author_of(each) % 2)


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
