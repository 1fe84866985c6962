"""Settings of the agent that searches."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from semnav_features.checked_fields import Bounds, Count, Length, Seconds, Share, check_fields


@dataclass(frozen=True)
class SearchSettings:
    """Settings of a search; all values were tuned on houses with seeds below 1000.

    Attributes:
        spacing: between the cells of the map, metres.
        half_side: half the side of the map if no plan is known, metres.
        short_range: range up to which beams make the floor safe, metres: at this range nothing
            fits between two beams (Visser et al. 2007 have two such ranges).
        long_range: range up to which beams show free floor, metres.
        clearance: least distance from the body to anything solid at a lookout, metres.
        candidate_spacing: distance between candidate lookouts, metres.
        rays: number of directions in which the gain of a lookout is estimated.
        fine_spacing: like `candidate_spacing`, once a coarse lattice finds no lookout, metres.
        fine_rays: like `rays`, for the fine lattice.
        least_gain: least area that a lookout must show, m^2.
        least_share: the same as a share of the floor seen of a room, once a coarse lattice finds no
            lookout: an area that is small in a hall is large in a small room.
        speed: assumed speed on paths, m/s.
        turn_rate: assumed yaw rate of turns, rad/s.
        look_seconds: cost of a lookout besides the path there, seconds.
        other_room: factor on the cost of a lookout in another room if a plan is known: a room is
            finished before it is left.
        tries: number of tries after which a cell is given up. A lookout that was meant to show the
            cell, or could not be reached, is one try; one that should have shown it is two.
        refused_distance: least distance of a lookout from one that could not be reached, metres.
        recheck: control periods between two checks whether a lookout is still worth its path.
        patience: control periods without moving after which a target is given up.
        long_patience: control periods without getting nearer after which it is given up.
        retreat: distance that a robot drives back along its path after two targets in succession
            could not be reached, metres.
        settle: control periods that an inspection takes.
        person_range: least and largest distance from which a person is inspected, metres.
        person_looks: control periods of standing before a possible person.
        person_tries: poses from which a possible person is inspected before being left out.
        stop_tolerance: distance from a target at which the robot stops, metres: beside a narrow gap
            another place shows other floor.
        position_tolerance: distance from a lookout at which it counts as reached, metres.
        near_tolerance: the same for other targets, and for a robot that stands still, metres.
        heading_tolerance: heading error with which a target counts as reached, radians.
        suspicion: probability from which on a possible person is inspected from near.
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
    stop_tolerance: float = 0.10
    position_tolerance: float = 0.12
    near_tolerance: float = 0.22
    heading_tolerance: float = math.radians(10.0)
