"""Other simulators, where they are installed: the same lidar among the same walls."""

from __future__ import annotations

import json
import tempfile
from importlib.util import find_spec
from itertools import cycle
from pathlib import Path
from typing import Any

import numpy as np

from semnav_env.bench.timing import Part, seconds_per_call
from semnav_env.features.frames import Pose
from semnav_env.features.lidar_spec import LidarSpec
from semnav_env.maps import FloorPlan
from semnav_env.robots import RobotSpec

PEER_STEPS = 20
"""Steps timed in a run: a peer's takes as long as many of ours."""


def peer_parts(plan: FloorPlan, robot: RobotSpec, lidar: LidarSpec, start: Pose) -> list[Part]:
    """The step of each peer that is installed: its physics and its lidar, without features.

    Args:
        plan: whose walls stand there.
        robot: the body; a differential drive is assumed.
        lidar: beams, span and range; peers do without its errors.
        start: pose of the robot, world frame.
    """
    return [_ir_sim(plan, robot, lidar, start)] if find_spec("irsim") else []


def _ir_sim(plan: FloorPlan, robot: RobotSpec, lidar: LidarSpec, start: Pose) -> Part:
    """A step of ir-sim."""
    import irsim  # pyright: ignore[reportMissingImports]

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "world.yaml")
        path.write_text(json.dumps(_ir_sim_world(plan, robot, lidar, start)))  # JSON is YAML
        env = irsim.make(str(path), display=False, log_level="ERROR")
    twists = cycle([np.array([[0.3], [0.2]])] * 5 + [np.array([[-0.3], [-0.2]])] * 5)
    return Part(
        f"step of ir-sim {irsim.__version__}, lidar alone",
        lambda: seconds_per_call(lambda: env.step(next(twists)), PEER_STEPS),
    )


def _ir_sim_world(
    plan: FloorPlan, robot: RobotSpec, lidar: LidarSpec, start: Pose
) -> dict[str, Any]:
    west, south, east, north = plan.boundary.bounds
    period = 1.0 / lidar.rate_hz
    sensor = {
        "name": "lidar2d",
        "range_min": lidar.range_min,
        "range_max": lidar.range_max,
        "angle_range": lidar.angle_increment * (lidar.beams - 1),
        "number": lidar.beams,
    }
    body = {"name": "rectangle", "length": robot.length, "width": robot.width}
    walls = [
        {"shape": {"name": "linestring", "vertices": ends}}
        for ends in plan.opaque_segments.reshape(-1, 2, 2).tolist()
    ]
    world = {"width": east - west, "height": north - south, "offset": [west, south]}
    return {
        "world": world | {"step_time": period, "sample_time": period},
        "robot": [
            {"kinematics": {"name": "diff"}, "shape": body, "state": start, "sensors": [sensor]}
        ],
        "obstacle": walls,
    }
