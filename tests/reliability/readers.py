"""Every reader of the project, each with a small sound file of its kind."""

from __future__ import annotations

import gzip
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import ezdxf
import numpy as np
from ezdxf.enums import InsertUnits
from PIL import Image

from semnav_agents.evaluation.kept_results import is_results, read_kept_result
from semnav_agents.learned import LearnedAgent
from semnav_env.judge.episodes import load_episodes, write_episodes
from semnav_env.judge.metrics import Recording
from semnav_env.networks.weights import load_tensors, save_tensors
from semnav_env.world.maps import load_floor_plan, save_floor_plan
from semnav_env.world.maps.importers import Drawing, import_map
from semnav_features.readers import Geometry, open_log
from tests.support.bags import BagFile, Moved, Sweep, storage
from tests.support.drawn_maps import two_rooms, write_map
from tests.support.evaluated import write_kept_result
from tests.support.small_plans import empty_hall

RANGES = [2.0 + 0.01 * k for k in range(60)]
SVG = '<svg xmlns="http://www.w3.org/2000/svg">{}</svg>'
LINES = '<g id="walls"><path d="M0 0 H40 V30 H0 Z"/><circle cx="9" cy="9" r="3"/></g>'


class Reader(NamedTuple):
    """A reader, and how a small sound file of its kind is made.

    Attributes:
        name: of the format.
        make: writes the file into a folder; returns its path.
        read: reads all of it; raises ValueError or OSError if that cannot be done.
    """

    name: str
    make: Callable[[Path], Path]
    read: Callable[[Path], Any]


def read_log(path: Path) -> list[Any]:
    """All records of a log."""
    with open_log(path, Geometry(beam_spacing=1.0, angle_min=-0.3, angle_increment=0.01)) as log:
        return list(log)


def read_drawing(path: Path) -> Any:
    """The floor plan of a drawing in decimetres."""
    return import_map(path, drawing=Drawing(scale=0.1))


def _text(name: str, text: str) -> Callable[[Path], Path]:
    def make(folder: Path) -> Path:
        path = folder / name
        data = text.encode()
        path.write_bytes(gzip.compress(data) if name.endswith(".gz") else data)
        return path

    return make


def _plan(folder: Path) -> Path:
    save_floor_plan(empty_hall(), folder / "hall.geojson")
    return folder / "hall.geojson"


def _map(folder: Path) -> Path:
    return write_map(folder, two_rooms())


def _image(suffix: str) -> Callable[[Path], Path]:
    def make(folder: Path) -> Path:
        path = folder / f"floor.{suffix}"
        Image.fromarray(np.asarray(two_rooms(), np.uint8)).save(path)
        return path

    return make


def _dxf(folder: Path) -> Path:
    document = ezdxf.new(units=InsertUnits.Meters)
    block = document.blocks.new("block")
    block.add_lwpolyline([(0, 0), (4, 0), (4, 3), (0, 1)], close=True)
    document.modelspace().add_blockref("block", (5, -2))
    document.modelspace().add_circle((3, 2), 1.5)
    document.saveas(folder / "drawing.dxf")
    return folder / "drawing.dxf"


def _npz(folder: Path) -> Path:
    stamps = np.arange(9.0)
    poses = np.zeros((9, 3))
    np.savez(folder / "log.npz", ranges=np.tile(RANGES, (9, 1)), stamps=stamps, poses=poses)
    return folder / "log.npz"


def _bag(kind: str) -> Callable[[Path], Path]:
    def make(folder: Path) -> Path:
        messages = [Sweep(RANGES), Moved((1.0, 2.0, 0.3)), Sweep(RANGES, time=2.0)]
        bag = BagFile(kind, messages).write(folder)
        return bag if kind == "ros1" else storage(bag)

    return make


def _episodes(folder: Path) -> Path:
    write_episodes(load_episodes("val_seen")[:20], folder / "some.jsonl.gz")
    return folder / "some.jsonl.gz"


def _results(folder: Path) -> Path:
    write_kept_result(folder / "kept.jsonl")
    return folder / "kept.jsonl"


def _tensors(folder: Path) -> Path:
    save_tensors(folder / "policy.safetensors", {"w": np.ones((4, 5), np.float32)})
    return folder / "policy.safetensors"


def _agent(folder: Path) -> Path:
    import semnav_agents

    bundled = Path(semnav_agents.__file__).parent / "pretrained" / "drive"
    for file in bundled.iterdir():
        (folder / file.name).write_bytes(file.read_bytes())
    return folder / "card.json"


def _recording(folder: Path) -> Path:
    rows = np.zeros((4, 3))
    still = Recording(rows, rows, np.zeros(4, np.int64), np.zeros(4), 0.1)
    still.save(folder / "recording.npz")
    return folder / "recording.npz"


HOUSE = {
    "verts": [[0, 0], [6, 0], [6, 4], [0, 4]],
    "room_category": {"Hallway": [[0, 0, 6, 2]], "Bedroom": [[0, 2, 3, 4]]},
}
SEGMENTS = [{"p0": {"x": 0, "y": 0}, "p1": {"x": 3, "y": k}} for k in range(4)]
WORDS = " ".join(map(str, RANGES))

READERS = (
    Reader("floor plan", _plan, load_floor_plan),
    Reader("map_server", _map, import_map),
    Reader("PGM", _image("pgm"), lambda path: import_map(path, 0.1)),
    Reader("PNG", _image("png"), lambda path: import_map(path, 0.1)),
    Reader("DXF", _dxf, import_map),
    Reader("SVG", _text("drawing.svg", SVG.format(LINES)), read_drawing),
    Reader("vector map", _text("map.json", json.dumps(SEGMENTS)), import_map),
    Reader("HouseExpo", _text("house.json", json.dumps(HOUSE)), import_map),
    Reader("list of walls", _text("walls.csv", "x1,y1,x2,y2\n0,0,5,0\n5,0,5,4\n"), import_map),
    Reader("episodes", _episodes, load_episodes),
    Reader("results", _results, lambda path: (is_results(path), read_kept_result(path))),
    Reader("CARMEN", _text("a.log", f"FLASER 60 {WORDS} 0 0 0 0 0 0 1.0 r 1.0\n" * 5), read_log),
    Reader("CSV", _text("a.csv", (",".join(map(str, RANGES)) + "\n") * 5), read_log),
    Reader("CSV in gzip", _text("a.csv.gz", (",".join(map(str, RANGES)) + "\n") * 5), read_log),
    Reader("npz", _npz, read_log),
    Reader("ROS 1 bag", _bag("ros1"), read_log),
    Reader("ROS 2 SQLite", _bag("sqlite3"), read_log),
    Reader("MCAP", _bag("mcap"), read_log),
    Reader("safetensors", _tensors, load_tensors),
    Reader("trained agent", _agent, lambda path: LearnedAgent.load(path.parent)),
    Reader("recording", _recording, Recording.load),
)
"""All of them."""
