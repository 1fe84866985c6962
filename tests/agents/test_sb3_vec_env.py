"""Many robots as stable-baselines3 takes them, and the environments of a preset."""

import subprocess
import sys
from dataclasses import replace

import gymnasium as gym
import numpy as np
import pytest

sb3 = pytest.importorskip("stable_baselines3", reason='needs the extra "rl"')

from stable_baselines3.common.evaluation import evaluate_policy  # noqa: E402
from stable_baselines3.common.vec_env import DummyVecEnv, VecEnv, VecMonitor  # noqa: E402

from semnav_agents.learning.compact import COMPACT_SIZE, CompactObserver  # noqa: E402
from semnav_agents.learning.preset_envs import dealt, preset_envs  # noqa: E402
from semnav_agents.learning.presets import PRESETS  # noqa: E402
from semnav_agents.learning.sb3_vec_env import as_sb3_vec_env  # noqa: E402
from semnav_env.env import SemNavEnv  # noqa: E402
from semnav_env.judge.episodes import load_episodes  # noqa: E402
from semnav_env.vector import SemNavVectorEnv  # noqa: E402

SHORT = {"floor_plan": "office_cross", "max_seconds": 1.5}
COUNT = 3


def dummies(**options):
    return DummyVecEnv([lambda: SemNavEnv(**SHORT | options)] * COUNT)


def actions(space, steps=60):
    rng = np.random.default_rng(2)
    return rng.uniform(-1.0, 1.0, (steps, COUNT, *space.shape)).astype(np.float32)


def assert_same_bits(found, expected):
    assert found.keys() == expected.keys()
    for name, value in expected.items():
        np.testing.assert_array_equal(found[name], value)


def assert_same_info(found, expected):
    seen, also_seen = found.pop("terminal_observation"), expected.pop("terminal_observation")
    assert_same_bits(seen, also_seen)
    assert found == expected


@pytest.mark.parametrize("observation", ["semantic", "raw"])
def test_it_gives_the_bits_of_single_environments(observation):
    together = as_sb3_vec_env(COUNT, observation=observation, **SHORT)
    alone = dummies(observation=observation)
    together.seed(7), alone.seed(7)
    assert_same_bits(together.reset(), alone.reset())
    assert together.reset_infos == alone.reset_infos
    ends = 0
    for action in actions(alone.action_space):
        (seen, rewards, over, infos), expected = together.step(action), alone.step(action)
        assert_same_bits(seen, expected[0])
        assert rewards.dtype == expected[1].dtype
        assert (rewards == expected[1]).all()
        assert (over == expected[2]).all()
        for k in np.flatnonzero(over):
            assert_same_info(infos[k], expected[3][k])
            assert together.reset_infos[k] == alone.reset_infos[k]
        assert all(infos[k] == {"TimeLimit.truncated": False} for k in np.flatnonzero(~over))
        ends += over.sum()
    assert ends > COUNT


def test_all_infos_are_those_of_single_environments_if_wanted():
    together, alone = as_sb3_vec_env(COUNT, all_infos=True, **SHORT), dummies()
    together.seed(7), alone.seed(7)
    together.reset(), alone.reset()
    for action in actions(alone.action_space, 10):
        assert together.step(action)[3] == alone.step(action)[3]


def test_options_of_the_next_reset_reach_their_robots():
    envs = as_sb3_vec_env(2)
    commands = ["go through the second door on the right", "go through the first door on the right"]
    pose = (-2.5, -0.6, 0.25)
    envs.set_options([{"command": text, "pose": pose} for text in commands])
    envs.reset()
    assert [info["command"] for info in envs.reset_infos] == commands


def test_attributes_and_methods_are_those_of_the_single_environments():
    envs = as_sb3_vec_env(COUNT, **SHORT)
    envs.reset()
    assert isinstance(envs, VecEnv)
    assert [plan.name for plan in envs.get_attr("floor_plan")] == ["office_cross"] * COUNT
    envs.set_attr("max_steps", 5, indices=1)
    assert envs.get_attr("max_steps", indices=[1, 2]) == [5, round(1.5 * 15)]
    assert len(envs.env_method("observe", indices=[0])) == 1
    assert envs.env_is_wrapped(gym.Wrapper) == [False] * COUNT
    assert list(envs.get_images()) == [None] * COUNT
    envs.close()


def test_pictures_are_those_of_the_robots():
    envs = as_sb3_vec_env(2, render_mode="rgb_array")
    envs.reset()
    images = envs.get_images()
    assert len(images) == 2
    assert images[0].ndim == 3
    assert envs.render().ndim == 3


def test_a_vector_environment_can_be_given():
    made = gym.make_vec(
        "semnav_env:SemNav-v0",
        2,
        vectorization_mode="vector_entry_point",
        autoreset_mode="SameStep",
    )
    assert as_sb3_vec_env(made).vector is made


def test_what_does_not_fit_is_refused():
    with pytest.raises(ValueError, match='needs autoreset_mode="SameStep"'):
        as_sb3_vec_env(SemNavVectorEnv(1))
    with pytest.raises(ValueError, match="not a SemNavVectorEnv"):
        as_sb3_vec_env(gym.wrappers.vector.RecordEpisodeStatistics(SemNavVectorEnv(1)))
    with pytest.raises(ValueError, match="leave robot out"):
        as_sb3_vec_env(SemNavVectorEnv(1, autoreset_mode="SameStep"), robot="spot")


def test_ppo_learns_and_is_evaluated_on_it():
    envs = VecMonitor(as_sb3_vec_env(4, **SHORT), info_keywords=("is_success",))
    model = sb3.PPO("MultiInputPolicy", envs, n_steps=32, batch_size=64, n_epochs=1, seed=0)
    model.learn(256)
    assert model.num_timesteps == 256
    assert model.ep_info_buffer
    rewards, lengths = evaluate_policy(model, envs, n_eval_episodes=4, return_episode_rewards=True)
    assert len(rewards) == 4
    assert max(lengths) <= round(1.5 * 15)


def test_the_environments_of_a_preset_draw_its_trials():
    envs = preset_envs(replace(PRESETS["hallway"], envs=20))
    envs.seed(0)
    envs.reset()
    drawn = {info["command"] for info in envs.venv.reset_infos}
    assert len(drawn) == len(PRESETS["hallway"].trials)


@pytest.mark.parametrize("preset", PRESETS.values(), ids=PRESETS)
def test_the_environments_of_a_preset_give_compact_observations(preset):
    preset = replace(preset, robots=preset.robots[:1], envs=2, max_seconds=1.0)
    envs = preset_envs(preset)
    twins = as_sb3_vec_env(
        2,
        observation="all",
        each=[
            {"task": source.task, "floor_plan": plan}
            for source, plan in zip(
                envs.get_attr("episode_source"), envs.get_attr("floor_plan"), strict=True
            )
        ],
        rewards=preset.rewards,
        max_seconds=1.0,
        repeat=preset.repeat,
    )
    if preset.episodes:
        for env, other in zip(twins.vector.envs, envs.get_attr("episode_source"), strict=True):
            env.episode_source = other
    observer = CompactObserver(twins.get_attr("robot"), twins.get_attr("lidar_spec")[0])
    envs.seed(1), twins.seed(1)
    assert (envs.reset() == observer.observe(twins.reset())).all()
    for action in np.full((8, 2, 2), 0.5, np.float32):
        seen, rewards, over, infos = envs.step(action)
        expected, same_rewards, same_over, same_infos = twins.step(action)
        for k in np.flatnonzero(over):
            last = same_infos[k]["terminal_observation"]
            final = observer.observe({name: entry[None] for name, entry in last.items()}, [k])
            assert (infos[k]["terminal_observation"] == final[0]).all()
        observer.forget(over)
        assert seen.shape == (2, COMPACT_SIZE)
        assert (seen == observer.observe(expected)).all()
        assert (rewards == same_rewards).all()
        assert (over == same_over).all()


def test_joined_environments_are_their_parts():
    preset = replace(PRESETS["drive"], envs=2, max_seconds=1.0)
    joined = preset_envs(preset)
    parts = [preset_envs(replace(preset, robots=(robot,))) for robot in preset.robots]
    joined.seed(5), parts[0].seed(5), parts[1].seed(7)
    assert (joined.reset() == np.concatenate([part.reset() for part in parts])).all()
    assert joined.action_space.shape == (3,)
    names = [robot.name for robot in joined.get_attr("robot")]
    assert names == ["wheelchair"] * 2 + ["spot"] * 2
    action = np.array([(0.5, 0.2, -0.1)] * 4, np.float32)
    for _ in range(8):
        seen, rewards, over, infos = joined.step(action)
        first, second = parts[0].step(action[:2, [0, 2]]), parts[1].step(action[2:])
        assert (seen == np.concatenate((first[0], second[0]))).all()
        assert (rewards == np.concatenate((first[1], second[1]))).all()
        assert (over == np.concatenate((first[2], second[2]))).all()
        assert [info.keys() for info in infos] == [i.keys() for i in first[3] + second[3]]
    joined.close()


def test_each_environment_of_a_split_stays_in_its_floor_plans():
    episodes = load_episodes("val_seen")
    hands = dealt(episodes, 7)
    assert sorted(each.id for hand in hands for each in hand) == [each.id for each in episodes]
    plans = [{each.floor_plan for each in hand} for hand in hands]
    assert sum(map(len, plans)) == len(set().union(*plans))
    with pytest.raises(ValueError, match="40 floor plans are too few for 41 environments"):
        dealt(episodes, 41)


def test_without_stable_baselines3_the_extra_is_named():
    program = (
        "import sys; sys.modules['stable_baselines3'] = None;"
        "from semnav_agents.learning.sb3_vec_env import as_sb3_vec_env"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.stderr.splitlines()[-1].endswith('pip install "semnav-env[rl]"')
