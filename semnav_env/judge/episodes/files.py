"""Reads and writes files of episodes: one JSON object in each line, compressed if named .gz."""

from __future__ import annotations

import gzip
import json
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from semnav_env.judge.episodes.episode import Episode, Expected
from semnav_env.language.languages import languages
from semnav_env.language.program import from_program, to_program
from semnav_env.language.tokens import CLAUSE_FEATURES
from semnav_features.decompression import read_lines
from semnav_features.validation import clipped, shown
from semnav_features.writing import write_file

SUFFIXES = (".jsonl", ".jsonl.gz")
"""Endings of the names of episode files; the second one is compressed."""

MAX_BYTES = 64_000_000
"""Size of the largest file of episodes that is read, bytes, also when decompressed: some 80,000."""

PLAN_SUFFIX = ".geojson"
"""Ending of the name of a floor plan that lies beside the file of its episodes."""


class EpisodeFileError(ValueError):
    """A file is not a file of episodes; the message names line, field and a correct value."""


def to_line(episode: Episode) -> str:
    """An episode as a line of JSON, always the same bytes."""
    row = vars(episode) | {"programs": [to_program(each) for each in episode.programs]}
    kept = {name: value for name, value in row.items() if value or name not in STORED}
    return json.dumps(kept, ensure_ascii=False, separators=(",", ":")) + "\n"


def write_episodes(episodes: Iterable[Episode], path: str | Path) -> None:
    """Write a file; the same episodes give the same bytes.

    Raises:
        EpisodeFileError: the name does not end in .jsonl or .jsonl.gz.
        OSError: it cannot be written.
    """
    where = Path(path)
    _check_name(where)
    text = "".join(map(to_line, episodes)).encode()
    write_file(where, gzip.compress(text, mtime=0) if where.suffix == ".gz" else text)


def read_episodes(path: str | Path) -> tuple[Episode, ...]:
    """Read the episodes of a file.

    Floor plans that are files lie beside it, if their paths are not absolute.

    Raises:
        EpisodeFileError: what is wrong first, and what would be right.
        OSError: it cannot be read.
    """
    where = Path(path)
    _check_name(where)
    lines = enumerate(read_lines(where, MAX_BYTES, EpisodeFileError), 1)
    episodes = tuple(_read(line, f"{where}:{n}") for n, line in lines)
    seen: set[str] = set()
    for n, episode in enumerate(episodes, 1):
        if episode.id in seen:
            raise EpisodeFileError(f"{where}:{n}: there is another episode {episode.id!r}")
        seen.add(episode.id)
    if not episodes:
        raise EpisodeFileError(f"{where}: holds no episode; one JSON object a line is one")
    return tuple(_found_beside(where, episode) for episode in episodes)


def _found_beside(where: Path, episode: Episode) -> Episode:
    plan = Path(episode.floor_plan)
    if plan.suffix != PLAN_SUFFIX or plan.is_absolute():
        return episode
    return replace(episode, floor_plan=str(where.parent / plan))


def _check_name(where: Path) -> None:
    if not where.name.endswith(SUFFIXES):
        raise EpisodeFileError(f"{where}: a file of episodes ends in {' or '.join(SUFFIXES)}")


def _read(line: str, place: str) -> Episode:
    try:
        row = json.loads(line, parse_int=_whole)
    except (ValueError, RecursionError) as error:
        raise EpisodeFileError(f"{place}: is no JSON: {clipped(str(error))}") from None
    if not isinstance(row, dict):
        raise EpisodeFileError(f"{place}: is a {type(row).__name__}; an episode is an object")
    for problem in _problems(row):
        raise EpisodeFileError(f"{place}: {problem}")
    programs, tokens = row.pop("programs", ()), row.pop("token_rows", ())
    values: dict[str, Any] = {name: _frozen(value) for name, value in row.items()}
    values["expected"] = Expected(row["expected"])
    try:
        values["programs"] = tuple(map(from_program, programs))
    except ValueError as error:
        raise EpisodeFileError(f"{place}: programs: {error}") from None
    return Episode(**values, token_rows=tuple(map(tuple, tokens)))


def _problems(row: dict[str, Any]) -> Iterator[str]:
    """All errors of a row, in the order of the fields."""
    for name in FIELDS:
        if name not in row and name not in STORED:
            yield f"has no {name!r}; an episode has {', '.join(FIELDS)}"
    for name in row.keys() - FIELDS.keys():
        yield f"has a {shown(name)}; an episode has only {', '.join(FIELDS)}"
    for name, (fits, right) in FIELDS.items():
        if name in row and not fits(row[name]):
            yield f"{name} is {_shown(row[name])}; it must be {right}"
    readings, expected = len(row["readings"]), row["expected"]
    if (readings > 1) != (expected == Expected.AMBIGUOUS):
        yield f"has {readings} readings and is expected to be {expected}"
    if row.get("programs") and len(row["programs"]) != readings:
        yield f"has {readings} readings and {len(row['programs'])} programs"


def _shown(value: object) -> str:
    return clipped(json.dumps(value, ensure_ascii=False))


def _whole(digits: str) -> float:
    """A whole number as an integer, or as infinity if no float is as large."""
    return int(digits) if len(digits) < 300 else math.inf


def _frozen(value: Any) -> Any:
    """Convert lists to tuples, and numbers in them to floats."""
    if isinstance(value, list):
        return tuple(map(_frozen, value))
    return float(value) if isinstance(value, int) else value


MAX_DIGITS = 18
"""Largest number of digits of an episode's number, the seed of its noise: 63 bits hold it."""


def _is_seed(digits: str) -> bool:
    return digits.isdecimal() and len(digits) <= MAX_DIGITS


def _is_text(value: object) -> bool:
    return isinstance(value, str) and bool(value.strip())


def _numbers(value: object, count: int) -> bool:
    return (
        isinstance(value, list)
        and len(value) == count
        and all(type(v) in (int, float) and math.isfinite(v) for v in value)
    )


def _integers(value: object, count: int) -> bool:
    return isinstance(value, list) and len(value) == count and all(type(v) is int for v in value)


def _all(value: object, fits: Callable[[Any], bool]) -> bool:
    return isinstance(value, list) and all(map(fits, value))


FIELDS: dict[str, tuple[Callable[[Any], bool], str]] = {
    "id": (
        lambda v: _is_text(v) and v.isascii() and _is_seed(v.rpartition("-")[2]),
        f'a split and a number of at most {MAX_DIGITS} digits, as "train-00017"',
    ),
    "floor_plan": (_is_text, "the name or path of a floor plan"),
    "plan_hash": (lambda v: _is_text(v) and len(v) == 16, "16 hexadecimal digits"),
    "start": (lambda v: _numbers(v, 3), "[x, y, heading], finite, metres and radians"),
    "command": (_is_text, "text"),
    "language": (
        lambda v: isinstance(v, str) and v in languages(),
        'the code of a language, as "en" or "de"',
    ),
    "readings": (lambda v: _all(v, _is_text) and len(v) > 0, "a list of texts, at least one"),
    "route": (lambda v: _all(v, lambda p: _numbers(p, 2)), "a list of [x, y], finite, metres"),
    "expected": (lambda v: v in list(Expected), f"one of {', '.join(Expected)}"),
    "programs": (
        lambda v: _all(v, lambda p: isinstance(p, list)),
        "a list with the clauses of each reading, see commands.to_program",
    ),
    "token_rows": (
        lambda v: _all(v, lambda row: _integers(row, CLAUSE_FEATURES)),
        f"a list of rows of {CLAUSE_FEATURES} whole numbers, see commands.encode",
    ),
}
"""For each field of an episode: a test of its value, and words for correct values."""

STORED = ("programs", "token_rows")
"""Fields that save parsing; a file may leave them out."""

assert tuple(FIELDS) == tuple(field.name for field in fields(Episode))
