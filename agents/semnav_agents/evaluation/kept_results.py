"""Finds what a kept result drove: the row of a file becomes an episode that can be driven again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from semnav_agents.evaluation.attempts import MAX_BYTES, result_row
from semnav_agents.evaluation.jobs import SuiteJob
from semnav_agents.evaluation.runner import SuiteSetup
from semnav_agents.evaluation.suites import SUITES
from semnav_env.judge.episodes import SPLITS, find_episode
from semnav_env.plain_settings import from_plain
from semnav_env.world.dynamics import NO_DYNAMICS, Dynamics
from semnav_features.decompression import read_lines
from semnav_features.validation import shown

TEXT = ("agent", "robot", "split")
"""Fields that every row has, as texts."""


@dataclass(frozen=True)
class KeptResult:
    """A row of a file that `semnav evaluate --out` or `semnav leaderboard --keep` wrote.

    Attributes:
        setup: agent, body, lidar and what moves.
        job: the episode.
        name: its id, or the command and the seed.
        success: whether the command was carried out.
        verdicts: one for each clause; empty in the files of `semnav leaderboard`.
        rules: fingerprint of the rules by which it was driven; empty if the row does not say it.
    """

    setup: SuiteSetup
    job: SuiteJob
    name: str
    success: bool
    verdicts: tuple[str, ...]
    rules: str


def read_kept_result(path: Path, which: str = "", episodes: Path | None = None) -> KeptResult:
    """One result of a file.

    Args:
        path: of JSON Lines; compressed if its name ends in .gz.
        which: id of a frozen episode, or number of a line, from 1; the first failure if empty.
        episodes: the file of its episodes, if they are of no split; if not given, the file that
            the row names, here or beside the results.

    Raises:
        ValueError: the row is none of results, or there is none; names what is wrong.
        OSError: a file cannot be read.
    """
    lines = read_lines(path, MAX_BYTES)
    number = _number_of(path, lines, which)
    place = f"{path}:{number + 1}"
    row = result_row(lines[number], place)
    for name, kind in (*((name, str) for name in TEXT), ("success", bool)):
        if type(row.get(name)) is not kind:
            said = shown(row.get(name))
            raise ValueError(f"{place}: {name} is {said}, not of type {kind.__name__}")
    lidar, verdicts, rules = row.get("lidar", "tim561"), row.get("verdicts", []), row.get("rules")
    if not isinstance(verdicts, list) or not isinstance(lidar, str):
        raise ValueError(f"{place}: verdicts must be a list, and lidar the name of one")
    job = _job(row, path, place, episodes)
    return KeptResult(
        SuiteSetup(row["agent"], row["robot"], dynamics=_dynamics(row, place), lidar=lidar),
        job,
        job.name if row.get("episode") else f'"{job.name}", seed {job.seed}',
        row["success"],
        tuple(map(str, verdicts)),
        rules if isinstance(rules, str) else "",
    )


def is_results(path: Path) -> bool:
    """Whether a file is one of results: its first line has an agent.

    Raises:
        ValueError: it is no text.
        OSError: it cannot be read.
    """
    lines = read_lines(path, MAX_BYTES)
    return bool(lines) and "agent" in result_row(lines[0], f"{path}:1")


def _number_of(path: Path, lines: Sequence[str], which: str) -> int:
    """The number of the line that is asked for, from 0."""
    if which.isascii() and which.isdigit() and 1 <= int(which[:9]) <= len(lines):
        return int(which) - 1
    rows = (result_row(line, f"{path}:{n}") for n, line in enumerate(lines, 1))
    for number, row in enumerate(rows):
        if row.get("episode") == which if which else row.get("success") is False:
            return number
    if which:
        told = f"the id of an episode, or a line from 1 to {len(lines)}"
        raise ValueError(f"{path}: has no result {which!r:.80}; give {told}")
    raise ValueError(f"{path}: nothing failed there; give {path}:ID, or the number of a line")


def _job(row: dict[str, Any], path: Path, place: str, episodes: Path | None) -> SuiteJob:
    """The episode of a row: a frozen one by its id, or a trial by its command and seed."""
    split, name, seed = row["split"], row.get("episode"), row.get("seed")
    if split in SUITES or split == "all":
        wanted = row.get("floor_plan"), row.get("command")
        for trial in (trial for trials in SUITES.values() for trial in trials):
            if (trial.floor_plan, trial.command) == wanted and type(seed) is int and seed >= 0:
                return SuiteJob(trial, seed)
        raise ValueError(f"{place}: names no command of {split} with a seed")
    if not isinstance(name, str):
        raise ValueError(f"{place}: episode is {shown(name)}; it must be the id of one")
    if split not in SPLITS:
        known = [episodes] if episodes else [Path(split), path.parent / split]
        file = next((file for file in known if file.exists()), None)
        if file is None:
            raise ValueError(f"{place}: its episodes are of {split!r:.80}; give --episodes FILE")
        name = f"{file}:{name}"
    episode = find_episode(name)
    return SuiteJob(episode, episode.number)


def _dynamics(row: dict[str, Any], place: str) -> Dynamics:
    """What moved: the row has the fields that were not as usual."""
    moved = row.get("dynamics", {})
    usual = asdict(NO_DYNAMICS)
    if isinstance(moved, dict) and moved.keys() <= usual.keys():
        try:
            found = from_plain(usual | moved, Dynamics)
        except (TypeError, ValueError) as error:
            raise ValueError(f"{place}: dynamics: {error}") from None
        if isinstance(found, Dynamics):
            return found
    raise ValueError(f"{place}: dynamics is {shown(moved)}; it must be fields of Dynamics")
