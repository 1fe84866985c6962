"""Hyperparameters for RL Baselines3 Zoo, which trains, evaluates and keeps the runs.

One sees what the Zoo prints: the hyperparameters, then return and success. Any option of
`rl_zoo3.train` may follow, such as `-n 200000`, `--eval-freq 20000` or `--optimize`.

    pip install "semnav-env[rl]" rl_zoo3
    python examples/rl_zoo.py -n 200000 --log-folder runs/zoo
    python -m rl_zoo3.enjoy --algo ppo --env SemNav-v0 --gym-packages semnav_env -f runs/zoo
"""

import sys
from dataclasses import asdict, replace

from semnav_env.world.lidar import TIM561

hyperparams = {
    "SemNav-v0": {
        # the environment: plain values, which the Zoo can write to its config.yml and read again
        "env_kwargs": {
            "robot": "spot",
            "observation": "all",
            "task": "go through the first door on the right",
            "lidar": asdict(replace(TIM561, rate_hz=5.0)),  # five decisions a second
            "max_seconds": 30.0,
        },
        "env_wrapper": [
            {"gymnasium.wrappers.FilterObservation": {"filter_keys": ["goal", "odometry", "scan"]}},
            "gymnasium.wrappers.FlattenObservation",
        ],
        "normalize": {"norm_obs": True, "norm_reward": False},
        # the learner: PPO of stable-baselines3
        "n_envs": 8,
        "n_timesteps": 200_000,
        "policy": "MlpPolicy",
        "n_steps": 128,
        "batch_size": 256,
        "n_epochs": 10,
        "learning_rate": 3e-4,
        "gamma": 0.99,
        "gae_lambda": 0.95,
        "ent_coef": 0.003,
        "policy_kwargs": {"log_std_init": -0.5, "net_arch": [64, 64]},
    }
}


def main() -> None:
    """Train with this file as the Zoo's configuration."""
    try:
        from rl_zoo3.train import train
    except ModuleNotFoundError as error:
        sys.exit(f'this example needs {error.name}: pip install "semnav-env[rl]" rl_zoo3')
    sys.argv[1:1] = ["--algo", "ppo", "--env", "SemNav-v0", "--gym-packages", "semnav_env"]
    sys.argv += ["--conf-file", __file__]
    train()


if __name__ == "__main__":
    main()
