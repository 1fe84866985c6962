"""Draw docs/images/listener.png: how the bundled agent that hears the command was trained."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from semnav_env.agents.hearing.agent import BUNDLED_FOLDER
from semnav_env.agents.hearing.card import ModelCard
from studies.figures import IMAGES

MEASURES = {
    "place": "place within 0.5 m",
    "kind": "kind of goal",
    "advance": "clause over, and seen so",
    "stay": "clause not over, and seen so",
}


def draw_learning(ax: Axes, epochs: list[dict[str, Any]]) -> None:
    """Shares of the samples held out that are right, over epochs."""
    for name, label in MEASURES.items():
        ax.plot(range(1, len(epochs) + 1), [row[name] for row in epochs], "o-", label=label)
    begin = sum(row["round"] == 0 for row in epochs)
    ax.axvline(begin + 0.5, color="black", linewidth=0.8, linestyle="--")
    ax.text(begin + 0.6, 0.03, "DAgger", transform=ax.get_xaxis_transform())
    ax.set(xlabel="epoch", ylabel="share of samples held out that are right", ylim=(0.0, 1.02))
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    ax.grid(alpha=0.3)
    ax.legend(fontsize=8, loc="center right")


def draw_driving(ax: Axes, chunks: list[dict[str, Any]]) -> None:
    """Success while collecting, over chunks of episodes."""
    for number, label in ((0, "scripted agent, round 0"), (1, "learner of round 0, in round 1")):
        points = [(k, row["success"]) for k, row in enumerate(chunks, 1) if row["round"] == number]
        ax.plot(*zip(*points, strict=True), "o-", label=label)
    ax.set(xlabel="chunk of 50 episodes of train", ylabel="success", ylim=(0.0, 1.02))
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    ax.grid(alpha=0.3)
    ax.legend(fontsize=8, loc="lower left")


def main() -> None:
    """Draw what the card of the bundled agent tells."""
    curve = ModelCard.read(BUNDLED_FOLDER / "listener").curve
    figure = Figure(figsize=(9.5, 3.4), layout="constrained")
    left, right = figure.subplots(1, 2)
    draw_learning(left, [row for row in curve if "epoch" in row])
    draw_driving(right, [row for row in curve if "chunk" in row])
    path = IMAGES / "listener.png"
    FigureCanvasAgg(figure).print_png(path)
    print(f"wrote {path}")
