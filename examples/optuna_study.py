"""An Optuna study: which step size and which entropy bonus let a robot learn soonest.

Each trial trains the PPO of stable-baselines3 for the same number of decisions on four commands of
the measured hallway (the preset `hallway`). One sees the mean reward of the last episodes of each
trial, and the best one. A study proper has trials of 200,000 decisions or more.

    pip install "semnav-env[rl]" optuna
    python examples/optuna_study.py --trials 20 --steps 200000
"""

import argparse
import sys
from dataclasses import replace

try:
    import optuna
    import torch
    from stable_baselines3 import PPO
    from stable_baselines3.common.vec_env import VecMonitor
except ModuleNotFoundError as error:
    sys.exit(f'this example needs {error.name}: pip install "semnav-env[rl]" optuna')

from semnav_agents.learning.preset_envs import preset_envs
from semnav_agents.learning.presets import preset

HALLWAY = replace(preset("hallway"), envs=16, max_seconds=20.0)
REPORTS = 4


def objective(trial: optuna.Trial, steps: int) -> float:
    """Mean reward of the last hundred episodes of a training."""
    envs = VecMonitor(preset_envs(HALLWAY))
    model = PPO(
        "MlpPolicy",
        envs,
        n_steps=64,
        batch_size=256,
        learning_rate=trial.suggest_float("learning_rate", 1e-4, 3e-3, log=True),
        ent_coef=trial.suggest_float("ent_coef", 1e-5, 1e-2, log=True),
        policy_kwargs={"log_std_init": -0.5},
        seed=0,
    )
    reward = float("-inf")
    for part in range(REPORTS):
        model.learn(steps // REPORTS, reset_num_timesteps=part == 0)
        rewards = [episode["r"] for episode in model.ep_info_buffer]
        reward = sum(rewards) / len(rewards) if rewards else reward
        trial.report(reward, part)
        if trial.should_prune():
            raise optuna.TrialPruned
    return reward


def main(trials: int, steps: int) -> None:
    """Run the study; the same seeds give the same study."""
    torch.set_num_threads(1)
    sampler, pruner = optuna.samplers.TPESampler(seed=0), optuna.pruners.MedianPruner(5)
    study = optuna.create_study(direction="maximize", sampler=sampler, pruner=pruner)
    study.optimize(lambda trial: objective(trial, steps), trials)
    print(f"best of {trials} trials: reward {study.best_value:.2f} with {study.best_params}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--trials", type=int, default=3)
    parser.add_argument("--steps", type=int, default=6144, help="decisions of a trial")
    arguments = parser.parse_args()
    main(arguments.trials, arguments.steps)
