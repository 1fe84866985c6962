"""What a recording shows of one moment, in the odom frame, for whichever program draws it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from semnav_env.language import Command
from semnav_env.mind.belief import Belief
from semnav_env.mind.grounding.goal import door_of
from semnav_features.frames import FloatArray, Pose, compose, points_to_parent
from semnav_features.readers import LogRecord

SECONDS_PER_SCAN = 1.0 / 15.0
"""Time from scan to scan of a log without stamps, seconds."""

Segment = tuple[tuple[float, float], tuple[float, float]]
"""Two ends, (x, y) in metres."""


@dataclass(frozen=True)
class RecordedMoment:
    """A scan and what the robot believes after it. Lengths are metres in the odom frame.

    Attributes:
        seconds: stamp of the scan, or seconds from the first scan of a log without stamps.
        robot: pose of the robot.
        hits: where beams ended, shape (n, 2).
        walls: remembered walls.
        doors: remembered doors.
        goal: pose of the goal.
        goal_door: the door that the goal means; None if it means none.
        said: the active clause and the reasons for the goal, one line each.
    """

    seconds: float
    robot: Pose
    hits: FloatArray
    walls: tuple[Segment, ...]
    doors: tuple[Segment, ...]
    goal: Pose
    goal_door: Segment | None
    said: tuple[str, ...]


class MomentWriter(Protocol):
    """Writes moments into a file."""

    def write(self, moment: RecordedMoment) -> None:
        """Add a moment; they come in the order of time."""
        ...


def moment_of(
    record: LogRecord, belief: Belief, command: Command, mount: Pose, number: int
) -> RecordedMoment:
    """The moment of a scan.

    Args:
        record: the scan.
        belief: the belief after it.
        command: which is followed.
        mount: pose of the lidar in the robot frame.
        number: of the scan, from 0, for logs without stamps.
    """
    scan, scene = record.scan, belief.scene
    ranges, angles = scan.ranges[scan.valid], scan.angles[scan.valid]
    local = np.stack((ranges * np.cos(angles), ranges * np.sin(angles)), axis=1)
    door = door_of(belief.goal)
    clauses = command.clauses
    over = belief.clause >= len(clauses)
    clause = "all clauses done" if over else f"{belief.clause + 1}: {clauses[belief.clause]}"
    return RecordedMoment(
        seconds=number * SECONDS_PER_SCAN if record.stamp is None else record.stamp,
        robot=belief.pose,
        hits=points_to_parent(compose(belief.pose, mount), local),
        walls=tuple((wall.start, wall.end) for wall in scene.walls),
        doors=tuple((each.start, each.end) for each in scene.doors),
        goal=belief.goal.pose,
        goal_door=None if door is None else (door.start, door.end),
        said=(clause,) if over else (clause, *belief.reasons),
    )
