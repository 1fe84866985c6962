"""Draws the films and the picture of the tutorials that show driving."""

from __future__ import annotations

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from examples.own_agent import HeadForGoal
from semnav_agents.base import Agent, steps
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import load_episodes
from semnav_env.judge.tasks import RewardWeights
from semnav_env.rendering.video import Picture, save_video
from studies.figures import IMAGES
from studies.figures.real_floor import drive

START = (-2.5, -0.6, 0.25)
EPISODE = 44
"""Number of an episode of `val_unseen` that `blind` fails."""

FRAMES_PER_SECOND = 15 / 10
"""Of the films: every tenth scan."""


def own_agent() -> None:
    """Draw own_agent.gif: the tutorial's own agent passes the first door on the right."""
    told = {"command": "go through the first door on the right", "pose": START}
    frames = film("heidelberg_hallway", HeadForGoal(), 0, told)
    save_video(IMAGES / "own_agent.gif", frames, 4 * FRAMES_PER_SECOND, 0.5)


def compare_agents() -> None:
    """Draw compare_agents.gif: one episode by `scripted`, and by `blind` at its right."""
    episode = load_episodes("val_unseen")[EPISODE]
    told = {"command": episode.command, "pose": episode.start}
    films = [
        film(episode.floor_plan, make_agent(name), episode.number, told)
        for name in ("scripted", "blind")
    ]
    longest = max(map(len, films))
    ended = [frames + [frames[-1]] * (longest - len(frames)) for frames in films]
    both = [np.hstack(pair) for pair in zip(*ended, strict=True)]
    save_video(IMAGES / "compare_agents.gif", both, 4 * FRAMES_PER_SECOND, 0.4)


def film(floor_plan: str, agent: Agent, seed: int, told: dict[str, object]) -> list[Picture]:
    """The frames of one drive."""
    env = SemNavEnv(floor_plan=floor_plan, observation=agent.observation, render_mode="rgb_array")
    return drive(env, agent, seed, told)[1]


def own_reward() -> None:
    """Draw own_reward.png: the sum of each term while a command of two clauses is carried out."""
    agent = make_agent("scripted")
    env = SemNavEnv(observation=agent.observation, render_mode="rgb_array")
    told = {"command": "go through the second door on the right, then turn around", "pose": START}
    terms = [
        step.info["reward_terms"] for step in steps(env, agent, *env.reset(seed=0, options=told))
    ]
    seconds = np.arange(1, len(terms) + 1) / env.lidar_spec.rate_hz
    figure = Figure(figsize=(10, 4), layout="constrained")
    FigureCanvasAgg(figure)
    seen, sums = figure.subplots(1, 2, width_ratios=(1, 1.1))
    seen.imshow(env.render())
    seen.set_axis_off()
    for name in vars(RewardWeights()):
        sums.plot(seconds, np.cumsum([each[name] for each in terms]), label=name)
    sums.set(xlabel="time, s", ylabel="sum of the term so far")
    sums.legend()
    figure.savefig(IMAGES / "own_reward.png", dpi=80)


def main() -> None:
    """Draw own_agent.gif, compare_agents.gif and own_reward.png: the tutorials that drive."""
    own_agent()
    compare_agents()
    own_reward()
