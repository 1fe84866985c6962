"""The page about reliability: budgets from the code, and the results of the last soak test."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from semnav_env.judge.episodes.files import MAX_BYTES as MAX_EPISODES
from semnav_env.networks.weights import MAX_FILE_SIZE
from semnav_env.rescue.visible_floor import STANDPOINT
from semnav_env.world.maps.cell_budget import MAX_CELLS
from semnav_env.world.maps.geodesic import COARSEST_SPACING, GRID_SPACING, RECENT_FIELDS
from semnav_env.world.maps.importers.documents import MAX_YAML_BYTES
from semnav_env.world.maps.importers.drawing import MAX_SEGMENTS
from semnav_env.world.maps.importers.dxf import MAX_BLOCKS, MAX_ENTITIES
from semnav_env.world.maps.importers.raster import MAX_IMAGE_BYTES, MAX_PIXELS
from semnav_env.world.maps.importers.svg_budget import (
    MAX_ARCS,
    MAX_CLOSINGS,
    MAX_DIGITS,
    MAX_ELEMENTS,
    MAX_NUMBERS,
    MAX_STYLE_SHEET,
    MAX_TRANSFORM,
)
from semnav_env.world.maps.library import MAX_KEPT_OFFICES
from semnav_env.world.maps.reach import COARSEST_SPACING as COARSEST_REACH
from semnav_features.readers.chunks import MAX_CHUNK_BYTES
from semnav_features.readers.npz_arrays import MAX_BYTES as MAX_ARRAY
from semnav_features.readers.text import MAX_EXPANSION
from semnav_features.reading import WHOLE_FILE
from semnav_features.writing import write_file
from tests.reliability.children import PROCESSOR_SECONDS
from tests.reliability.long_runs import RUN_BYTES, TOKENS
from tests.support.paths import ROOT

PAGE = ROOT / "docs" / "reliability.md"
RESULTS = Path(__file__).with_name("soak.json")

TEMPLATE = """\
# Reliability

Bad input is refused at once, with one line that names what is wrong and what would be right.
Input that was accepted works.

- **Settings** (`RobotSpec`, `LidarSpec`, `RewardWeights`, `Dynamics` and all others) declare in
  their annotations what each field takes, and check it when they are made
  (`semnav_features/checked_fields.py`). A body that Chipmunk could not simulate is never made.
- **Files** are all written by one function (`semnav_features/writing.py`): first to a partial file
  beside the target, which replaces the target when it is complete and on the disk. A full disk, an
  error, Ctrl-C or a kill leaves the old file as it was. After an error or Ctrl-C, a file of lines
  keeps the lines so far, and a dataset keeps the episodes so far. After a kill a partial file may
  remain (`*.part*`). If a command writes several files, some may be new and some old, but each
  of them is complete.
- **Two writers** of one file never mix. Partial files have names that cannot be predicted and are
  always created anew, so a symbolic link that somebody has put there is not followed. The file is
  the complete one of the writer that finished last. Files of lines and datasets take long, so they
  have one writer at a time (`semnav_features/sole_writer.py`): a second writer is refused before it
  begins, with a message. If the target itself is a symbolic link, it is followed if it belongs to
  you or to root, and refused otherwise.
- **Readers** have a budget of bytes, see below. Input without an end (a pipe, an alias of aliases,
  a view that counts without end) is refused before it is read.
- **Compiled kernels** that cannot be written to the cache are kept in a temporary folder; those
  that cannot be read again are compiled anew. A line on stderr says so. Each file begins with a
  checksum, because one wrong bit of machine code would raise no error. `semnav doctor` removes
  damaged files, files that killed writers left behind, and the kernels of sources that have not
  been used for a month. Please include its output in a bug report. If several processes start at
  once, one compiles a kernel and the others wait for it.
- **The cache of kernels** is the folder `semnav-env-kernels` in the one that `SEMNAV_CACHE_DIR` or
  `NUMBA_CACHE_DIR` names, else in the user's cache directory. Nothing outside it is ever removed.
  Inside it, a folder is removed only if its name has 20 hexadecimal digits and it holds nothing but
  files of kernels.
- **Kernels are code**: anybody who can write to the cache can run code as you, because a cached
  kernel is machine code in a pickle, and the checksum does not prevent this. Therefore the cache
  and its folders must belong to you, must not be symbolic links, and must be closed to group and
  others. They are made so (mode 0700) whatever the umask. The folders above must belong to you or
  to root. They must be closed to other writers as well, unless they are sticky, such as /tmp; only
  a group of which you are the only member may write there. Relative paths are refused, and so is
  `~/.cache` if the home directory is not known. If a condition is not met, kernels are kept in a
  temporary folder of your own, and a line on stderr says why. Share sources with others, but not
  a cache.
- **Ctrl-C** ends every command with one line and exit code 130, SIGTERM with one line and 143. This
  applies from the command's own first line on, not while Python itself starts.
- **Threads**: only one thread at a time may use an environment, a vector environment, a simulator
  or a `BeliefTracker`. A second thread that uses it at the same time gets a `RuntimeError`; one
  after the other is fine. Each thread may have its own. `extract` may be called from any number
  of threads at once.
- **Forks**: a vector environment that is forked makes new threads in the child, and parent and
  child continue with the same results. Do not fork while another thread is in the middle of a step:
  the child gets the `RuntimeError`.

## Budgets of the readers

{budgets}

## Memory by geometry

Grids and tables over a floor plan have one budget of {cells:,} cells
(`semnav_env/world/maps/cell_budget.py`). It covers shortest paths, the places that a body reaches,
the floor that is seen in a search, the walls near a lidar, and points on walls. Where a plan needs
more cells, the grid becomes coarser: up to {ways:g} m for shortest paths and up to {reach:g} m for
the places that a body reaches. A plan for which this is too coarse to find doors is refused in one
line that names its extent. The limits are {ways_area:,.0f} m2 for shortest paths and
{reach_area:,.0f} m2 for the places that a body reaches. Plans of up to {usual:,.0f} m2 keep their
grid of {spacing:g} m. Tests check that every use of such plans, among them an episode, takes less
than a gigabyte (`tests/reliability/test_geometry_budgets.py`). Pictures have a fixed size, and an
exported map has at most {pixels:,} pixels. Time has no such budget: a search looks around from
every {standpoint:g} m of the floor.

## Texts of files

Text from a file is printed as plain text: control characters, escape sequences and marks that
change the direction of writing are printed as codes, such as `\\x1b`
(`semnav_scripts/printable.py`).

## Bad inputs

The table counts bad inputs of every area. They are hostile values for the fields of all settings,
and drives with the values that were not refused; hostile actions, options, texts and command lines;
and valid files of every kind, damaged at random. Each is tried in a child process with a limit of
time and memory. An input fails if it ends in a traceback, a message of several lines, a message
that names no file, a NaN, more than a gigabyte of memory, or not at all.

{inputs}

## Interrupted writers

Every command that writes files is run in a folder with older files of the same names, and is
interrupted in one of three ways. The disk is full after some kilobytes; the process is killed while
it writes, opens, renames or removes a file, or at any time; or the process gets Ctrl-C or SIGTERM
at such moments. A strike fails in four cases: an earlier file is gone; a file under its final name
is neither the old nor a complete new one; a partial file remains although nothing was killed; or
the command ends in anything but one line that names the file.

{strikes}

## Signals at random moments

Ctrl-C and SIGTERM are sent to a process at a random moment between the command's first line and
the end of the process. A signal fails if the process ends in a traceback or in anything but one
line, or leaves a partial file.

{signals}

## Long drives

A robot took {steps:,} random steps in {episodes:,} episodes on {floors:,} floors, each of which
was generated for this drive. A process keeps {kept} floors in memory. The resident memory was
{warm:.0f} MB when these had been made, and {memory:.0f} MB at the end. In between, the memory for
distance fields fills up, to {fields:.0f} MB at most. Every observation and reward was finite. The
drive took {seconds:,.0f} s on a busy machine; [Speed](guides/speed.md) says how fast a step is.

`make soak` measures all of this again and writes this page; `make soak COUNT=100000 STRIKES=100
STEPS=50000000` tries more. A part of it runs with the tests (`tests/reliability`), together with
small files that ask for endless time or gigabytes ("bombs"). For each text format, runs of
{run:,} bytes of one character or one short token ({tokens} of these) are put in each place of a
file: none takes longer than {seconds_each:.0f} s of processor time.
"""

BUDGETS = (
    ("floor plan, vector map, HouseExpo, list of walls, DXF, SVG", f"{WHOLE_FILE:,} bytes"),
    ("YAML of a map or its labels", f"{MAX_YAML_BYTES:,} bytes, no aliases"),
    ("image of a map", f"{MAX_IMAGE_BYTES:,} bytes, {MAX_PIXELS:,} pixels"),
    ("DXF", f"{MAX_ENTITIES:,} entities, {MAX_BLOCKS:,} inserted blocks"),
    (
        "SVG, with repetitions by `<use>`",
        f"{MAX_ELEMENTS:,} elements, {MAX_NUMBERS:,} numbers in outlines, {MAX_ARCS:,} arcs",
    ),
    (
        "one element of an SVG",
        f"numbers of {MAX_DIGITS} characters, transforms of {MAX_TRANSFORM:,}, a style sheet of "
        f"{MAX_STYLE_SHEET:,}, {MAX_CLOSINGS} closings of one line",
    ),
    ("walls of a drawing", f"{MAX_SEGMENTS:,} segments"),
    ("episodes", f"{MAX_EPISODES:,} bytes, also when decompressed"),
    ("text log", f"one line at a time; in gzip at most {MAX_EXPANSION} times the size of the file"),
    ("npz", f"one row at a time; {MAX_ARRAY:,} bytes of an array that is read as a whole"),
    ("ROS bag, MCAP", f"one chunk at a time; {MAX_CHUNK_BYTES:,} bytes of a decompressed chunk"),
    ("ROS bag compressed as a whole", f"at most {MAX_EXPANSION} times the size of the file"),
    ("trained agent", f"{MAX_FILE_SIZE:,} bytes"),
)

GEOMETRY = {
    "cells": MAX_CELLS,
    "ways": COARSEST_SPACING,
    "reach": COARSEST_REACH,
    "ways_area": MAX_CELLS * COARSEST_SPACING**2,
    "reach_area": MAX_CELLS * COARSEST_REACH**2,
    "usual": MAX_CELLS * GRID_SPACING**2,
    "spacing": GRID_SPACING,
    "pixels": MAX_PIXELS,
    "standpoint": STANDPOINT,
}
"""Budgets of what follows from geometry, by their places in the page."""


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
        signals=counts("command, signals", results["signals"]),
        strikes=counts("command, strikes", results["strikes"]),
        kept=MAX_KEPT_OFFICES,
        **GEOMETRY,
        fields=RECENT_FIELDS.max_bytes / 1e6,
        run=RUN_BYTES,
        tokens=len(TOKENS),
        seconds_each=PROCESSOR_SECONDS,
        **results["steps"],
    )


def keep(part: str, measured: Any) -> None:
    """Replace a part of the results, and write the page anew."""
    results = json.loads(RESULTS.read_text()) | {part: measured}
    write_file(RESULTS, json.dumps(results, indent=1) + "\n")
    write_file(PAGE, page(results))
