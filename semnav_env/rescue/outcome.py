"""What became of a search."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

from semnav_env.rescue.settings import SearchRules
from semnav_features.frames import Point


@dataclass(frozen=True)
class SearchOutcome:
    """What the judge says of a search; times in seconds since the start, lengths in metres.

    Attributes:
        coverage: of the floor of each room that can be seen, the share that was, by name.
        floor_coverage: the same of all its floor, hidden or not.
        victims: how many people there are.
        found: how many of them were reported.
        false_reports: how many reports were of nobody.
        found_at: when each that was found was reported, in order.
        report_errors: distance of the report nearest to each that was found from its middle.
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
        """Coverage of the room that was looked at least; 1 without rooms."""
        return min(self.coverage.values(), default=1.0)

    def fulfils(self, rules: SearchRules) -> bool:
        """Whether the search was carried out."""
        covered = self.least_coverage >= rules.coverage
        return covered and self.found == self.victims and self.false_reports <= rules.false_reports

    @property
    def info(self) -> dict[str, Any]:
        """As plain values, for `info`."""
        return asdict(self) | {"least_coverage": self.least_coverage}


@dataclass(frozen=True)
class Report:
    """Somebody was reported: where, world frame, and when, seconds since the start."""

    place: Point
    seconds: float


def judge_reports(
    coverage: dict[str, float],
    floor_coverage: dict[str, float],
    victims: list[Point],
    reports: list[Report],
    rules: SearchRules,
) -> SearchOutcome:
    """Compare reports with the people who are there.

    Args:
        coverage: of each room.
        floor_coverage: of each room, all of its floor.
        victims: middles of the people, world frame.
        reports: in the order of time.
        rules: how far off a report may be.
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
