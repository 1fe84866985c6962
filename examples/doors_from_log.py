"""Doors from a log of scans, without the simulator: what `semnav extract` does, in a few lines.

One sees each door of some scans, with its place, its width and how sure the extractor is. Give the
path of a log of your own (CARMEN, ROS 1 or 2, MCAP, CSV, npz); without one, a small log is made.

    python examples/doors_from_log.py robot.log.gz
"""

import sys
import tempfile
from itertools import islice
from pathlib import Path

import numpy as np

from semnav_features import ExtractorSettings, extract
from semnav_features.readers import open_log

EVERY = 20
"""Only each so many-th scan is shown."""


def made_log(folder: str) -> Path:
    """A log as an npz archive: a robot that rolls down a hallway for six seconds."""
    from semnav_env.world.maps import load_floor_plan
    from semnav_env.world.simulator import Simulator

    simulator, ranges, poses = Simulator(load_floor_plan("heidelberg_hallway")), [], []
    sensed = simulator.reset((-2.5, -0.6, 0.25), np.random.default_rng(0))
    for _ in range(90):
        ranges.append(sensed.ranges.copy())
        poses.append(sensed.odometry)
        sensed = simulator.step((0.6, 0.0, 0.0))
    lidar, path = simulator.lidar.spec, Path(folder, "hallway.npz")
    angles = {"angle_min": lidar.angle_min, "angle_increment": lidar.angle_increment}
    np.savez(path, ranges=ranges, poses=poses, range_max=lidar.range_max, **angles)
    return path


def main(path: str | None = None) -> None:
    """Read a log and extract the doors of some of its scans."""
    settings = ExtractorSettings(door_width_max=1.3)
    with tempfile.TemporaryDirectory() as folder, open_log(path or made_log(folder)) as log:
        for record in islice(log, 0, None, EVERY):
            scene = extract(record.scan, settings)
            print(f"scan {record.line}: {len(scene.walls)} walls")
            for door in scene.doors:
                x, y = door.midpoint
                print(f"  door at ({x:.2f}, {y:.2f}) m from the lidar,", end=" ")
                print(f"{door.width:.2f} m wide, confidence {door.confidence:.2f}")


if __name__ == "__main__":
    main(*sys.argv[1:2])
