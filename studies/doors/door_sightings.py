"""Which doors a scan can show, and which of them a detector found: one rule for all data."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from enum import IntEnum
from typing import Self

import numpy as np

from semnav_features.frames import FloatArray, Point
from semnav_features.scan import Scan
from semnav_features.scene import Door


class View(IntEnum):
    """How well a scan shows a door."""

    HIDDEN = 0
    SEEN = 1
    GATED = 2


@dataclass(frozen=True)
class Gate:
    """When a door counts as seen, and when it counts as seen well (gated).

    Attributes:
        reach: both jambs are within this, metres.
        hit: some beam ends within this of each jamb, metres.
        beams: gated, so many beams between the jambs reach beyond the opening ...
        depth: ... by more than this along the beam, metres; no return reaches beyond.
        incidence: gated, the largest angle between the opening's normal and the line from the
            scanner to its centre, radians.
        distance: gated, the least distance from the scanner to the chord's line, metres.
        range_max: a longer range is no return, metres.
    """

    reach: float = 4.0
    hit: float = 0.12
    beams: int = 8
    depth: float = 0.15
    incidence: float = math.radians(70.0)
    distance: float = 0.4
    range_max: float = 10.0

    def view(self, scan: Scan, start: Point, end: Point) -> View:
        """How well a scan shows the door between two jambs, given in the lidar frame."""
        if max(math.hypot(*start), math.hypot(*end)) > self.reach:
            return View.HIDDEN
        hits = _hits(scan, self.range_max)
        jambs = np.array((start, end))
        nearest = np.hypot(*(hits[:, None] - jambs).transpose(2, 0, 1)).min(axis=0, initial=np.inf)
        if (nearest >= self.hit).any():
            return View.HIDDEN
        return View.GATED if self._is_gated(scan, jambs) else View.SEEN

    def _is_gated(self, scan: Scan, jambs: FloatArray) -> bool:
        chord = jambs[1] - jambs[0]
        normal = np.array((chord[1], -chord[0])) / np.hypot(*chord)
        distance = abs(float(normal @ jambs[0]))
        centre = float(np.hypot(*jambs.mean(axis=0)))
        if distance < self.distance or distance < centre * math.cos(self.incidence):
            return False
        beyond = _beyond(scan, jambs, normal, self.range_max)
        return int(np.count_nonzero(beyond > self.depth)) >= self.beams


def _hits(scan: Scan, range_max: float) -> FloatArray:
    valid = scan.valid & (scan.ranges > 0.0) & (scan.ranges < range_max)
    ranges, angles = scan.ranges[valid], scan.angles[valid]
    return np.stack((ranges * np.cos(angles), ranges * np.sin(angles)), axis=1)


def _beyond(scan: Scan, jambs: FloatArray, normal: FloatArray, range_max: float) -> FloatArray:
    """How far the beams between two jambs reach beyond the chord, along the beam, metres."""
    first, second = np.arctan2(jambs[:, 1], jambs[:, 0])
    turn = math.remainder(second - first, math.tau)
    angles = scan.angles
    inside = np.abs(np.remainder(angles - first - turn / 2 + math.pi, math.tau) - math.pi)
    chosen = inside < abs(turn) / 2
    angles, ranges = angles[chosen], scan.ranges[chosen]
    returned = scan.valid[chosen] & (ranges > 0.0) & (ranges < range_max)
    slant = np.cos(angles) * normal[0] + np.sin(angles) * normal[1]
    with np.errstate(divide="ignore", invalid="ignore"):
        beyond: FloatArray = np.where(returned, ranges, np.inf) - (jambs[0] @ normal) / slant
    return beyond


@dataclass(frozen=True)
class DoorCounts:
    """What became of some scans; counts of several may be added.

    Attributes:
        seen: doors in view.
        seen_found: of them, how many were found.
        gated: doors in good view.
        gated_found: of them, how many were found.
        detections: all.
        right: detections of a labelled opening.
        undecided: detections of an opening that is labelled as uncertain.
    """

    seen: int = 0
    seen_found: int = 0
    gated: int = 0
    gated_found: int = 0
    detections: int = 0
    right: int = 0
    undecided: int = 0

    def __add__(self, other: Self) -> DoorCounts:
        """The counts of both."""
        names = [field.name for field in fields(self)]
        return DoorCounts(*(getattr(self, name) + getattr(other, name) for name in names))

    @property
    def recall(self) -> float:
        """Share of the gated sightings that were found; NaN if there are none."""
        return self.gated_found / self.gated if self.gated else math.nan

    @property
    def recall_ungated(self) -> float:
        """Share of all sightings that were found; NaN if there are none."""
        return self.seen_found / self.seen if self.seen else math.nan

    @property
    def precision(self) -> float:
        """Share of the detections that are labelled openings; undecided ones are left out."""
        decided = self.detections - self.undecided
        return self.right / decided if decided else math.nan

    @property
    def precision_at_least(self) -> float:
        """The same with every undecided detection taken for a false one."""
        return self.right / self.detections if self.detections else math.nan


MAX_JAMB_ERROR = 0.25
"""A detection is a door if both its ends lie within this of the jambs, metres."""


def matches(detection: Door, start: Point, end: Point, tolerance: float = MAX_JAMB_ERROR) -> bool:
    """Whether both ends of a detection lie at the jambs, either way round."""
    return jambs_apart(detection, start, end) <= tolerance


def jambs_apart(detection: Door, start: Point, end: Point) -> float:
    """The larger distance between the ends of a detection and the jambs, metres."""
    same = max(math.dist(detection.start, start), math.dist(detection.end, end))
    turned = max(math.dist(detection.start, end), math.dist(detection.end, start))
    return min(same, turned)


def judge(
    scan: Scan,
    detections: Iterable[Door],
    doors: Sequence[Door],
    undecided: Sequence[Door] = (),
    gate: Gate | None = None,
    wanted: Sequence[Door] | None = None,
) -> DoorCounts:
    """Compare the detections in one scan with the true doors.

    Detections count if both their ends are within the gate's reach.

    Args:
        scan: for what is in view.
        detections: in the lidar frame, like all doors here.
        doors: every real opening.
        undecided: openings that may be doors or not.
        gate: what counts as in view.
        wanted: those doors whose sightings count; all of `doors` if None.
    """
    gate = gate or Gate()
    near = [d for d in detections if max(math.hypot(*d.start), math.hypot(*d.end)) <= gate.reach]
    counts = dict.fromkeys((field.name for field in fields(DoorCounts)), 0)
    for door in doors if wanted is None else wanted:
        view = gate.view(scan, door.start, door.end)
        found = any(matches(each, door.start, door.end) for each in near)
        counts["seen"] += view >= View.SEEN
        counts["seen_found"] += view >= View.SEEN and found
        counts["gated"] += view == View.GATED
        counts["gated_found"] += view == View.GATED and found
    right = [any(matches(each, d.start, d.end) for d in doors) for each in near]
    unsure = [any(matches(each, d.start, d.end) for d in undecided) for each in near]
    counts["detections"], counts["right"] = len(near), sum(right)
    counts["undecided"] = sum(u and not r for u, r in zip(unsure, right, strict=True))
    return DoorCounts(**counts)
