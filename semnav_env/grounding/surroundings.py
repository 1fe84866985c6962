"""What a robot stands among: the doors of the room around it."""

from __future__ import annotations

import numpy as np

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.scene import Door, Scene, ends_of

LOOKED_AT = (0.2, 0.5, 0.8)
"""Where in an opening one looks to see whether it is in view, as shares of its width."""

SHORT_OF = 0.98
"""How much of the way to it must be free: it begins in a wall."""


def doors_around(scene: Scene, pose: Pose) -> list[Door]:
    """The doors that are in view from a pose, behind no wall and through no other door."""
    walls, openings = ends_of(scene.walls), ends_of(scene.doors)
    seen = []
    for k, door in enumerate(scene.doors):
        between = np.vstack((walls, np.delete(openings, k, axis=0)))
        shares = np.array(LOOKED_AT)[:, None]
        places = np.array(door.start) + shares * np.subtract(door.end, door.start)
        reach = np.array(pose[:2]) + SHORT_OF * (places - np.array(pose[:2]))
        if any(not _is_crossed(between, pose, place) for place in reach):
            seen.append(door)
    return seen


def _is_crossed(segments: FloatArray, pose: Pose, place: FloatArray) -> bool:
    """Whether the line from a pose to a place meets one of the segments, shape (n, 4)."""
    x, y = pose[0], pose[1]
    dx, dy = place - (x, y)
    first = dx * (segments[:, 1] - y) - dy * (segments[:, 0] - x)
    last = dx * (segments[:, 3] - y) - dy * (segments[:, 2] - x)
    rx, ry = segments[:, 2] - segments[:, 0], segments[:, 3] - segments[:, 1]
    here = rx * (y - segments[:, 1]) - ry * (x - segments[:, 0])
    there = rx * (place[1] - segments[:, 1]) - ry * (place[0] - segments[:, 0])
    return bool(((first * last < 0.0) & (here * there < 0.0)).any())
