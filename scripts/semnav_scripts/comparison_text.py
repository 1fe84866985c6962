"""The comparison of two agents as text that fits a terminal of 80 columns."""

from __future__ import annotations

from semnav_agents.evaluation.comparison import Comparison, MeasureComparison
from semnav_agents.evaluation.provenance import UNKNOWN
from semnav_scripts.leaderboard_text import SHOWN_DIGITS

TITLES = {"success": "success", "contact_free": "no contact", "spl": "SPL"}
"""Measures, as the table calls them."""

COLUMNS = "{:<10} {:>6} {:>6}  {:<26} {:>8} {:>8} {:>7}"
"""A line of the table."""


def comparison_text(compared: Comparison) -> str:
    """A heading, the two agents, and a line for each measure."""
    made = dict.fromkeys(map(_made_by, compared.versions, compared.rules))
    where = compared.split, compared.robot, f"{compared.episodes} episodes", " and ".join(made)
    names = (f"{side}: {agent}" for side, agent in zip("AB", compared.agents, strict=True))
    head = COLUMNS.format("", "A", "B", "A - B (95 %)", "A better", "B better", "p")
    lines = [_line(TITLES[name], each) for name, each in compared.measures.items()]
    return "\n".join([", ".join(where), *names, head, *lines])


def _made_by(version: str, rules: str) -> str:
    return rules if rules == UNKNOWN else f"{version}, rules {rules[:SHOWN_DIGITS]}"


def _line(title: str, measure: MeasureComparison) -> str:
    mean, low, high = measure.difference
    return COLUMNS.format(
        title,
        f"{measure.first:.3f}",
        f"{measure.second:.3f}",
        f"{mean:+.3f} ({low:+.3f} to {high:+.3f})",
        measure.first_better,
        measure.second_better,
        f"{measure.p_value:.3f}",
    )
