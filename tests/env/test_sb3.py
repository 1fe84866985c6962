"""The environment as stable-baselines3 takes it."""

import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import MODES
from semnav_env.robots import ROBOTS

sb3 = pytest.importorskip("stable_baselines3", reason='needs the extra "rl"')

from stable_baselines3.common.env_checker import check_env  # noqa: E402


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("mode", MODES)
def test_the_environment_passes_the_checker(robot, mode):
    check_env(SemNavEnv(robot, observation=mode), skip_render_check=False)


def test_ppo_takes_the_environment_as_it_is():
    env = SemNavEnv(observation="semantic", max_seconds=10)
    model = sb3.PPO("MultiInputPolicy", env, n_steps=500, batch_size=250, n_epochs=2, seed=0)
    model.learn(2000)
    assert model.num_timesteps == 2000
    assert all(np.isfinite(p.detach().numpy()).all() for p in model.policy.parameters())
    observation, _ = env.reset(seed=0)
    action, _ = model.predict(observation, deterministic=True)
    assert env.action_space.contains(action)
