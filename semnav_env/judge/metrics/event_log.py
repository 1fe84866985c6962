"""Finds the events of a recorded drive in the true floor plan."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray

from semnav_env.judge.metrics.events import (
    Arm,
    ContactBegun,
    DoorCrossed,
    Event,
    JunctionEntered,
    JunctionLeft,
    Stopped,
    Turned,
)
from semnav_env.judge.metrics.recording import Recording
from semnav_env.mind.grounding.crossing import first_crossed
from semnav_env.rules import SuccessRules
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Region
from semnav_features.frames import FloatArray, Point, wrap_angle


@dataclass(frozen=True)
class EventThresholds:
    """Thresholds for a turn and for a stop.

    Attributes:
        stop_seconds: shortest time of standing still that is a stop.
        turning_rate: yaw rate above which a robot is turning, rad/s; noise and small corrections
            stay below.
        least_turn: smallest heading change that is a turn, radians.
        max_turn_pause: longest pause within one turn, seconds.
    """

    stop_seconds: float = 1.0
    turning_rate: float = 0.1
    least_turn: float = math.radians(30.0)
    max_turn_pause: float = 0.5


THRESHOLDS = EventThresholds()
"""Thresholds of all events."""

ARMS = (Arm.AHEAD, Arm.LEFT, Arm.BACK, Arm.RIGHT)
"""Arms of a junction by the quarter turns, counter-clockwise, from the way in to the way out."""


Mask = NDArray[np.bool_]
"""A truth value for each row of a recording, shape (n,)."""


def events_of(recording: Recording, floor_plan: FloorPlan) -> tuple[Event, ...]:
    """Every event of a recorded drive, in the order of time.

    Doors, regions and intersections are those of the plan; one without named intersections gives
    no events of junctions.
    """
    found: list[Event] = [
        *_doors(recording, floor_plan),
        *_junctions(recording, floor_plan),
        *_turns(recording),
        *_stops(recording),
        *_contacts(recording),
    ]
    return tuple(sorted(found, key=lambda event: event.step))


def region_at(floor_plan: FloorPlan, point: Point) -> str:
    """The name of the region around a point, rooms first; empty if there is none."""
    for region in floor_plan.regions:
        if shapely.intersects_xy(region.polygon, *point):
            return region.name
    return ""


def _doors(recording: Recording, floor_plan: FloorPlan) -> Iterator[DoorCrossed]:
    doors = floor_plan.doors
    steps = pairwise(recording.path.tolist())
    for step, (before, after) in enumerate(steps, start=1):
        index = first_crossed(floor_plan.door_ends, *before, *after)
        if index >= 0:
            from_left = _is_left(doors[index], before)
            left, right = (region_at(floor_plan, p) for p in _beside(doors[index]))
            sides = (left, right) if from_left else (right, left)
            time = step * recording.period
            yield DoorCrossed(step, time, doors[index].name, from_left, *sides)


def _is_left(door: PlanDoor, point: Point) -> bool:
    (ax, ay), (bx, by) = door.start, door.end
    return (bx - ax) * (point[1] - ay) - (by - ay) * (point[0] - ax) > 0.0


def _beside(door: PlanDoor, distance: float = 0.5) -> tuple[Point, Point]:
    """The points to the left and to the right of the middle of a door."""
    (x, y), share = door.midpoint, distance / door.width
    dx, dy = share * (door.end[0] - door.start[0]), share * (door.end[1] - door.start[1])
    return (x - dy, y + dx), (x + dy, y - dx)


def _junctions(
    recording: Recording, floor_plan: FloorPlan
) -> Iterator[JunctionEntered | JunctionLeft]:
    for region in floor_plan.intersections:
        inside = shapely.contains_xy(region.polygon, recording.path)
        for start, stop in runs(inside):
            yield from _visit(recording, floor_plan, region, start, stop)


def _visit(
    recording: Recording, floor_plan: FloorPlan, region: Region, start: int, stop: int
) -> Iterator[JunctionEntered | JunctionLeft]:
    """The events of one stay in an intersection, from row `start` to the row before `stop`."""
    path, period, name = recording.path, recording.period, region.name
    inward = float(recording.poses[0, 2])
    if start > 0:
        inward = _outward(region, path[start - 1], path[start]) + math.pi
        origin = region_at(floor_plan, tuple(path[start - 1]))
        yield JunctionEntered(start, start * period, name, origin)
    if stop < len(path):
        heading_change = wrap_angle(_outward(region, path[stop - 1], path[stop]) - inward)
        arm = ARMS[round(heading_change / (math.pi / 2)) % 4]
        into = region_at(floor_plan, tuple(path[stop]))
        yield JunctionLeft(stop, stop * period, name, arm, into)


def _outward(region: Region, before: FloatArray, after: FloatArray) -> float:
    """The direction out of a region across the side nearest to a step over its border."""
    ring = np.asarray(shapely.normalize(region.polygon).exterior.coords)[::-1]  # counter-clockwise
    sides = shapely.linestrings(np.stack((ring[:-1], ring[1:]), axis=1))
    step = shapely.Point((before + after) / 2)
    dx, dy = np.diff(ring, axis=0)[int(np.argmin(shapely.distance(sides, step)))]
    return math.atan2(-dx, dy)


def _turns(recording: Recording) -> Iterator[Turned]:
    rates, period = recording.velocities[:, 2], recording.period
    headings = np.unwrap(recording.poses[:, 2])
    pause = round(THRESHOLDS.max_turn_pause / period)
    for turning in (rates > THRESHOLDS.turning_rate, rates < -THRESHOLDS.turning_rate):
        for start, stop in _joined(list(runs(turning)), pause):
            begin = max(start - 1, 0)
            angle = float(headings[stop - 1] - headings[begin])
            if abs(angle) >= THRESHOLDS.least_turn:
                yield Turned(start, start * period, angle, (stop - 1 - begin) * period)


def _stops(recording: Recording) -> Iterator[Stopped]:
    rules = SuccessRules()
    yaw_rates = np.abs(recording.velocities[:, 2])
    still = (recording.speeds < rules.still_speed) & (yaw_rates < rules.still_yaw_rate)
    for start, stop in runs(still):
        duration = (stop - start) * recording.period
        if start > 0 and duration >= THRESHOLDS.stop_seconds:
            yield Stopped(start, start * recording.period, duration)


def _contacts(recording: Recording) -> Iterator[ContactBegun]:
    impulses, period = recording.impulses, recording.period
    for start, stop in runs(recording.contacts > 0):
        total, duration = float(impulses[start:stop].sum()), (stop - start) * period
        yield ContactBegun(start, start * period, float(impulses[start]), total, duration)


def runs(mask: Mask) -> list[tuple[int, int]]:
    """The runs of a mask that are true: (first row, row after the last)."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], mask, [False])).astype(np.int8)))
    return [(start, stop) for start, stop in edges.reshape(-1, 2).tolist()]


def _joined(stretches: list[tuple[int, int]], gap: int) -> list[tuple[int, int]]:
    """The runs, with those at most `gap` rows apart joined."""
    joined: list[tuple[int, int]] = []
    for start, stop in stretches:
        if joined and start - joined[-1][1] <= gap:
            start = joined.pop()[0]
        joined.append((start, stop))
    return joined
