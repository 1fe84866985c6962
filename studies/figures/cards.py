"""Write the results of the bundled agents into their model cards, from the kept results."""

from __future__ import annotations

from collections.abc import Sequence
from statistics import fmean
from typing import Any

from semnav_agents.evaluation.attempts import Attempt, read_attempts
from semnav_agents.hearing.network import NetworkShape
from semnav_agents.learning.policy import PolicySettings
from semnav_agents.networks.bundled import BUNDLED_FOLDER
from semnav_env.networks.card import Card, NetworkSettings
from studies.figures.leaderboard import RESULTS

AGENTS: dict[str, type[NetworkSettings]] = {"drive": PolicySettings, "listener": NetworkShape}
"""The bundled agents with kept results, and the settings of their networks."""


def results_of(agent: str) -> list[dict[str, Any]]:
    """The kept results of the bundled training of an agent, seed 0, a row for each file."""
    return [_row(read_attempts(path)) for path in sorted(RESULTS.glob(f"{agent}-0.*"))]


def _row(attempts: Sequence[Attempt]) -> dict[str, Any]:
    first = attempts[0]
    by_clauses = {
        str(n): _mean([each.success for each in attempts if each.clauses == n])
        for n in sorted({each.clauses for each in attempts})
    }
    return {
        "split": first.split,
        "robot": first.robot,
        "episodes": len(attempts),
        "success": _mean([each.success for each in attempts]),
        "success_by_clauses": by_clauses,
        "contact_free": _mean([each.contact_free for each in attempts]),
        "spl": _mean([each.spl for each in attempts]),
    }


def _mean(values: Sequence[float]) -> float:
    return round(fmean(values), 3)


def bundled_card(agent: str) -> Card[NetworkSettings]:
    """The card of a bundled agent as it is."""
    return Card.read(BUNDLED_FOLDER / agent, AGENTS[agent])


def main() -> None:
    """Write the results into the cards."""
    for agent in AGENTS:
        card = bundled_card(agent)
        card.notes["results"] = results_of(agent)
        card.write(BUNDLED_FOLDER / agent)
