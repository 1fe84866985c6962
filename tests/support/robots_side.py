"""Beliefs from a record of what a robot sensed; run as a module, also what of ours was loaded."""

from __future__ import annotations

import json
import pickle
import sys
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from semnav_env.mind.belief import Belief, BeliefTracker

NEEDED = ("networks", "language", "mind", "robots", "rules")
"""What of `semnav_env` a robot may need; all else belongs to the simulator."""


class Recorded(NamedTuple):
    """What a robot was told and sensed: ranges, odometry, velocity and bumps of each scan."""

    command: str
    mount: tuple[float, float, float]
    sensed: list[tuple[Any, ...]]


def begun(record: Recorded) -> BeliefTracker:
    """A tracker that has been told the command."""
    from semnav_env.language import parse
    from semnav_env.mind.belief import BeliefTracker

    tracker = BeliefTracker("tim561", record.mount)
    tracker.begin(parse(record.command))
    return tracker


def beliefs(record: Recorded) -> list[str]:
    """What is believed at each scan, to the last bit."""
    tracker = begun(record)
    return [described(tracker.update(*each)) for each in record.sensed]


def described(belief: Belief) -> str:
    """Pose, clause and goal of a belief, to the last bit."""
    pose, goal = belief.pose, belief.goal
    return f"{pose} {belief.clause} {goal!r} {belief.target.pose} {belief.impossible}"


def simulator_loaded() -> list[str]:
    """The modules of this process that a robot has no use for."""
    return sorted(filter(_is_the_simulators, sys.modules))


def _is_the_simulators(name: str) -> bool:
    package, _, rest = name.partition(".")
    if package == "semnav_env":
        return bool(rest) and rest.split(".")[0] not in NEEDED
    return package in ("pymunk", "shapely", "semnav_agents", "semnav_scripts")


def main(path: str) -> None:
    """Print the beliefs of a record, and what of the simulator they needed, as JSON."""
    with open(path, "rb") as file:
        record = Recorded(*pickle.load(file))
    print(json.dumps([beliefs(record), simulator_loaded()]))


if __name__ == "__main__":
    sys.modules["tests.support.robots_side"] = sys.modules["__main__"]
    main(sys.argv[1])
