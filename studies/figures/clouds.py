"""Draw docs/images/clouds.png and clouds_rigs.png: door jambs in point clouds, after Mes 2021."""

from __future__ import annotations

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.robots import DepthRig
from semnav_features.clouds.picture import draw_above, draw_front
from studies.clouds import detectors
from studies.clouds.scenes import POSES, CloudScene, draw_scenes
from studies.figures import IMAGES

SCENES = {"A": 2, "B": 3, "C": 1, "D": 2}
"""Which scene of each category is drawn."""

SEED = 99
"""Of the scenes: they are among those that the detectors were tuned on."""

TITLES = {"A": "perpendicular", "B": "diagonal", "C": "diagonal, past it", "D": "parallel"}


def scene(category: str) -> CloudScene:
    *_, last = draw_scenes(category, SCENES[category] + 1, SEED)
    return last


def draw_categories() -> None:
    """A column for each category: from above, her pipeline, and the better detector."""
    figure = Figure(figsize=(13.0, 7.6), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(3, len(POSES), height_ratios=(2.0, 1.1, 1.1))
    for k, category in enumerate(POSES):
        shown = scene(category)
        view = detectors.spot(shown)
        hers = detectors.by_hand()(shown, view)
        ours = detectors.finder(shown, view)
        draw_above(axes[0, k], view.cloud, ours)
        draw_front(axes[1, k], view.cloud, shown.truth, hers)
        draw_front(axes[2, k], view.cloud, shown.expected, ours)
        axes[0, k].set_title(f"{category}, {TITLES[category]}: the {shown.door.name} door")
        axes[1, k].set_title("Mes 2021, crop by hand", fontsize=9)
        axes[2, k].set_title("DoorFinder", fontsize=9)
    figure.savefig(IMAGES / "clouds.png", dpi=80)


def draw_rigs() -> None:
    """One door as the stereo pairs see it, and as a sensor of full height does."""
    shown = scene("A")
    figure = Figure(figsize=(9.0, 3.9), layout="constrained")
    FigureCanvasAgg(figure)
    rigs = {"SPOT's stereo pairs": DepthRig.spot(), "full height": DepthRig.full_height()}
    for ax, (title, rig) in zip(figure.subplots(1, 2), rigs.items(), strict=True):
        draw_front(ax, shown.look(rig).cloud, shown.truth, None)
        ax.set_title(title, fontsize=10)
    figure.savefig(IMAGES / "clouds_rigs.png", dpi=80)


def main() -> None:
    """Draw clouds.png and clouds_rigs.png: door jambs in point clouds."""
    draw_categories()
    draw_rigs()
