"""Searches of generated houses, and the table of their results."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass

import numpy as np

from semnav_agents.base import steps
from semnav_agents.evaluation.intervals import wilson_interval
from semnav_agents.registry import make_agent
from semnav_env.rescue.environment import search_and_rescue
from semnav_env.rescue.person_search import PersonSearch
from studies.search.all_around import seen_all_around

FIRST_SEED = 10_000
"""Seeds from here on are for measuring; the agents were tuned on seeds below 1000."""

BACK = 1.0
"""Distance from where it came in at which a robot is back, metres."""

AGENTS = {"with the plan": "searcher", "without": "explorer"}
"""The agents that are compared, by what they know."""


@dataclass(frozen=True)
class Search:
    """One search of one house.

    Attributes:
        seed: of the episode, which also draws the house, the victims and the start.
        agent: its name.
        house: name of its plan.
        verdict: of the judge.
        success: whether the judge accepts it.
        coverage: of each room, of the floor that the detector on its mount can see.
        around: the same of the floor that a detector in the middle of the body could see in all
            directions, which was the measure before.
        floor_coverage: of each room, of all its floor.
        victims: how many there are.
        found: how many were reported.
        false_reports: of nobody.
        report_errors: distances of reports from victims, metres.
        contacts: begun in the search.
        metres: driven.
        seconds: of simulated time.
        from_start: distance of the robot from where it came in when it was over, metres.
        cpu: processor time, seconds.
    """

    seed: int
    agent: str
    house: str
    verdict: str
    success: bool
    coverage: tuple[float, ...]
    around: tuple[float, ...]
    floor_coverage: tuple[float, ...]
    victims: int
    found: int
    false_reports: int
    report_errors: tuple[float, ...]
    contacts: int
    metres: float
    seconds: float
    from_start: float
    cpu: float


def search(agent: str, seed: int, robot: str) -> Search:
    """Let an agent search the house of a seed."""
    begun, driver = time.process_time(), make_agent(agent)
    env = search_and_rescue(robot=robot, observation=driver.observation)
    observation, start = env.reset(seed=seed)
    info = start
    came_in = env.simulator.motion.pose
    for step in steps(env, driver, observation, start):
        info = step.info
    outcome, payload = info["search"], env.payload
    assert isinstance(payload, PersonSearch)
    seen = payload.coverage
    around = seen_all_around(env.floor_plan, env.robot, payload.settings, seen.grid)
    return Search(
        seed,
        agent,
        start["floor_plan"],
        str(info["verdicts"][0]),
        info["is_success"],
        tuple(round(share, 4) for share in outcome["coverage"].values()),
        tuple(round(share, 4) for share in seen.shares_of(around).tolist()),
        tuple(round(share, 4) for share in outcome["floor_coverage"].values()),
        outcome["victims"],
        outcome["found"],
        outcome["false_reports"],
        tuple(round(error, 3) for error in outcome["report_errors"]),
        info["collisions"],
        round(info["path_length"], 2),
        round(env.seconds, 1),
        round(math.dist(came_in[:2], env.simulator.motion.pose[:2]), 2),
        round(time.process_time() - begun, 1),
    )


def row(each: Search) -> dict[str, object]:
    """A search as plain values, for a line of a file."""
    return asdict(each)


def summary(searches: Sequence[Search]) -> dict[str, float]:
    """The figures of some searches, of which there must be at least one; shares from 0 to 1."""
    rooms = [share for each in searches for share in each.coverage]
    errors = [error for each in searches for error in each.report_errors]
    covered = [share >= 0.95 for share in rooms]
    around = [share for each in searches for share in each.around]
    metres = sum(each.metres for each in searches)
    seconds = np.array([each.seconds for each in searches])
    return {
        "searches": len(searches),
        "success": _mean([each.success for each in searches]),
        "rooms": len(rooms),
        "all rooms covered": _mean([min(each.coverage) >= 0.95 for each in searches]),
        "rooms covered": _mean(covered),
        "rooms covered, 95 % from": wilson_interval(_mean(covered), len(covered))[0],
        "rooms covered, 95 % to": wilson_interval(_mean(covered), len(covered))[1],
        "least coverage": min(rooms),
        "mean coverage": _mean(rooms),
        "rooms covered, looking all around from the middle": _mean([s >= 0.95 for s in around]),
        "least coverage, looking all around from the middle": min(around),
        "mean coverage of all floor": _mean([s for each in searches for s in each.floor_coverage]),
        "all victims found": _mean([each.found == each.victims for each in searches]),
        "victims found": sum(each.found for each in searches)
        / max(sum(each.victims for each in searches), 1),
        "false reports a search": _mean([each.false_reports for each in searches]),
        "report error, m": _mean(errors),
        "contacts per 100 m": 100.0 * sum(each.contacts for each in searches) / max(metres, 1e-9),
        "metres": metres / len(searches),
        "seconds, median": float(np.median(seconds)),
        "seconds, most": float(seconds.max()),
        "back at the start": _mean([each.from_start < BACK for each in searches]),
        "CPU seconds, mean": _mean([each.cpu for each in searches]),
    }


def _mean(values: Sequence[float]) -> float:
    return float(np.mean(values)) if len(values) else 0.0
