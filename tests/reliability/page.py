"""The page about reliability: budgets from the code, and what the last soak measured."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from semnav_env.agents.learning.files import MAX_FILE_SIZE
from semnav_env.episodes.files import MAX_BYTES as MAX_EPISODES
from semnav_env.features.readers.chunks import MAX_CHUNK_BYTES
from semnav_env.features.readers.npz_arrays import MAX_BYTES as MAX_ARRAY
from semnav_env.features.readers.text import MAX_EXPANSION
from semnav_env.features.reading import WHOLE_FILE
from semnav_env.features.writing import write_file
from semnav_env.maps.geodesic import RECENT_FIELDS
from semnav_env.maps.importers.documents import MAX_YAML_BYTES
from semnav_env.maps.importers.drawing import MAX_SEGMENTS
from semnav_env.maps.importers.dxf import MAX_BLOCKS, MAX_ENTITIES
from semnav_env.maps.importers.raster import MAX_IMAGE_BYTES, MAX_PIXELS
from semnav_env.maps.importers.svg import MAX_ELEMENTS
from semnav_env.maps.library import MAX_KEPT_OFFICES
from tests.support.paths import ROOT

PAGE = ROOT / "docs" / "reliability.md"
RESULTS = Path(__file__).with_name("soak.json")

TEMPLATE = """\
# Reliability

What is wrong is refused at once, in one line that names what is wrong and what would be right;
what was accepted works.

- **Settings** (`RobotSpec`, `LidarSpec`, `RewardWeights`, `Dynamics` and all others) say in their
  annotations what each field takes, and check it when they are made
  (`features/checked_fields.py`). A body that Chipmunk could not carry is never made.
- **Files** are written by one writer (`features/writing.py`): to a part beside the file, which
  takes its place when it is complete and on the disk. A full disk, an error, Ctrl-C or a kill
  leaves the old file as it was. Files of lines keep the lines so far, and a dataset the episodes
  so far, if the end is an error or Ctrl-C. After a kill a part may stay (`*.part*`). Of a command
  that writes several files, some may be new and some old, each of them whole.
- **Readers** have a budget of bytes, below. What does not end (a pipe, an alias of aliases, a
  view that counts for ever) is refused before it is read.
- **Compiled kernels** that cannot be kept, or cannot be read again, are kept in a temporary
  folder, or compiled anew; a line on stderr says so. Each file begins with a checksum, for one
  wrong bit of machine code would raise nothing. `semnav doctor` removes what is damaged, what
  killed writers left behind, and the kernels of sources that nobody has used for a month; what it
  prints belongs into a bug report.
- **Ctrl-C** ends every command with one line and exit code 130, **SIGTERM** with 143.

## Budgets of the readers

{budgets}

## Bad inputs

Bad inputs of every area: hostile values for the fields of all settings, and driving with those
that were not refused; hostile actions, options, texts and command lines; sound files of every
kind, damaged at random. Each is tried in a child process with a limit of time and memory. An
input fails if it ends in a traceback, a message of several lines or one that names no file, a
NaN, more than a gigabyte, or never.

{inputs}

## Interrupted writers

Every command that writes, in a folder with older files of the same names: on a disk that is full
after some kilobytes; killed while it writes a file, when it opens, renames or removes one, or at
any time; interrupted by Ctrl-C likewise. A strike fails if a file that was there is gone, if a
file under its final name is neither the old nor a whole new one, if a part stays that no kill
excuses, or if the command ends in anything but one line that names the file.

{strikes}

## Long drives

{steps:,} steps of a robot that drives at random, in {episodes:,} episodes on {floors:,} floors,
of which each was generated for the drive: resident memory was {warm:.0f} MB when the {kept} floors
that a process keeps had been made, and {memory:.0f} MB at the end. Between them the fields of
distances that it keeps fill up, to {fields:.0f} MB at most. Every observation and reward was
finite. It took {seconds:,.0f} s on a busy machine; [Speed](speed.md) says how fast a step is.

`make soak` measures all of it anew and writes this page; `make soak COUNT=100000 STRIKES=100
STEPS=50000000` tries more. A share of it is part of the tests (`tests/reliability`), with the
bombs: small files that ask for endless time or gigabytes.
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
    ("ROS bag compressed as a whole", f"at most {MAX_EXPANSION} times the size of the file"),
    ("trained agent", f"{MAX_FILE_SIZE:,} bytes"),
)


def rows(head: tuple[str, ...], body: list[tuple[str, ...]]) -> str:
    """A table in Markdown."""
    lines = [head, tuple("---" for _ in head), *body]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def counts(head: str, results: dict[str, list[int]]) -> str:
    """A table of what was tried, and what failed, with results as {name: [tried, failures]}."""
    total = [sum(column) for column in zip(*results.values(), strict=True)]
    body = [
        (name, f"{tried:,}", str(failed))
        for name, (tried, failed) in {**results, "all": total}.items()
    ]
    return rows((*head.split(", "), "failures"), body)


def page(results: dict[str, Any]) -> str:
    """The page, with the results of each part of a soak."""
    return TEMPLATE.format(
        budgets=rows(("file", "at most"), list(BUDGETS)),
        inputs=counts("area, inputs", results["inputs"]),
        strikes=counts("command, strikes", results["strikes"]),
        kept=MAX_KEPT_OFFICES,
        fields=RECENT_FIELDS.max_bytes / 1e6,
        **results["steps"],
    )


def keep(part: str, measured: Any) -> None:
    """Replace a part of the results, and write the page anew."""
    results = json.loads(RESULTS.read_text()) | {part: measured}
    write_file(RESULTS, json.dumps(results, indent=1) + "\n")
    write_file(PAGE, page(results))
