"""Presets of agents that hear the command: amount of data, and length of the training."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from semnav_agents.hearing.network import NetworkShape
from semnav_features.checked_fields import Bounds, Count, Share, check_fields


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
    """

    episodes: Count
    epochs: Count
    rate: Share = 1.5e-3

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class HearingPreset:
    """Settings of a training: network, data and duration.

    Attributes:
        name: as in `semnav train NAME`.
        robot: name of the body that drives while samples are collected.
        split: of the frozen episodes.
        rounds: one after the other.
        chunk: episodes between checkpoints while driving.
        batch_size: samples in a gradient step.
        max_seconds: time limit of an episode, simulated seconds.
        shape: of the network.
    """

    name: str
    rounds: tuple[HearingRound, ...]
    robot: str = "wheelchair"
    split: str = "train"
    chunk: Count = 50
    batch_size: Count = 256
    max_seconds: Annotated[float, Bounds(1.0, 1e4, "s")] = 100.0
    shape: NetworkShape = field(default_factory=NetworkShape)

    def __post_init__(self) -> None:
        check_fields(self)


HEARING_PRESETS = {
    preset.name: preset
    for preset in (
        HearingPreset(
            "listener",
            (HearingRound(700, 8), HearingRound(200, 10, 1e-3)),
        ),
    )
}
