"""Other simulators, where they are installed: the same lidar among the same walls."""

from __future__ import annotations

import json
import tempfile
from importlib.metadata import version
from importlib.util import find_spec
from itertools import cycle
from pathlib import Path
from typing import Any

import numpy as np

from semnav_env.bench.timing import Part, seconds_per_call
from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan
from semnav_features.frames import Pose
from semnav_features.lidar_spec import LidarSpec

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
    peers = {"irsim": _ir_sim, "navground": _navground}
    return [make(plan, robot, lidar, start) for name, make in peers.items() if find_spec(name)]


def _ir_sim(plan: FloorPlan, robot: RobotSpec, lidar: LidarSpec, start: Pose) -> Part:
    """A step of ir-sim."""
    import irsim

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


def _navground(plan: FloorPlan, robot: RobotSpec, lidar: LidarSpec, start: Pose) -> Part:
    """A step of navground: the body is a disc that turns in a small circle."""
    from navground import core, sim

    period, radius = 1.0 / lidar.rate_hz, robot.width / 2
    wheels = core.kinematics.TwoWheelsDifferentialDriveKinematics(1.0, robot.width)
    behavior = core.behaviors.DummyBehavior(kinematics=wheels, radius=radius)
    behavior.target = core.Target.Twist(core.Twist2((0.1, 0.0), 1.0, frame=core.Frame.relative))
    agent = sim.Agent(radius, behavior, wheels, control_period=period)
    agent.pose = core.Pose2(start[:2], start[2])
    world = sim.World()
    world.add_agent(agent)
    for x1, y1, x2, y2 in plan.opaque_segments.tolist():
        world.add_wall(sim.Wall((x1, y1), (x2, y2)))
    view = lidar.angle_increment * (lidar.beams - 1)
    sensor = sim.state_estimations.LidarStateEstimation(
        lidar.range_max, -view / 2, view, lidar.beams
    )
    sensed = core.SensingState()
    sensor.prepare_state(sensed)

    def step() -> None:
        world.update(period)
        sensor.update(agent, world, sensed)

    name = f"step of navground {version('navground')}, lidar alone"
    return Part(name, lambda: seconds_per_call(step, PEER_STEPS))
