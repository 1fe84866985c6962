"""Presets of agents that hear the command: amount of data, and length of the training."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, TypeAlias

from semnav_agents.hearing.network import NetworkShape
from semnav_features.checked_fields import Bounds, Count, OneOf, Share, check_fields

SampleDriver: TypeAlias = Annotated[str, OneOf(("scripted", "planner", "policy"))]
"""The driver of the episodes from which a network learns to hear: "scripted" drives to the goals of
the environment; "planner" and "policy", which is the bundled `drive`, to those of the learner."""


@dataclass(frozen=True)
class HearingRound:
    """A round of training: episodes are driven, and the network learns from all samples so far.

    In the first round the scripted agent drives, as the environment grounds the command; then the
    learner drives, and the environment says what would have been right (DAgger, Ross, Gordon and
    Bagnell 2011).

    Attributes:
        episodes: that are driven.
        epochs: passes over all samples.
        rate: largest step size of AdamW; it falls to a fiftieth of this.
        drivers: of the chunks of episodes, in turn.
        robots: names of the bodies of the chunks, in turn.
    """

    episodes: Count
    epochs: Count
    rate: Share = 1.5e-3
    drivers: tuple[SampleDriver, ...] = ("planner",)
    robots: tuple[str, ...] = ("wheelchair",)

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class HearingPreset:
    """Settings of a training: network, data and duration.

    Attributes:
        name: as in `semnav train NAME`.
        split: of the frozen episodes.
        rounds: one after the other.
        chunk: episodes between checkpoints while driving.
        batch_size: samples in a gradient step.
        max_seconds: time limit of an episode, simulated seconds.
        shape: of the network.
    """

    name: str
    rounds: tuple[HearingRound, ...]
    split: str = "train"
    chunk: Count = 50
    batch_size: Count = 256
    max_seconds: Annotated[float, Bounds(1.0, 1e4, "s")] = 100.0
    shape: NetworkShape = field(default_factory=NetworkShape)

    def __post_init__(self) -> None:
        check_fields(self)


MIXED_DRIVERS = (
    *("policy", "policy", "scripted", "policy"),
    *("planner", "policy", "scripted", "policy"),
)
MIXED_ROBOTS = ("wheelchair", "spot", *("wheelchair",) * 4, "spot", "wheelchair")
"""Of eight chunks five are driven by the policy, which errs most, and two by the scripted agent, so
that what it shows is not forgotten; two are driven with SPOT."""

HEARING_PRESETS = {
    preset.name: preset
    for preset in (
        HearingPreset(
            "listener",
            (
                HearingRound(700, 8, drivers=("scripted",)),
                HearingRound(200, 10, 1e-3),
                HearingRound(1100, 10, 8e-4, MIXED_DRIVERS, MIXED_ROBOTS),
                HearingRound(1700, 12, 8e-4, MIXED_DRIVERS, MIXED_ROBOTS),
            ),
        ),
    )
}
