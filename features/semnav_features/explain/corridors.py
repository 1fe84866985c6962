"""Why a probe from a corner finds no corridor."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from semnav_features.elements import Rejection
from semnav_features.explain.trace import Trace, ends
from semnav_features.kernels import corridor_probes as kernel
from semnav_features.kernels.corners import OUTER
from semnav_features.kernels.layout import CORNERS, CORRIDOR, WALLS
from semnav_features.settings import ExtractorSettings


def rejected_corridors(trace: Trace) -> Iterator[Rejection]:
    """The probes of every inner and potential corner that found nothing."""
    found = 0
    for c, corner in enumerate(trace.features.corners[: trace.features.counts[CORNERS]]):
        if corner["kind"] == OUTER:
            continue
        ending, starting = trace.scratch.corner_ends[c].tolist()
        for probe in range(2):
            entry, fault = _probe(trace, corner, ending, starting, probe, found)
            if fault:
                yield Rejection("corridor", *ends(entry), _reason(fault, entry, trace.settings))
            found += not fault


def _probe(
    trace: Trace, corner: Any, ending: int, starting: int, probe: int, found: int
) -> tuple[Any, int]:
    """Where one probe of a corner leads, as the kernel has it, and what is wrong with it."""
    record, scratch, walls = trace.record, trace.scratch, trace.features.counts[WALLS]
    entry = np.zeros(1, CORRIDOR)[0]
    entry["start_x"] = entry["end_x"] = corner["x"]
    entry["start_y"] = entry["end_y"] = corner["y"]
    if kernel.is_remote(corner, record):
        return entry, kernel.TOO_FAR
    near = kernel.find_near_walls(corner, ending, starting, walls, record, scratch)
    along = kernel.probe_direction(corner["kind"], ending, starting, probe, scratch)
    square = math.cos(record["corridor_angle_tolerance"])
    reach = kernel.nearest_wall(corner["x"], corner["y"], *along, near, square, record, scratch)
    length = reach if reach > 0.0 else float(record["corridor_probe"])
    entry["end_x"] += length * along[0]
    entry["end_y"] += length * along[1]
    if reach < 0.0:
        return entry, int(-reach)
    return entry, (
        kernel.corridor_fault(entry, record)
        or kernel.view_fault(entry, scratch)
        or kernel.repeat_fault(entry, found, trace.features.corridors, record)
    )


def _reason(fault: int, entry: Any, settings: ExtractorSettings) -> str:
    start, end = ends(entry)
    width, away = math.dist(start, end), math.dist(start, (-end[0], -end[1])) / 2
    tolerance = math.degrees(settings.corridor_angle_tolerance)
    near, far = settings.corridor_distance_min, settings.corridor_distance_max
    half = settings.corridor_half_width
    return {
        kernel.NO_WALL_MET: f"no wall within corridor_probe, {settings.corridor_probe:g} m",
        kernel.NOT_SQUARE: f"the nearest wall is met from behind, or more than "
        f"corridor_angle_tolerance, {tolerance:g} degrees, from square",
        kernel.TOO_NARROW: f"{width:.3f} m wide; twice corridor_half_width is {2 * half:g}",
        kernel.TOO_NEAR: f"the middle is {away:.3f} m away; corridor_distance_min is {near:g}",
        kernel.TOO_FAR: f"the middle is {away:.3f} m away; corridor_distance_max is {far:g}",
        kernel.HIDDEN: "no beam passes over the middle",
        kernel.REPEATED: f"a corridor with its middle within corridor_half_width, {half:g} m",
    }[fault]
