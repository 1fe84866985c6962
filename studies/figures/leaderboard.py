"""Writes the table of docs/guides/leaderboard.md from the kept results in docs/results."""

from __future__ import annotations

import re

from semnav_agents.evaluation.attempts import read_attempts
from semnav_agents.evaluation.leaderboard import Standing, standings
from semnav_scripts.leaderboard import KEPT_SUFFIX, markdown
from studies.figures import IMAGES

PAGE = IMAGES.parent / "guides" / "leaderboard.md"

RESULTS = IMAGES.parent / "results"
"""Folder of the kept results: one file for each agent, split and body."""

TABLE = re.compile(r"^\| split .*\n(?:\|.*\n)*", re.MULTILINE)
"""The table in the page."""


def main() -> None:
    """Write the table."""
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")


def kept_standings() -> list[Standing]:
    """The standings as they follow from the kept results."""
    files = sorted(RESULTS.glob(f"*{KEPT_SUFFIX}"))
    return standings(attempt for file in files for attempt in read_attempts(file))


def page(text: str) -> str:
    """The text of the page with the table as it follows from the kept results."""
    return TABLE.sub(lambda _: markdown(kept_standings()), text, count=1)
