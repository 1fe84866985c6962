"""Runs the scripted agent on imported floors: how often it gets there, and a film of one run."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge import plan_goals
from semnav_env.language import Approach, Command, DoorReference, GoToDoor, Side
from semnav_env.mind.grounding import GroundingError
from semnav_env.mind.grounding.goal import door_of
from semnav_env.rendering.video import save_video
from semnav_env.robots import WHEELCHAIR
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.importers import import_map
from semnav_env.world.maps.placement import sample_pose
from studies.figures import IMAGES

FLOORS = ("2", "3ne")
START_COUNT = 60
"""Random starts on each floor."""

MAX_GOAL_DISTANCE = 12.0
"""Commands whose goal is farther from the start are left out, metres."""

COMMANDS_PER_DOOR = 2
"""Most commands for one door."""

FILM = "3ne", "go to room 3.512", (-14, -5.04, 3.1)
FRAME_EVERY = 10
FILM_SCALE = 0.5
"""Size of the film as a share of the frames."""


def tasks(plan: FloorPlan) -> list[tuple[Command, tuple[float, float, float]]]:
    """Commands by ordinals from random starts, at most `COMMANDS_PER_DOOR` for a door."""
    rng = np.random.default_rng(0)
    found: dict[str | None, list[Any]] = {}
    for _ in range(START_COUNT):
        start = sample_pose(plan, WHEELCHAIR, rng)
        for ordinal, side in ((1, Side.LEFT), (2, Side.LEFT), (1, Side.RIGHT), (2, Side.RIGHT)):
            command = Command((GoToDoor(DoorReference(ordinal, side), Approach.THROUGH),))
            try:
                (goal,) = plan_goals(plan, command, start)
            except GroundingError:
                continue
            away = np.hypot(goal.pose[0] - start[0], goal.pose[1] - start[1])
            door = door_of(goal)
            known = found.setdefault(door and door.name, [])
            if away < MAX_GOAL_DISTANCE and len(known) < COMMANDS_PER_DOOR:
                known.append((command, start))
    return [task for known in found.values() for task in known]


def drive(env: SemNavEnv, agent: Any, seed: int, options: dict[str, Any]) -> tuple[bool, list[Any]]:
    """Whether it got there, and the frames if the environment draws any."""
    frames = []
    started = env.reset(seed=seed, options=options)
    for number, step in enumerate(steps(env, agent, *started), 1):
        over = step.terminated or step.truncated
        if env.render_mode and (over or number % FRAME_EVERY == 0):
            frames.append(env.render())
    return step.info["is_success"], frames


def main(data: Path) -> None:
    """Draw real_floor.gif, and count the commands that the scripted agent carries out.

    Args:
        data: folder that holds gdc_floors.
    """
    floors, agent = data / "gdc_floors", make_agent("scripted")
    plans = {name: import_map(floors / name / f"{name}.yaml").plan for name in FLOORS}
    name, command, start = FILM
    env = SemNavEnv(floor_plan=plans[name], observation=agent.observation, render_mode="rgb_array")
    there, frames = drive(env, agent, 0, {"command": command, "pose": start})
    print(f"film: {'done' if there else 'not done'}")
    save_video(IMAGES / "real_floor.gif", frames, 15 / FRAME_EVERY, FILM_SCALE)
    for name, plan in plans.items():
        env = SemNavEnv(floor_plan=plan, observation=agent.observation)
        runs = [
            drive(env, agent, k, {"command": command, "pose": start})[0]
            for k, (command, start) in enumerate(tasks(plan))
        ]
        print(f"{name}: {sum(runs)} of {len(runs)} commands carried out")
