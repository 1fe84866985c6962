"""`SearchAndRescue-v0`: `SemNavEnv` with the parts of a search; it has no class of its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import AddedTerms, EpisodeRequest, RewardWeights, Tick
from semnav_env.language import Command, SearchHouse
from semnav_env.mind.observations import EntryObservation
from semnav_env.rescue.people_entry import PeopleEntry
from semnav_env.rescue.person_search import PersonSearch
from semnav_env.vector import SemNavVectorEnv
from semnav_env.world.dynamics import Dynamics

SEARCH = Command((SearchHouse(),))
"""The command of a search."""

MAX_SEARCH_SECONDS = 1200.0
"""Default time limit of a search, seconds: the scripted agents needed 920 s at most."""

VICTIMS = 2
"""Default number of victims."""

HOUSES = 2**31
"""Number of different houses from which a task draws."""


class HouseTask:
    """A task that requests the search of a generated house, another one for each episode."""

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        """A house and the command to search it."""
        return EpisodeRequest(SEARCH, floor_plan=f"office:house:{rng.integers(HOUSES)}")


def area_gained(tick: Tick) -> float:
    """Reward term: 0.1 for each m^2 of room floor that was seen for the first time."""
    return 0.1 * float(getattr(tick.payload, "gained", 0.0))


def people_reported(tick: Tick) -> float:
    """Reward term: 5 for each victim that is reported, -5 for each false report."""
    return 5.0 * float(getattr(tick.payload, "reported", 0.0))


SEARCH_REWARDS = AddedTerms(
    {"area": area_gained, "people": people_reported}, RewardWeights(progress=0.0)
)
"""Rewards of a search: contact, time, success and failure as in `RewardWeights`, area and
people."""


def search_and_rescue(observation: Any = "semantic", **options: Any) -> SemNavEnv:
    """A `SemNavEnv` in which a robot searches houses for people on the floor.

    Args:
        observation: a mode, which gets the entry "people" beside its own, or an observation type.
        options: arguments of `SemNavEnv`; without them a robot searches a generated house for two
            victims.
    """
    return SemNavEnv(**_search_options(observation=observation, **options))


def search_and_rescue_vector(
    num_envs: int = 1, *, each: Sequence[Mapping[str, Any]] | None = None, **options: Any
) -> SemNavVectorEnv:
    """Many robots that search, each in a house of its own; see `SemNavVectorEnv`.

    Args:
        num_envs: number of robots.
        each: arguments that differ, one mapping for each robot.
        options: for all robots, and those of `SemNavVectorEnv`.
    """
    return SemNavVectorEnv(num_envs, each=each, **_search_options(**options))


def _search_options(
    observation: Any = "semantic",
    floor_plan: Any = None,
    task: Any = None,
    dynamics: Dynamics = Dynamics(victims=VICTIMS),
    max_seconds: float = MAX_SEARCH_SECONDS,
    rewards: Any = SEARCH_REWARDS,
    payload: Any = None,
    **options: Any,
) -> dict[str, Any]:
    """Arguments of `SemNavEnv`, with those of a search where none are given."""
    if isinstance(observation, str):
        observation = EntryObservation(observation, [PeopleEntry()])
    if options.get("episodes") is None:
        floor_plan = "office:house:0" if floor_plan is None else floor_plan
        task = HouseTask() if task is None else task
    return {
        "observation": observation,
        "floor_plan": floor_plan,
        "task": task,
        "dynamics": dynamics,
        "max_seconds": max_seconds,
        "rewards": rewards,
        "payload": PersonSearch() if payload is None else payload,
        **options,
    }
