"""Every command that writes, with what it writes; inputs are made by the tests themselves."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

from semnav_env.lidar import Lidar
from semnav_env.maps import load_floor_plan
from tests.support.drawn_maps import two_rooms, write_map

HALL = "heidelberg_hallway"
SPLIT = "val_seen"


class Writer(NamedTuple):
    """A command that writes.

    Attributes:
        name: in the table.
        words: the command; {inputs} and {out} are the folders of its files.
        files: what it writes into {out}, the last one last.
        replaces: whether it replaces files that are there; otherwise it refuses them.
    """

    name: str
    words: str
    files: tuple[str, ...]
    replaces: bool = True


AGENT_FILES = ("training.safetensors", "policy.safetensors", "agent.json")
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
        "extract",
        "extract {inputs}/drive.log --out {out}/scenes.jsonl --plot {out}/page.pdf",
        ("scenes.jsonl", "page.pdf"),
    ),
    Writer("follow", "follow {inputs}/drive.log stop --plot {out}/seen.png", ("seen.png",)),
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
        f"evaluate {SPLIT} --agent random --episodes 2 --out {{out}}/rows.jsonl --pictures {{out}}",
        ("rows.jsonl",),
    ),
    Writer(
        "demonstrate",
        f"demonstrate {SPLIT} --episodes 2 --agent random --failures --max-seconds 8"
        " --out {out}/data",
        DATASET_FILES,
        replaces=False,
    ),
    Writer(
        "train", "train quick --steps 0 --out {out}/new", tuple(f"new/{f}" for f in AGENT_FILES)
    ),
    Writer(
        "train --resume",
        "train quick --resume --steps 0 --out {out}/agent",
        tuple(f"agent/{file}" for file in AGENT_FILES),
    ),
)
"""All of them."""


def make_inputs(folder: Path) -> None:
    """Write what the commands read: a map, a floor plan and a log of a short drive."""
    from semnav_env.maps import save_floor_plan

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
