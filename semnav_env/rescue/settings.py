"""Settings of the person detector, of the map of people, and of a successful search."""

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

    A planar lidar cannot distinguish a person on the floor from a piece of furniture: both are
    outlines. The detector can, with errors. Look-alikes are pieces of furniture that it may take
    for people from afar. The figures are assumptions, of the order of the error rates of neural
    networks on frames of lying people; they are not from a data sheet.

    Attributes:
        range_min: least distance of a detection, metres; nearer bodies are not seen as a whole.
        range_max: largest distance of a detection, metres.
        field_of_view: radians, half of it to each side.
        rate_hz: frames per second, rounded to whole control periods.
        least_share: share of a body's outline that must be in view; the rest may be hidden by
            walls, furniture, or the body itself.
        hit_near: probability that a frame finds a near person in view.
        hit_far: the same at `range_max`; in between it falls linearly.
        look_alikes: share of the pieces of furniture that look like a person from afar.
        false_near: probability that a frame takes a look-alike in view for a person, within
            `clear_range`.
        false_far: the same from farther away.
        clear_range: distance within which look-alikes are recognised well, metres.
        clutter: probability that a frame has a detection where nothing is.
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
        """Probability that a frame finds a person in view at a distance, metres."""
        share = min(max(distance / self.range_max, 0.0), 1.0)
        return self.hit_near + share * (self.hit_far - self.hit_near)

    def false_chance(self, distance: float) -> float:
        """Probability that a frame takes a look-alike in view at a distance for a person."""
        return self.false_near if distance <= self.clear_range else self.false_far


@dataclass(frozen=True)
class PersonMapSettings:
    """Settings by which detections become reports.

    Attributes:
        prior: probability that the first detection at a place is of a person.
        independence: weight of a frame relative to an independent one: successive frames have much
            in common.
        same_distance: detections nearer to each other than this are of one person, metres.
        behind: distance before a track to which the lidar must see for the track to count as in
            view, metres: half the length of a lying person, because the body itself ends the beam.
            With less, large furniture would be found sometimes but never missed.
        report: probability from which on a person is reported.
        drop: probability below which a track is forgotten.
        report_range: largest distance from which a person is reported, metres.
        capacity: largest number of tracks.
        heard: probability that a person is where a voice comes from.
    """

    prior: Share = 0.2
    independence: Share = 0.3
    same_distance: Length = 0.9
    behind: Length = 0.9
    report: Share = 0.99
    drop: Share = 0.02
    report_range: Length = 2.0
    capacity: Count = 16
    heard: Share = 0.95

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class SearchRules:
    """Tolerances of the judge for a search that was carried out.

    Attributes:
        coverage: least seen share of the visible floor of each room.
        report_distance: largest distance of a report from the middle of a victim, metres.
        false_reports: largest number of false reports.
        person_distance: largest distance of the robot from a person to whom it was to go, metres.
        look_distance: largest distance from where "look around" began, metres: a body may need
            room to turn, as for `SuccessRules.turn_distance`.
    """

    coverage: Share = 0.95
    report_distance: Length = 1.0
    false_reports: Annotated[int, Bounds(0, 1000)] = 0
    person_distance: Length = 2.0
    look_distance: Length = 1.5

    def __post_init__(self) -> None:
        check_fields(self)
