"""Reward terms of one's own: two beside the usual ones, and a reward that replaces them all.

One sees the terms of a step as `info["reward_terms"]` has them; the reward is their sum.
"""

import numpy as np

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import AddedTerms, RewardWeights, Tick

START = {"command": "go through the second door on the right", "pose": (-2.5, -0.3, 0.24)}


def smoothness(tick: Tick) -> float:
    """Turning fast is uncomfortable."""
    return -0.05 * abs(tick.motion.yaw_rate)


def hurry(tick: Tick) -> float:
    """Driving is worth more than standing."""
    return 0.02 * tick.motion.speed


class OnlySuccess:
    """A sparse reward: 1 when the command has been carried out."""

    def terms(self, tick: Tick) -> dict[str, float]:
        """The terms by name."""
        return {"success": float(tick.success)}


def main() -> None:
    """Step each environment for a second, in a gentle bend."""
    added = AddedTerms({"smoothness": smoothness, "hurry": hurry}, base=RewardWeights(contact=-1.0))
    for rewards in (RewardWeights(), added, OnlySuccess()):
        env = SemNavEnv(rewards=rewards)
        env.reset(seed=0, options=START)
        for _ in range(15):
            _, reward, _, _, info = env.step(np.array([0.5, 0.1]))
        terms = ", ".join(f"{name} {value:+.4f}" for name, value in info["reward_terms"].items())
        print(f"{type(rewards).__name__}: {reward:+.4f} = {terms}")


if __name__ == "__main__":
    main()
