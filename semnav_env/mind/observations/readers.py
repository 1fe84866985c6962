"""Reads observations back into poses, goals and tables."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.mind.grounding.goal import GoalKind
from semnav_env.mind.observations.layout import GOAL, GOAL_KINDS, MEMORY_TABLES, ODOMETRY, TABLES
from semnav_features.frames import Pose, Twist

_COLUMNS = {entry.name: len(entry.columns) for entry in (*TABLES, *MEMORY_TABLES)}
"""Number of columns of each feature."""


def table(observation: dict[str, NDArray[Any]], name: str) -> NDArray[Any]:
    """The rows of a feature that count, such as walls or doors, shape (n, columns).

    Args:
        observation: of the environment.
        name: "walls", "doors", "corners", "corridors", "remembered_doors" or "bumps"; and with
            `observation="command"` "remembered_walls", "junctions", "told_ways" or "told_doors".

    Raises:
        ValueError: no such feature.
    """
    if name not in _COLUMNS:
        raise ValueError(f"no feature {name!r}; there are: {', '.join(_COLUMNS)}")
    rows = observation[name].reshape(-1, _COLUMNS[name])
    return rows[observation[f"{name}_mask"] > 0.5]


def read_odometry(observation: dict[str, NDArray[Any]]) -> tuple[Pose, Twist]:
    """Believed pose and velocity from the "odometry" entry of an observation."""
    value = dict(zip(ODOMETRY.columns, observation["odometry"].tolist(), strict=True))
    heading = math.atan2(value["sine"], value["cosine"])
    velocity = value["forward"], value["left"], value["yaw_rate"]
    return (value["x"], value["y"], heading), velocity


@dataclass(frozen=True)
class SeenGoal:
    """The goal in an observation, robot frame.

    Attributes:
        kind: the kind of the goal.
        pose: (x, y, heading), robot frame.
        door: (start, end) of its doorway, robot frame, if it has one.
    """

    kind: GoalKind
    pose: Pose
    door: tuple[tuple[float, float], tuple[float, float]] | None

    @classmethod
    def read(cls, values: NDArray[np.float32]) -> SeenGoal:
        """Read a goal from the "goal" entry of an observation."""
        value = dict(zip(GOAL.columns, values.tolist(), strict=True))
        start = value["door_start_x"], value["door_start_y"]
        end = value["door_end_x"], value["door_end_y"]
        door = (start, end) if value["has_door"] > 0.5 else None
        kind = GoalKind(int(np.argmax(values[: len(GOAL_KINDS)])))
        return cls(kind, (value["x"], value["y"], math.atan2(value["sine"], value["cosine"])), door)

    @property
    def values(self) -> NDArray[np.float32]:
        """The values of the "goal" entry of an observation; the inverse of `read`."""
        x, y, heading = self.pose
        kinds = np.arange(len(GOAL_KINDS)) == self.kind
        door = np.zeros(5) if self.door is None else np.append(np.ravel(self.door), 1.0)
        values = (*kinds, x, y, math.cos(heading), math.sin(heading), *door)
        return np.array(values, np.float32)
