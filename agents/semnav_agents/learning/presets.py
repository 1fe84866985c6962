"""Presets of training: task, demonstrations and hyperparameters."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from typing import Annotated, Any

from semnav_agents.evaluation.suites import Trial, suite
from semnav_env.judge.tasks import RewardWeights
from semnav_env.robots import robot_spec
from semnav_features.checked_fields import Bounds, Count, Share, check_fields


@dataclass(frozen=True)
class PPOSettings:
    """Hyperparameters of proximal policy optimisation (Schulman et al. 2017).

    Attributes:
        hidden: widths of the tanh layers of the policy and, separately, of the value function.
        rollout: decisions of each environment between updates.
        batch_size: decisions in a gradient step.
        epochs: passes over a rollout.
        learning_rate: step size of Adam.
        gamma: discount per decision.
        gae_lambda: of generalised advantage estimation.
        clip_range: of the probability ratio.
        entropy: weight of the entropy bonus.
        log_std: logarithm of the initial standard deviation of the actions.
        max_kl: divergence from the old policy at which an update stops early.
        stretch: updates between two checkpoints; each checkpoint ends all episodes.
        anneal: whether the step size falls to zero over the decisions of the preset.
    """

    hidden: tuple[Count, ...] = (64, 64)
    rollout: Count = 64
    batch_size: Count = 512
    epochs: Count = 10
    learning_rate: Share = 3e-4
    gamma: Share = 0.99
    gae_lambda: Share = 0.95
    clip_range: Share = 0.2
    entropy: float = 0.0
    log_std: float = -0.5
    max_kl: float = 0.05
    stretch: Annotated[int, Bounds(1, 10_000)] = 16
    anneal: bool = False

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class Preset:
    """Settings of a training: bodies, commands, floor plans and duration.

    Attributes:
        name: as in `semnav train NAME`.
        robots: names of the bodies, all of which one policy drives.
        floor_plan: floor plan of the commands; not used with `episodes`.
        trials: commands and start poses, one of which is drawn for each episode; none for random
            commands.
        episodes: split whose episodes are drawn instead; empty for none.
        max_seconds: time limit of an episode, simulated seconds.
        repeat: steps of the environment (1/15 s each) for which one decision holds.
        envs: number of environments of each body that are driven at once.
        steps: default number of decisions of the training.
        ppo: hyperparameters.
        demonstrations: number of drives of the scripted agent that are imitated first.
        rewards: weights of the rewards. Contact costs more than in the environment itself:
            otherwise a policy soon learns to slide along the jambs.
    """

    name: str
    robots: tuple[str, ...]
    floor_plan: str
    max_seconds: float
    repeat: int
    envs: int
    steps: int
    trials: tuple[Trial, ...] = ()
    episodes: str = ""
    demonstrations: int = 0
    ppo: PPOSettings = PPOSettings()
    rewards: RewardWeights = RewardWeights(contact=-0.5)

    @property
    def action_size(self) -> int:
        """Number of values in an action of the policy: as many as the largest of its bodies has."""
        return max(robot_spec(robot).action_size for robot in self.robots)

    def plain(self) -> dict[str, Any]:
        """The preset as plain data for a JSON file."""
        return dict(json.loads(json.dumps(asdict(self))))


PRESETS = {
    preset.name: preset
    for preset in (
        Preset(
            name="hallway",
            robots=("wheelchair",),
            floor_plan="heidelberg_hallway",
            trials=suite("heidelberg"),
            max_seconds=45.0,
            repeat=3,
            envs=64,
            steps=2_000_000,
        ),
        Preset(
            name="quick",
            robots=("wheelchair",),
            floor_plan="",
            episodes="train",
            max_seconds=100.0,
            repeat=3,
            envs=120,
            steps=983_040,
            demonstrations=200,
            ppo=PPOSettings(
                hidden=(128, 128),
                batch_size=1024,
                epochs=6,
                log_std=-1.3,
                max_kl=0.03,
                anneal=True,
            ),
            rewards=RewardWeights(contact=-1.0),
        ),
        Preset(
            name="drive",
            robots=("wheelchair", "spot"),
            floor_plan="",
            episodes="train",
            max_seconds=150.0,
            repeat=3,
            envs=120,
            steps=0,
            demonstrations=1500,
            ppo=PPOSettings(
                hidden=(256, 256),
                batch_size=1024,
                epochs=6,
                learning_rate=3e-4,
                gamma=0.99,
                log_std=-1.3,
                max_kl=0.03,
                stretch=12,
            ),
            rewards=RewardWeights(contact=-1.0),
        ),
    )
}


def preset(name: str) -> Preset:
    """The preset of that name.

    Raises:
        ValueError: no such preset; lists those there are.
    """
    if name not in PRESETS:
        raise ValueError(f"no preset {name!r}; there are: {', '.join(PRESETS)}")
    return PRESETS[name]
