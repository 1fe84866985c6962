"""Goes on with an evaluation that ended early: what was driven before is read, not driven again."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any

from semnav_agents.evaluation.attempts import MAX_BYTES, result_row
from semnav_agents.evaluation.jobs import SuiteJob
from semnav_agents.evaluation.results import Result
from semnav_env.judge import Verdict
from semnav_env.judge.episodes import Episode
from semnav_env.judge.metrics import Metrics
from semnav_env.language import parse
from semnav_features.decompression import read_lines
from semnav_features.validation import shown

PASSED = frozenset((Verdict.DONE, Verdict.SKIPPED))
"""Verdicts on clauses behind which the robot went on."""

ABSENT = frozenset(("spl", "sdtw"))
"""Measures that are absent where they are null; others were infinite."""

Row = dict[str, Any]
"""A line of results."""


def rows_so_far(out: Path) -> list[Row]:
    """The results that an evaluation has written: its file, or what a killed one left beside it.

    Args:
        out: the file; of it and of the partial files beside it the longest counts.

    Raises:
        ValueError: a line is no object.
        OSError: a file cannot be read.
    """
    files = [out, *parts_left(out)]
    return max((_rows(file) for file in files if file.exists()), key=len, default=[])


def parts_left(out: Path) -> list[Path]:
    """The partial files that killed runs have left beside a file, see `writing.part_of`."""
    name = re.compile(rf"\.{re.escape(out.stem[:100])}-[0-9a-f]{{12}}\.part{re.escape(out.suffix)}")
    if not out.parent.is_dir():
        return []
    return sorted(path for path in out.parent.iterdir() if name.fullmatch(path.name))


def results_so_far(
    rows: Sequence[Row], jobs: Sequence[SuiteJob], who: Row, place: Path
) -> list[Result]:
    """The results of rows, which must be of the first episodes of an evaluation.

    Args:
        rows: of an earlier run.
        jobs: all episodes, in the order in which they are driven.
        who: the fields that all rows begin with.
        place: what errors call the file.

    Raises:
        ValueError: a row was made otherwise, or is not of the episode in its place.
    """
    if len(rows) > len(jobs):
        raise ValueError(f"{place}: has {len(rows)} results, but there are {len(jobs)} episodes")
    return list(_results(rows, jobs, who, place))


def _results(
    rows: Sequence[Row], jobs: Sequence[SuiteJob], who: Row, place: Path
) -> Iterator[Result]:
    for n, (row, job) in enumerate(zip(rows, jobs, strict=False), 1):
        for name, value in who.items():
            if row.get(name) != value:
                was = f"{name} is {shown(row.get(name))}, and is {shown(value)} now"
                raise ValueError(f"{place}:{n}: {was}; give another --out, or leave out --resume")
        wanted = _identity(job)
        if any(row.get(name) != value for name, value in wanted.items()):
            found = {name: row.get(name) for name in wanted}
            raise ValueError(f"{place}:{n}: is of {shown(found)}; there {shown(wanted)} is due")
        try:
            yield _result(row, job, who)
        except (KeyError, TypeError, ValueError):
            raise ValueError(f"{place}:{n}: lacks a measure; leave out --resume") from None


def _identity(job: SuiteJob) -> Row:
    """The fields of a row that name its episode."""
    if isinstance(job.trial, Episode):
        return {"episode": job.trial.id, "seed": job.seed}
    return {"command": job.trial.command, "seed": job.seed, "floor_plan": job.trial.floor_plan}


def _result(row: Row, job: SuiteJob, who: Row) -> Result:
    """The result that a row was made from; what its kept drive would be is not known."""
    names = [each.name for each in fields(Metrics)]
    metrics = Metrics(**{name: _number(name, row[name]) for name in names})
    verdicts = tuple(map(str, row["verdicts"]))
    told = {"floor_plan", "command", "seed", "verdicts", "episode", "cause", "rechecked"}
    rest = row.keys() - told - who.keys() - set(names)
    return Result(
        row["command"],
        row["seed"],
        verdicts,
        metrics,
        row["cause"],
        row["rechecked"],
        {name: _number(name, value) for name, value in row.items() if name in rest},
        row.get("episode", ""),
        job.trial.group,
        "" if metrics.success else _failed_kind(job, verdicts),
        row["floor_plan"],
    )


def _number(name: str, value: Any) -> Any:
    """A measure of a row, where JSON holds no infinite value and no NaN."""
    if value is None:
        return math.nan if name in ABSENT else math.inf
    if not isinstance(value, bool | int | float):
        raise TypeError(name)
    return value


def _failed_kind(job: SuiteJob, verdicts: Sequence[str]) -> str:
    """The kind of the clause behind which a robot did not go on, see `Drive.kind`."""
    trial = job.trial
    command = trial.meanings()[0] if isinstance(trial, Episode) else parse(trial.command)
    active = next((k for k, each in enumerate(verdicts) if each not in PASSED), len(verdicts))
    return type(command.clauses[min(active, len(command.clauses) - 1)]).__name__


def _rows(file: Path) -> list[Row]:
    """The lines of a file; a last one that was cut short by a killed run does not count."""
    lines = read_lines(file, MAX_BYTES)
    if lines and not file.read_bytes().endswith(b"\n"):
        lines = lines[:-1]
    return [result_row(line, f"{file}:{n}") for n, line in enumerate(lines, 1)]
