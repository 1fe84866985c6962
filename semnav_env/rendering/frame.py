"""The contents of one picture."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from semnav_env.mind.grounding.goal import Goal
from semnav_env.robots import RobotSpec
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import FloatArray, Point, Pose
from semnav_features.scene import Scene


@dataclass(frozen=True, eq=False)
class Frame:
    """One moment of an episode, all in the world frame, metres and radians.

    Attributes:
        floor_plan: the plan of the episode without moving things.
        robot: the body.
        pose: pose of the footprint's centre.
        lidar: point from which the beams start; None draws no beams, only hits.
        hits: ends of the beams, shape (n, 2), in beam order; rows that are not finite are skipped.
        scene: the scene perceived now.
        remembered: the memory, moved from the odometry frame to the world frame.
        door_numbers: number to show at `remembered.doors[index]`, by index, as the command counts.
        goal: goal of the active clause.
        trail: past positions, oldest first, shape (k, 2).
        route: the true route, shape (m, 2); None hides it.
        command: the text of each clause.
        language: code of the language of `command`, in which the picture is labelled.
        active_clause: index into `command`; those before are done or
            skipped. len(command): all are done.
        status: lines of text below the command, such as "t = 12.4 s".
        people: x, y and radius of everybody, shape (n, 3).
        leaves: hinge and tip of the leaves that can move, shape (m, 4).
        cloud: points of the depth cameras above the floor, (x, y), shape (n, 2).
        jambs: door jambs found among them, shape (k, 2).
        looked: middles of the cells of floor that a payload has inspected, shape (n, 2).
        flags: places that a payload has reported, shape (k, 2).
        prompt: what is being typed, or what to do, in a field over the map; none if empty.
        in_contact: the body touches something.
        failed: the active clause has failed.
        skipped: indices of clauses that a condition ruled out; they keep their number.

    Raises:
        ValueError: a pose that is not finite, points that are not of shape (n, 2), or numbers for
            doors that are not remembered.
    """

    floor_plan: FloorPlan
    robot: RobotSpec
    pose: Pose
    lidar: Point | None = None
    hits: FloatArray | None = None
    scene: Scene = field(default_factory=Scene)
    remembered: Scene = field(default_factory=Scene)
    door_numbers: Mapping[int, int] = field(default_factory=dict)
    goal: Goal | None = None
    trail: FloatArray | None = None
    route: FloatArray | None = None
    command: tuple[str, ...] = ()
    language: str = "en"
    active_clause: int = 0
    skipped: frozenset[int] = frozenset()
    status: tuple[str, ...] = ()
    people: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))
    leaves: FloatArray = field(default_factory=lambda: np.zeros((0, 4)))
    cloud: FloatArray = field(default_factory=lambda: np.zeros((0, 2)))
    jambs: FloatArray = field(default_factory=lambda: np.zeros((0, 2)))
    looked: FloatArray = field(default_factory=lambda: np.zeros((0, 2)))
    flags: FloatArray = field(default_factory=lambda: np.zeros((0, 2)))
    prompt: str = ""
    in_contact: bool = False
    failed: bool = False

    def __post_init__(self) -> None:
        """Check values that would otherwise fail deep inside the drawing."""
        if not all(math.isfinite(value) for value in self.pose):
            raise ValueError(f"pose is {self.pose}; it must be finite")
        for name in ("hits", "trail", "route"):
            points = getattr(self, name)
            if points is not None and (np.ndim(points) != 2 or np.shape(points)[1] != 2):
                raise ValueError(f"{name} has shape {np.shape(points)}; it must be (n, 2)")
        doors = len(self.remembered.doors)
        if not all(0 <= index < doors for index in self.door_numbers):
            raise ValueError(
                f"door_numbers has the indices {list(self.door_numbers)}; "
                f"{doors} doors are remembered"
            )
