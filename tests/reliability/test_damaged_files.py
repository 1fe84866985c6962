"""Files that are damaged, endless or huge, and numbers that are no numbers.

Each is read in a child process of limited time and memory, and refused in one line that names it.
One file of each kind of fault is part of every run; the others are slow.
"""

from __future__ import annotations

import gzip
import json
import random
from pathlib import Path
from typing import Any

import pytest

from semnav_env.judge.episodes import load_episodes
from semnav_env.judge.episodes.files import to_line
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.importers import import_map
from semnav_features.decompression import decompressed
from semnav_features.readers import open_log
from tests.reliability.bombs import BOMBS
from tests.reliability.children import PROCESSOR_SECONDS, in_child, outcome_of
from tests.reliability.mutations import write_mutated
from tests.reliability.readers import HOUSE, READERS, SVG, Reader, read_drawing, read_log
from tests.support.bags import KINDS, BagFile, Moved, Sweep
from tests.support.drawn_maps import two_rooms, write_map

BY_SUFFIX = {
    **{".geojson": load_floor_plan, ".svg": read_drawing, ".jsonl": load_episodes},
    **{".yaml": import_map, ".dxf": import_map, ".json": import_map},
    ".png": lambda path: import_map(path, 0.1),
}
EACH_READER = pytest.mark.parametrize("reader", READERS, ids=lambda reader: reader.name)


def read(path: Path) -> Any:
    """Read a file with the reader of its suffix; a log by default."""
    return BY_SUFFIX.get(Path(path.name.removesuffix(".gz")).suffix, read_whole)(path)


def read_whole(path: Path) -> int:
    with open_log(path) as log:
        return sum(1 for _ in log)


def refused(path: Path, seconds: float = PROCESSOR_SECONDS) -> str:
    """Why a file is refused, in a child process."""
    outcome = in_child(lambda: read(path), path.name, seconds)
    assert not outcome.fault, outcome
    assert outcome.message, "it was read"
    return outcome.message


QUICK_BOMBS = {"yaml_aliases", "log_pipe", "svg_uses", "dxf_array", "npz_wide", "mcap_chunk"}
"""An alias of aliases, a pipe, nested elements, repeated blocks, a huge array, a huge chunk."""


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[] if name in QUICK_BOMBS else pytest.mark.slow)
        for name in BOMBS
        if name != "large_picture"
    ],
)
def test_a_bomb_is_refused_in_one_line(tmp_path: Path, name: str) -> None:
    refused(BOMBS[name](tmp_path))


@pytest.mark.slow
def test_the_largest_picture_takes_less_than_a_gigabyte(tmp_path: Path) -> None:
    assert "no pixel is darker" in refused(BOMBS["large_picture"](tmp_path), 8.0)


@EACH_READER
@pytest.mark.parametrize("count", [5, pytest.param(100, marks=pytest.mark.slow)])
def test_a_damaged_file_is_read_or_refused(tmp_path: Path, reader: Reader, count: int) -> None:
    sound = reader.make(tmp_path)
    data = sound.read_bytes()
    reader.read(sound)
    (tmp_path / "sound").write_bytes(data)

    def read_damaged() -> None:
        for seed in range(count):
            write_mutated(tmp_path / "sound", sound, random.Random(seed))
            outcome = outcome_of(lambda: reader.read(sound), sound.name)
            if outcome.fault:
                raise AssertionError(f"seed {seed}: {outcome}")

    assert not (outcome := in_child(read_damaged, seconds=5.0 + 0.2 * count)).fault, outcome


@pytest.mark.parametrize("digits", ["1" + "0" * 400, "1" + "0" * 5000, "1e400", "-1e999"])
def test_a_number_of_400_digits_is_refused(tmp_path: Path, digits: str) -> None:
    floor = write_map(tmp_path, two_rooms())
    floor.write_text(f"image: floor.pgm\nresolution: {digits}\norigin: [0, 0, 0]\n")
    refused(floor)
    floor.write_text(f"image: floor.pgm\nresolution: 0.1\norigin: [0, {digits}, 0]\n")
    refused(floor)
    house = tmp_path / "house.json"
    house.write_text(json.dumps(HOUSE).replace("6", digits))
    refused(house)
    episodes = tmp_path / "episodes.jsonl"
    line = json.loads(to_line(load_episodes("val_seen")[0]))
    text = json.dumps(line | {"start": [0, 0, 0]}).replace("[0, 0, 0]", f"[0, {digits}, 0]")
    episodes.write_text(text)
    assert "start is" in refused(episodes)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("large", [1e154, 1e200, 1e308, float("inf"), float("nan")])
def test_odometry_of_any_size_is_read_or_counted(tmp_path: Path, kind: str, large: float) -> None:
    moved = Moved((large, 1.0, 0.0))
    bag = BagFile(kind, [moved, Sweep([1.0] * 30, time=2.0)]).write(tmp_path)
    assert not (outcome := in_child(lambda: read_log(bag))).fault, outcome


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a":' * 100_000, "[1" * 50_000])
def test_an_episode_file_of_brackets_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "episodes.jsonl"
    path.write_text(text)
    refused(path)


@pytest.mark.parametrize(
    "shape",
    [
        '<path d="M0 0 L nan 4"/>',
        '<path d="M0 0 A 1e308 1e308 0 1 1 1e308 1"/>',
        '<circle cx="1e400" cy="1" r="2"/>',
        '<path d="M0 0 C 1e300 1e300 -1e300 1 5 5"/>',
        '<g transform="matrix(1e308 1e308 0 1e308 0 0)"><path d="M1 1 L 3 4"/></g>',
    ],
)
def test_a_drawing_that_becomes_no_number_is_refused(tmp_path: Path, shape: str) -> None:
    path = tmp_path / "drawing.svg"
    path.write_text(SVG.format(shape))
    refused(path)


def test_gzip_of_several_parts_is_read_within_its_budget() -> None:
    parts = gzip.compress(b"one") + gzip.compress(b"two")
    assert decompressed(parts, 6) == b"onetwo"
    with pytest.raises(ValueError, match="more than 5 bytes"):
        decompressed(parts, 5)
    assert decompressed(b"", 5) == b""
