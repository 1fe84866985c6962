"""Drift that is taken out of odometry by walls that are seen again."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan, Surface, load_floor_plan
from semnav_env.world.maps.importers.imported import boundary_of
from semnav_env.world.simulator.odometry import OdometrySettings
from semnav_features import extract
from semnav_features.frames import FloatArray, Pose, compose, relative, to_parent
from semnav_features.kernels.drift import (
    MAX_LANDMARK_OFFSET,
    MIN_LANDMARK_SIGHTINGS,
)
from semnav_features.kernels.lanes import WIDTH
from semnav_features.kernels.remembered import WALL_ROWS
from semnav_features.kernels.scene_drift import without_drift
from semnav_features.memory import SceneMemory

ROOM = np.array([(4, 3, -4, 3), (-4, 3, -4, -3), (-4, -3, 4, -3), (4, -3, 4, 3)], dtype=float)
CORRIDOR = ROOM[[0, 2]]
HERE: Pose = (0.5, -0.4, 0.3)

small = st.tuples(st.floats(-0.08, 0.08), st.floats(-0.08, 0.08), st.floats(-0.03, 0.03))


def known(
    walls: FloatArray, hits: int = MIN_LANDMARK_SIGHTINGS, variance: float = 0.0
) -> FloatArray:
    """What is remembered after these walls were seen that often, shape (`WALL_ROWS`, n)."""
    return np.vstack((walls.T, np.full(len(walls), hits), np.full(len(walls), variance)))


def corrected(walls: FloatArray, memory: FloatArray, pose: Pose) -> Pose:
    """The pose that a memory corrects; whatever stands in its free room."""
    room = np.full((WALL_ROWS, -memory.shape[1] % WIDTH), np.nan)
    return without_drift(walls, np.hstack((memory, room)), memory.shape[1], pose)


def placed(walls: FloatArray, true: Pose, believed: Pose) -> FloatArray:
    """Walls seen from a true pose, put where a robot that believes in another pose puts them."""
    motion = compose(believed, relative(true, (0.0, 0.0, 0.0)))
    ends = [(*to_parent(motion, wall[:2]), *to_parent(motion, wall[2:])) for wall in walls.tolist()]
    return np.array(ends)


def settled(walls: FloatArray, believed: Pose, scans: int = 200) -> Pose:
    """What is believed after that many scans from `HERE`."""
    for _ in range(scans):
        believed = corrected(placed(walls, HERE, believed), known(walls), believed)
    return believed


@given(small)
def test_in_a_room_the_pose_settles_where_the_scan_was_taken(error: Pose) -> None:
    x, y, heading = settled(ROOM, compose(HERE, error))
    assert math.dist((x, y), HERE[:2]) < 1e-3
    assert heading == pytest.approx(HERE[2], abs=1e-3)


@given(small)
def test_a_bare_corridor_corrects_all_but_the_place_along_it(error: Pose) -> None:
    """Its walls tell the heading and the place across."""
    believed = HERE[0] + error[0], HERE[1] + error[1], HERE[2] + error[2]
    _, y, heading = settled(CORRIDOR, believed)
    assert (y, heading) == pytest.approx(HERE[1:], abs=1e-3)
    turned = HERE[0] + error[0], HERE[1], HERE[2]
    assert settled(CORRIDOR, turned)[0] == pytest.approx(turned[0], abs=1e-9)


@given(small)
def test_one_scan_corrects_a_part_and_never_more_than_the_whole(error: Pose) -> None:
    believed = HERE[0], HERE[1] + error[1], HERE[2]
    seen = placed(CORRIDOR, HERE, believed)
    _, y, _ = corrected(seen, known(CORRIDOR), believed)
    assert abs(y - HERE[1]) <= abs(error[1])
    assert (y - HERE[1]) * error[1] >= -1e-12


@given(st.floats(0.01, 0.08), st.floats(0.005, 0.1))
def test_walls_whose_sightings_differ_correct_less(error: float, deviation: float) -> None:
    believed = HERE[0], HERE[1] + error, HERE[2]
    seen = placed(CORRIDOR, HERE, believed)
    straight, rough = (
        corrected(seen, known(CORRIDOR, variance=v), believed)[1] for v in (0, deviation**2)
    )
    assert HERE[1] < straight < rough < believed[1]


@pytest.mark.parametrize(
    "memory",
    [
        known(CORRIDOR[:0]),
        known(CORRIDOR, MIN_LANDMARK_SIGHTINGS - 1),
        known(CORRIDOR[:, (2, 3, 0, 1)]),
        known(np.add(CORRIDOR, (0.0, 2 * MAX_LANDMARK_OFFSET, 0.0, 2 * MAX_LANDMARK_OFFSET))),
        known(np.add(CORRIDOR, (20.0, 0.0, 20.0, 0.0))),
        known(CORRIDOR[:, (0, 1, 0, 1)]),
    ],
    ids=["none", "seldom seen", "facing away", "beside", "elsewhere", "without length"],
)
def test_walls_that_are_not_those_seen_do_not_move_the_robot(memory: FloatArray) -> None:
    assert corrected(CORRIDOR, memory, HERE) == HERE


def test_a_memory_locates_a_lidar_by_what_it_saw_before() -> None:
    memory, lidar = SceneMemory(), Lidar(load_floor_plan("office_cross"))
    start = (6.0, 9.1, 0.2)
    for step in range(MIN_LANDMARK_SIGHTINGS + 1):
        scan = lidar.scan(start, (0, 0, step))
        memory.see(extract(scan), scan, start)
    believed = compose(start, (0.05, -0.05, 0.02))
    for _ in range(60):
        believed = memory.locate(extract(scan), believed)
    assert believed == pytest.approx(start, abs=0.01)


def test_walls_do_not_turn_along_with_a_robot_that_turns_in_a_small_room() -> None:
    """With 2 % too much in its odometry, 52 degrees in a minute; the walls once turned by 24."""
    walls = Surface(((1.5, 1.2), (-1.5, 1.2), (-1.5, -1.2), (1.5, -1.2), (1.5, 1.2)))
    plan = FloorPlan("room", (walls,), (), (), (), (), boundary_of((walls,)))
    memory, lidar, believed = SceneMemory(), Lidar(plan), (0.0, 0.0, 0.0)
    for step in range(900):
        scan = lidar.scan((0.0, 0.0, 0.05 * step), (0, 0, step))
        scene = extract(scan)
        believed = memory.locate(scene, believed)
        memory.see(scene, scan, believed)
        off = math.remainder(believed[2] - 0.05 * step, math.tau)
        assert abs(off) < math.radians(3.0)
        believed = compose(believed, (0.0, 0.0, 0.051))


def test_corrected_odometry_is_nearer_to_the_truth() -> None:
    """Along a way with three turns, with twice the usual drift."""
    errors = OdometrySettings(turn_bias=0.02, turn_noise=0.02, veer_noise=0.01)
    command = "turn left at the intersection, turn right at the corner and take the last door"
    start = (1.3, 9.1, 0.0)
    agent, off = make_agent("scripted"), []
    for seed in range(3):
        env = SemNavEnv(floor_plan="office_cross", observation="all", odometry=errors)
        begun = env.reset(seed=seed, options={"command": command, "pose": start})
        for _ in steps(env, agent, *begun):
            pass
        true = relative(start, env.world.pose)
        off.append([_apart(env.simulator.odometry.pose, true), _apart(env.belief.pose, true)])
    raw, corrected = np.mean(off, axis=0)
    assert (corrected < 0.3 * raw).all()


def _apart(pose: Pose, other: Pose) -> tuple[float, float]:
    return math.dist(pose[:2], other[:2]), abs(math.remainder(pose[2] - other[2], math.tau))


def test_uncorrected_odometry_is_left_as_it_is() -> None:
    env = SemNavEnv(corrects_drift=False)
    env.reset(seed=0)
    for _ in range(40):
        observation, *_ = env.step(env.action_space.high)
        assert env.belief.pose == env.simulator.odometry.pose
        assert observation["odometry"][:2] == pytest.approx(
            env.simulator.odometry.pose[:2], abs=1e-5
        )


def test_on_the_truth_the_robot_is_where_it_believes_to_be() -> None:
    env = SemNavEnv(observation="truth")
    env.reset(seed=0)
    for _ in range(40):
        env.step(env.action_space.high)
        assert env.belief.pose == env.world.pose
