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
from semnav_env.rescue.person_finder import PersonFinder
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
    """A robot searches a house for people who lie or sit on its floors.

    ## Description
    SPOT (or the wheelchair) is sent into a house that nobody can look into. It visits every room,
    inspects the floor from enough places, and reports where people are. The lidar cannot tell a
    person on the floor from furniture; a camera with a person detector, `PersonFinder`, can, with
    errors. It is the mission of Mes 2021, made of `SemNavEnv` with the command "search the house".
    Her robot's other actions are clauses, too: "search this room", "look around", "call and
    listen", "go to the person you found", "ask for the name".

    ## Action Space
    As in `SemNav-v0`: `Box(-1, 1, (2,), float32)` for the wheelchair, `Box(-1, 1, (3,), float32)`
    for SPOT; shares of the largest forward speed, speed to the left (SPOT) and yaw rate.

    ## Observation Space
    The entries of the mode, as in `SemNav-v0`, and

    - people: 16 rows of is_there, x, y (robot frame, metres), probability (0 to 1) and reported,
      the tracks of the robot's own map of people.

    ## Rewards
    The sum of the terms in `info["reward_terms"]`:

    - area: 0.1 for each square metre of floor that the camera sees for the first time;
    - people: 5 for each victim that is reported, -5 for each false report;
    - clause, success, failure, contact and time as in `SemNav-v0`.

    ## Starting State
    Another generated house for each episode, with furniture, open doors and two victims in its
    rooms; the robot stands in a hall. `reset(options=...)` is that of `SemNav-v0`.

    ## Episode End
    - Termination: the search is done: each room is covered by 95 %, each victim has a report within
      1 m, and no report is false. Or "incomplete": before that the robot stands still for 20 s, by
      which it says that it has finished.
    - Truncation: after `max_seconds`, 1200 s of simulated time by default.

    `info["search"]` says at the end what was covered, found and reported wrongly, and
    `info["found"]` where people are believed to be, and what their names are.

    ## Arguments
    - observation: a mode, which gets the entry "people" beside its own, or an observation type.
    - options: arguments of `SemNavEnv`. Other defaults than there have task, dynamics (two
      victims), payload (`PersonFinder`, whose settings are those of the detector), rewards and
      max_seconds.

    ## Vectorized Environment
    `gymnasium.make_vec(..., vectorization_mode="vector_entry_point")` works; the person detector
    runs in Python, so many robots are slower than in `SemNav-v0`.

    ## Version History
    - v0: the first version.

    ## References
    Mes 2021, "Point planning and drift correction based on reliable door detection".
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
        "payload": PersonFinder() if payload is None else payload,
        **options,
    }
