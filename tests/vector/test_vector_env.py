"""Many robots in one environment: the bits of single environments, whatever the threads."""

import copy
import pickle

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode, SyncVectorEnv

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import AddedTerms, RewardWeights
from semnav_env.mind.observations import EntryObservation
from semnav_env.vector import SemNavVectorEnv
from semnav_env.world.dynamics import Dynamics

EACH = (
    {"floor_plan": "heidelberg_hallway"},
    {"floor_plan": "office_cross", "max_seconds": 3.0},
    {"floor_plan": "office_cross", "max_seconds": 4.0},
    {"floor_plan": "office:small:3", "max_seconds": 2.0},
    {"floor_plan": "heidelberg_hallway", "max_seconds": 5.0, "corrects_drift": False},
)
STEPS = 100


def actions(space, count=STEPS, seed=5):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        drawn = rng.uniform(-1.0, 1.0, space.shape).astype(np.float32)
        drawn[:, 0] = np.abs(drawn[:, 0])
        yield drawn


def assert_same(found, expected):
    if isinstance(expected, dict):
        assert set(found) == set(expected)
        for key, value in expected.items():
            assert_same(found[key], value)
    elif isinstance(expected, np.ndarray) and expected.dtype == object:
        for one, other in zip(found, expected, strict=True):
            if other is not None:  # else the mask, compared too, says that there is nothing
                assert_same(tuple(one) if isinstance(one, np.ndarray) else one, other)
    elif isinstance(expected, np.ndarray):
        np.testing.assert_array_equal(found, expected)
    else:
        assert found == expected


def assert_goes_on_like(found, expected, steps=STEPS):
    for action in actions(expected.action_space, steps):
        for one, other in zip(found.step(action), expected.step(action), strict=True):
            assert_same(one, other)


def singles(mode, wrapper=lambda env: env, **options):
    return SyncVectorEnv(
        [lambda each=each: wrapper(SemNavEnv(**options | each)) for each in EACH],
        autoreset_mode=mode,
    )


class Repeated(gym.Wrapper):
    """Holds an action for three steps, or until the episode ends."""

    def step(self, action):
        total, terms = 0.0, {}
        for _ in range(3):
            seen, reward, terminated, truncated, info = self.env.step(action)
            total += reward
            terms = {name: terms.get(name, 0.0) + x for name, x in info["reward_terms"].items()}
            if terminated or truncated:
                break
        return seen, total, terminated, truncated, info | {"reward_terms": terms}


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
@pytest.mark.parametrize("threads", [1, 2, 3])
def test_a_vector_gives_the_bits_of_single_environments(mode, threads):
    together = SemNavVectorEnv(len(EACH), each=EACH, threads=threads, autoreset_mode=mode)
    alone = singles(mode)
    for one, other in zip(together.reset(seed=3), alone.reset(seed=3), strict=True):
        assert_same(one, other)
    assert_goes_on_like(together, alone)


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
def test_a_repeated_action_gives_the_bits_of_repeated_steps(mode):
    """The limits of the episodes are such that they end in the middle of an action."""
    together = SemNavVectorEnv(len(EACH), each=EACH, threads=2, repeat=3, autoreset_mode=mode)
    alone = singles(mode, Repeated)
    for one, other in zip(together.reset(seed=3), alone.reset(seed=3), strict=True):
        assert_same(one, other)
    assert_goes_on_like(together, alone)


@pytest.mark.parametrize("observation", ["raw", "truth", "all"])
@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_every_observation_and_body_can_be_in_a_vector(observation, robot):
    options = {"observation": observation, "robot": robot}
    together = SemNavVectorEnv(len(EACH), each=EACH, **options)
    alone = singles(AutoresetMode.NEXT_STEP, **options)
    together.reset(seed=4), alone.reset(seed=4)
    assert_goes_on_like(together, alone, steps=40)


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_robots_in_a_vector_feel_what_they_touch(robot):
    """Each drives ahead and turns slowly, along walls and into what it does not see."""
    options = {"robot": robot, "floor_plan": "office_cross", "max_seconds": 100.0}
    together = SemNavVectorEnv(4, **options)
    alone = SyncVectorEnv([lambda: SemNavEnv(**options)] * 4)
    together.reset(seed=2), alone.reset(seed=2)
    ahead = np.zeros(together.action_space.shape, np.float32)
    ahead[:, 0], ahead[:, -1] = 1.0, 0.2
    touched, felt = 0, 0
    for _ in range(300):
        found, expected = together.step(ahead), alone.step(ahead)
        for one, other in zip(found, expected, strict=True):
            assert_same(one, other)
        touched += expected[4]["in_contact"].sum()
        felt += expected[0]["bumps_mask"].any(axis=1).sum()
    assert min(touched, felt) > 100


def test_a_copy_goes_on_like_the_original():
    original = SemNavVectorEnv(3, floor_plan="office_cross", max_seconds=2.0, threads=2)
    original.reset(seed=1)
    for action in actions(original.action_space, 20):
        original.step(action)
    for duplicate in (pickle.loads(pickle.dumps(original)), copy.deepcopy(original)):
        reference = copy.deepcopy(original)
        assert_goes_on_like(duplicate, reference, steps=30)


def test_gymnasium_makes_it_by_its_entry_point():
    envs = gym.make_vec("semnav_env:SemNav-v0", num_envs=2, vectorization_mode="vector_entry_point")
    assert isinstance(envs.unwrapped, SemNavVectorEnv)
    observations, infos = envs.reset(seed=0)
    assert observations in envs.observation_space
    assert infos["_pose"].all()
    envs.close()


def test_each_robot_can_be_told_its_own_command():
    envs = SemNavVectorEnv(2, floor_plan="heidelberg_hallway")
    commands = ["go through the second door on the right", "go through the first door on the right"]
    pose = (-2.5, -0.6, 0.25)
    _, infos = envs.reset(
        seed=0, options={"each": [{"command": text, "pose": pose} for text in commands]}
    )
    assert infos["command"].tolist() == commands


def test_only_those_of_the_mask_are_reset():
    envs = SemNavVectorEnv(3, floor_plan="office_cross", autoreset_mode=AutoresetMode.DISABLED)
    assert envs.autoreset_mode is AutoresetMode.DISABLED
    first, _ = envs.reset(seed=0)
    mask = np.array([True, False, True])
    again, infos = envs.reset(seed=9, options={"reset_mask": mask})
    np.testing.assert_array_equal(infos["_pose"], mask)
    np.testing.assert_array_equal(again["odometry"][1], first["odometry"][1])


class Speed:
    name = "speed"

    def space(self, robot, lidar):
        return gym.spaces.Box(-10.0, 10.0, (1,), np.float32)

    def observe(self, moment):
        return np.array([moment.belief.velocity[0]], np.float32)


def smoothness(tick):
    return -0.1 * abs(tick.motion.yaw_rate)


@pytest.mark.parametrize(
    "options",
    [
        {"rewards": AddedTerms({"smooth": smoothness})},
        {"rewards": RewardWeights(progress=3.0, contact=-2.0)},
        {"dynamics": Dynamics(pedestrians=2)},
        {"observation": EntryObservation("raw", [Speed()])},
    ],
)
def test_what_a_stranger_gives_works_in_a_vector(options):
    together = SemNavVectorEnv(2, floor_plan="office_cross", threads=2, **options)
    alone = SyncVectorEnv([lambda: SemNavEnv(floor_plan="office_cross", **options)] * 2)
    together.reset(seed=4), alone.reset(seed=4)
    assert_goes_on_like(together, alone, steps=40)


def test_the_path_of_pymunk_gives_the_same_bits(monkeypatch):
    fast = SemNavVectorEnv(2, floor_plan="office_cross")
    fast.reset(seed=4)
    monkeypatch.setattr("semnav_env.world.physics.world.chipmunk_can_be_called", lambda: False)
    slow = SemNavVectorEnv(2, floor_plan="office_cross")
    slow.reset(seed=4)
    assert_goes_on_like(fast, slow, steps=60)


class OnlySuccess:
    def terms(self, tick):
        return {"success": float(tick.success)}


@pytest.mark.parametrize("repeat", [1, 3])
def test_robots_with_other_rewards_have_other_terms(repeat):
    each = [{"rewards": OnlySuccess()}, {}]
    envs = SemNavVectorEnv(2, each=each, repeat=repeat)
    alone = SyncVectorEnv([lambda own=own: SemNavEnv(**own) for own in each])
    envs.reset(seed=0), alone.reset(seed=0)
    action = np.full((2, 2), 0.1, np.float32)
    terms = envs.step(action)[4]["reward_terms"]
    expected = alone.step(action)[4]["reward_terms"]
    assert set(terms) == set(expected)
    for name in (name for name in expected if name.startswith("_")):
        assert terms[name].tolist() == expected[name].tolist()
