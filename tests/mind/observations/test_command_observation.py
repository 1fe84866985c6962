"""What a policy gets that hears the command itself."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.spaces import MultiDiscrete, Text

from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import load_episodes
from semnav_env.language import decode, parse
from semnav_env.mind.observations import (
    MEMORY_TABLES,
    MODES,
    TABLES,
    EntryObservation,
    InstructionEntry,
    read_odometry,
    table,
)
from semnav_features.corridor import corridor_at
from semnav_features.frames import points_to_local, to_local
from tests.support.episodes import START, actions, fresh, rollout

OFFICE = {"floor_plan": "office_cross", "command": "take the first door on the right"}
ROOM = {
    "floor_plan": "office_cross",
    "command": "go down the hallway for 1 metre and then go to room west north 1",
    "pose": (1.5, 9.1, 0.0),
}


def driven(options: dict[str, Any], steps: int = 60) -> tuple[SemNavEnv, dict[str, np.ndarray]]:
    env = SemNavEnv(observation="command", max_seconds=300.0)
    observation, _ = env.reset(seed=5, options=options)
    for action in actions(steps, 2, seed=2):
        observation, _, terminated, _, _ = env.step(action * np.float32(0.5))
        assert not terminated
    return env, observation


def test_nothing_of_the_grounding_is_observed() -> None:
    """Two robots at one place that were told different things observe the same, but for words."""
    seen = []
    for command in ("take the third door on the right", "turn left at the intersection"):
        env = fresh("command", command=command, pose=START["pose"])
        for action in actions(40, 2):
            observation, *_ = env.step(action * np.float32(0.4))
        seen.append(observation)
    assert not {"goal", "clause"} & set(MODES["command"])
    for name in MODES["command"]:
        same = np.array_equal(seen[0][name], seen[1][name])
        assert same == (name != "command"), name


def test_a_completed_clause_changes_nothing_that_is_observed() -> None:
    """The moment at which the grounding goes on to the next clause is not to be seen."""
    whole, part = "go down the hallway for 1 metre and then stop", "stop for 90 seconds"
    rows = []
    for command in (whole, part):
        env = fresh("command", command=command, pose=START["pose"])
        clauses = {env.belief.clause}
        row = []
        for _ in range(45):
            observation, *_ = env.step(np.array([0.5, 0.0]))
            clauses.add(env.belief.clause)
            row.append({k: v for k, v in observation.items() if k != "command"})
        rows.append((clauses, row))
    assert len(rows[0][0]) > len(rows[1][0])
    for first, second in zip(rows[0][1], rows[1][1], strict=True):
        for name, value in first.items():
            np.testing.assert_array_equal(value, second[name], err_msg=name)


def test_remembered_walls_and_doors_are_those_that_count_nearest_first() -> None:
    env, observation = driven(OFFICE | {"pose": (1.5, 9.1, 0.0)})
    scene, pose = env.tracker.memory.scene(), env.belief.pose
    for name, items in (("remembered_walls", scene.walls), ("remembered_doors", scene.doors)):
        rows = table(observation, name)
        ends = [[item.start, item.end] for item in items]
        expected = points_to_local(pose, np.array(ends)).reshape(-1, 4)
        assert len(rows) == len(expected) > 2
        order = np.lexsort(np.round(expected, 3).T)
        np.testing.assert_allclose(
            rows[np.lexsort(np.round(rows.astype(float), 3).T)], expected[order], atol=2e-3
        )
    doors = table(observation, "remembered_doors")
    apart = np.hypot(*((doors[:, :2] + doors[:, 2:]) / 2).T)
    assert (np.diff(apart) >= -1e-4).all()
    walls = table(observation, "remembered_walls").reshape(-1, 2, 2)
    ways = walls[:, :1] + np.linspace(0, 1, 200)[None, :, None] * np.diff(walls, axis=1)
    assert (np.diff(np.hypot(*np.moveaxis(ways, -1, 0)).min(axis=1)) >= -0.05).all()


def test_the_hallway_and_its_junctions_are_those_of_the_corridor() -> None:
    third = {"command": "go through the third door on the right", "pose": START["pose"]}
    env, observation = driven(third, 90)
    pose = env.belief.pose
    corridor = corridor_at(env.belief.scene, pose)
    x, y, cosine, sine, half_width, end, ends = observation["hallway"].tolist()
    assert (x, y) == pytest.approx(to_local(pose, corridor.frame[:2]), abs=1e-4)
    assert math.atan2(sine, cosine) == pytest.approx(corridor.frame[2] - pose[2], abs=1e-4)
    assert half_width == pytest.approx(corridor.half_width, abs=1e-4)
    assert (end if ends else math.inf) == pytest.approx(corridor.end, abs=1e-4)
    mouths = [
        (opening, junction) for junction in corridor.junctions for opening in junction.openings
    ]
    rows = table(observation, "junctions")
    assert len(rows) == len(mouths) > 0
    for opening, _ in mouths:
        offset = opening.offset if opening.left else -opening.offset
        edges = [corridor.place(along, offset)[:2] for along in (opening.near, opening.far)]
        wanted = [
            *np.ravel([to_local(pose, edge) for edge in edges]),
            1.0 if opening.left else -1.0,
        ]
        assert np.abs(rows[:, :5] - wanted).max(axis=1).min() < 1e-3


def test_the_told_way_to_a_room_is_an_entry_of_its_own() -> None:
    env, observation = driven(ROOM, 20)
    [(clause, way)] = env.judge.mission.ways_seen_from(ROOM["pose"]).items()
    rows, pose = table(observation, "told_ways"), env.belief.pose
    assert set(rows[:, 0]) == {float(clause)} == {1.0}
    np.testing.assert_allclose(rows[:, 1:], points_to_local(pose, np.array(way.places)), atol=1e-3)
    [door] = table(observation, "told_doors")
    assert way.door is not None
    assert door[0] == 1.0
    jambs = points_to_local(pose, np.array([way.door.start, way.door.end])).ravel()
    np.testing.assert_allclose(door[1:], jambs, atol=1e-3)
    observation, _ = env.reset(seed=1, options=START)
    assert not observation["told_ways_mask"].any()
    assert not observation["told_ways"].any()


def test_the_start_is_odometry_the_other_way_round() -> None:
    _, observation = driven(OFFICE | {"pose": (1.5, 9.1, 0.0)})
    pose, _ = read_odometry(observation)
    x, y, cosine, sine = observation["start"].tolist()
    assert (x, y) == pytest.approx(to_local(pose, (0.0, 0.0)), abs=1e-4)
    assert math.atan2(sine, cosine) == pytest.approx(-pose[2], abs=1e-4)


def test_tokens_are_multidiscrete_in_every_mode() -> None:
    for mode in MODES:
        env = SemNavEnv(observation=mode)
        observation, _ = env.reset(seed=0, options=START)
        space = env.observation_space["command"]
        assert isinstance(space, MultiDiscrete)
        assert space.contains(observation["command"])
        assert decode(observation["command"].reshape(8, 5)) == parse(START["command"])


def test_masked_rows_of_the_memory_are_zero() -> None:
    for observation in rollout(fresh("command"), actions(20, 2)):
        for entry in (*TABLES, *MEMORY_TABLES):
            mask = observation[f"{entry.name}_mask"]
            rows = observation[entry.name].reshape(-1, len(entry.columns))
            assert not rows[mask == 0].any()


def test_random_episodes_stay_in_the_space_of_the_command_mode() -> None:
    for robot, size in (("wheelchair", 2), ("spot", 3)):
        env = SemNavEnv(robot, observation="command", episodes="val_unseen", max_seconds=4.0)
        env.reset(seed=3)
        for observation in rollout(env, actions(240, size)):
            assert env.observation_space.contains(observation)


@pytest.mark.parametrize("threads", [1, 2])
def test_a_vector_observes_the_command_mode_bit_for_bit(threads: int) -> None:
    options = {"observation": "command", "episodes": "test_real", "max_seconds": 3.0}
    envs = gym.make_vec(
        "semnav_env:SemNav-v0",
        num_envs=4,
        vectorization_mode="vector_entry_point",
        threads=threads,
        **options,
    )
    singles = [SemNavEnv(**options) for _ in range(4)]  # type: ignore[arg-type]
    observations, _ = envs.reset(seed=7)
    alone = [env.reset(seed=7 + k)[0] for k, env in enumerate(singles)]
    for action in actions(40, 2):
        for k, each in enumerate(alone):
            for name, value in each.items():
                np.testing.assert_array_equal(observations[name][k], value, err_msg=name)
        observations, *_ = envs.step(np.tile(action, (4, 1)))
        alone = [env.step(action)[0] for env in singles]
    assert envs.observation_space.contains(observations)
    envs.close()


def test_info_says_the_words_as_they_were_said() -> None:
    env = SemNavEnv()
    said = {"command": "fahr durch die zweite Tür rechts", "language": "de"}
    _, info = env.reset(seed=0, options=START | said)
    assert info["instruction"] == said["command"]
    assert info["command"] == START["command"]
    _, info = env.reset(seed=0, options=START | {"command": parse(START["command"])})
    assert info["instruction"] == START["command"]
    _, info = env.reset(seed=0)
    assert info["instruction"] == info["command"]
    german = next(e for e in load_episodes("test_real") if e.language == "de")
    for episode in (german, replace(german, programs=(), token_rows=())):
        _, info = env.reset(options={"episode": episode})
        assert info["instruction"] == german.command


def test_the_words_can_be_an_entry_of_text() -> None:
    observation = EntryObservation("command", [InstructionEntry(max_length=40)])
    env = SemNavEnv(observation=observation)
    said = {"command": "fahr durch die zweite Tür rechts", "language": "de"}
    seen, _ = env.reset(seed=0, options=START | said)
    assert seen["instruction"] == said["command"]
    assert isinstance(env.observation_space["instruction"], Text)
    assert env.observation_space.contains(seen)
    long = "please, please, please, please, please, " + START["command"]
    seen, _ = env.reset(seed=0, options=START | {"command": long})
    assert seen["instruction"] == long[:40]
    assert env.observation_space.contains(seen)
    envs = gym.make_vec(
        "semnav_env:SemNav-v0",
        num_envs=2,
        vectorization_mode="vector_entry_point",
        observation=observation,
        task=START["command"],
    )
    seen, infos = envs.reset(seed=0)
    assert tuple(seen["instruction"]) == (START["command"],) * 2
    assert tuple(infos["instruction"]) == (START["command"],) * 2
    envs.close()
