"""Ranks the candidates of a text: a log-linear model over what they were made of."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import cache
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from semnav_env.language.clauses import Clause, Follow, GoToDoor, GoToRoom, Turn
from studies.chart_reader.beam import PROTECTED
from studies.chart_reader.chart import Chart
from studies.chart_reader.lattice import SLIP
from studies.chart_reader.lexicon import TABLES

if TYPE_CHECKING:
    from studies.chart_reader.reader import Candidate

MOST_COST = 12.0
"""Larger costs count as this one."""

QUESTION_WORDS = frozenset(
    [
        "is",
        "are",
        "was",
        "do",
        "does",
        "did",
        "what",
        "why",
        "who",
        "when",
        "how",
        "where",
        "which",
        "has",
        "have",
        "am",
        "ist",
        "sind",
        "war",
        "was",
        "warum",
        "wer",
        "wann",
        "wie",
        "wo",
        "welche",
        "welcher",
        "hat",
        "habe",
        "bin",
        "wieso",
        "weshalb",
    ]
)


def features_of(found: Sequence[Candidate]) -> list[dict[str, float]]:
    """The features of each candidate of a text."""
    best = min((each.cost for each in found), default=0.0)
    return [_features(each, best) for each in found]


def _features(candidate: Candidate, best: float) -> dict[str, float]:
    values = dict(candidate.tags)
    values["cost"] = min(candidate.cost, MOST_COST)
    values["cost over best"] = min(candidate.cost - best, MOST_COST)
    if candidate.command is None:
        values["unsayable"] = 1.0
        return values
    clauses = candidate.command.clauses
    values["clauses"] = float(len(clauses))
    kinds = ["start", *map(_kind, clauses), "end"]
    for first, second in pairwise(kinds):
        values[f"K:{second}"] = values.get(f"K:{second}", 0.0) + 1.0
        values[f"K:{first}>{second}"] = values.get(f"K:{first}>{second}", 0.0) + 1.0
    return values


def _kind(clause: Clause) -> str:
    """A clause without its numbers and sides."""
    name = type(clause).__name__
    if isinstance(clause, Follow):
        what = clause.until
        return (
            f"{name}:{'past:' if clause.past else ''}{getattr(what, 'place', type(what).__name__)}"
        )
    if isinstance(clause, Turn):
        where = getattr(clause.at, "place", "by" if clause.degrees else "here")
        return f"{name}:{'around:' if clause.turning == 'around' else ''}{where}"
    if isinstance(clause, GoToDoor | GoToRoom):
        return f"{name}:{clause.approach}"
    return name


def text_features(chart: Chart, text: str, found: Sequence[Candidate]) -> dict[str, float]:
    """The features of "none of these": what of a text speaks against its being a command."""
    costs = [each.cost for each in found if each.command is not None]
    best = min(costs, default=MOST_COST)
    values = {"none": 1.0, "none:no candidate": float(not costs), "none:cost": min(best, MOST_COST)}
    values |= {
        f"none:cost over {limit}": float(best > limit) for limit in (0.6, 1.2, 2.0, 3.0, 5.0)
    }
    words = chart.lattice.words
    single = [
        {
            symbol
            for symbol, row in spans.items()
            if any(stop == at + 1 and c <= 0.2 for stop, _, c in row)
        }
        for at, spans in enumerate(chart.at)
    ]
    beyond = sum("BEYOND" in symbols and not symbols & PROTECTED for symbols in single)
    alone = sum(symbols == {"BEYOND"} or symbols == {"NAREA"} for symbols in single)
    unknown = sum(chart.lattice.unknown)
    slips = sum(bool(row) and min(edge.cost for edge in row) >= SLIP for row in chart.lattice.edges)
    values["none:slips"] = min(slips, 4.0)
    values |= {"none:beyond": min(beyond, 3.0), "none:beyond alone": min(alone, 3.0)}
    values |= {"none:any beyond": float(alone > 0), "none:any unknown": float(unknown > 0)}
    values |= {"none:unknown": min(unknown, 4.0), "none:words": min(len(words), 30) / 10.0}
    values |= {"none:negated": float(any("NOT" in symbols for symbols in single))}
    values |= {"none:or": float(any("OR" in symbols for symbols in single))}
    if "?" in text:
        asked = words and words[0] in QUESTION_WORDS
        values["none:question word" if asked else "none:question"] = 1.0
    elif words and words[0] in QUESTION_WORDS:
        values["none:begins as question"] = 1.0
    return values


@cache
def weights(code: str) -> dict[str, float]:
    """The weights of a language."""
    table: dict[str, float] = json.loads((TABLES / f"weights_{code}.json").read_text("utf-8"))
    return table


def probabilities(rows: Sequence[Mapping[str, float]], weight: Mapping[str, float]) -> np.ndarray:
    """The probability of each row of features; shape (rows,)."""
    scores = np.array([sum(weight.get(name, 0.0) * v for name, v in row.items()) for row in rows])
    raised = np.exp(scores - scores.max())
    found: np.ndarray = raised / raised.sum()
    return found
