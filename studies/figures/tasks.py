"""Draws docs/images/train.png: four episodes of the split `train`, each with its true route."""

from __future__ import annotations

import textwrap

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.judge.episodes import Episode, load_episodes
from semnav_env.judge.routes.draw import draw_routes
from semnav_env.judge.routes.route import Route
from studies.figures import IMAGES

SHOWN = (486, 1485, 2262, 3705)
"""Numbers of the episodes, from several offices, with one to three clauses, in two languages."""


def main() -> None:
    """Draw train.png: episodes of the benchmark."""
    episodes = load_episodes("train")
    figure = Figure(figsize=(13, 10), layout="constrained")
    FigureCanvasAgg(figure)
    for number, ax in zip(SHOWN, figure.subplots(2, 2).flat, strict=True):
        draw(episodes[number], ax)
    figure.savefig(IMAGES / "train.png", dpi=70)


def draw(episode: Episode, ax: Axes) -> None:
    """One episode: its office, the start as an arrow, the true route and the command."""
    route = Route(episode.start, np.array(episode.route))
    draw_routes(episode.plan(), [(route, episode.command)], ax, names=False)
    ax.set_title("\n".join(textwrap.wrap(episode.command, 60)), fontsize=13)
    ax.set_axis_off()
