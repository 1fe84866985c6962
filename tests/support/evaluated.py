"""Results of episodes made by hand, and an agent that fails."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from semnav_agents.evaluation import Result
from semnav_agents.team import AgentsOneByOne
from semnav_env.judge.metrics import METRIC_NAMES, Metrics
from semnav_env.robots import RobotSpec

NOTHING = Metrics(**dict.fromkeys(METRIC_NAMES, 0))


def result(success: bool, collisions: int = 0, seed: int = 0, rechecked: str = "") -> Result:
    verdict, cause = ("done", "") if success else ("wrong door", "crossed a, wanted b")
    measured = replace(
        NOTHING, success=success, collisions=collisions, contact_free=collisions == 0, spl=success
    )
    return Result("stop", seed, (verdict,), measured, cause, rechecked)


class Statue:
    """Stands still."""

    observation = "truth"

    def reset(self, info: dict[str, Any]) -> None:
        self.action = np.zeros(RobotSpec(**info["robot"]).action_size, dtype=np.float32)

    def act(self, observation: dict[str, Any]) -> np.ndarray:
        return self.action


def statues(name: str, robots: int) -> AgentsOneByOne:
    """A team that stands still, in place of any."""
    return AgentsOneByOne([Statue() for _ in range(robots)])


def write_kept_result(path: Path) -> None:
    """Write one result as `semnav evaluate --out` does, of a drive of some seconds."""
    drive = {"agent": "blind", "robot": "wheelchair", "split": "heidelberg", "seed": 3}
    said = {
        "floor_plan": "heidelberg_hallway",
        "command": "go through the second door on the right",
    }
    ended = {"success": False, "verdicts": ["wrong door"], "dynamics": {"pedestrians": 0}}
    path.write_text(json.dumps({**drive, **said, **ended}) + "\n")
