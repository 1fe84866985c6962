"""Learns the weights of the ranker, and chooses from which probabilities on a robot acts.

Each text has the candidates that a translator finds which has not learned from its author.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from semnav_env.language.command import room_of
from semnav_env.language.corpora import Sentence, load_sentences
from semnav_env.language.corpora.meanings import key_of, normal
from semnav_env.language.corpora.measure import rooms_in
from semnav_env.language.errors import CommandError
from semnav_env.language.rewording import paraphrases
from semnav_env.language.sampling import sample_command
from semnav_env.language.stops import is_stop
from semnav_env.language.translating.network import load_translator
from semnav_env.language.translating.ranking import evidence
from semnav_env.language.translating.translator import TranslatedText, translate

Array = NDArray[np.float64]

PRIOR = 1.0
"""Weight of the squares of the weights; none of them should carry a text alone."""


@dataclass(frozen=True)
class RankedText:
    """A text with the evidence about its translations.

    Attributes:
        kind: feasible, ambiguous or infeasible.
        evidence: of each translation.
        right: which translations the text means.
        language: "english" or "german".
    """

    kind: str
    evidence: tuple[Mapping[str, float], ...]
    right: tuple[bool, ...]
    language: str


def ranked_texts(path: Path, folder: Path) -> Iterator[RankedText]:
    """The texts of a corpus as a translator takes them, but for calls to stop.

    Args:
        path: of the corpus.
        folder: of the translator.
    """
    sentences = load_sentences(path)
    rooms = tuple(dict.fromkeys(rooms_in(each.meanings for each in sentences)))
    language = "german" if "german" in path.stem else "english"
    for sentence in sentences:
        if not is_stop(sentence.text):
            yield _ranked(sentence, rooms, folder, language)


def _ranked(sentence: Sentence, rooms: Sequence[str], folder: Path, language: str) -> RankedText:
    meant = tuple(map(normal, sentence.meanings))
    return _judged(sentence.kind, _translated(sentence.text, rooms, folder), meant, language)


def _translated(text: str, rooms: Sequence[str], folder: Path) -> TranslatedText | None:
    try:
        return translate(text, rooms, load_translator(folder))
    except CommandError:
        return None


def _judged(
    kind: str, found: TranslatedText | None, meant: Sequence[object], language: str
) -> RankedText:
    """The evidence about what a text is taken for, and which of it is meant."""
    translations = found.translations if found else ()
    return RankedText(
        kind,
        tuple(evidence(each, found) for each in translations if found),
        tuple(key_of(each.command) in meant for each in translations),
        language,
    )


def paraphrased(count: int, folder: Path, seed: int) -> Iterator[RankedText]:
    """Paraphrases of the generator, half of them German, with one to six clauses each.

    People say such long routes rarely.
    """
    rng = np.random.default_rng(seed)
    for number in range(count):
        command, code = sample_command(rng, 6, 5), ("en", "de")[number % 2]
        text = paraphrases(command, rng, 1, code)[0]
        rooms = tuple(filter(None, map(room_of, command.clauses)))
        found = _translated(text, rooms, folder)
        yield _judged("feasible", found, (key_of(command),), "generated")


def learned(texts: Sequence[RankedText]) -> dict[str, float]:
    """The weights under which the right candidates, or none where none is, are likeliest."""
    judged = [each for each in texts if each.kind != "ambiguous" and each.evidence]
    names = sorted({name for text in judged for each in text.evidence for name in each})
    tables = [_table(text, names) for text in judged]
    right = [np.array([*text.right, not any(text.right)], float) for text in judged]

    def loss(weights: Array) -> tuple[float, Array]:
        total, slope = 0.5 * PRIOR * float(weights @ weights), PRIOR * weights
        for table, wanted in zip(tables, right, strict=True):
            shares = _shares(table, weights)
            hit = float(shares @ wanted) + 1e-12
            total -= float(np.log(hit))
            slope = slope - table.T @ (shares * wanted / hit - shares)[:-1]
        return total, slope

    found = minimize(loss, np.zeros(len(names)), jac=True, method="L-BFGS-B").x
    return {name: round(float(w), 4) for name, w in zip(names, found, strict=True)}


def shares_of(text: RankedText, weights: Mapping[str, float]) -> Array:
    """Probability of each candidate, and behind them that of "none of these"."""
    names = list(weights)
    return _shares(_table(text, names), np.array([weights[name] for name in names]))


def _table(text: RankedText, names: Sequence[str]) -> Array:
    rows = [[each.get(name, 0.0) for name in names] for each in text.evidence]
    return np.array(rows, float).reshape(len(rows), len(names))


def _shares(table: Array, weights: Array) -> Array:
    scores = np.append(table @ weights, 0.0)
    raised = np.exp(scores - scores.max())
    shares: Array = raised / raised.sum()
    return shares
