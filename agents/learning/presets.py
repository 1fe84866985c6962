"""Presets of training: what to learn, and how."""

from __future__ import annotations

from dataclasses import dataclass

from semnav_env.agents.evaluation.suites import Trial, suite
from semnav_env.features.checked_fields import Count, Share, check_fields
from semnav_env.tasks import RewardWeights


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

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class Preset:
    """What to learn, where and for how long.

    Attributes:
        name: as in `semnav train NAME`.
        robot: name of the body.
        floor_plan: where random commands are given, if there are no trials.
        trials: commands and start poses, one of which is drawn for each episode; none for random
            commands.
        max_seconds: time limit of an episode, simulated seconds.
        repeat: steps of the environment (1/15 s each) for which one decision holds.
        envs: number of environments that are driven at once.
        steps: number of decisions to train for, unless told otherwise.
        ppo: hyperparameters.
        rewards: weights of the rewards. Contact costs more than in the environment itself:
            otherwise a policy soon learns to slide along the jambs.
    """

    name: str
    robot: str
    floor_plan: str
    trials: tuple[Trial, ...]
    max_seconds: float
    repeat: int
    envs: int
    steps: int
    ppo: PPOSettings = PPOSettings()
    rewards: RewardWeights = RewardWeights(contact=-0.5)


PRESETS = {
    preset.name: preset
    for preset in (
        Preset(
            name="quick",
            robot="wheelchair",
            floor_plan="heidelberg_hallway",
            trials=suite("heidelberg"),
            max_seconds=45.0,
            repeat=3,
            envs=64,
            steps=2_000_000,
        ),
        Preset(
            name="office",
            robot="wheelchair",
            floor_plan="office_cross",
            trials=(),
            max_seconds=60.0,
            repeat=3,
            envs=64,
            steps=5_000_000,
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
