"""A detector with a 2D lidar: the door of a scene at the place of an expected door."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.clouds.detected_door import DetectedDoor, frame_of
from semnav_features.elements import Door
from semnav_features.scene import Scene

JAMB_SIGMA = 0.04
"""Standard deviation of a jamb along either axis, metres: beams are that far apart at 4 m, and
ranges err by half of it."""

GATE = 0.15
"""Largest distance of a jamb from where it is expected, besides three sigmas, metres."""


def door_in_scene(scene: Scene, expected: Door, sigma: float) -> DetectedDoor | None:
    """The door of a scene whose jambs are nearest to the expected ones.

    Args:
        scene: what `extract` makes of a scan, robot frame (`Scene.placed` moves it there).
        expected: where the door should be, robot frame.
        sigma: standard deviation of that place, metres.

    Returns:
        None where no door has both jambs within the gate. Both jambs of a door are seen.

    Raises:
        ValueError: an expected door without a width.
    """
    frame_of(expected)  # checks it
    found = min(
        (
            (_misfit(ends, expected), ends, door.confidence)
            for door in scene.doors
            for ends in ((door.start, door.end), (door.end, door.start))
        ),
        default=None,
    )
    if found is None or not found[0] <= GATE + 3.0 * sigma:
        return None
    _, (start, end), confidence = found
    return DetectedDoor(start, end, confidence, JAMB_SIGMA**2 * np.eye(4))


def _misfit(ends: tuple[tuple[float, float], tuple[float, float]], expected: Door) -> float:
    """The larger distance of a jamb from the expected one, metres."""
    return max(math.dist(ends[0], expected.start), math.dist(ends[1], expected.end))
