"""Drives of the scripted agent as it is shown to a learner, and its word on a learner's drives."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import gymnasium as gym
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from semnav_agents.hearing.collecting import GroundedGoal
from semnav_agents.learning.imitation import Perturbation, discounted
from semnav_agents.scripted import ScriptedTeam
from semnav_env.judge.episodes import load_episodes
from semnav_env.mind.observations import EntryObservation, Moment
from semnav_env.networks.weights import load_tensors, save_tensors
from semnav_env.robots import RobotSpec
from semnav_env.vector import SemNavVectorEnv
from semnav_features.lidar_spec import LidarSpec
from studies.learning.command_envs import CONTROL_HZ, OPTIONS, REPEAT, Array
from studies.learning.heard_vector import STATE_START, HeardVectors

Policy = Callable[[Array], Array]
"""Gives actions (n, 3) for vectors (n, SIZE)."""

GAMMA = 0.99
"""Discount for a decision."""

MOST_LATE = 4
"""Decisions for which a finger may stay behind in a demonstration, so that a learner sees it."""

STANDING = 0.05
"""Of a robot that moves less, and of an expert whose action is less, nothing is learned: it waits
for a reason that is not in the vector."""


class ActiveClause:
    """The index of the clause that the robot's grounding has under way, for the expert alone."""

    name = "active"

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.Space[Any]:
        """The space of the entry."""
        return Box(0.0, 100.0, (1,), np.float32)

    def observe(self, moment: Moment) -> NDArray[np.float32]:
        """The index."""
        return np.array([moment.belief.clause], np.float32)


class Lesson(NamedTuple):
    """An episode in which the expert drove or said what it would do; a row for each decision.

    Attributes:
        vectors: what the learner sees, shape (n, SIZE).
        actions: of the expert, shape (n, 3); the last is 1 where the finger is to move on, else -1.
        returns: the discounted sum of each reward and those after it, shape (n,).
        success: whether the episode succeeded.
        steps: of the environment.
    """

    vectors: Array
    actions: Array
    returns: Array
    success: bool
    steps: int


def lessons(seed: int, robots: int, learner: Policy | None = None) -> Iterator[Lesson]:
    """Drive random episodes of `train` for ever, many at once; each is given as it ends.

    Args:
        seed: of the episodes and the noise.
        robots: how many drive at once.
        learner: who drives; if None the expert, whose actions are disturbed in half of the episodes
            (DART; Laskey et al. 2017).
    """
    class_ = _Class(seed, robots, learner)
    while True:
        yield from class_.decide()


class _Class:
    """Many robots in the middle of their episodes."""

    def __init__(self, seed: int, robots: int, learner: Policy | None) -> None:
        self._rng, self._learner = np.random.default_rng(seed), learner
        self._episodes = load_episodes("train")
        observation = EntryObservation("command", [GroundedGoal(), ActiveClause()])
        self._envs = SemNavVectorEnv(
            robots, observation=observation, autoreset_mode="Disabled", **OPTIONS
        )
        self._team = ScriptedTeam(robots)
        self._vectors = HeardVectors(robots, REPEAT / CONTROL_HZ)
        self._rows: list[list[tuple[Array, Array]]] = [[] for _ in range(robots)]
        self._noise = [Perturbation(2, self._rng) for _ in range(robots)]
        self._rewards: list[list[float]] = [[] for _ in range(robots)]
        self._late = np.zeros(robots, np.int64)
        for k in range(robots):
            self._begin(k)
        self._seen = self._envs.observe()

    def _begin(self, index: int) -> None:
        episode = self._episodes[int(self._rng.integers(len(self._episodes)))]
        seed = int(self._rng.integers(2**31))
        info = self._envs.begin(index, seed, {"episode": episode})
        self._team.reset(index, info, self._envs.envs[index].floor_plan)
        self._vectors.forget(np.arange(len(self._rows)) == index)
        self._rows[index], self._rewards[index] = [], []
        self._noise[index] = Perturbation(2, self._rng)

    def decide(self) -> Iterator[Lesson]:
        """One decision of all robots; gives the lessons that end with it."""
        vectors = self._vectors.observe(self._seen)
        wanted = self._team.act(self._seen)
        behind = self._seen["active"][:, 0] > self._vectors.clause
        labels = np.column_stack((wanted, np.where(behind, 1.0, -1.0))).astype(np.float32)
        for k, rows in enumerate(self._rows):
            rows.append((vectors[k], labels[k]))
        driven, moved = self._driven(vectors, wanted, behind)
        self._vectors.advance(moved, self._seen)
        self._seen, worth, terminated, truncated, infos = self._envs.step(driven)
        for rewards, reward in zip(self._rewards, worth.tolist(), strict=True):
            rewards.append(reward)
        over = np.flatnonzero(terminated | truncated).tolist()
        for k in over:
            seen, actions = map(np.array, zip(*self._rows[k], strict=True))
            returns = discounted(self._rewards[k], GAMMA)
            yield Lesson(seen, actions, returns, bool(infos["is_success"][k]), REPEAT * len(seen))
            self._begin(k)
        if over:
            self._seen = self._envs.observe()

    def _driven(
        self, vectors: Array, wanted: Array, behind: NDArray[np.bool_]
    ) -> tuple[Array, NDArray[np.bool_]]:
        """What the robots do, and which fingers move on; none moves before its clause is over."""
        if self._learner is None:
            self._late = np.where(
                behind, self._late, self._rng.integers(MOST_LATE, size=len(wanted))
            )
            moved = behind & (self._late == 0)
            self._late -= behind
            noise = np.array([each.draw() for each in self._noise])
            return np.clip(wanted + noise, -1.0, 1.0).astype(np.float32), moved
        actions = np.clip(self._learner(vectors), -1.0, 1.0)
        return actions[:, :-1], behind & (actions[:, -1] > 0.0)


def is_taught(lesson: Lesson) -> NDArray[np.bool_]:
    """Which decisions of a lesson are learned from: not those in which the expert waits."""
    speed = np.abs(lesson.vectors[:, _VELOCITY]).max(axis=1)
    waits = np.maximum(speed, np.abs(lesson.actions[:, :2]).max(axis=1)) < STANDING
    taught: NDArray[np.bool_] = ~waits | (lesson.actions[:, -1] > 0.0)
    return taught


_VELOCITY = slice(STATE_START, STATE_START + 3)


def demonstrations(steps: int, folder: Path, robots: int = 32) -> list[Lesson]:
    """The first demonstrations, of so many steps in all, which a folder keeps.

    All seeds of all methods learn from the same ones: what differs is what they make of them.
    """
    if not (folder / _part(0)).exists():
        found, have = [], 0
        for lesson in lessons(DEMONSTRATION_SEED, robots):
            found.append(lesson)
            have += lesson.steps
            if have >= steps:
                break
        for k in reversed(range(0, len(found), LESSONS_OF_A_FILE)):
            save_tensors(folder / _part(k), _tensors(found[k : k + LESSONS_OF_A_FILE]))
    kept = [
        each
        for file in sorted(folder.glob("demonstrations-*.safetensors"))
        for each in _lessons(file)
    ]
    return first_of(kept, steps)


def first_of(lessons: Sequence[Lesson], steps: int) -> list[Lesson]:
    """The first lessons, of so many steps in all; the last one ends beyond them."""
    before = np.cumsum([0, *(lesson.steps for lesson in lessons)])
    return [lesson for lesson, done in zip(lessons, before, strict=False) if done < steps]


DEMONSTRATION_SEED, LESSONS_OF_A_FILE = 1000, 100
"""Seed of the demonstrations, and how many of them lie in a file."""


def _part(first: int) -> str:
    return f"demonstrations-{first:06}.safetensors"


def _tensors(found: Sequence[Lesson]) -> dict[str, NDArray[Any]]:
    return {
        "lengths": np.array([len(lesson.vectors) for lesson in found], np.int64),
        "success": np.array([lesson.success for lesson in found], np.uint8),
        "vectors": np.concatenate([lesson.vectors for lesson in found]).astype(np.float16),
        "actions": np.concatenate([lesson.actions for lesson in found]),
        "returns": np.concatenate([lesson.returns for lesson in found]),
    }


def _lessons(file: Path) -> Iterator[Lesson]:
    tensors = load_tensors(file)
    ends = np.cumsum(tensors["lengths"])[:-1]
    names = ("vectors", "actions", "returns")
    parts = (np.split(tensors[name].astype(np.float32), ends) for name in names)
    for seen, actions, returns, done in zip(*parts, tensors["success"], strict=True):
        yield Lesson(seen, actions, returns, bool(done), REPEAT * len(seen))
