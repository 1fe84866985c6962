"""Draw docs/images/drift.png, and measure how far a robot strays from where it believes to be."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode, evenly, load_episodes
from semnav_env.world.maps.draw import draw_floor_plan
from semnav_env.world.simulator.odometry import OdometrySettings
from semnav_features.frames import compose, relative
from studies.figures import IMAGES

ERRORS = OdometrySettings(turn_bias=0.02, turn_noise=0.02, veer_noise=0.01)
"""Of the picture: twice the usual ones of turning."""

START = (1.3, 9.1, 0.0)
COMMAND = (
    "turn left at the intersection, turn right at the corner and take the last door on the left"
)
VIEW = (8.0, 30.0), (6.0, 21.5)


def draw(ax: Axes, corrected: bool) -> None:
    """The plan, what is remembered, and the ways believed and driven, put on each other's start."""
    env = SemNavEnv(
        floor_plan="office_cross", observation="all", odometry=ERRORS, corrects_drift=corrected
    )
    begun = env.reset(seed=1, options={"command": COMMAND, "pose": START})
    ways = [
        (env.world.pose[:2], compose(START, env.belief.pose)[:2])
        for _ in steps(env, make_agent("scripted"), *begun)
    ]
    draw_floor_plan(env.floor_plan, ax, names=False)
    for wall in env.tracker.scene().placed(START).walls:
        ax.plot(*zip(wall.start, wall.end, strict=True), color="tab:red", lw=1.0)
    true, believed = np.array(ways).transpose(1, 2, 0)
    ax.plot(*true, color="tab:green", lw=1.8, label="driven")
    ax.plot(*believed, "--", color="tab:blue", lw=1.8, label="believed")
    ax.plot([], [], color="tab:red", lw=1.0, label="remembered walls")
    ax.set(xlim=VIEW[0], ylim=VIEW[1], aspect="equal")
    ax.axis("off")
    ax.set_title("corrected by walls seen again" if corrected else "odometry alone", fontsize=10)


def strayed(env: SemNavEnv, episode: Episode) -> tuple[float, ...]:
    """At the end: metres and degrees off by odometry alone, and as believed."""
    begun = env.reset(seed=episode.number, options={"episode": episode})
    start = env.world.pose
    for _ in steps(env, make_agent("scripted"), *begun):
        pass
    true, off = relative(start, env.world.pose), []
    for pose in (env.simulator.odometry.pose, env.belief.pose):
        turned = abs(math.remainder(pose[2] - true[2], math.tau))
        off += [math.dist(pose[:2], true[:2]), math.degrees(turned)]
    return tuple(off)


def main(episodes: int = 40) -> None:
    """Draw drift.png, and measure how far a robot strays from where it believes to be.

    Args:
        episodes: how many of test_long.
    """
    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    FigureCanvasAgg(figure)
    for ax, corrected in zip(figure.subplots(1, 2), (False, True), strict=True):
        draw(ax, corrected)
    figure.legend(*ax.get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=9)
    figure.savefig(IMAGES / "drift.png", dpi=90)
    env = SemNavEnv(observation="all", max_seconds=300.0)
    driven = evenly(load_episodes("test_long"), episodes)
    off = np.array([strayed(env, episode) for episode in driven])
    for name, column in zip(("odometry", "believed"), (0, 2), strict=True):
        metres, degrees = off[:, column], off[:, column + 1]
        print(
            f"{name}: off by {metres.mean():.2f} m and {degrees.mean():.2f} degrees on average, "
            f"by {np.percentile(metres, 95):.2f} m and {np.percentile(degrees, 95):.2f} degrees "
            f"for one in twenty of {episodes} episodes"
        )
