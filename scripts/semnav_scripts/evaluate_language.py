"""`semnav evaluate language`: how much of people's commands is understood."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Literal

from tyro.conf import Positional

from semnav_env.language import Command, LearnedInterpreter
from semnav_env.language.corpora import (
    Count,
    ParseOutcome,
    SentenceVerdict,
    load_sentences,
    verdicts,
)
from semnav_env.language.translating.network import TRAINED_FOLDER
from semnav_scripts.progress import tracked

HELD_OUT = Path("studies/corpora/held_out")
"""Folder of the sets of which nothing was learned, from the root of a checkout."""


@dataclass(frozen=True)
class Arguments:
    """Count the sentences that are understood, asked about, refused and misread.

    Attributes:
        corpora: files of sentences with their meanings (.jsonl, see docs/guides/meanings.md), or of
            plain sentences, one a line; by default those of which nothing was
            learned, in a checkout.
        language: force a language; by default each text is recognised.
        translator: folder of the translator; by default that of the package.
        show: print the sentences with this outcome.
        json: print JSON.
    """

    corpora: Positional[tuple[Path, ...]] = ()
    language: str | None = None
    translator: Path = TRAINED_FOLDER
    show: Literal["understood", "asked", "refused", "misread"] | None = None
    json: bool = False

    def run(self) -> int:
        """Judge every sentence, and print the counts."""
        corpora = [load_sentences(path) for path in self._files()]
        total = sum(map(len, corpora))
        judged = (verdicts(each, self._understood, self.language) for each in corpora)
        found: list[SentenceVerdict] = []
        for verdict in tracked(
            chain.from_iterable(judged), lambda n: f"{n} sentences", lambda: len(found) / total
        ):
            found.append(verdict)
        counts: defaultdict[tuple[str, str], Count] = defaultdict(Count)
        for verdict in found:
            sentence = verdict.sentence
            counts[sentence.corpus, sentence.kind].outcomes[verdict.outcome] += 1
        shown = [verdict for verdict in found if self.show and _is_shown(verdict, self.show)]
        if self.json:
            rows = [_row(*key, count) for key, count in counts.items()]
            print(json.dumps({"counts": rows, "shown": [_plain(each) for each in shown]}))
        else:
            _print(counts, shown)
        return 0

    def _files(self) -> Sequence[Path]:
        found = self.corpora or sorted(HELD_OUT.glob("*.jsonl"))
        if not found:
            raise ValueError(
                f"name files of sentences; there are none in {HELD_OUT}, as in a checkout"
            )
        return found

    def _understood(self, text: str, language: str | None, rooms: Sequence[str]) -> Command:
        return LearnedInterpreter(language, rooms, folder=self.translator).interpret(text).command


def _is_shown(verdict: SentenceVerdict, show: str) -> bool:
    wrong = show == "misread" and verdict.outcome is ParseOutcome.ASKED_WRONGLY
    return verdict.outcome == show or wrong


def _row(corpus: str, kind: str, count: Count) -> dict[str, object]:
    outcomes = {each.value: count.outcomes[each] for each in ParseOutcome}
    return {"corpus": corpus, "kind": kind, "sentences": count.total, **outcomes}


def _plain(verdict: SentenceVerdict) -> dict[str, object]:
    sentence = verdict.sentence
    return {"id": sentence.id, "text": sentence.text, "answer": verdict.answer}


def _print(counts: dict[tuple[str, str], Count], shown: Sequence[SentenceVerdict]) -> None:
    width = max((len(f"{corpus} {kind}") for corpus, kind in counts), default=0) + 2
    print(f"{'':<{width}}{'n':>6}" + "".join(f"{each.value:>15}" for each in ParseOutcome))
    for (corpus, kind), count in counts.items():
        cells = (f"{count.outcomes[each]:>7} {count.share(each):7.1%}" for each in ParseOutcome)
        print(f"{f'{corpus} {kind}':<{width}}{count.total:>6}" + "".join(cells))
    for verdict in shown:
        said = " / ".join(verdict.answer)
        print(f'{verdict.sentence.id} "{verdict.sentence.text}": {verdict.outcome}: {said}')
