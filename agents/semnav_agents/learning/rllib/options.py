"""Options for distributing a training over processes; this module needs no Ray."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from semnav_agents.learning.presets import Preset
from semnav_features.checked_fields import Bounds, Count, check_fields


@dataclass(frozen=True)
class RayOptions:
    """Options of `--engine ray`: the cluster, and the processes that drive robots.

    Attributes:
        address: of a Ray cluster, as HOST:PORT or "auto"; without it, Ray starts on this machine
            and can be reached from this machine alone.
        runners: processes that drive robots.
        threads: threads of each runner, which are also the cores that it reserves.
        robots: robots of each runner; without it, those of the preset are divided among the
            runners, rounded up.
    """

    address: str | None = None
    runners: Annotated[int, Bounds(1, 10_000)] = 2
    threads: Count = 1
    robots: Annotated[int | None, Bounds(1, 100_000)] = None

    def __post_init__(self) -> None:
        check_fields(self)

    def robots_each(self, preset: Preset) -> int:
        """Number of robots of one runner."""
        return self.robots or -(-preset.envs // self.runners)

    def decisions(self, preset: Preset) -> int:
        """Number of decisions between updates, of all runners together."""
        return preset.ppo.rollout * self.robots_each(preset) * self.runners
