"""`python -m studies drift`: success against drift, with and without correction."""

from __future__ import annotations

import json
from dataclasses import dataclass
from itertools import product
from pathlib import Path

from semnav_env.judge.episodes import evenly, load_episodes
from semnav_scripts.jsonl import JsonLines
from semnav_scripts.progress import tracked
from studies.drift.measure import Condition, Ending, endings, row


@dataclass(frozen=True)
class Arguments:
    """Drive episodes with odometry that errs more and more, each body with its own.

    Attributes:
        split: of which episodes.
        episodes: how many of them, evenly spaced.
        factors: how many times as large as usual for that body its errors are.
        out: file for the rows, one JSON object a line.
    """

    split: str = "test_long"
    episodes: int = 40
    factors: tuple[float, ...] = (0.0, 1.0, 2.0, 4.0)
    out: Path = Path("out/drift.jsonl")

    def run(self) -> int:
        """Drive, print a row for each condition, and keep the rows."""
        episodes = list(evenly(load_episodes(self.split), self.episodes))
        conditions = product(("wheelchair", "spot"), self.factors, (False, True))
        self.out.parent.mkdir(parents=True, exist_ok=True)
        with JsonLines(self.out) as out:
            for robot, factor, corrected in conditions:
                condition, ends = Condition(robot, robot, factor, corrected), list[Ending]()
                for end in tracked(
                    endings(condition, episodes),
                    lambda n: f"{n} episodes",
                    lambda ends=ends: len(ends) / len(episodes),  # type: ignore[misc]
                ):
                    ends.append(end)
                found = row(condition, ends)
                out.write(found)
                print(json.dumps(found), flush=True)
        return 0
