"""Gives each episode its request: from the options of `reset`, or else from a task."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from semnav_env.judge.tasks.request import EpisodeRequest
from semnav_env.judge.tasks.task import AdaptiveTask, Task, as_task

if TYPE_CHECKING:
    from semnav_env.judge.tasks.frozen import Episodes, FrozenEpisodes
    from semnav_env.world.maps import FloorPlan


USUAL_PLAN = "heidelberg_hallway"
"""The default floor plan, if neither an argument nor a request names another one."""


class EpisodeSource:
    """Source of the requests of an environment.

    Args:
        task: what `task=` takes, see `as_task`.
        episodes: frozen episodes to draw from instead.

    Raises:
        ValueError: both are given, or one of them is something else.
    """

    episodes: FrozenEpisodes | None

    def __init__(self, task: object = None, episodes: Episodes | None = None) -> None:
        if task is not None and episodes is not None:
            raise ValueError("give task= or episodes=, not both")
        self.episodes = None if episodes is None else _frozen(episodes)
        self.task: Task = self.episodes or as_task(task)
        self._asked_task = False

    def next(self, options: dict[str, Any] | None, rng: np.random.Generator) -> EpisodeRequest:
        """The request of the next episode.

        Args:
            options: options of `reset`; without any, the task decides.
            rng: random generator of the environment.

        Raises:
            ValueError: bad options, or an episode that is unknown or cannot be carried out.
        """
        asked = EpisodeRequest.from_options(options)
        self._asked_task = asked is None
        request = self.task.request(rng) if asked is None else asked
        if not isinstance(request, EpisodeRequest):
            raise ValueError(f"a task asks for an EpisodeRequest, not for {request!r:.80}")
        if request.episode is None:
            return request
        from semnav_env.judge.tasks.frozen import spelled_out  # most environments need none

        return spelled_out(request, self.episodes)

    def usual_plan(self, given: str | FloorPlan | None) -> str | FloorPlan:
        """The floor plan of requests that name none.

        Args:
            given: what `floor_plan=` was given.

        Raises:
            ValueError: it was given, and so were episodes.
        """
        if given is not None and self.episodes is not None:
            raise ValueError(
                "give floor_plan= or episodes=, not both: each episode says its own floor plan"
            )
        return USUAL_PLAN if given is None else given

    def note(self, success: bool) -> None:
        """Tell a task that learns how the last episode ended."""
        if self._asked_task and isinstance(self.task, AdaptiveTask):
            self._asked_task = False  # who drives on past the end ends no other episode
            self.task.note(success)


def _frozen(episodes: Episodes) -> FrozenEpisodes:
    from semnav_env.judge.tasks.frozen import FrozenEpisodes  # most environments need none

    return FrozenEpisodes(episodes)
