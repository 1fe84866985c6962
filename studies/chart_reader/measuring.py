"""Judges what the ranker makes of examples: done, asked, refused, misread."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from studies.chart_reader.examples import Example

OUTCOMES = ("understood", "asked", "asked wrongly", "refused", "misread")
"""What may become of a feasible text."""

MOST_MISREAD, MOST_TAKEN = 0.01, 0.02
"""Share of the feasible texts that may be misread, and of the infeasible ones that may be taken."""


@dataclass(frozen=True)
class Limits:
    """When to act, and when to refuse.

    Attributes:
        act: the least probability of the best reading for acting.
        refuse: the probability of "none of these" from which on a text is refused.
        ask: the least probability of the best reading for a question.
    """

    act: float = 0.7
    refuse: float = 0.35
    ask: float = 0.15


LIMITS = Limits()
"""Limits that misread about as much as today's grammar."""


def outcome_of(example: Example, chances: np.ndarray, limits: Limits) -> str:
    """What becomes of a text, in the words of `semnav evaluate language`."""
    groups: dict[object, list[float]] = {}
    for chance, form, right in zip(chances, example.forms, example.right, strict=True):
        group = groups.setdefault(form, [0.0, float(right and form is not None)])
        group[0] += float(chance)
    none = groups.pop(None, [0.0, 0.0])[0]
    ranked = sorted(groups.values(), key=lambda group: -group[0])
    if not ranked or none > limits.refuse or ranked[0][0] < limits.ask:
        return "refused"
    if ranked[0][0] >= limits.act:
        return "understood" if ranked[0][1] else "misread"
    return "asked" if any(group[1] for group in ranked[:2]) else "asked wrongly"


def counted(
    examples: Sequence[Example], chances: Sequence[np.ndarray], limits: Limits
) -> dict[str, Counter[str]]:
    """How many texts of each kind came to which outcome."""
    found: dict[str, Counter[str]] = {}
    for example, chance in zip(examples, chances, strict=True):
        kind = example.sentence.kind
        found.setdefault(kind, Counter())[outcome_of(example, chance, limits)] += 1
    return found


def chosen_limits(examples: Sequence[Example], chances: Sequence[np.ndarray]) -> Limits:
    """The limits with the most texts done rightly among those that misread few enough."""
    best = (-1, Limits(act=1.0))
    for act in np.arange(0.5, 1.0, 0.01):
        limits = Limits(act=round(float(act), 2))
        counts = counted(examples, chances, limits)
        feasible, infeasible = counts["feasible"], counts["infeasible"]
        few = feasible["misread"] <= MOST_MISREAD * feasible.total()
        if few and infeasible["misread"] <= MOST_TAKEN * infeasible.total():
            best = max(best, (feasible["understood"], limits), key=lambda each: each[0])
    return best[1]
