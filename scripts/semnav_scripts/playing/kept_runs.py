"""Played runs on disk: a file of episodes, and beside it the recording of each."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from semnav_env.judge.episodes.files import read_episodes, write_episodes
from semnav_env.judge.metrics import Recording
from semnav_features.door_passages import DoorPassage
from semnav_scripts.playing.played_drive import PlayedRun

EPISODES = "played.jsonl"
"""Name of the file of episodes in a folder of runs."""


def check_new(folder: Path) -> None:
    """Refuse a folder that has runs already.

    Raises:
        ValueError: it has.
    """
    if (folder / EPISODES).exists():
        raise ValueError(f"--out: '{folder}' has runs already; give another folder")


def keep_runs(folder: Path, runs: Iterable[PlayedRun]) -> Path:
    """Write runs into a folder, which is made if it is missing; returns the file of episodes."""
    folder.mkdir(parents=True, exist_ok=True)
    runs = list(runs)
    for run in runs:
        run.recording.save(_recording_of(folder, run.episode.id))
    write_episodes((run.episode for run in runs), folder / EPISODES)
    return folder / EPISODES


def passages_of_runs(path: Path) -> tuple[DoorPassage, ...]:
    """How doorways were passed in the runs of a file of episodes that `keep_runs` wrote.

    Raises:
        ValueError: it is no such file, or a recording is missing or damaged.
        OSError: a file cannot be read.
    """
    found: list[DoorPassage] = []
    for episode in read_episodes(path):
        recording = _recording_of(path.parent, episode.id)
        if not recording.exists():
            raise ValueError(
                f"{path}: episode {episode.id} has no '{recording}', in which `semnav play --out` "
                "keeps how it was driven; let agents drive it with --episodes"
            )
        found += Recording.load(recording).passages(episode.plan().doors)
    return tuple(found)


def _recording_of(folder: Path, name: str) -> Path:
    return folder / f"{name}.npz"
