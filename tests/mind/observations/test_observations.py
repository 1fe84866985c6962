"""Entries of the observation say what they are said to say."""

from __future__ import annotations

import math

import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.language import decode
from semnav_env.mind.grounding import GoalKind
from semnav_env.mind.observations import MODES, TABLES, SeenGoal, table
from semnav_features.extraction import to_scene
from tests.support.episodes import START, actions, fresh, rollout


def test_every_mode_has_the_entries_it_is_said_to_have() -> None:
    for mode, names in MODES.items():
        assert set(fresh(mode).reset(seed=1)[0]) == set(names)


def test_tables_hold_the_features_of_the_scan_in_the_robot_frame() -> None:
    env = fresh("semantic")
    observation = list(rollout(env, actions(12, 2)))[-1]
    scene = to_scene(env.tracker.features).placed(env.robot.lidar_mount)
    walls = [(*wall.start, *wall.end) for wall in scene.walls]
    assert len(walls) > 3
    assert table(observation, "walls") == pytest.approx(np.array(walls), abs=1e-4)
    corners = [(*corner.point, corner.kind) for corner in scene.corners]
    assert table(observation, "corners") == pytest.approx(np.array(corners), abs=1e-4)


def test_features_that_are_not_observed_are_found_when_asked_for() -> None:
    """Corners and corridors as well, which stand in no belief."""
    scenes = []
    for mode in ("semantic", "raw"):
        env = fresh(mode)
        list(rollout(env, actions(12, 2)))
        scenes.append(to_scene(env.tracker.features))
    assert scenes[0] == scenes[1]
    assert len(scenes[1].corners) > 1


def test_an_unknown_table_is_an_error_that_lists_the_known_ones() -> None:
    with pytest.raises(ValueError, match="walls, doors, corners"):
        table(fresh("semantic").reset(seed=0)[0], "windows")


def test_masks_are_zero_or_one_and_what_they_leave_out_is_zero() -> None:
    env = fresh("semantic")
    for observation in rollout(env, actions(5, 2)):
        for entry in TABLES:
            mask = observation[f"{entry.name}_mask"]
            assert set(np.unique(mask)) <= {0.0, 1.0}
            rows = observation[entry.name].reshape(-1, len(entry.columns))
            assert not rows[mask == 0].any()


def test_the_tokens_are_those_of_the_command() -> None:
    env = fresh("semantic")
    observation, _ = env.reset(seed=0, options=START)
    assert decode(observation["command"].reshape(8, 5)) == env.judge.mission.command


def test_the_seen_goal_leads_to_the_true_door() -> None:
    env = fresh("semantic")
    observation = list(rollout(env, actions(12, 2)))[-1]
    goal = SeenGoal.read(observation["goal"])
    assert goal.kind is GoalKind.PASS
    assert goal.door is not None
    x, y, heading = env.world.pose
    c, s = math.cos(heading), math.sin(heading)
    (ax, ay), (bx, by) = goal.door
    mx, my = (ax + bx) / 2, (ay + by) / 2
    seen = (x + c * mx - s * my, y + s * mx + c * my)
    assert seen == pytest.approx(env.floor_plan.door("south_2").midpoint, abs=0.25)


def test_the_truth_has_neither_drift_nor_noise() -> None:
    env = fresh("truth")
    for _ in range(30):
        observation, *_ = env.step(np.array([0.4, 0.05]))
    x, y, cosine, sine = observation["odometry"][:4]
    heading = math.atan2(sine, cosine)
    assert (x, y, heading) == pytest.approx(env.world.pose, abs=1e-5)
    goal = SeenGoal.read(observation["goal"])
    assert goal.kind is GoalKind.PASS


def test_a_beam_without_a_return_reads_as_the_range() -> None:
    env = SemNavEnv(floor_plan="office_cross", observation="raw")
    options = {"command": "go to the end of the hallway", "pose": (1.5, 9.1, 0.0)}
    observation, _ = env.reset(seed=0, options=options)
    assert observation["scan"].max() == env.lidar_spec.range_max
    assert observation["scan"].min() > 0.0
