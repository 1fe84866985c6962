"""What a corridor looks like from its start."""

from __future__ import annotations

from semnav_features.corridor import Corridor
from semnav_features.frames import Pose
from semnav_features.scene import Scene, Wall

START: Pose = (0.0, 0.0, 0.0)


def ways_on(seen: Corridor) -> list[tuple[bool, bool, bool]]:
    """For each junction: does it open left, right, and go on ahead?"""
    return [(j.left is not None, j.right is not None, j.ahead) for j in seen.junctions]


def with_walls(scene: Scene, *walls: Wall) -> Scene:
    return Scene(scene.walls + walls, scene.doors)
