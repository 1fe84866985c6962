"""Proximal policy optimisation in one file (Schulman et al. 2017), with torch alone.

One sees decisions, the mean reward of a decision and the share of episodes that succeed. The few
decisions of the default show that it runs; give more of them to see it learn. The same seed gives
the same curve; docs/guides/learners.md says what it reached.

    python examples/ppo.py --steps 30720 --seed 0
"""

import argparse
import sys
from dataclasses import replace
from typing import Any

import gymnasium as gym
import numpy as np

from semnav_env.judge.tasks import EpisodeRequest
from semnav_env.mind.observations import Moment
from semnav_env.vector import SemNavVectorEnv
from semnav_env.world.lidar import TIM561

try:
    import torch
    from torch import nn
except ModuleNotFoundError:
    sys.exit('this example needs torch: pip install "semnav-env[rl]"')

ENVS, HORIZON, EPOCHS, BATCH = 8, 128, 10, 256
DISCOUNT, TRACE, CLIP, ENTROPY = 0.99, 0.95, 0.2, 0.003
SECTORS = 54
START = EpisodeRequest("go through the first door on the right", pose=(-2.5, -0.3, 0.24))


class GoalAndScan:
    """What the policy sees: the goal in the robot frame, the velocity and the scan in sectors."""

    def space(self, robot: Any, lidar: Any) -> gym.spaces.Box:
        """All values are squashed into [-1, 1]."""
        return gym.spaces.Box(-1.0, 1.0, (5 + SECTORS,), np.float32)

    def observe(self, moment: Moment) -> np.ndarray:
        """Squash what the robot believes."""
        belief = moment.belief
        c, s = np.cos(belief.pose[2]), np.sin(belief.pose[2])
        ahead = np.array([[c, s], [-s, c]]) @ np.subtract(belief.target.pose, belief.pose)[:2]
        far = np.nan_to_num(moment.tracker.ranges, posinf=10.0, neginf=0.0)
        near = np.array([part.min() for part in np.array_split(far, SECTORS)])
        values = np.concatenate((ahead, belief.velocity, near))
        return np.float32(values / (1.0 + np.abs(values)))


def make() -> SemNavVectorEnv:
    """Robots that decide five times a second, for the control rate is that of the lidar."""
    return SemNavVectorEnv(
        ENVS,
        robot="spot",
        observation=GoalAndScan(),
        lidar=replace(TIM561, rate_hz=5.0),
        task=lambda rng: START,
        max_seconds=30.0,
        autoreset_mode="SameStep",
    )


def network(inputs: int, outputs: int) -> nn.Sequential:
    """Two layers of 64 units."""
    sizes = nn.Linear(inputs, 64), nn.Tanh(), nn.Linear(64, 64), nn.Tanh(), nn.Linear(64, outputs)
    return nn.Sequential(*sizes)


def advantages(rewards: torch.Tensor, values: torch.Tensor, ends: torch.Tensor) -> torch.Tensor:
    """Generalised advantage estimation (Schulman et al. 2016), shape (horizon, envs)."""
    estimate, later = torch.zeros_like(rewards), torch.zeros(rewards.shape[1])
    for t in reversed(range(len(rewards))):
        error = rewards[t] + DISCOUNT * values[t + 1] * (1 - ends[t]) - values[t]
        estimate[t] = later = error + DISCOUNT * TRACE * (1 - ends[t]) * later
    return estimate


def main(decisions: int, seed: int) -> None:
    """Train for about so many decisions."""
    np.random.seed(seed)  # noqa: NPY002 - nothing here draws from it; what you add may
    torch.manual_seed(seed)
    torch.set_num_threads(1)  # sums in the same order everywhere, and small networks are faster
    envs = make()
    inputs, outputs = envs.single_observation_space.shape[0], envs.single_action_space.shape[0]
    actor, critic = network(inputs, outputs), network(inputs, 1)
    spread = nn.Parameter(torch.full((outputs,), -0.5))
    parameters = [*actor.parameters(), *critic.parameters(), spread]
    optimiser = torch.optim.Adam(parameters, lr=3e-4)
    seen = torch.as_tensor(envs.reset(seed=seed)[0])
    for update in range(1, max(1, decisions // (ENVS * HORIZON)) + 1):
        rows, successes = [], []
        for _ in range(HORIZON):
            with torch.no_grad():
                policy = torch.distributions.Normal(actor(seen), spread.exp())
                action = policy.sample()
            following, reward, terminated, truncated, info = envs.step(action.numpy())
            over = terminated | truncated
            successes += info["final_info"]["is_success"][over].tolist() if over.any() else []
            log_chance = policy.log_prob(action).sum(-1)
            ended = torch.as_tensor(over, dtype=torch.float32)
            rows.append((seen, action, log_chance, torch.as_tensor(reward).float(), ended))
            seen = torch.as_tensor(following)
        states, actions, before, rewards, ends = map(torch.stack, zip(*rows, strict=True))
        with torch.no_grad():
            values = critic(torch.cat((states, seen[None]))).squeeze(-1)
        gains = advantages(rewards, values, ends)
        flat = [x.flatten(0, 1) for x in (states, actions, before, gains, gains + values[:-1])]
        for batch in torch.cat([torch.randperm(len(flat[0])) for _ in range(EPOCHS)]).split(BATCH):
            state, action, old, gain, target = (x[batch] for x in flat)
            policy = torch.distributions.Normal(actor(state), spread.exp())
            ratio = (policy.log_prob(action).sum(-1) - old).exp()
            gain = (gain - gain.mean()) / (gain.std() + 1e-8)
            gained = torch.min(ratio * gain, ratio.clamp(1 - CLIP, 1 + CLIP) * gain).mean()
            missed = (critic(state).squeeze(-1) - target).square().mean()
            loss = 0.5 * missed - gained - ENTROPY * policy.entropy().sum(-1).mean()
            optimiser.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_(parameters, 0.5)
            optimiser.step()
        share = f"{np.mean(successes):.2f} of {len(successes)}" if successes else "none ended"
        done, mean = update * ENVS * HORIZON, rewards.mean().item()
        print(f"{done} decisions: reward {mean:+.4f} a decision, success {share}", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=4096, help="decisions, all environments")
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    main(arguments.steps, arguments.seed)
