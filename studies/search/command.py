"""`python -m studies search`: search houses with their plan and without, and print the figures."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from semnav_scripts.progress import tracked
from studies.search.searches import AGENTS, FIRST_SEED, Search, row, search, summary


@dataclass(frozen=True)
class Arguments:
    """Search generated houses.

    A file of results is gone on with: what is in it already is not searched again.

    Attributes:
        houses: how many; they are frozen by their seeds, from `first` on.
        first: seed of the first house; those below `FIRST_SEED` are for tuning.
        agents: searcher (knows the plan), explorer (does not), or both.
        robot: spot or wheelchair.
        out: file of results (.jsonl), a line for each search; none if not given.
        json: print the figures as JSON.
    """

    houses: int = 200
    first: int = FIRST_SEED
    agents: tuple[str, ...] = tuple(AGENTS.values())
    robot: str = "spot"
    out: Path | None = None
    json: bool = False

    def run(self) -> int:
        """Search what is not in the file yet, and print the figures of each agent."""
        if self.houses < 1:
            raise ValueError(f"houses is {self.houses}; it must be 1 or more")
        found = self._known()
        known = {(each.agent, each.seed) for each in found}
        seeds = range(self.first, self.first + self.houses)
        left = [(a, s) for s in seeds for a in self.agents if (a, s) not in known]
        searches = (search(agent, seed, self.robot) for agent, seed in left)
        begun = len(found)
        for each in tracked(
            searches, lambda n: f"{n} searches", lambda: (len(found) - begun) / max(len(left), 1)
        ):
            found.append(each)
            if self.out is not None:
                with self.out.open("a", encoding="utf-8") as lines:
                    print(json.dumps(row(each)), file=lines)
        rows = {a: summary(own) for a in self.agents if (own := [f for f in found if f.agent == a])}
        print(json.dumps(rows) if self.json else "\n".join(_lines(rows)))
        return 0

    def _known(self) -> list[Search]:
        if self.out is None or not self.out.exists():
            return []
        lines = map(json.loads, self.out.read_text(encoding="utf-8").splitlines())
        return [Search(**{k: _tuple(v) for k, v in line.items()}) for line in lines]


def _tuple(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value


def _lines(rows: dict[str, dict[str, float]]) -> list[str]:
    """A table of Markdown, with a column for each agent."""
    names = list(next(iter(rows.values()), {}))
    lines = [f"| | {' | '.join(rows)} |", "|---" * (len(rows) + 1) + "|"]
    figures = [(name, [f"{row[name]:.3g}" for row in rows.values()]) for name in names]
    return lines + [f"| {name} | {' | '.join(values)} |" for name, values in figures]
