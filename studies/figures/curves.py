"""Draw docs/images/curves.png: how the agents of the package learn, a line for each seed."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from semnav_agents.hearing.network import NetworkShape
from semnav_agents.networks.bundled import BUNDLED_FOLDER
from semnav_env.networks.card import Card
from studies.figures import IMAGES

CURVES = IMAGES.parent / "results" / "curves"
"""Folder of the kept curves, PRESET-SEED.json: `cloning.json` of a trained `drive`, the card
of a trained `listener`."""

MEASURES = {
    "place": ("C0", "place within 0.5 m"),
    "advance": ("C1", "clause over, and seen so"),
    "stay": ("C2", "clause not over, and seen so"),
}

BUNDLED = "bundled"
"""Name of the bundled training of `listener`, whose lines are thick; others have thin ones."""

WHO_COLLECTS = (
    ("C0", "scripted agent, round 0"),
    ("C1", "learner, round 1"),
    ("C2", "learner and scripted agent, round 2"),
    ("C3", "learner and scripted agent, round 3"),
)


def kept(preset: str) -> dict[int, Any]:
    """The kept curves of a preset, by seed."""
    files = {_seed(path): path for path in CURVES.glob(f"{preset}-*.json")}
    return {seed: json.loads(files[seed].read_text(encoding="utf-8")) for seed in sorted(files)}


def _seed(path: Path) -> int:
    found = re.search(r"-(\d+)$", path.stem)
    if found is None:
        raise ValueError(f"{path}: a curve is named PRESET-SEED.json")
    return int(found[1])


def draw_cloning(ax: Axes) -> None:
    """The loss of `drive` on what it imitates, over passes."""
    for seed, losses in kept("drive").items():
        ax.plot(range(1, len(losses) + 1), losses, label=f"seed {seed}")
    ax.set(xlabel="pass over the demonstrations", ylabel="loss", title="drive, what it imitates")
    ax.set_ylim(bottom=0.0)
    ax.legend(fontsize=8)


def listeners() -> dict[str, list[dict[str, Any]]]:
    """The curves of `listener`: of the bundled training, and by seed."""
    found = {BUNDLED: Card.read(BUNDLED_FOLDER / "listener", NetworkShape).curve}
    return found | {f"seed {seed}": card["curve"] for seed, card in kept("listener").items()}


def draw_listening(ax: Axes) -> None:
    """Shares of the samples held out of which `listener` says what is right, over epochs."""
    begin = 0
    for name, curve in listeners().items():
        epochs = [row for row in curve if "epoch" in row]
        for measure, (colour, label) in MEASURES.items():
            points = [(k, row[measure]) for k, row in enumerate(epochs, 1)]
            _draw_training(ax, name, points, colour, label)
        begin = sum(row["round"] == 0 for row in epochs)
    ax.axvline(begin + 0.5, color="black", linewidth=0.8, linestyle=":")
    ax.text(begin + 0.7, 0.3, "DAgger", transform=ax.get_xaxis_transform())
    ax.set(xlabel="epoch", ylabel="share that is right", title="listener, samples held out")
    ax.set_ylim(0.0, 1.08)
    ax.legend(fontsize=8, loc="lower center")


def draw_driving(ax: Axes) -> None:
    """Success of `listener` while it collects, over chunks of episodes."""
    for name, curve in listeners().items():
        chunks = list(enumerate((row for row in curve if "chunk" in row), 1))
        for number, (colour, label) in enumerate(WHO_COLLECTS):
            points = [(k, row["success"]) for k, row in chunks if row["round"] == number]
            _draw_training(ax, name, points, colour, label)
    ax.set(
        xlabel="chunk of 25 or 50 episodes of train",
        ylabel="success",
        title="listener, who collects",
    )
    ax.set_ylim(0.0, 1.02)
    ax.legend(fontsize=8, loc="lower left")


def _draw_training(
    ax: Axes, name: str, points: list[tuple[int, float]], colour: str, label: str
) -> None:
    """Draw one curve of one training; the bundled one alone stands in the legend."""
    if not points:  # other trainings had fewer rounds
        return
    width, shown = (2.0, label) if name == BUNDLED else (0.7, None)
    ax.plot(*zip(*points, strict=True), ".-", color=colour, linewidth=width, label=shown)


def main() -> None:
    """Draw what the kept curves tell."""
    figure = Figure(figsize=(12.0, 3.8), layout="constrained")
    axes = figure.subplots(1, 3)
    for ax, draw in zip(axes, (draw_cloning, draw_listening, draw_driving), strict=True):
        draw(ax)
        ax.xaxis.set_major_locator(MaxNLocator(integer=True))
        ax.grid(alpha=0.3)
    path = IMAGES / "curves.png"
    FigureCanvasAgg(figure).print_png(path)
    print(f"wrote {path}")
