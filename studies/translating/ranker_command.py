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
from semnav_features.writing import write_file
from studies.translating.command import (
    QUARTERS,
    TEACHERS_FOLDER,
    Recipe,
    strangers,
    teachers_in,
)
from studies.translating.ranker import RankedText, learned, paraphrased, ranked_texts, shares_of

PARAPHRASES = 200
"""Of the generator, from which the ranker learns, too."""

ACTING = (0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95)
"""The limits that are shown."""


@dataclass(frozen=True)
class Arguments:
    """Learn the weights of the ranker from texts whose authors their translator does not know.

    Each teacher translates the texts of the quarter of the authors whom it does not know. The table
    is of weights that were learned from half of the quarters and asked about the others; the
    weights that are written were learned from all.

    Attributes:
        teachers: folder of the teachers, see `python -m studies translator`.
        out: folder to which the weights are written; by default that of the package.
        recipe: what teachers that are not there learn from.
    """

    teachers: Path = TEACHERS_FOLDER
    out: Path = TRAINED_FOLDER
    recipe: Recipe = field(default_factory=Recipe)

    def run(self) -> int:
        """Learn and write the weights."""
        quarters = [
            self._texts(quarter, folder)
            for quarter, folder in zip(
                QUARTERS, teachers_in(self.teachers, self.recipe), strict=True
            )
        ]
        halves = [quarters[0] + quarters[1], quarters[2] + quarters[3]]
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

    def _texts(self, quarter: int, folder: Path) -> list[RankedText]:
        """The texts of strangers, and paraphrases, as their teacher takes them."""
        said = [text for path in strangers(quarter) for text in ranked_texts(path, folder)]
        return [*said, *paraphrased(PARAPHRASES, folder, quarter)]


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
