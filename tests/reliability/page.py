"""The page about reliability: budgets from the code, and what the last soak measured."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from semnav_agents.networks.weights import MAX_FILE_SIZE
from semnav_env.judge.episodes.files import MAX_BYTES as MAX_EPISODES
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

What is wrong is refused at once, in one line that names what is wrong and what would be right;
what was accepted works.

- **Settings** (`RobotSpec`, `LidarSpec`, `RewardWeights`, `Dynamics` and all others) say in their
  annotations what each field takes, and check it when they are made
  (`semnav_features/checked_fields.py`). A body that Chipmunk could not carry is never made.
- **Files** are written by one writer (`semnav_features/writing.py`): to a part beside the file,
  which takes its place when it is complete and on the disk. A full disk, an error, Ctrl-C or a kill
  leaves the old file as it was. Files of lines keep the lines so far, and a dataset the episodes
  so far, if the end is an error or Ctrl-C. After a kill a part may stay (`*.part*`). Of a command
  that writes several files, some may be new and some old, each of them whole.
- **Two writers** of one file never mix: parts have names that nobody can know before, and are new
  files, so no link is followed that somebody has put there. The file is a whole one, of the writer
  that was done last. What takes long, files of lines and datasets, has one writer at a time
  (`semnav_features/sole_writer.py`): a second one is refused before it begins, and says so. A link
  in the place of the file itself is followed if it is yours or root's, and refused otherwise.
- **Readers** have a budget of bytes, below. What does not end (a pipe, an alias of aliases, a
  view that counts for ever) is refused before it is read.
- **Compiled kernels** that cannot be kept, or cannot be read again, are kept in a temporary
  folder, or compiled anew; a line on stderr says so. Each file begins with a checksum, for one
  wrong bit of machine code would raise nothing. `semnav doctor` removes what is damaged, what
  killed writers left behind, and the kernels of sources that nobody has used for a month; what it
  prints belongs into a bug report. Of processes that start at once, one compiles a kernel and the
  others wait for it.
- **The cache of kernels** is the folder `semnav-env-kernels` in the one that `SEMNAV_CACHE_DIR` or
  `NUMBA_CACHE_DIR` names, else in the user's cache directory. Nothing outside it is ever removed,
  and in it only folders that are named by 20 hexadecimal digits and hold nothing but files of
  kernels.
- **Kernels are code**: whoever can write there can run code as you, for what is read is machine
  code in a pickle, and the checksum keeps nobody out. So the cache and the folders of its versions
  must be yours, no links, and closed to group and others; they are made so (mode 0700) whatever
  the umask. The folders above must be yours or root's, and closed likewise, unless they are
  sticky, such as /tmp; a group of yours alone may write there. Relative paths are not taken, nor
  `~/.cache` where nobody knows your home. Where anything is amiss, kernels are kept in a temporary
  folder of your own, and a line on stderr says why. Let others share sources, not a cache.
- **Ctrl-C** ends every command with one line and exit code 130, SIGTERM with one line and 143. This
  holds from the command's own first line on, not while Python itself starts.
- **Threads**: one thread at a time may use an environment, a vector environment, a simulator or
  a `BeliefTracker`; a second one that comes meanwhile gets a `RuntimeError`, and one after the
  other is fine. Threads may each have their own. `extract` may be called from any number at once.
- **Forks**: a vector environment that is forked makes new threads in the child, and both drive on
  alike. Do not fork while another thread is in the middle of a step: the child gets the
  `RuntimeError`.

## Budgets of the readers

{budgets}

## Memory by geometry

Grids and tables over a floor plan have one budget of {cells:,} cells
(`semnav_env/world/maps/cell_budget.py`): ways, what a body reaches, the floor that is seen in a
search, the walls near a lidar, points on walls. Where a plan needs more, the grid gets coarser,
for ways up to {ways:g} m and for what a body reaches up to {reach:g} m; a plan for which that is
too coarse to find doors, of more than {ways_area:,.0f} m2 and {reach_area:,.0f} m2, is refused in
one line
that names its extent. Plans of up to {usual:,.0f} m2 keep their grid of {spacing:g} m.
Tests hold every use of such plans, among them an episode, below a gigabyte
(`tests/reliability/test_geometry_budgets.py`). Pictures have a fixed size, an exported map at most
{pixels:,} pixels. Time has no such budget: a search looks around in every
{standpoint:g} m of the floor.

## Texts of files

What a file says is printed as text: control characters, escape sequences and marks that turn the
direction of writing are written out, such as `\\x1b` (`semnav_scripts/printable.py`).

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
any time; interrupted by Ctrl-C and SIGTERM likewise. A strike fails if a file that was there is
gone, if a file under its final name is neither the old nor a whole new one, if a part stays that no
kill excuses, or if the command ends in anything but one line that names the file.

{strikes}

## Signals at random moments

Ctrl-C and SIGTERM to processes of their own, at any moment from the command's first line to the end
of its process. One fails if it ends in a traceback or in anything but one line, or leaves a part.

{signals}

## Long drives

{steps:,} steps of a robot that drives at random, in {episodes:,} episodes on {floors:,} floors,
of which each was generated for the drive: resident memory was {warm:.0f} MB when the {kept} floors
that a process keeps had been made, and {memory:.0f} MB at the end. Between them the fields of
distances that it keeps fill up, to {fields:.0f} MB at most. Every observation and reward was
finite. It took {seconds:,.0f} s on a busy machine; [Speed](speed.md) says how fast a step is.

`make soak` measures all of it anew and writes this page; `make soak COUNT=100000 STRIKES=100
STEPS=50000000` tries more. A share of it is part of the tests (`tests/reliability`), with the
bombs: small files that ask for endless time or gigabytes. In each place of a file of each text
format they try runs of {run:,} bytes of one character or one short token, of which there are
{tokens}: none takes longer than {seconds_each:.0f} s of processor time.
"""

BUDGETS = (
    ("floor plan, vector map, HouseExpo, list of walls, DXF, SVG", f"{WHOLE_FILE:,} bytes"),
    ("YAML of a map or its labels", f"{MAX_YAML_BYTES:,} bytes, no aliases"),
    ("image of a map", f"{MAX_IMAGE_BYTES:,} bytes, {MAX_PIXELS:,} pixels"),
    ("DXF", f"{MAX_ENTITIES:,} entities, {MAX_BLOCKS:,} inserted blocks"),
    (
        "SVG, what `<use>` repeats included",
        f"{MAX_ELEMENTS:,} elements, {MAX_NUMBERS:,} numbers in outlines, {MAX_ARCS:,} arcs",
    ),
    (
        "an element of an SVG",
        f"numbers of {MAX_DIGITS} characters, transforms of {MAX_TRANSFORM:,}, a style sheet of "
        f"{MAX_STYLE_SHEET:,}, {MAX_CLOSINGS} closings of one line",
    ),
    ("walls of a drawing", f"{MAX_SEGMENTS:,} segments"),
    ("episodes", f"{MAX_EPISODES:,} bytes, also when decompressed"),
    ("text log", f"a line at a time; in gzip at most {MAX_EXPANSION} times the size of the file"),
    ("npz", f"a row at a time; {MAX_ARRAY:,} bytes of an array that is read as a whole"),
    ("ROS bag, MCAP", f"a chunk at a time; {MAX_CHUNK_BYTES:,} bytes of one when decompressed"),
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
