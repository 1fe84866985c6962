"""`python -m tests.reliability.soak`: tries bad inputs of every area, and writes the page about it.

`make soak` does it; COUNT is the number of inputs of an area of share 1.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

from semnav_env.agents.learning.files import MAX_FILE_SIZE
from semnav_env.episodes.files import MAX_BYTES as MAX_EPISODES
from semnav_env.features.readers.chunks import MAX_CHUNK_BYTES
from semnav_env.features.readers.npz_arrays import MAX_BYTES as MAX_ARRAY
from semnav_env.features.readers.text import MAX_EXPANSION
from semnav_env.features.reading import WHOLE_FILE
from semnav_env.features.writing import write_file
from semnav_env.maps.importers.documents import MAX_YAML_BYTES
from semnav_env.maps.importers.drawing import MAX_SEGMENTS
from semnav_env.maps.importers.dxf import MAX_BLOCKS, MAX_ENTITIES
from semnav_env.maps.importers.raster import MAX_IMAGE_BYTES, MAX_PIXELS
from semnav_env.maps.importers.svg import MAX_ELEMENTS
from tests.reliability.areas import AREAS, Area, compile_kernels, try_area
from tests.support.paths import ROOT

PAGE = ROOT / "docs" / "reliability.md"
RESULTS = Path(__file__).with_name("soak.json")
BATCH = 200
"""Inputs that are tried in one child process: a fault in it counts once."""

TEMPLATE = """\
# Reliability

What is wrong is refused at once, in one line that names what is wrong and what would be right;
what was accepted works.

- **Settings** (`RobotSpec`, `LidarSpec`, `RewardWeights`, `Dynamics` and all others) say in their
  annotations what each field takes, and check it when they are made
  (`features/checked_fields.py`). A body that Chipmunk could not carry is never made.
- **Files** are written by one writer (`features/writing.py`): to a part beside the file, which
  takes its place when it is complete and on the disk. A full disk, an error, Ctrl-C or a kill
  leaves the old file as it was.
- **Readers** have a budget of bytes, below. What does not end (a pipe, an alias of aliases, a
  view that counts for ever) is refused before it is read.
- **Compiled kernels** that cannot be kept, or cannot be read again, are kept in a temporary
  folder, or compiled anew; a line on stderr says so.
- **Ctrl-C** ends every command with one line and exit code 130.

## Budgets of the readers

{budgets}

## Tried

Bad inputs of every area: hostile values for the fields of all settings, and driving with those
that were not refused; hostile actions, options, texts and command lines; sound files of every
kind, damaged at random. Each is tried in a child process with a limit of time and memory. An
input fails if it ends in a traceback, a message of several lines or one that names no file, a
NaN, more than a gigabyte, or never.

{table}

`make soak` measures the table anew and writes this page; `make soak COUNT=100000` tries more. A
share of it is part of the tests (`tests/reliability`), with the bombs: small files that ask for
endless time or gigabytes.
"""

BUDGETS = (
    ("floor plan, vector map, HouseExpo, list of walls, DXF, SVG", f"{WHOLE_FILE:,} bytes"),
    ("YAML of a map or its labels", f"{MAX_YAML_BYTES:,} bytes, no aliases"),
    ("image of a map", f"{MAX_IMAGE_BYTES:,} bytes, {MAX_PIXELS:,} pixels"),
    ("DXF", f"{MAX_ENTITIES:,} entities, {MAX_BLOCKS:,} inserted blocks"),
    ("SVG", f"{MAX_ELEMENTS:,} elements, those of `<use>` included"),
    ("walls of a drawing", f"{MAX_SEGMENTS:,} segments"),
    ("episodes", f"{MAX_EPISODES:,} bytes, also when decompressed"),
    ("text log", f"a line at a time; in gzip at most {MAX_EXPANSION} times the size of the file"),
    ("npz", f"a row at a time; {MAX_ARRAY:,} bytes of an array that is read as a whole"),
    ("ROS bag, MCAP", f"a chunk at a time; {MAX_CHUNK_BYTES:,} bytes of one when decompressed"),
    ("trained agent", f"{MAX_FILE_SIZE:,} bytes"),
)


def rows(head: tuple[str, ...], body: list[tuple[str, ...]]) -> str:
    """A table in Markdown."""
    lines = [head, tuple("---" for _ in head), *body]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def page(results: dict[str, list[int]]) -> str:
    """The page, with results as {area: [inputs, failures]}."""
    total = [sum(column) for column in zip(*results.values(), strict=True)]
    body = [
        (name, f"{tried:,}", str(failed))
        for name, (tried, failed) in {**results, "all": total}.items()
    ]
    return TEMPLATE.format(
        budgets=rows(("file", "at most"), list(BUDGETS)),
        table=rows(("area", "inputs", "failures"), body),
    )


def soak(area: Area, count: int) -> list[int]:
    """Numbers of inputs that were tried and of batches that failed; prints each failure."""
    failed = 0
    for number in range(0, count, BATCH):
        outcome = try_area(area, min(BATCH, count - number), number)
        if outcome.fault:
            failed += 1
            print(f"  {area.name}, seed {number}: {outcome}", file=sys.stderr)
    return [count, failed]


def main(count: int) -> int:
    """Try all areas; returns 1 if anything failed."""
    compile_kernels()
    results: dict[str, list[int]] = {}
    for area in AREAS:
        start = time.monotonic()
        results[area.name] = soak(area, round(count * area.share))
        tried, failed = results[area.name]
        seconds = time.monotonic() - start
        print(f"{area.name:<28}{tried:>8} inputs {failed:>3} failures {seconds:7.0f} s", flush=True)
    write_file(RESULTS, json.dumps(results, indent=1) + "\n")
    write_file(PAGE, page(results))
    return int(any(failed for _, failed in results.values()))


if __name__ == "__main__":
    raise SystemExit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 2000))
