"""Draw docs/images/lines.png: one simulated scan as lines, by several extractors."""

import numpy as np
from matplotlib.figure import Figure

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import load_floor_plan
from semnav_features import polylines
from studies.features.clutter import cluttered
from studies.figures import IMAGES
from studies.lines.line_baselines import end_point_fit, greedy_polylines, walls

VERTICES = 20
POSE = (8.5, 9.1, 0.0)


def main() -> None:
    """Draw lines.png: one simulated scan as lines, by several extractors."""
    rng = np.random.default_rng(4)
    scan = Lidar(cluttered(load_floor_plan("office_cross"), rng)).scan(POSE, key=(0, 0, 0))
    panels = {
        f"end-point fit, {VERTICES} vertices": end_point_fit(scan, VERTICES),
        f"greedy (PLE), {VERTICES} vertices": greedy_polylines(scan, VERTICES),
        f"polylines, {VERTICES} vertices": polylines(scan, VERTICES),
        "extract: walls": walls(scan),
    }
    figure = Figure(figsize=(12, 6.2), layout="constrained")
    valid = scan.valid
    points = scan.ranges[valid] * np.array((np.cos(scan.angles), np.sin(scan.angles)))[:, valid]
    for axes, (title, lines) in zip(figure.subplots(2, 2).flat, panels.items(), strict=True):
        axes.plot(*points, ".", color="0.6", markersize=2)
        for line in lines:
            axes.plot(*line.T, "-", color="tab:blue", linewidth=1.8)
            axes.plot(*line.T, "o", color="tab:red", markersize=3)
        axes.plot(0, 0, "k>", markersize=8)
        axes.set(title=title, aspect="equal")
        axes.tick_params(labelsize=7)
    figure.savefig(IMAGES / "lines.png", dpi=110)
