"""Write the results of the bundled agents into their model cards, from the kept results."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from statistics import fmean
from typing import Any

from semnav_agents.evaluation.attempts import Attempt, read_attempts
from semnav_agents.hearing.agent import BUNDLED_FOLDER
from semnav_agents.hearing.card import ModelCard
from semnav_features.writing import write_file
from studies.figures.leaderboard import RESULTS

DRIVE_CARD = BUNDLED_FOLDER / "drive" / "card.json"
"""The card of the policy; that of an agent that hears is its `hearing.json`."""

LISTENER = BUNDLED_FOLDER / "listener"


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


def drive_card() -> dict[str, Any]:
    """The card of `drive` as it is."""
    return dict(json.loads(Path(DRIVE_CARD).read_text(encoding="utf-8")))


def main() -> None:
    """Write the results into the cards."""
    card = drive_card() | {"results": results_of("drive")}
    write_file(DRIVE_CARD, json.dumps(card, indent=1) + "\n")
    heard = ModelCard.read(LISTENER)
    heard.notes["results"] = results_of("listener")
    heard.write(LISTENER)
