"""`python -m studies chart_reader`: train and measure the chart reader beside today's grammar."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from semnav_agents.translating.interpreter import understand as with_second_opinion
from semnav_env.language.corpora import load_sentences, verdicts
from semnav_env.language.parser import parse
from studies.chart_reader.canonical import changed_commands, longest_text, times
from studies.chart_reader.examples import SAMPLED, Example, all_examples, sampled_examples
from studies.chart_reader.lexicon import TABLES
from studies.chart_reader.measuring import OUTCOMES, Limits, chosen_limits, counted
from studies.chart_reader.reading import understand_with_doubt
from studies.chart_reader.training import Trainer
from studies.corpora import development_corpora, held_out_corpora

CODES = {"english": "en", "german": "de"}


@dataclass(frozen=True)
class Arguments:
    """Train the chart reader's ranker and measure it, each author left out in turn.

    Attributes:
        held_out: measure the held-out authors, too.
        compare: measure today's grammar and the second opinion on the same sets; it is slow.
        write: write the weights that were learned from all development sets.
        doubt: measure the written weights with the learned translator as a second opinion on the
            held-out authors, who are the only ones from whom it has not learned. Needs `write`.
        canonical: sampled commands whose canonical words are read; texts are timed, too.
        sampled: sampled commands in each language from which the ranker learns, too.
    """

    held_out: bool = False
    compare: bool = False
    write: bool = False
    doubt: bool = False
    sampled: int = 200
    canonical: int = 0

    def run(self) -> int:
        """Print a table by language."""
        print("| language | authors | reader | n |" + "".join(f" {o} |" for o in OUTCOMES), end="")
        print(" infeasible taken |\n|---|---|---|---|" + "---|" * (len(OUTCOMES) + 1))
        for name, code in CODES.items():
            self._measure(name, code)
        for name, code in CODES.items() if self.canonical else ():
            self._speak(name, code)
        return 0

    def _speak(self, name: str, code: str) -> None:
        """Read canonical words, and time the first development set and a long text."""
        changed = list(changed_commands(self.canonical, code, np.random.default_rng(0)))
        print(f"{name}: {len(changed)} of {self.canonical} commands are read as something else")
        file = next(each for each in development_corpora() if name in each.stem)
        each = 1000 * times([sentence.text for sentence in load_sentences(file)], code)
        long = 1000 * times([longest_text()], code)[0]
        middle, most = np.quantile(each, (0.5, 0.99))
        print(f"{name}: median {middle:.0f} ms, 99 of 100 under {most:.0f} ms, long {long:.0f} ms")

    def _measure(self, name: str, code: str) -> None:
        files = [file for file in development_corpora() if name in file.stem]
        examples = list(all_examples([(file, code) for file in files]))
        trainer = Trainer([*examples, *sampled_examples(self.sampled, code)])
        chances = left_out_chances(trainer)
        limits = chosen_limits(examples, chances)
        there = sum(any(e.right[:-1]) for e in examples if e.sentence.kind == "feasible")
        title = f"chart, author left out, acts from {limits.act:g} ({there} among the candidates)"
        _print(name, "1 to 6", title, counted(examples, chances, limits))
        self._compare(name, "1 to 6", files)
        learned = trainer.train(_unambiguous(trainer.examples))
        weights = {n: round(float(w), 3) for n, w in zip(trainer.names, learned, strict=True)}
        if self.write:
            text = json.dumps(weights, indent=0, ensure_ascii=False)
            (TABLES / f"weights_{code}.json").write_text(text + "\n", "utf-8")
        if self.held_out:
            files = [file for file in held_out_corpora() if name in file.stem]
            others = list(all_examples([(file, code) for file in files]))
            found = [_chances(each, weights) for each in others]
            for own in (limits, Limits(act=0.7), Limits(act=0.5)):
                counts = counted(others, found, own)
                _print(name, "7 and 8", f"chart, acts from {own.act:g}", counts)
            self._compare(name, "7 and 8", files)
            if self.doubt:
                reader = partial(understand_with_doubt, limits=limits)
                title = f"chart, acts from {limits.act:g}, or from 0.5 with the translator"
                _print(name, "7 and 8", title, _judged(files, reader, code))

    def _compare(self, name: str, authors: str, files: Sequence[Path]) -> None:
        if not self.compare:
            return
        for title, reader in (("grammar", parse), ("second opinion", with_second_opinion)):
            _print(name, authors, title, _judged(files, reader, None))


def _judged(files: Sequence[Path], reader: Any, code: str | None) -> dict[str, Counter[str]]:
    """How many texts of each kind come to which outcome."""
    counts: dict[str, Counter[str]] = {}
    for file in files:
        for each in verdicts(load_sentences(file), code, reader):
            kind = counts.setdefault(each.sentence.kind, Counter())
            kind[each.outcome.value] += 1
    return counts


def left_out_chances(trainer: Trainer) -> list[np.ndarray]:
    """The probabilities of each example's candidates, learned from the other authors."""
    examples = trainer.examples
    found: dict[int, np.ndarray] = {}
    for author in dict.fromkeys(e.author for e in examples if e.author != SAMPLED):
        known = [i for i in _unambiguous(examples) if examples[i].author != author]
        weights = trainer.train(known)
        for i, each in enumerate(examples):
            if each.author == author:
                found[i] = trainer.probabilities(i, weights)
    return [found[i] for i in range(len(found))]


def _unambiguous(examples: Sequence[Example]) -> list[int]:
    return [i for i, each in enumerate(examples) if each.sentence.kind != "ambiguous"]


def _chances(example: Example, weights: dict[str, float]) -> np.ndarray:
    rows = example.features
    scores = np.array([sum(weights.get(n, 0.0) * v for n, v in row.items()) for row in rows])
    raised = np.exp(scores - scores.max())
    found: np.ndarray = raised / raised.sum()
    return found


def _print(name: str, authors: str, title: str, counts: dict[str, Counter[str]]) -> None:
    feasible, infeasible = counts["feasible"], counts["infeasible"]
    cells = "".join(f" {feasible[outcome]} |" for outcome in OUTCOMES)
    taken = f"{infeasible['misread']} of {infeasible.total()}"
    total = feasible.total()
    print(f"| {name} | {authors} | {title} | {total} |{cells} {taken} |", flush=True)
