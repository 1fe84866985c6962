"""Episodes driven with and without assistance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from semnav_agents.assistance.assisted import Assisted
from semnav_agents.base import Agent
from semnav_agents.evaluation.drive import Drive, drive
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode, evenly, load_episodes
from semnav_env.language import Approach, GoToDoor, Leave
from semnav_features.door_passages import DrivingHabits, driving_habits
from studies.assistance.clumsy import DRIVERS, Clumsiness, ClumsyDriver

ASSISTANCE = ("none", "contacts", "doors")
"""Nothing; contacts are prevented; and help through doors as well."""

MAX_SECONDS = 60.0
"""Time limit of an episode, seconds."""


@dataclass(frozen=True)
class Assistance:
    """What became of some drives.

    Attributes:
        drives: how many.
        success: share that was carried out.
        contacts: mean number of contacts.
        contact_free: share without a contact.
        seconds: mean time of all.
        habits: how doorways were passed.
    """

    drives: int
    success: float
    contacts: float
    contact_free: float
    seconds: float
    habits: DrivingHabits


def episodes_through_doors(split: str, count: int) -> tuple[Episode, ...]:
    """Short commands of a split that lead through a door, evenly spaced."""
    return evenly([each for each in load_episodes(split) if _leads_through(each)], count)


def _leads_through(episode: Episode) -> bool:
    clauses = episode.meanings()[0].clauses
    through = (
        isinstance(each, Leave)
        or (isinstance(each, GoToDoor) and each.approach is Approach.THROUGH)
        for each in clauses
    )
    return len(clauses) <= 2 and any(through)


def driver_of(name: str, clumsiness: Clumsiness, assistance: str, seed: int) -> Agent:
    """A driver of `DRIVERS` with an assistance of `ASSISTANCE`."""
    agent: Agent = ClumsyDriver(DRIVERS[name](), clumsiness, seed)
    return agent if assistance == "none" else Assisted(agent, doors=assistance == "doors")


def assisted_drives(
    robot: str,
    episodes: Sequence[Episode],
    name: str,
    clumsiness: Clumsiness,
    assistance: str,
    seeds: int,
) -> Assistance:
    """Drive episodes, each with several seeds of the driver's noise."""
    driven = [
        one_drive(robot, episode, driver_of(name, clumsiness, assistance, seed))
        for episode in episodes
        for seed in range(seeds)
    ]
    contacts = [each.recording.collisions for each in driven]
    return Assistance(
        len(driven),
        float(np.mean([each.metrics.success for each in driven])),
        float(np.mean(contacts)),
        float(np.mean([count == 0 for count in contacts])),
        float(np.mean([each.recording.seconds for each in driven])),
        driving_habits([passage for each in driven for passage in each.passages()]),
    )


def one_drive(robot: str, episode: Episode, agent: Agent) -> Drive:
    """Drive one episode."""
    env = SemNavEnv(robot, observation=agent.observation, max_seconds=MAX_SECONDS)
    return drive(env, agent, episode.number, {"episode": episode})
