"""`semnav leaderboard`: the table of agents, from kept results."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from tyro.conf import Positional

from semnav_agents.evaluation.attempts import Attempt, read_attempts, write_attempts
from semnav_agents.evaluation.comparison import compare
from semnav_agents.evaluation.leaderboard import (
    Estimate,
    Standing,
    check_one_rules,
    standings,
)
from semnav_agents.evaluation.provenance import UNKNOWN
from semnav_scripts.comparison_text import comparison_text
from semnav_scripts.leaderboard_text import SHOWN_DIGITS, plain_table

HEADINGS = (
    *("split", "robot", "agent", "n", "trainings"),
    *("success", "no contact", "SPL", "worst 5 %", "IQM", "version, rules"),
)
"""Headings of the table."""

KEPT_SUFFIX = ".jsonl.gz"
"""Ending of the names of kept results."""


@dataclass(frozen=True)
class Arguments:
    """Make a table of agents from files that `semnav evaluate --out` wrote.

    Each file holds one evaluation: one agent, one split, one body. Trainings of one preset with
    different seeds are one row. In brackets are intervals of 95 %: of a bootstrap, or Wilson's
    where all episodes agree. The last column says the version, and the first digits of the
    fingerprint of the rules; results under different rules are refused.

    `--compare` takes two files of the same episodes and says how the agents differ: the difference
    of their means with an interval of 95 %, in how many episodes either was better, and the sign
    test of these numbers.

    Attributes:
        files: results, JSON Lines, or such compressed by gzip.
        compare: results of two agents on the same episodes, which are compared instead.
        mixed: take results under different rules into one table, or compare them.
        markdown: print the table as Markdown.
        json: print it as JSON.
        keep: folder for the values that the table needs, with a small file for each evaluation.
    """

    files: Positional[tuple[Path, ...]]
    compare: tuple[Path, Path] | None = None
    mixed: bool = False
    markdown: bool = False
    json: bool = False
    keep: Path | None = None

    def run(self) -> int:
        """Read, count and print."""
        if self.compare is not None:
            return self._compare(*self.compare)
        if not self.files:
            raise ValueError(
                "give one file of results or more; `semnav evaluate --out` writes them"
            )
        attempts = [attempt for file in self.files for attempt in read_attempts(file)]
        rows = standings(attempts)
        if not self.mixed:
            check_one_rules(rows)
        if self.keep is not None:
            _keep(attempts, self.keep)
        if self.json:
            print(json.dumps([asdict(row) for row in rows]))
        elif self.markdown:
            print(markdown(rows), end="")
        else:
            print(plain(rows), end="")
        return 0

    def _compare(self, first: Path, second: Path) -> int:
        """Compare two files, and print."""
        if self.files or self.markdown or self.keep is not None:
            raise ValueError("--compare takes two files, and no others, --markdown or --keep")
        compared = compare(read_attempts(first), read_attempts(second), self.mixed)
        if self.json:
            print(json.dumps([asdict(each) for each in compared]))
        else:
            print("\n\n".join(map(comparison_text, compared)))
        return 0


def markdown(rows: list[Standing]) -> str:
    """The table as Markdown."""
    lines = [HEADINGS, ["---"] * len(HEADINGS), *(_cells(row, "`") for row in rows)]
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


def plain(rows: list[Standing]) -> str:
    """The table as text, at most 80 columns wide."""
    return plain_table(HEADINGS, list(map(_cells, rows)))


def _cells(row: Standing, quote: str = "") -> tuple[str, ...]:
    return (
        f"{quote}{row.split}{quote}",
        row.robot,
        f"{quote}{row.agent}{quote}",
        str(row.episodes),
        str(row.seeds),
        *(map(_written, (row.success, row.contact_free, row.spl))),
        f"{row.worst:.2f}",
        "" if row.interquartile is None else f"{row.interquartile:.3f}",
        row.rules if row.rules == UNKNOWN else f"{row.version}, {row.rules[:SHOWN_DIGITS]}",
    )


def _written(estimate: Estimate | None) -> str:
    if estimate is None:
        return ""
    return f"{estimate.mean:.3f} ({estimate.low:.2f} to {estimate.high:.2f})"


def _keep(attempts: list[Attempt], folder: Path) -> None:
    """Write the attempts of each evaluation to a file named by agent, split and body."""
    files: dict[str, list[Attempt]] = {}
    for each in sorted(attempts):
        seed = "" if each.training_seed < 0 else f"-{each.training_seed}"
        name = f"{each.agent}{seed}.{each.split}.{each.robot}".replace("/", "_").replace(":", "_")
        files.setdefault(name, []).append(each)
    for name, group in files.items():
        write_attempts(group, folder / f"{name}{KEPT_SUFFIX}")
