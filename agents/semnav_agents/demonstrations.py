"""Demonstrations: the actions of an agent, with the observations for a learner."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Agent, Step, steps
from semnav_agents.expert import Expert, true_goal
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode

Column = NDArray[Any]
"""A value for each observation, shape (n + 1, ...)."""


@dataclass(frozen=True, eq=False)
class Demonstration:
    """One driven episode of n steps.

    Attributes:
        episode: the frozen episode that was driven.
        observations: the entries of the observation by name, each of shape (n + 1, size).
        actions: shape (n, action size).
        rewards: shape (n,).
        terminations: shape (n,).
        truncations: shape (n,).
        success: whether the command was carried out.
        infos: values beside each observation, by name, see `demonstrate`.
    """

    episode: Episode
    observations: dict[str, Column]
    actions: NDArray[np.float32]
    rewards: NDArray[np.float64]
    terminations: NDArray[np.bool_]
    truncations: NDArray[np.bool_]
    success: bool
    infos: dict[str, Any] = field(default_factory=dict)


def demonstrate(
    env: SemNavEnv,
    agent: Agent,
    episode: Episode,
    shown: SemNavEnv | None = None,
    expert: Expert | None = None,
) -> Demonstration:
    """Let an agent drive a frozen episode, with its number as the seed, and record everything.

    The infos are the true "pose" (world frame), the true "goal" (as the entry of an observation,
    robot frame), the number of the true "clause", "collisions", "path_length", "in_contact" and
    "reward_terms"; and "expert_action" if there is an expert.

    Args:
        env: in which the agent drives; it has the `observation=` of the agent.
        agent: the driver.
        episode: what to drive.
        shown: an environment like the first one but for its `observation=`, which is recorded. It
            is driven beside it with the same actions. The first one itself if not given.
        expert: labels every state that the agent comes to.
    """
    reset: dict[str, Any] = {"seed": episode.number, "options": {"episode": episode}}
    with episode.named_in_errors():
        first, info = env.reset(**reset)
        seen = first if shown is None else shown.reset(**reset)[0]
    recorded = shown or env
    observations, infos = [seen], [_info(recorded, None, expert)]
    driven: list[Step] = []
    for step in steps(env, agent, first, info):
        result = step if shown is None else Step(step.action, *shown.step(step.action))
        driven.append(result)
        observations.append(result.observation)
        infos.append(_info(recorded, result, expert))
    infos[0]["reward_terms"] = dict.fromkeys(driven[0].info["reward_terms"], 0.0)
    return Demonstration(
        episode,
        _stacked(observations),
        np.stack([step.action for step in driven]),
        np.array([step.reward for step in driven]),
        np.array([step.terminated for step in driven]),
        np.array([step.truncated for step in driven]),
        bool(driven[-1].info["is_success"]),
        _stacked(infos),
    )


def _info(env: SemNavEnv, step: Step | None, expert: Expert | None) -> dict[str, Any]:
    """The infos of the present state of an environment, in plain numbers."""
    period = env.judge.period
    known = {
        "pose": np.array(env.world.pose),
        "goal": true_goal(env).values,
        "clause": env.judge.follower.active,
        "collisions": period.collisions,
        "path_length": period.path_length,
        "in_contact": bool(step.info["in_contact"]) if step else False,
        "reward_terms": step.info["reward_terms"] if step else {},
    }
    return known | ({} if expert is None else {"expert_action": expert.label(env)})


def _stacked(rows: Sequence[Any]) -> dict[str, Any]:
    """Stack dictionaries into one, with an array, or again a dictionary, for each name."""
    return {
        name: _stacked([row[name] for row in rows])
        if isinstance(value, dict)
        else np.stack([row[name] for row in rows])
        for name, value in rows[0].items()
    }
