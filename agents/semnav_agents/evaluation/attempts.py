"""Kept results of evaluations: the values of each episode that a leaderboard needs."""

from __future__ import annotations

import gzip
import json
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from math import isnan, nan
from pathlib import Path
from typing import Any

from semnav_agents.evaluation.provenance import UNKNOWN, Provenance
from semnav_features.decompression import read_lines
from semnav_features.validation import clipped, require, shown
from semnav_features.writing import write_file

NOT_KNOWN = Provenance(UNKNOWN, "", UNKNOWN).row()
"""Provenance of results that were kept before results recorded it."""

MAX_BYTES = 64_000_000
"""Size of the largest file of results that is read, bytes, also when decompressed."""


@dataclass(frozen=True, order=True)
class Attempt:
    """An agent's drive of one episode.

    Attributes:
        agent: name of the agent.
        training_seed: seed with which it was trained; -1 if it was not.
        split: split, suite or file of the episode.
        robot: name of the body.
        episode: id of the episode, or the command and its seed.
        clauses: number of clauses of the command.
        success: whether the command was carried out.
        contact_free: whether nothing was touched.
        spl: success weighted by path length; NaN, in files null, if the command is impossible.
        version: of semnav-env; `UNKNOWN` in files that do not say it.
        commit: of its checkout; empty without one, see `Provenance`.
        rules: their fingerprint; `UNKNOWN` in files that do not say it.
    """

    agent: str
    training_seed: int
    split: str
    robot: str
    episode: str
    clauses: int
    success: bool
    contact_free: bool
    spl: float
    version: str
    commit: str
    rules: str


def read_attempts(path: str | Path) -> list[Attempt]:
    """The attempts of a file that `semnav evaluate --out` or `write_attempts` wrote.

    Args:
        path: of JSON Lines; compressed if its name ends in .gz.

    Raises:
        ValueError: what is wrong first, with the number of the line.
        OSError: it cannot be read.
    """
    where = Path(path)
    lines = enumerate(read_lines(where, MAX_BYTES), 1)
    attempts = [_attempt(line, f"{where}:{n}") for n, line in lines]
    if not attempts:
        raise ValueError(f"{where}: holds no results; `semnav evaluate --out` writes them")
    return attempts


def write_attempts(attempts: Iterable[Attempt], path: Path) -> None:
    """Write attempts as compressed JSON Lines; the same ones give the same text."""
    rows = (
        asdict(attempt) | {"spl": None if isnan(attempt.spl) else round(attempt.spl, 4)}
        for attempt in attempts
    )
    text = "".join(json.dumps(row, separators=(",", ":")) + "\n" for row in rows)
    write_file(path, gzip.compress(text.encode(), mtime=0))


def result_row(line: str, place: str) -> dict[str, Any]:
    """The fields of a line of results.

    Args:
        line: of the file.
        place: what errors call it.

    Raises:
        ValueError: it is no JSON, or no object.
    """
    try:
        row = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{place}: is no JSON: {clipped(str(error))}") from None
    if not isinstance(row, dict):
        raise ValueError(f"{place}: is a {type(row).__name__}; a result is an object")
    return row


def _attempt(line: str, place: str) -> Attempt:
    row = result_row(line, place)
    if row.get("dynamics"):
        with_what = f"was driven with {shown(row['dynamics'])}"
        raise ValueError(f"{place}: {with_what}; the table is of drives where nothing else moves")
    if row.get("lidar"):
        with_what = f"was driven with the lidar {shown(row['lidar'])}"
        raise ValueError(f"{place}: {with_what}; the table is of drives with the usual one")
    row = _completed(row)
    values: dict[str, Any] = {}
    for each in fields(Attempt):
        kind, value = _KINDS[str(each.type)], row.get(each.name)
        if type(value) not in kind:
            right = " or ".join(one.__name__ for one in kind)
            hint = "; evaluate anew with --out" if each.name not in row else ""
            raise ValueError(f"{place}: {each.name} is {shown(value)}, not of type {right}{hint}")
        values[each.name] = value
    spl = values["spl"]
    require(spl != spl or 0.0 <= spl <= 1.0, f"{place}: spl", spl, "from 0 to 1, or null")
    return Attempt(**values)


def _completed(row: dict[str, Any]) -> dict[str, Any]:
    """A row with what follows from the rest: the number of clauses, and the id of a trial.

    Rows that say nothing of what they were made by were written before 0.2.
    """
    verdicts = row.get("verdicts")
    if row.keys().isdisjoint(NOT_KNOWN):
        row = row | NOT_KNOWN
    if "spl" in row and row["spl"] is None:
        row = row | {"spl": nan}
    if "clauses" in row and isinstance(verdicts, list):  # there it is the share that was done
        row = row | {"clauses": len(verdicts)}
    if "episode" not in row and "command" in row:
        row = row | {
            "episode": f"{row.get('floor_plan')}: {row['command']}, seed {row.get('seed')}"
        }
    return row


_KINDS: dict[str, tuple[type, ...]] = {
    "str": (str,),
    "int": (int,),
    "bool": (bool,),
    "float": (float, int),
}
