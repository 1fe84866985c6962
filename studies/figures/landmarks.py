"""Draw docs/images/landmarks.png: landmarks of table II fused, and drift on a real log.

It reads the log freiburg-079 in ../shared/data, beside the checkout.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse

from semnav_features import CornerKind
from semnav_features.mapping import LandmarkMap, LandmarkSettings
from studies.figures import IMAGES
from studies.landmarks.drift import CORRECTIONS, drive_of_log, followed, motions
from studies.landmarks.room import POSES, room, views

LOG = Path("../shared/data/carmen/freiburg-079-corrected.log.gz")
SCANS = 1200
"""Scans of the log that are drawn."""

ELLIPSE = 10.0
"""Ellipses are drawn with so many standard deviations; true to scale they would be dots."""

COLOURS = {CornerKind.OUTER: "C3", CornerKind.INNER: "C0", CornerKind.POTENTIAL: "C2"}


def draw_room(axes: Axes) -> None:
    """The three scans of the corridor, and its landmarks with ten times their deviations."""
    exact = LandmarkSettings(position=0.0, angle=0.0, sightings=1)
    landmarks = LandmarkMap(exact)
    for scene, scan, pose in views(0.02, 4):
        landmarks.add(scene, scan, pose)
        for wall in scene.placed(pose).walls:
            axes.plot(*zip(wall.start, wall.end, strict=True), color="0.7", linewidth=3.0)
    for surface in room().surfaces:
        axes.plot(*zip(*surface.points, strict=True), color="black", linewidth=0.6)
    for corner in landmarks.corners:
        values, vectors = np.linalg.eigh(corner.covariance)
        angle = np.degrees(np.arctan2(vectors[1, 1], vectors[0, 1]))
        width, height = 2.0 * ELLIPSE * np.sqrt(values[::-1])
        colour = COLOURS[corner.kind]
        axes.add_patch(Ellipse(corner.point, width, height, angle=angle, fill=False, color=colour))
        axes.plot(*corner.point, ".", color=colour)
    for kind, colour in COLOURS.items():
        axes.plot([], [], ".", color=colour, label=kind.name.lower())
    axes.plot(*zip(*[pose[:2] for pose in POSES], strict=True), "k^", label="scans")
    axes.set_title("corners of three scans, ellipses of 10 deviations")
    axes.set(xlim=(-2.2, 3.0), ylim=(0.8, 7.6))
    axes.set(aspect="equal", xlabel="x, m", ylabel="y, m")
    axes.legend(loc="upper right")


def draw_drift(axes: Axes) -> None:
    """Paths on a real log with simulated errors of the wheels, with each correction."""
    drive = drive_of_log(LOG)
    part = type(drive)(drive.name, drive.scans[:SCANS], drive.poses[:SCANS])
    axes.plot(
        *np.array(part.poses)[:, :2].T, color="black", linewidth=1.5, label="poses of the log"
    )
    for name, landmarks in CORRECTIONS.items():
        found = np.array(followed(part, motions(part, 0), landmarks))
        axes.plot(*found[:, :2].T, linewidth=0.9, label=f"corrected by {name}")
    axes.set_title("freiburg-079 with the errors of a wheelchair's odometry")
    axes.set(aspect="equal", xlabel="x, m", ylabel="y, m")
    axes.legend()


def main() -> None:
    """Draw landmarks.png: corners of three scans, and a real log with its drift corrected."""
    figure = Figure(figsize=(15, 7), layout="constrained")
    FigureCanvasAgg(figure)
    left, right = figure.subplots(1, 2, width_ratios=(1, 2))
    draw_room(left)
    draw_drift(right)
    figure.savefig(IMAGES / "landmarks.png", dpi=60)
