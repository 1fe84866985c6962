"""`python -m studies unsaid`: what doing what goes without saying is good for."""

from __future__ import annotations

import json
from dataclasses import dataclass

import numpy as np

from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_scripts.progress import tracked
from studies.unsaid.unsaid import Followed, Unsaid, follow, unsaid_trials


@dataclass(frozen=True)
class Arguments:
    """Say commands that leave steps unsaid, with and without doing those.

    Attributes:
        map: a floor plan with rooms: a bundled name or a path.
        agent: drives what is understood: scripted, oracle, drive (a trained one), or the
            path of a trained one; with "none" it is only counted.
        robot: wheelchair or spot.
        trials: at most so many commands; 0 for all.
        seed: of the start poses.
        json: print the shares as JSON.
    """

    map: str = "office_cross"
    agent: str = "none"
    robot: str = "wheelchair"
    trials: int = 0
    seed: int = 0
    json: bool = False

    def run(self) -> int:
        """Count, and print the shares."""
        if self.trials < 0 or self.seed < 0:
            raise ValueError("trials and seed must be 0 or more")
        agent = None if self.agent == "none" else make_agent(self.agent)
        observation = "truth" if agent is None else agent.observation
        env = SemNavEnv(self.robot, self.map, observation=observation)
        rng = np.random.default_rng(self.seed)
        trials = list(unsaid_trials(env.floor_plan, env.robot, rng))
        if self.trials:
            chosen = rng.permutation(len(trials))[: self.trials]
            trials = [trials[k] for k in sorted(chosen)]
        rows = {
            name: self._shares(env, agent, trials, implicit)
            for name, implicit in (("with implicit steps", True), ("without", False))
        }
        print(json.dumps(rows) if self.json else "\n".join(_line(*row) for row in rows.items()))
        return 0

    def _shares(
        self, env: SemNavEnv, agent: object, trials: list[Unsaid], implicit: bool
    ) -> dict[str, float]:
        found: list[Followed] = []
        steps = (
            follow(env, trial, agent, self.seed, implicit_steps=implicit)  # type: ignore[arg-type]
            for trial in trials
        )
        done = tracked(steps, lambda n: f"{n} commands", lambda: len(found) / len(trials))
        for each in done:
            found.append(each)
        shares = {"commands": len(found), "understood": _share([f.understood for f in found])}
        reached = [f.reached for f in found if f.reached is not None]
        return shares | ({"reached": _share(reached)} if reached else {})


def _share(flags: list[bool]) -> float:
    return round(sum(flags) / len(flags), 3) if flags else 0.0


def _line(name: str, shares: dict[str, float]) -> str:
    figures = ", ".join(f"{key} {value:g}" for key, value in shares.items())
    return f"{name}: {figures}"
