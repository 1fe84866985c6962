"""Doors in a real log whose openings were labelled: by scan, by a short memory, and by pass."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from semnav_features import ExtractorSettings, Scan, extract
from semnav_features.frames import Pose
from semnav_features.memory import SceneMemory
from semnav_features.readers import open_log
from semnav_features.scene import Door, Scene
from studies.doors.door_sightings import DoorCounts, Gate, View, judge, matches
from studies.doors.openings import LABELS_FOLDER, LabelledOpening
from studies.sheets import ResultSheet

FREIBURG = Path("carmen") / "freiburg-079-corrected.log.gz"
FREIBURG_LABELS = LABELS_FOLDER / "freiburg_079_openings.csv"

MEMORY_SCANS = 5
"""Scans that the short memory joins."""

MAX_PASS_GAP = 5
"""A door that is out of good view for so many of the scans that are looked at ends a pass."""

MIN_PASS_SIGHTINGS = 3
"""Fewest gated sightings of a pass."""


class Glimpse(NamedTuple):
    """What was seen in one scan of a log.

    Attributes:
        scan: the scan.
        pose: of the lidar in the log's frame.
        doors: what was detected, lidar frame.
        remembered: what the last `MEMORY_SCANS` scans together say, lidar frame.
    """

    scan: Scan
    pose: Pose
    doors: tuple[Door, ...]
    remembered: tuple[Door, ...]


@dataclass(frozen=True)
class LabelledTarget:
    """Which labelled openings must be found.

    Attributes:
        name: what to call them.
        wanted: their sightings count.
        doors: all real openings: to detect one is right.
        undecided: to detect one is neither right nor wrong.
    """

    name: str
    wanted: tuple[Door, ...]
    doors: tuple[Door, ...]
    undecided: tuple[Door, ...]


def look_through(path: Path, settings: ExtractorSettings, every: int = 8) -> Iterator[Glimpse]:
    """Every Nth scan of a log with the doors in it, and in it and the scans before it.

    Args:
        path: the log, with corrected poses.
        settings: of the extractor.
        every: which scans are looked at; the memory joins successive scans of the log.

    Raises:
        ValueError: the log tells no poses.
        OSError: it cannot be opened.
    """
    window: deque[tuple[Scene, Scan, Pose]] = deque(maxlen=MEMORY_SCANS)
    with open_log(path) as log:
        for number, record in enumerate(log):
            if (-number) % every >= MEMORY_SCANS:
                continue
            if record.pose is None:
                raise ValueError(f"{path} tells no poses; give a log with corrected ones")
            scene = extract(record.scan, settings)
            window.append((scene, record.scan, record.pose))
            if number % every == 0:
                remembered = seen_from(record.pose, remember(window))
                yield Glimpse(record.scan, record.pose, tuple(scene.doors), remembered)


def remember(window: Iterable[tuple[Scene, Scan, Pose]]) -> tuple[Door, ...]:
    """The doors that a memory holds after a few scans, in the frame of their poses."""
    memory = SceneMemory()
    for scene, scan, pose in window:
        memory.see(scene, scan, pose)
    return tuple(memory.scene().doors)


def seen_from(pose: Pose, doors: Iterable[Door]) -> tuple[Door, ...]:
    """The doors in the frame of a pose in their own frame."""
    return tuple(Scene(doors=tuple(doors)).seen_from(pose).doors)


def targets(openings: Sequence[LabelledOpening]) -> list[LabelledTarget]:
    """What is asked for: the north side without and with its uncertain doors, and everything."""
    certain = tuple([o.door for o in openings if o.certain])
    unsure = tuple([o.door for o in openings if not o.certain])
    north = tuple([o.door for o in openings if o.group == "north" and o.certain])
    doubtful = tuple([o.door for o in openings if o.group == "north" and not o.certain])
    rest = tuple([door for door in unsure if door not in doubtful])
    return [
        LabelledTarget("north, certain", north, certain, unsure),
        LabelledTarget("north, all", north + doubtful, certain + doubtful, rest),
        LabelledTarget("all certain", certain, certain, unsure),
    ]


def count(
    glimpses: Sequence[Glimpse], target: LabelledTarget, gate: Gate, memory: bool
) -> DoorCounts:
    """Sightings and detections over a log, by single scans or with the short memory."""
    total = DoorCounts()
    for glimpse in glimpses:
        found = glimpse.remembered if memory else glimpse.doors
        parts = (target.doors, target.undecided, target.wanted)
        doors, undecided, wanted = (seen_from(glimpse.pose, part) for part in parts)
        total += judge(glimpse.scan, found, doors, undecided, gate, wanted)
    return total


def passes(glimpses: Sequence[Glimpse], target: LabelledTarget, gate: Gate) -> tuple[int, int]:
    """How many passes by a wanted door there were, and in how many it was found at least once.

    A pass has at least `MIN_PASS_SIGHTINGS` gated sightings, each less than `MAX_PASS_GAP` scans
    after the one before it.
    """
    found_in = [found for door in target.wanted for found in _passes(glimpses, door, gate)]
    return len(found_in), sum(found_in)


def _passes(glimpses: Sequence[Glimpse], door: Door, gate: Gate) -> Iterator[bool]:
    sightings: list[bool] = []
    last = -MAX_PASS_GAP
    for number, glimpse in enumerate(glimpses):
        (seen,) = seen_from(glimpse.pose, (door,))
        if gate.view(glimpse.scan, seen.start, seen.end) is not View.GATED:
            continue
        if number - last >= MAX_PASS_GAP:
            if len(sightings) >= MIN_PASS_SIGHTINGS:
                yield any(sightings)
            sightings = []
        sightings.append(any(matches(d, seen.start, seen.end) for d in glimpse.doors))
        last = number
    if len(sightings) >= MIN_PASS_SIGHTINGS:
        yield any(sightings)


def door_sheet(glimpses: Sequence[Glimpse], openings: Sequence[LabelledOpening]) -> ResultSheet:
    """Recall and precision for every target, by single scans and with the short memory."""
    gate = Gate()
    rows = []
    for target in targets(openings):
        all_passes, found = passes(glimpses, target, gate)
        for memory in (False, True):
            c = count(glimpses, target, gate, memory)
            seen = (c.gated, c.recall, c.seen, c.recall_ungated)
            given = (c.detections, c.undecided, c.precision, c.precision_at_least)
            name = f"last {MEMORY_SCANS} scans" if memory else "single scans"
            rows.append((target.name, name, *seen, *given, all_passes, found))
    columns = (
        *("doors", "from", "gated", "recall", "in view", "recall, all in view"),
        *("detections", "undecided", "precision", "precision, undecided wrong"),
        *("passes", "passes found"),
    )
    return ResultSheet("Real doors, freiburg-079", columns, rows)
