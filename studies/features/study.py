"""Strategies of the extractor, tried on simulated scans of floor plans."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum
from functools import partial
from typing import Any

import numpy as np

from semnav_env.world.maps import FloorPlan
from semnav_features import ExtractorSettings, Scan, Scene, extract
from semnav_features.strategies import BreakpointRule, Segmentation, strategy_names
from studies.features.barbret_chain import barbret_scene
from studies.features.cases import Case, CaseSituation, draw_cases
from studies.features.comparison import compare
from studies.features.metrics import Table
from studies.features.records import CountingLimits, Detection, Sighting, as_table

DEFAULT_STRATEGY = "default"
"""Name of the default settings in the tables."""


CHOICES: dict[str, type[IntEnum]] = {
    "breakpoint_rule": BreakpointRule,
    "segmentation": Segmentation,
}
"""The settings that name a strategy."""

THESIS_STRATEGY = "barbret"
"""Name of the chain of Barbret's thesis in the tables."""

Extractor = Callable[[Scan], Scene]
"""What turns a scan into a scene."""


def all_strategies() -> dict[str, ExtractorSettings]:
    """The default settings and, beside them, every other named strategy in their place."""
    default = ExtractorSettings()
    found = {DEFAULT_STRATEGY: default}
    for choice, strategies in CHOICES.items():
        for name in strategy_names(strategies):
            if name != getattr(default, choice):
                change: dict[str, Any] = {choice: name}
                found[f"{choice}={name}"] = replace(default, **change)
    return found


def all_extractors() -> dict[str, Extractor]:
    """An extractor for every strategy, and the chain of Barbret's thesis."""
    found: dict[str, Extractor] = {
        name: partial(extract, settings=settings) for name, settings in all_strategies().items()
    }
    return found | {THESIS_STRATEGY: barbret_scene}


@dataclass(frozen=True)
class Condition:
    """What a set of scans has in common.

    Attributes:
        strategy: name of the extractor.
        situation: where they were taken.
        sigma: standard deviation of the ranges, metres.
    """

    strategy: str
    situation: CaseSituation
    sigma: float


@dataclass(frozen=True, eq=False)
class Outcome:
    """What became of all scans of some conditions.

    Attributes:
        scans: how many.
        sightings: table of `Sighting`.
        detections: table of `Detection`.
        seconds: that each extraction took, shape (scans,).
    """

    scans: int
    sightings: Table
    detections: Table
    seconds: np.ndarray


@dataclass
class _Tally:
    sightings: list[Sighting] = field(default_factory=list)
    detections: list[Detection] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)

    def outcome(self) -> Outcome:
        return Outcome(
            len(self.seconds),
            as_table(self.sightings, Sighting),
            as_table(self.detections, Detection),
            np.array(self.seconds),
        )


@dataclass
class Study:
    """Extracts, compares and keeps what was found.

    Attributes:
        strategies: the extractors to try, by name.
        limits: what is in good view, and what counts as found.
        outcomes: so far, by condition.
        cases: how many were taken into account.
    """

    strategies: Mapping[str, Extractor]
    limits: CountingLimits = field(default_factory=CountingLimits)
    outcomes: dict[Condition, Outcome] = field(default_factory=dict)
    cases: int = 0

    @property
    def sigmas(self) -> tuple[float, ...]:
        """The noises that there are, metres."""
        return tuple(sorted({condition.sigma for condition in self.outcomes}))

    @property
    def plans(self) -> tuple[str, ...]:
        """The names of the floor plans, in order."""
        return tuple(dict.fromkeys(condition.situation.plan for condition in self.outcomes))

    def run(
        self,
        plans: Sequence[FloorPlan],
        poses: int,
        sigmas: tuple[float, ...],
        clutter: Sequence[bool],
        seed: int,
    ) -> Iterator[Case]:
        """Draw cases, take each into account and yield it.

        Args:
            plans: floor plans.
            poses: in each, and in each with clutter.
            sigmas: standard deviations of the ranges, metres.
            clutter: without, with, or both.
            seed: of everything random.
        """
        for number, (plan, filled) in enumerate((p, c) for p in plans for c in clutter):
            rng = np.random.default_rng((seed, number))
            yield from self._take(draw_cases(plan, poses, sigmas, filled, rng))

    def _take(self, cases: Iterable[Case]) -> Iterator[Case]:
        tallies: dict[Condition, _Tally] = defaultdict(_Tally)
        for case in cases:
            for name, look in self.strategies.items():
                for sigma, scan in case.scans:
                    tally = tallies[Condition(name, case.situation, sigma)]
                    look(scan)  # what was done before has filled the caches
                    begin = time.perf_counter()
                    found = look(scan)
                    tally.seconds.append(time.perf_counter() - begin)
                    sightings, detections = compare(scan, case.truth, found, self.limits)
                    tally.sightings += sightings
                    tally.detections += detections
            self.cases += 1
            yield case
        self.outcomes.update({condition: tally.outcome() for condition, tally in tallies.items()})

    def pooled(
        self,
        strategy: str = DEFAULT_STRATEGY,
        sigma: float | None = None,
        place: str | None = None,
        clutter: bool | None = None,
        plan: str | None = None,
    ) -> Outcome:
        """Everything under these conditions; None takes all."""
        chosen = [
            outcome
            for condition, outcome in self.outcomes.items()
            if condition.strategy == strategy
            and sigma in (None, condition.sigma)
            and place in (None, condition.situation.place)
            and clutter in (None, condition.situation.clutter)
            and plan in (None, condition.situation.plan)
        ]
        return Outcome(
            sum(outcome.scans for outcome in chosen),
            np.concatenate([as_table([], Sighting), *(o.sightings for o in chosen)]),
            np.concatenate([as_table([], Detection), *(o.detections for o in chosen)]),
            np.concatenate([np.empty(0), *(o.seconds for o in chosen)]),
        )
