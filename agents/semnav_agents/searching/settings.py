"""Settings of the agent that searches."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from semnav_features.checked_fields import Bounds, Count, Length, Seconds, Share, check_fields


@dataclass(frozen=True)
class SearchSettings:
    """How a house is searched. All values were tuned on houses with seeds below 1000.

    Attributes:
        spacing: between the cells of the map, metres.
        half_side: half the side of the map where no plan is known, metres.
        short_range: beams make the floor safe up to here, metres: so near, nothing hides between
            two beams (Visser et al. 2007 have two such ranges).
        long_range: beams show free floor up to here, metres.
        clearance: least distance from the body where it is to stand to anything solid, metres.
        candidate_spacing: between places to look from, metres.
        rays: directions in which the gain of a place is estimated.
        fine_spacing: as `candidate_spacing`, once a coarse lattice finds no place, metres.
        fine_rays: as `rays` there.
        least_gain: least area that is worth a look, m^2.
        least_share: the same as a share of the floor seen of a room, once a coarse lattice finds no
            place: what is little in a hall is much in a small room.
        speed: with which ways are counted, m/s.
        turn_rate: with which turns are counted, rad/s.
        look_seconds: cost of a look besides the way there.
        other_room: factor on the cost of a place in another room while a plan is known: a room is
            finished before it is left.
        tries: a cell is given up after so many places from which it ought to have been seen, or
            that could not be reached; a look that ought to have shown it counts for two.
        refused_distance: no place nearer to one that could not be reached is tried, metres.
        recheck: control periods between two questions whether a view is still worth its way.
        patience: control periods without moving after which a target is given up.
        long_patience: control periods without getting nearer after which it is given up.
        retreat: how far a robot goes back the way it came if it stands where two targets in
            succession could not be reached, metres.
        settle: control periods that a look takes.
        person_range: least and largest distance from which a person is looked at, metres.
        person_looks: control periods of standing before somebody who may be a person.
        person_tries: places from which somebody is looked at before being left aside.
        suspicion: probability from which on somebody is looked at from near.
    """

    spacing: Length = 0.05
    half_side: Length = 20.0
    short_range: Length = 3.0
    long_range: Length = 9.0
    clearance: Length = 0.05
    candidate_spacing: Length = 0.35
    rays: Count = 60
    fine_spacing: Length = 0.10
    fine_rays: Count = 120
    least_gain: Annotated[float, Bounds(0.0, 1e6)] = 0.06
    least_share: Share = 0.01
    speed: Annotated[float, Bounds(0.0, 20.0, "m/s")] = 0.6
    turn_rate: Annotated[float, Bounds(0.0, 20.0, "rad/s")] = 0.8
    look_seconds: Seconds = 1.5
    other_room: Length = 2.5
    tries: Count = 4
    refused_distance: Length = 0.4
    recheck: Count = 12
    patience: Count = 50
    long_patience: Count = 450
    retreat: Length = 1.5
    settle: Count = 15
    person_range: tuple[Length, Length] = (0.9, 1.7)

    def __post_init__(self) -> None:
        check_fields(self)

    person_looks: int = 40
    person_tries: int = 3
    suspicion: float = 0.1
    position_tolerance: float = 0.22
    heading_tolerance: float = math.radians(10.0)
