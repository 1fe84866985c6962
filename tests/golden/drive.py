"""The golden table of the bundled agent: how many of a few episodes it succeeds in."""

from __future__ import annotations

import json
from pathlib import Path

from semnav_env.agents.evaluation import run_suite
from semnav_env.episodes import evenly, load_episodes
from semnav_env.robots import ROBOTS

GOLDEN = Path(__file__).with_suffix(".json")

EPISODES = 10
"""Evenly spaced episodes of `val_seen` that each body drives."""


def counts(robot: str) -> dict[str, int]:
    """Episodes, those that succeed, and those without contact."""
    episodes = evenly(load_episodes("val_seen"), EPISODES)
    results = list(run_suite(episodes, "drive", robot))
    return {
        "episodes": len(results),
        "success": sum(result.success for result in results),
        "contact_free": sum(result.metrics.contact_free for result in results),
    }


if __name__ == "__main__":
    GOLDEN.write_text(json.dumps({robot: counts(robot) for robot in ROBOTS}, indent=1) + "\n")
