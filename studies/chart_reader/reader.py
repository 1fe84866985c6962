"""From a text to its candidates: commands with what the ranker knows of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from semnav_env.language.command import Command
from studies.chart_reader.beam import hypotheses, tags_of
from studies.chart_reader.chart import Chart, grammar_of
from studies.chart_reader.edits import edited
from studies.chart_reader.lattice import Lattice
from studies.chart_reader.lexicon import lexicon_of
from studies.chart_reader.programs import programs

MOST_HYPOTHESES, MOST_CANDIDATES = 40, 24
"""The most hypotheses that become programs, and the most programs that are ranked."""

MOST_COST_OVER = 7.0
"""A candidate may cost so much more than the cheapest one."""


@dataclass(frozen=True, eq=False)
class Candidate:
    """A command that a text may mean, or None for one that no clause can say.

    Attributes:
        command: of clauses.
        cost: of its derivation.
        tags: how often each thing stands in its derivation.
    """

    command: Command | None
    cost: float
    tags: dict[str, float]


def chart_of(text: str, code: str, rooms: Sequence[str] = ()) -> Chart:
    """The chart of a text."""
    lexicon = lexicon_of(code)
    return Chart(Lattice(text, lexicon, rooms), grammar_of(lexicon.language.name))


def candidates(chart: Chart) -> list[Candidate]:
    """The commands that a text may mean, the cheapest first."""
    found: dict[Command | None, tuple[float, dict[str, float]]] = {}
    best = None
    for hypothesis in hypotheses(chart)[:MOST_HYPOTHESES]:
        if best is not None and hypothesis.cost > best + MOST_COST_OVER:
            break
        for way in edited(hypothesis.entries):
            for draft in programs(way):
                cost = hypothesis.cost + draft.cost
                best = cost if best is None else min(best, cost)
                try:
                    command = None if draft.unsayable else Command(draft.clauses)
                except ValueError:
                    command = None
                if command not in found or cost < found[command][0]:
                    tags = tags_of(hypothesis.trace)
                    for tag in draft.tags:
                        tags[tag] = tags.get(tag, 0.0) + 1.0
                    found[command] = (cost, tags)
    ranked = sorted(found.items(), key=lambda pair: pair[1][0])[:MOST_CANDIDATES]
    return [Candidate(command, cost, tags) for command, (cost, tags) in ranked]
