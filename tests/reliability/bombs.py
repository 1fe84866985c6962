"""Small files that ask for endless time or for gigabytes; each is refused in one line."""

from __future__ import annotations

import bz2
import gzip
import io
import os
import sqlite3
import struct
import zipfile
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import ezdxf
from backports import zstd
from ezdxf.enums import InsertUnits
from numpy.lib import format as npy
from PIL import Image

from tests.support.bags import BagFile, Sweep, storage
from tests.support.drawn_maps import two_rooms, write_map

MEGABYTE = 1 << 20
GRID = {"column_count": 2000, "row_count": 2000, "column_spacing": 1, "row_spacing": 1}


def yaml_aliases(folder: Path) -> Path:
    """600 bytes whose `image:` is a text of gigabytes."""
    rows = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    rows += [f"a{k}: &a{k} [{', '.join([f'*a{k - 1}'] * 9)}]" for k in range(1, 9)]
    path = write_map(folder, two_rooms())
    path.write_text("\n".join([*rows, "image: *a8", "resolution: 0.1", "origin: [0, 0, 0]"]))
    return path


def image_pipe(folder: Path) -> Path:
    """A map whose image is a pipe into which nobody writes."""
    path = write_map(folder, two_rooms(), name="map")
    (folder / "map.pgm").unlink()
    os.mkfifo(folder / "map.pgm")
    return path


def log_pipe(folder: Path) -> Path:
    """A log that is a pipe into which nobody writes."""
    os.mkfifo(folder / "log.csv")
    return folder / "log.csv"


def plan_pipe(folder: Path) -> Path:
    """A floor plan that is a pipe into which nobody writes."""
    os.mkfifo(folder / "plan.geojson")
    return folder / "plan.geojson"


def _drawing(folder: Path, nested: int = 0) -> tuple[Path, ezdxf.document.Drawing]:
    document = ezdxf.new(units=InsertUnits.Meters)
    document.blocks.new("b0")
    for k in range(nested):
        block = document.blocks.new(f"b{k + 1}")
        for _ in range(60):
            block.add_blockref(f"b{k}", (0, 0))
    return folder / "drawing.dxf", document


def dxf_array(folder: Path) -> Path:
    """Four million times the same block, which is empty."""
    path, document = _drawing(folder)
    document.modelspace().add_blockref("b0", (0, 0), dxfattribs=GRID)
    document.saveas(path)
    return path


def dxf_nest(folder: Path) -> Path:
    """Six levels of blocks with 60 blocks each, of which the last is empty."""
    path, document = _drawing(folder, nested=6)
    document.modelspace().add_blockref("b6", (0, 0))
    document.saveas(path)
    return path


def dxf_circles(folder: Path) -> Path:
    """Circles of a radius of a light hour."""
    path, document = _drawing(folder)
    for k in range(50):
        document.modelspace().add_circle((k, 0), 1e12)
    document.saveas(path)
    return path


def svg_uses(folder: Path) -> Path:
    """Ten elements, each of which is ten times the one before."""
    groups = ['<g id="g0"><path d="M0 0 H1"/></g>']
    groups += [f'<g id="g{k}">' + f'<use href="#g{k - 1}"/>' * 10 + "</g>" for k in range(1, 11)]
    path = folder / "drawing.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg">{"".join(groups)}</svg>')
    return path


def svg_circle_of_uses(folder: Path) -> Path:
    """An element that contains itself."""
    path = folder / "drawing.svg"
    inner = '<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g>'
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg">{inner}</svg>')
    return path


def recursive_view(folder: Path) -> Path:
    """A bag of ROS 2 whose messages are a view that counts without end."""
    path = folder / "bag.db3"
    with closing(sqlite3.connect(path)) as database:
        database.execute("CREATE TABLE topics(id, name, type, serialization_format)")
        database.execute(
            "INSERT INTO topics VALUES (1, '/scan', 'sensor_msgs/msg/LaserScan', 'cdr')"
        )
        database.execute(
            "CREATE VIEW messages AS WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL "
            "SELECT id + 1 FROM n) SELECT id, 1 AS topic_id, 0 AS timestamp, x'00' AS data FROM n"
        )
        database.commit()
    return path


def zipped_episodes(folder: Path) -> Path:
    """Three megabytes that are three gigabytes."""
    path = folder / "episodes.jsonl.gz"
    path.write_bytes(3000 * gzip.compress(b" " * MEGABYTE))
    return path


def zipped_log(folder: Path) -> Path:
    """A log of a gigabyte of empty lines."""
    path = folder / "log.csv.gz"
    path.write_bytes(gzip.compress(b"1,2,3\n") + 1000 * gzip.compress(b"\n" * MEGABYTE))
    return path


def _npz(folder: Path, arrays: dict[str, tuple[tuple[int, ...], int]]) -> Path:
    """An archive of arrays of a shape, of which a number of bytes is there."""
    path = folder / "log.npz"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        for name, (shape, size) in arrays.items():
            header = io.BytesIO()
            told = {"descr": "<f8", "fortran_order": False, "shape": shape}
            npy.write_array_header_1_0(header, told)
            with archive.open(f"{name}.npy", "w", force_zip64=True) as file:
                file.write(header.getvalue())
                for start in range(0, size, MEGABYTE):
                    file.write(b"\0" * min(MEGABYTE, size - start))
    return path


def npz_huge_angle(folder: Path) -> Path:
    """An `angle_min` of half a gigabyte of zeros."""
    return _npz(
        folder,
        {"ranges": ((2, 60), 960), "angle_min": ((1 << 26,), 1 << 29), "angle_increment": ((), 8)},
    )


def npz_wide(folder: Path) -> Path:
    """One scan of 2**62 beams."""
    return _npz(folder, {"ranges": ((1, 2**62), 64)})


def npz_rows_of_nothing(folder: Path) -> Path:
    """2**62 scans of no beams."""
    return _npz(folder, {"ranges": ((2**62, 0), 0)})


def ros1_chunk(folder: Path) -> Path:
    """A chunk of two kilobytes that is three gigabytes."""

    def header(**fields: bytes) -> bytes:
        packed = b"".join(
            struct.pack("<L", len(name) + 1 + len(value)) + name.encode() + b"=" + value
            for name, value in fields.items()
        )
        return struct.pack("<L", len(packed)) + packed

    def record(data: bytes, **fields: bytes) -> bytes:
        return header(**fields) + struct.pack("<L", len(data)) + data

    chunk = 3000 * bz2.compress(b"\0" * MEGABYTE)
    first = record(
        b" " * 4000,
        op=b"\x03",
        index_pos=struct.pack("<Q", 0),
        conn_count=struct.pack("<L", 0),
        chunk_count=struct.pack("<L", 1),
    )
    size = struct.pack("<L", 3000 * MEGABYTE)
    path = folder / "bag.bag"
    path.write_bytes(
        b"#ROSBAG V2.0\n" + first + record(chunk, op=b"\x05", compression=b"bz2", size=size)
    )
    return path


def mcap_chunk(folder: Path) -> Path:
    """A chunk of 128 kilobytes that is four gigabytes."""
    size = 4000 * MEGABYTE
    chunk = 4000 * zstd.compress(b"\0" * MEGABYTE)
    body = struct.pack("<QQQI", 0, 1, size, 0) + struct.pack("<I", 4) + b"zstd"
    body += struct.pack("<Q", len(chunk)) + chunk
    start = struct.pack("<I", 0) * 2
    path = folder / "bag.mcap"
    path.write_bytes(
        b"\x89MCAP0\r\n"
        + b"".join(bytes([k]) + struct.pack("<Q", len(b)) + b for k, b in ((1, start), (6, body)))
    )
    return path


def zipped_bag(folder: Path) -> Path:
    """A bag compressed as a whole: 150 kilobytes that are three gigabytes."""
    bag = BagFile("sqlite3", [Sweep([1.0] * 30)], "file").write(folder)
    storage(bag).write_bytes(3000 * zstd.compress(b"\0" * MEGABYTE))
    return bag


def large_picture(folder: Path) -> Path:
    """A picture of 25 million pixels with a palette."""
    path = folder / "floor.png"
    picture = Image.new("P", (5000, 5000), 255)
    picture.putpalette([255] * 768)
    picture.save(path)
    return path


BOMBS: dict[str, Callable[[Path], Path]] = {
    each.__name__: each
    for each in (
        *(yaml_aliases, image_pipe, log_pipe, plan_pipe, dxf_array, dxf_nest, dxf_circles),
        *(svg_uses, svg_circle_of_uses, recursive_view, zipped_episodes, zipped_log),
        *(npz_huge_angle, npz_wide, npz_rows_of_nothing, ros1_chunk, mcap_chunk, zipped_bag),
        large_picture,
    )
}
"""All of them by name."""
