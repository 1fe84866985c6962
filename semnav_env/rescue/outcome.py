"""The outcome of a search."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from semnav_env.rescue.settings import SearchRules
from semnav_features.frames import Point


@dataclass(frozen=True)
class SearchOutcome:
    """The judgement of a search; times in seconds since the start, lengths in metres.

    Attributes:
        coverage: seen share of the visible floor of each room, by name.
        floor_coverage: seen share of all floor of each room, hidden or not.
        victims: number of victims.
        found: number of victims that were reported.
        false_reports: number of reports without a victim.
        found_at: time of the report of each found victim, in order.
        report_errors: distance from the middle of each found victim to the nearest report.
    """

    coverage: dict[str, float]
    floor_coverage: dict[str, float]
    victims: int
    found: int
    false_reports: int
    found_at: tuple[float, ...]
    report_errors: tuple[float, ...]

    @property
    def least_coverage(self) -> float:
        """Coverage of the room with the least coverage; 1 without rooms."""
        return min(self.coverage.values(), default=1.0)

    def fulfils(self, rules: SearchRules) -> bool:
        """Whether the search was carried out."""
        covered = self.least_coverage >= rules.coverage
        return covered and self.found == self.victims and self.false_reports <= rules.false_reports

    @property
    def info(self) -> dict[str, Any]:
        """The outcome as plain values, for `info`."""
        return asdict(self) | {"least_coverage": self.least_coverage}


@dataclass(frozen=True)
class Report:
    """A report of a person: position, world frame, and time, seconds since the start."""

    place: Point
    seconds: float


def judge_reports(
    coverage: dict[str, float],
    floor_coverage: dict[str, float],
    victims: list[Point],
    reports: list[Report],
    rules: SearchRules,
) -> SearchOutcome:
    """Compare reports with the true victims.

    Args:
        coverage: seen share of the visible floor of each room.
        floor_coverage: seen share of all floor of each room.
        victims: middles of the people, world frame.
        reports: in the order of time.
        rules: tolerances of reports.
    """
    near = rules.report_distance
    first, errors = [], []
    for victim in victims:
        right = [each for each in reports if math.dist(each.place, victim) <= near]
        if right:
            first.append(right[0].seconds)
            errors.append(min(math.dist(each.place, victim) for each in right))
    false = [r for r in reports if all(math.dist(r.place, v) > near for v in victims)]
    return SearchOutcome(
        coverage,
        floor_coverage,
        len(victims),
        len(first),
        len(false),
        tuple(sorted(first)),
        tuple(errors),
    )
