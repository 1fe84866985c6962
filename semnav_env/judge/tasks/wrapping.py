"""Tasks made of other tasks: a curriculum, and a randomised robot for each episode."""

from __future__ import annotations

import warnings
from collections import deque
from collections.abc import Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from semnav_env.judge.tasks.request import EpisodeRequest
from semnav_env.judge.tasks.task import AdaptiveTask, Task, as_task
from semnav_env.robots import RobotSpec, robot_spec
from semnav_env.world.simulator.odometry import OdometrySettings
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import lidar_spec

_T = TypeVar("_T")

MOST_UNHEARD = 1000
"""Number of requested episodes without a reported end after which a curriculum warns; it is larger
than the number of environments that may share it."""


class Curriculum:
    """Moves on to the next task when enough of the last episodes of a task have succeeded.

    Args:
        tasks: tasks in their order, each as for `task=`.
        promotion: share of the last episodes that must succeed.
        window: number of episodes from which this share is computed.

    Attributes:
        stage: index of the current task.

    Raises:
        ValueError: no tasks, a share outside [0, 1], or a window below 1.
    """

    stage: int

    def __init__(self, tasks: Sequence[object], promotion: float = 0.8, window: int = 20) -> None:
        if not tasks or not 0.0 <= promotion <= 1.0 or window < 1:
            raise ValueError(
                f"a curriculum has one task or more (here {len(tasks)}), a promotion in [0, 1] "
                f"(here {promotion}) and a window of at least 1 (here {window})"
            )
        self._tasks = tuple(map(as_task, tasks))
        self._promotion, self.stage, self._unheard = promotion, 0, 0
        self._ended: deque[bool] = deque(maxlen=window)

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        """The request of the current task."""
        self._unheard += 1
        if self._unheard == MOST_UNHEARD + 1:
            warnings.warn(
                f"a curriculum has given {MOST_UNHEARD} episodes and was told of no end; if a "
                "TimeLimit cuts them off, give max_seconds= in place of max_episode_steps=",
                RuntimeWarning,
                stacklevel=2,
            )
        return self._tasks[self.stage].request(rng)

    def note(self, success: bool) -> None:
        """Count an episode, and move on to the next task if enough episodes succeeded."""
        self._unheard = 0
        _pass_on(self._tasks[self.stage], success)
        self._ended.append(success)
        full = len(self._ended) == self._ended.maxlen
        enough = sum(self._ended) >= self._promotion * len(self._ended)
        if full and enough and self.stage + 1 < len(self._tasks):
            self.stage += 1
            self._ended.clear()


class RandomisedRobot:
    """Draws body, lidar and odometry for each episode of a task.

    Args:
        task: a task, as for `task=`.
        robots: bodies to draw from, with the action space of the environment's.
        lidars: lidars to draw from, with the beams, range and rate of the environment's.
        odometry: errors of odometry to draw from.
    """

    def __init__(
        self,
        task: object = None,
        robots: Sequence[str | RobotSpec] = (),
        lidars: Sequence[str | LidarSpec] = (),
        odometry: Sequence[OdometrySettings] = (),
    ) -> None:
        self._task: Task = as_task(task)
        self._robots = tuple(map(robot_spec, robots))
        self._lidars = tuple(map(lidar_spec, lidars))
        self._odometry = tuple(odometry)

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        """The request of the task, with a drawn robot."""
        request = self._task.request(rng)
        return replace(
            request,
            robot=_chosen(self._robots, rng),
            lidar=_chosen(self._lidars, rng),
            odometry=_chosen(self._odometry, rng),
        )

    def note(self, success: bool) -> None:
        """Tell the task how its episode ended."""
        _pass_on(self._task, success)


def _pass_on(task: Task, success: bool) -> None:
    if isinstance(task, AdaptiveTask):
        task.note(success)


def _chosen(choices: tuple[_T, ...], rng: np.random.Generator) -> _T | None:
    return choices[int(rng.integers(len(choices)))] if choices else None
