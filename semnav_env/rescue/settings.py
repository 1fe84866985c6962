"""What a person detector can do, and when a search has been carried out."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from semnav_features.checked_fields import (
    Angle,
    Bounds,
    Count,
    Length,
    Share,
    check_fields,
    require_order,
)


@dataclass(frozen=True)
class PersonDetectorSettings:
    """A camera with a person detector, on the mount of the lidar, looking forward.

    A planar lidar does not tell somebody on the floor from a piece of furniture: both are outlines.
    The detector does, with errors. It looks at people and at look-alikes, pieces of furniture that
    it may take for people from afar. The figures are assumed: of the order of what networks for
    people do on frames of people who lie down, no product's data sheet.

    Attributes:
        range_min: nearer bodies are not seen as a whole, metres.
        range_max: metres.
        field_of_view: radians, half of it to each side.
        rate_hz: looks per second, rounded to whole control periods.
        least_share: share of a body's outline that must be in view: the rest may be hidden by
            walls, furniture, or the body itself.
        hit_near: probability that a look finds a person in view, near.
        hit_far: the same at `range_max`; in between it falls evenly.
        look_alikes: share of the pieces of furniture that look like a person from afar.
        false_near: probability that a look takes a look-alike in view for a person, within
            `clear_range`.
        false_far: the same from farther away.
        clear_range: distance within which look-alikes are told apart well, metres.
        clutter: probability that a look sees somebody where nothing is.
        range_std: standard deviation of the error of a distance, as a share of it.
        bearing_std: standard deviation of the error of a direction, radians.

    Raises:
        ValueError: a number out of its range; names it.
    """

    range_min: Length = 0.3
    range_max: Length = 6.0
    field_of_view: Angle = math.radians(120.0)
    rate_hz: Annotated[float, Bounds(1e-3, 1e6, "Hz")] = 5.0
    least_share: Share = 0.2
    hit_near: Share = 0.9
    hit_far: Share = 0.5
    look_alikes: Share = 0.1
    false_near: Share = 0.03
    false_far: Share = 0.3
    clear_range: Length = 2.5
    clutter: Share = 0.005
    range_std: Length = 0.05
    bearing_std: Angle = math.radians(2.0)

    def __post_init__(self) -> None:
        check_fields(self)
        require_order(self, ("range_min", "range_max"))

    def hit_chance(self, distance: float) -> float:
        """Probability that a look finds a person in view so far away, metres."""
        share = min(max(distance / self.range_max, 0.0), 1.0)
        return self.hit_near + share * (self.hit_far - self.hit_near)

    def false_chance(self, distance: float) -> float:
        """Probability that a look takes a look-alike in view so far away for a person."""
        return self.false_near if distance <= self.clear_range else self.false_far


@dataclass(frozen=True)
class PersonMapSettings:
    """How detections become reports.

    Attributes:
        prior: probability that the first detection at a place is of a person.
        independence: share of an independent look that each look counts for: looks that follow
            each other have much in common.
        same_distance: detections nearer to each other are of one person, metres.
        behind: distance before a track to which the lidar must see for it to count as in view,
            metres: the body itself ends the beam, half the length of somebody who lies. With less,
            large furniture is found now and then and never missed.
        report: probability from which on a person is reported.
        drop: probability below which a track is forgotten.
        report_range: a person is reported from no farther away, metres: one goes near.
        capacity: most tracks that are kept.
    """

    prior: Share = 0.2
    independence: Share = 0.3
    same_distance: Length = 0.9
    behind: Length = 0.9
    report: Share = 0.99
    drop: Share = 0.02
    report_range: Length = 2.0
    capacity: Count = 16

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class SearchRules:
    """What the judge accepts as a search that was carried out.

    Attributes:
        coverage: least share of the floor of each room that was looked at.
        report_distance: largest distance of a report from the middle of a victim, metres.
        false_reports: most reports of people who are not there.
    """

    coverage: Share = 0.95
    report_distance: Length = 1.0
    false_reports: Annotated[int, Bounds(0, 1000)] = 0

    def __post_init__(self) -> None:
        check_fields(self)
