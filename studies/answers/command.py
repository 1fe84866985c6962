"""`python -m studies answers`: what the right answers to commands on real floors depend on."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from semnav_env.judge.episodes.buildings import TUNE
from studies.answers.asked import Asked
from studies.answers.first_commands import first_commands


@dataclass(frozen=True)
class Arguments:
    """Say what changes the right answers to the first commands of a split of real floors.

    Attributes:
        kth: folder of the KTH data set's buildings.
        split: name of the split. That of the tests is to measure on, not to look into.
        json: print the counts as JSON.
    """

    kth: Path
    split: str = TUNE
    json: bool = False

    def run(self) -> int:
        """Ground each command in all variants of its floor, and print the counts."""
        rules, kept, jumping, alone = (Counter[str]() for _ in range(4))
        with TemporaryDirectory() as folder:
            commands = list(first_commands(self.kth, self.split, Path(folder)))
        for asked in map(Asked, commands):
            rules.update(asked.kept_if)
            kept.update(asked.kept_by)
            jumping.update(asked.jumps)
            alone.update(asked.jumps if len(asked.jumps) == 1 else ())
        rows = {
            "commands": {"in all": len(commands)},
            "kept if": dict(rules),
            "kept by": dict(kept.most_common()),
            "what jumps": dict(jumping.most_common()),
            "what jumps alone": dict(alone.most_common()),
        }
        print(json.dumps(rows) if self.json else "\n".join(_lines(rows)))
        return 0


def _lines(rows: Mapping[str, Mapping[str, int]]) -> Iterator[str]:
    for title, counts in rows.items():
        yield f"{title}:"
        yield from (f"  {count:4d}  {name}" for name, count in counts.items())
