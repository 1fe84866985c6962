"""Showing a memory of scenes what a scan saw."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from semnav_features.frames import FloatArray, Pose, to_local
from semnav_features.kernels.layout import CAPACITY, DOOR, DOORS, WALL, WALLS
from semnav_features.memory import SceneMemory

Ends = tuple[float, float, float, float]

HERE: Pose = (0.0, 0.0, 0.0)
ANGLES = (-math.pi, math.radians(1.0))
NOTHING = np.full(360, -np.inf)

WALL_A: Ends = (0.0, 1.0, 3.0, 1.0)
DOOR_A: Ends = (3.0, 1.0, 4.0, 1.0)
DOOR_B: Ends = (6.0, 1.0, 7.0, 1.0)


def see(
    memory: SceneMemory,
    walls: Sequence[Ends] = (),
    doors: Sequence[Ends] = (),
    pose: Pose = HERE,
    ranges: FloatArray = NOTHING,
    confidence: float = 0.8,
    scans: int = 1,
) -> None:
    """Show the memory scans, taken at `pose`, of things given in the memory's frame."""
    wall_array, door_array = np.zeros(CAPACITY["walls"], WALL), np.zeros(CAPACITY["doors"], DOOR)
    for array, items in ((wall_array, walls), (door_array, doors)):
        for entry, (x1, y1, x2, y2) in zip(array, items, strict=False):
            entry["start_x"], entry["start_y"] = to_local(pose, (x1, y1))
            entry["end_x"], entry["end_y"] = to_local(pose, (x2, y2))
    door_array["confidence"] = confidence
    counts = np.zeros(4, dtype=np.int64)
    counts[WALLS], counts[DOORS] = len(walls), len(doors)
    for _ in range(scans):
        memory.update(wall_array, door_array, counts, ranges, ANGLES, pose)


def beams_that_end_at(y: float) -> FloatArray:
    """The ranges of a scan from the origin that meets the line at `y`."""
    angles = ANGLES[0] + ANGLES[1] * np.arange(360)
    with np.errstate(divide="ignore"):
        distances = y / np.sin(angles)
    return np.where(distances > 0, distances, np.inf)
