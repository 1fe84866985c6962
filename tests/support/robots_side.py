"""Beliefs from a record of what a robot sensed; run as a module where no simulator can be had."""

from __future__ import annotations

import importlib.abc
import json
import pickle
import sys
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from semnav_env.mind.belief import Belief, BeliefTracker

SIMULATOR = ("dynamics", "env", "episodes", "lidar", "maps", "metrics", "observations", "rendering")
SIMULATOR += ("robots", "routes", "simulator", "tasks", "judge", "world", "agents", "scripts")
FORBIDDEN = {"pymunk", "shapely", *(f"semnav_env.{name}" for name in SIMULATOR)}


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


class _NoSimulator(importlib.abc.MetaPathFinder):
    """Refuses to import what belongs to the simulator."""

    def find_spec(self, name: str, path: Any, target: Any = None) -> None:
        if any(name == each or name.startswith(f"{each}.") for each in FORBIDDEN):
            raise ImportError(f"{name} is the simulator's")


def main(path: str) -> None:
    """Print the beliefs of a record as JSON."""
    sys.meta_path.insert(0, _NoSimulator())
    with open(path, "rb") as file:
        record = Recorded(*pickle.load(file))
    print(json.dumps(beliefs(record)))


if __name__ == "__main__":
    sys.modules["tests.support.robots_side"] = sys.modules["__main__"]
    main(sys.argv[1])
