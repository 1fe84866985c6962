"""The golden table of the bundled agents that drive: how many of a few episodes succeed."""

from __future__ import annotations

import json
from pathlib import Path

from semnav_agents.evaluation import run_suite
from semnav_env.judge.episodes import evenly, load_episodes

GOLDEN = Path(__file__).with_suffix(".json")

EPISODES = {
    "drive on wheelchair": 16,
    "drive on spot": 16,
    "listener_drives on wheelchair": 10,
}
"""Evenly spaced episodes of `val_seen` that each agent drives on a body; with the 8 of the listener
(`listener.json`) they are fifty."""


def counts(name: str) -> dict[str, int]:
    """Episodes, those that succeed, and those without contact."""
    agent, robot = name.split(" on ")
    episodes = evenly(load_episodes("val_seen"), EPISODES[name])
    results = list(run_suite(episodes, agent, robot))
    return {
        "episodes": len(results),
        "success": sum(result.success for result in results),
        "contact_free": sum(result.metrics.contact_free for result in results),
    }


if __name__ == "__main__":
    GOLDEN.write_text(json.dumps({name: counts(name) for name in EPISODES}, indent=1) + "\n")
