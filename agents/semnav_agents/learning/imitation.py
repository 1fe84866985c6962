"""Demonstrations of the scripted agent, imitated by a policy before reinforcement learning."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from semnav_agents.learning.actions import from_body
from semnav_agents.learning.compact import COMPACT_ENTRIES, VELOCITY, CompactObserver
from semnav_agents.learning.presets import Preset
from semnav_agents.scripted import ScriptedAgent
from semnav_env.env import SemNavEnv
from semnav_env.networks.weights import load_tensors, save_tensors
from semnav_env.robots import robot_spec

Tensors = dict[str, NDArray[np.float32]]

SHARD_SIZE = 20
"""Demonstrations in a file; as many may be lost when driving them is interrupted."""

PERTURBED_SHARE, PERTURBATION_RATE, PERTURBATION_SIGMA = 0.5, 0.12, 0.5
"""Share of episodes with perturbed actions, the chance that a decision of these is the first of one
to three perturbed ones, and the standard deviation of the perturbation."""

STANDING = 0.05
"""Velocity, squashed, and action below which a robot stands."""


def demonstrations(preset: Preset, seed: int, folder: Path) -> Iterator[int]:
    """Drive the demonstrations of a preset that are not in a folder yet.

    Yields:
        The number of demonstrations so far, after each.
    """
    demonstrator = Demonstrator(preset, seed)
    for first in range(0, preset.demonstrations, SHARD_SIZE):
        end = min(first + SHARD_SIZE, preset.demonstrations)
        path = folder / f"{first:06}.safetensors"
        if not path.exists():
            drives = []
            for number in range(first, end - 1):
                drives.append(demonstrator.drive(number))
                yield number + 1
            save_tensors(path, joined([*drives, demonstrator.drive(end - 1)]))
        yield end


def load_demonstrations(folder: Path) -> Tensors:
    """All demonstrations in a folder, one after the other."""
    return joined([load_tensors(path) for path in sorted(folder.glob("*.safetensors"))])


def pauses(demonstrations: Tensors) -> NDArray[np.bool_]:
    """Whether the scripted agent stands and waits in each decision, shape (n,).

    The scripted agent waits before it plans again. A policy cannot observe the reason, so a policy
    that imitates the pauses stands still for ever.
    """
    velocity, actions = demonstrations["observations"][:, VELOCITY], demonstrations["actions"]
    largest = np.maximum(np.abs(velocity).max(axis=1), np.abs(actions).max(axis=1))
    waits: NDArray[np.bool_] = largest < STANDING
    return waits


def joined(parts: list[Tensors]) -> Tensors:
    """Concatenate tensors of the same names along their first dimension."""
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


class Demonstrator:
    """Lets the scripted agent drive, and records the observations of a policy.

    In some episodes noise is added to the actions now and then, so that the record also shows how
    to recover from errors of a learner: DART (Laskey et al. 2017). The recorded action is the one
    without noise.

    Args:
        preset: whose robots, episodes and rewards.
        seed: of the training.
    """

    def __init__(self, preset: Preset, seed: int) -> None:
        self._preset, self._seed = preset, seed
        self._envs = [
            SemNavEnv(
                robot,
                observation="all",
                rewards=preset.rewards,
                max_seconds=preset.max_seconds,
                episodes=preset.episodes,
            )
            for robot in preset.robots
        ]
        self._bodies = [robot_spec(robot) for robot in preset.robots]

    def drive(self, number: int) -> Tensors:
        """One demonstration; bodies take turns.

        Returns:
            "observations", "actions" and "returns" (the discounted sum of rewards), a row for each
            decision; no rows if the agent failed.
        """
        which = number % len(self._envs)
        env, body = self._envs[which], self._bodies[which]
        rng = np.random.default_rng((self._seed, number))
        noise = Perturbation(body.action_size, rng)
        observation, info = env.reset(seed=int(rng.integers(2**31)))
        agent, observer = ScriptedAgent(), CompactObserver([body], env.lidar_spec)
        agent.reset(info)
        observations, actions, rewards = [], [], []
        over = False
        while not over:
            row = {name: observation[name][None] for name in COMPACT_ENTRIES}
            observations.append(observer.observe(row)[0])
            disturbance, wanted, reward = noise.draw(), [], 0.0
            for _ in range(self._preset.repeat):
                wanted.append(agent.act(observation))
                driven = np.clip(wanted[-1] + disturbance, -1.0, 1.0).astype(np.float32)
                observation, worth, terminated, truncated, info = env.step(driven)
                reward += worth
                over = terminated or truncated
                if over:
                    break
            actions.append(from_body(np.mean(wanted, axis=0), self._preset.action_size))
            rewards.append(reward)
        end = len(actions) if info["is_success"] else 0
        return {
            "observations": np.array(observations, np.float32)[:end],
            "actions": np.array(actions, np.float32)[:end],
            "returns": discounted(rewards, self._preset.ppo.gamma)[:end],
        }


class Perturbation:
    """The noise that is added to the actions of one demonstration.

    Args:
        size: of an action.
        rng: draws whether and how this demonstration is perturbed.
    """

    def __init__(self, size: int, rng: np.random.Generator) -> None:
        self._rng, self._size = rng, size
        self._perturbed = rng.random() < PERTURBED_SHARE
        self._left, self._value = 0, np.zeros(size)

    def draw(self) -> NDArray[np.float64]:
        """The noise of the next decision."""
        if self._left:
            self._left -= 1
        elif self._perturbed and self._rng.random() < PERTURBATION_RATE:
            self._value = self._rng.normal(0.0, PERTURBATION_SIGMA, self._size)
            self._left = int(self._rng.integers(3))
        else:
            self._value = np.zeros(self._size)
        return self._value


def discounted(rewards: list[float], gamma: float) -> NDArray[np.float32]:
    """The discounted sum of each reward and those after it."""
    returns, after = np.zeros(len(rewards), np.float32), 0.0
    for k in reversed(range(len(rewards))):
        after = rewards[k] + gamma * after
        returns[k] = after
    return returns
