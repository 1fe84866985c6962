"""Every command that writes, with what it writes; inputs are made by the tests themselves."""

from __future__ import annotations

import io
import json
import os
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import h5py
from safetensors.numpy import load

from semnav_agents.evaluation.attempts import Attempt, write_attempts
from semnav_agents.learning.files import TRAINING_FILE
from semnav_env.judge.episodes import SPLITS
from semnav_env.networks.card import CARD_FILE
from semnav_env.networks.weights import WEIGHTS_FILE
from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import load_floor_plan, save_floor_plan
from tests.support.drawn_maps import two_rooms, write_map
from tests.support.evaluated import write_kept_result

HALL = "heidelberg_hallway"
SPLIT = "val_seen"


class Writer(NamedTuple):
    """A command that writes.

    Attributes:
        name: in the table.
        words: the command; {inputs} and {out} are the folders of its files.
        files: what it writes into {out}.
        named: what an error of writing names: one of these; the files if not given.
        follows: name of the command whose results it goes on with; otherwise older files of the
            same names are there, if it replaces files at all.
        replaces: whether it replaces files that are there; otherwise it refuses them.
    """

    name: str
    words: str
    files: tuple[str, ...]
    named: tuple[str, ...] = ()
    follows: str = ""
    replaces: bool = True

    def whole(self, name: str, content: bytes, undisturbed: bytes) -> bool:
        """Whether the content of a file is whole, given what it is if nothing happens."""
        if content == undisturbed or "tfevents" in name:  # curves, which are only added to
            return True
        if name.endswith(".jsonl"):
            return content.endswith(b"\n") and undisturbed.startswith(content)
        check = _CHECKS.get(Path(name).suffix)
        try:
            return check is not None and check(content) is not None
        except (ValueError, OSError):
            return False


def _read_dataset(content: bytes) -> list[str]:
    """The names of the episodes; raises OSError if the file is damaged."""
    with h5py.File(io.BytesIO(content)) as file:
        file.visititems(lambda _, item: item[()] if isinstance(item, h5py.Dataset) else None)
        return list(file)


_CHECKS = {
    **{".hdf5": _read_dataset, ".json": json.loads, ".safetensors": load},
    **{".svg": ElementTree.fromstring, ".pdf": lambda content: content[content.index(b"%%EOF") :]},
}
"""How files are read that differ from run to run."""

AGENT_FILES = tuple(f"agent/{name}" for name in (TRAINING_FILE, WEIGHTS_FILE, CARD_FILE))
DATASET_FILES = ("data/data/main_data.hdf5", "data/data/metadata.json")

WRITERS = (
    Writer("map generate", "map generate --seed 3 --out {out}/plan.geojson", ("plan.geojson",)),
    Writer("map show", f"map show {HALL} --out {{out}}/plan.png", ("plan.png",)),
    Writer(
        "map import",
        "map import {inputs}/floor.yaml --out {out}/plan.geojson --picture {out}/plan.svg",
        ("plan.geojson", "plan.svg"),
    ),
    Writer(
        "map export",
        f"map export {HALL} --out {{out}}/map.yaml",
        ("map.pgm", "doors.yaml", "locations.yaml", "map.yaml"),
    ),
    Writer(
        "map build",
        "map build {inputs}/drive.log --out {out}/plan.geojson --picture {out}/plan.png",
        ("plan.geojson", "plan.png"),
    ),
    Writer(
        "demo",
        "demo --map office_cross --pose 3,11.5,0 --save {out}/film.gif --picture {out}/end.png"
        " -- stop",
        ("film.gif", "end.png"),
    ),
    Writer(
        "play",
        "play --map office_cross --pose 3,11.5,0 --seconds 0.2 --out {out}/drives -- stop",
        ("drives/played.jsonl", "drives/played-00000.npz"),
        replaces=False,
    ),
    Writer(
        "extract",
        "extract {inputs}/drive.log --out {out}/scenes.jsonl --plot {out}/page.pdf",
        ("scenes.jsonl", "page.pdf"),
    ),
    Writer("follow", "follow {inputs}/drive.log stop --plot {out}/seen.png", ("seen.png",)),
    Writer("habits", "habits {inputs}/drive.log --plot {out}/habits.png", ("habits.png",)),
    Writer(
        "approach",
        "approach --map office_cross --door west_north_2 --plot {out}/pose.svg",
        ("pose.svg",),
    ),
    Writer(
        "describe",
        "describe --map office_cross --from 3,11.5,0 --to west_north_2 --plot {out}/way.png",
        ("way.png",),
    ),
    Writer("episodes generate", f"episodes generate {SPLIT} --out {{out}}", (f"{SPLIT}.jsonl.gz",)),
    Writer(
        "episodes import",
        "episodes import {inputs}/floor.geojson --episodes 1 --out {out}",
        ("office_cross-0.geojson", "test_real_floors.jsonl.gz"),
    ),
    Writer(
        "evaluate",
        f"evaluate {SPLIT} --agent random --episodes 2 --out {{out}}/rows.jsonl --pictures {{out}}"
        " --html {out}/report.html",
        ("rows.jsonl", "report.html"),
        named=("rows.jsonl", "report.html", ".png"),
    ),
    Writer("view", "view {inputs}/kept.jsonl --out {out}/run.gif", ("run.gif",)),
    Writer(
        "leaderboard",
        "leaderboard {inputs}/results.jsonl.gz --keep {out}",
        ("random.val_seen.wheelchair.jsonl.gz",),
    ),
    Writer(
        "demonstrate",
        f"demonstrate {SPLIT} --episodes 2 --agent random --failures --max-seconds 8"
        " --out {out}/data",
        DATASET_FILES,
        named=("/data'",),
        replaces=False,
    ),
    Writer(
        "train",
        "train hallway --steps 0 --out {out}/agent",
        AGENT_FILES,
        replaces=False,
    ),
    Writer(
        "train --resume",
        "train hallway --resume --steps 0 --out {out}/agent",
        AGENT_FILES,
        follows="train",
    ),
)
"""All of them."""


def shorten() -> None:
    """In the process of a command: let a split be of one building, and windows need no display."""
    os.environ["SDL_VIDEODRIVER"] = "dummy"
    SPLITS[SPLIT] = replace(SPLITS[SPLIT], episodes=20, buildings=1)


def make_inputs(folder: Path) -> None:
    """Write what the commands read: a map, a floor plan, a log of a short drive, and results."""
    write_map(folder, two_rooms())
    plan = load_floor_plan(HALL)
    save_floor_plan(load_floor_plan("office_cross"), folder / "floor.geojson")
    lidar, lines = Lidar(plan), []
    for k in range(12):
        pose = (-2.5 + 0.1 * k, -0.3, 0.24)
        ranges = " ".join(f"{r:.2f}" for r in lidar.scan(pose, key=(1, 2, k)).ranges[::3][:181])
        place = " ".join(f"{value:.3f}" for value in pose)
        lines.append(f"FLASER {len(ranges.split())} {ranges} {place} {place} {k} robot {k}\n")
    (folder / "drive.log").write_text("".join(lines))
    drive = "random", -1, SPLIT, "wheelchair", "one", 1
    attempt = Attempt(*drive, True, True, 1.0, version="0.2.0", commit="", rules="0" * 16)
    write_attempts([attempt], folder / "results.jsonl.gz")
    write_kept_result(folder / "kept.jsonl")
