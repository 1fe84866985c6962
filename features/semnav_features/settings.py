"""Every limit of the feature extractor, with its unit and its source."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from enum import IntEnum
from typing import Annotated

import numpy as np

from semnav_features.checked_fields import (
    Bounds,
    Length,
    OneOf,
    Share,
    check_fields,
    require_order,
)
from semnav_features.rules import DoorRules
from semnav_features.strategies import BreakpointRule, Segmentation, strategy_names

_RECORD_TYPES = {float: "f8", int: "i8", bool: "?", str: "i8"}
_STRATEGIES: dict[str, type[IntEnum]] = {
    "breakpoint_rule": BreakpointRule,
    "segmentation": Segmentation,
}
"""The choices of the fields that hold a name; the kernels get the number of the name."""

_DOOR = DoorRules()


@dataclass(frozen=True)
class ExtractorSettings:
    """Limits of the extractor. Lengths in metres, angles in radians.

    "Thesis" is Barbret 2021. Defaults without a source were chosen by measurement on simulated
    office corridors with sigma 20 mm.

    Attributes:
        rupture_range: a longer range counts as a missing return, metres (thesis (2.1): 6; the
            TiM561 reaches 10, and doors and junctions beyond 6 m are useful).
        sigma: standard deviation of a range, metres (TiM561 data sheet: 0.02).
        veil_angle: removes mixed pixels, which are beams that ended between two surfaces: there
            the lines to both neighbours are met at less than this angle, radians. 0 keeps all;
            5 to 10 degrees remove the mixed pixels at edges and no wall (`kernels.filters`).
        median_beams: number of beams on either side for a median filter of the ranges, where it
            moves no edge; 0 switches it off.
        breakpoint_rule: rule for the largest distance of neighbouring points: "constant",
            "borges_aldon", "certad", "dietmayer", "santos", "lee" or "weerakoon"; the equations are
            in `kernels.breakpoints`. "certad" is the rule of the thesis (2.3), "borges_aldon", made
            the same for both directions of the scan.
        breakpoint_angle: lambda of the adaptive breakpoint, the flattest incidence at which
            neighbouring points are still joined, radians (thesis (2.3): 10 degrees, which loses
            the far part of a corridor's walls). Not read by "constant", "dietmayer" and "lee".
        breakpoint_distance: C0 of "constant", "dietmayer" and "santos", metres.
        breakpoint_ratio: largest `|r1 - r2| / (r1 + r2)` of neighbouring ranges, for "lee".
        dropout_beams: number of missing returns in a row that do not end a wall.
        segmentation: how a connected group is cut into straight pieces: "end_point_fit" (thesis
            2.4.4); "dynamic", the most likely partition (`kernels.optimal_partition`), which takes
            a hundred times as long; or "curvature", where the curvature function with adaptive
            arms peaks (`kernels.curvature`).
        split_distance: "end_point_fit" cuts at a point that is farther from the chord than this,
            metres (thesis: 0.06; here four standard deviations). In "curvature" the contour along
            an arm may be longer than its chord by this.
        wall_beams: fewest beams of a wall (thesis: 3).
        wall_length: shortest wall, metres.
        merge_gap: widest gap across which two collinear walls are joined, metres; less than any
            gap that a robot could pass.
        merge_offset: largest step between two walls that are joined, metres.
        robust_fit: fit every line once more with less weight on points away from it.
        confidence: tolerated errors of a fitted line, in standard deviations.
        door_width_min: narrowest door, metres, see `rules.DoorRules`.
        door_width_max: widest door, metres, see `rules.DoorRules`.
        door_width_tolerance: added to both limits, metres, see `rules.DoorRules`; on top of it each
            jamb may lie one beam spacing inside the gap that was measured.
        door_angle_tolerance: largest angle between a door and its wall beyond the uncertainty of
            the fit, radians (thesis: 2 degrees in all; walls that are drawn or built a few
            centimetres off need more).
        door_point_tolerance: largest distance of the jambs from the line of the wall beyond the
            uncertainty of the fit, metres.
        door_wall_gap: largest distance before the jamb at which a supporting wall may end, metres;
            door frames interrupt the fit.
        door_depth: beams through the opening reach this far beyond its chord, metres. The distance
            is measured along the beam and not across the chord, so that an open leaf seen through
            a grazing gap does not hide the door.
        door_clear_fraction: least share of the beams between the jambs that reach `door_depth`.
        door_recess: least depth across the chord that some beam must reach, metres: a closed door
            lies less deep in its frame, and so does a niche.
        door_shadow: if a beam beside a jamb ends this far in front of the chord, metres, the jamb
            is only the edge of a shadow.
        door_beams: fewest beams through an opening.
        door_confidence_min: least confidence of a door, 0 to 1: a higher value gives fewer false
            doors and more missed ones. At 0.6 the F1 in simulated offices full of furniture is
            highest.
        one_sided_doors: accept doors with a wall in line on one side only, or on none.
        arcs: whether to find columns and curved walls.
        arc_radius_min: thinnest column, metres; thinner ones are legs of chairs and people.
        arc_radius_max: flattest curved wall, metres.
        arc_extent_min: smallest angle that an arc spans about its centre, radians.
        arc_sagitta_min: least distance of an arc from the chord between its ends, metres; a flatter
            one cannot be told from a wall with a bend in it.
        arc_beams: fewest beams of an arc.
        arc_residual: largest root mean square distance of the points of an arc, metres.
        corner_angle: smallest angle between the directions of two walls at a corner, radians
            (thesis: 50 degrees; Weerakoon et al.: 30).
        corner_gap: walls are extended this far to their corner, metres; their ends may be twice
            as far apart.
        corner_fuse: corners closer together than this are one, metres.
        corridor_probe: length of a probe from a corner to an opposite wall, metres (thesis 3.3).
        corridor_wall_slack: a probed wall may end this far beside the probe, metres.
        corridor_angle_tolerance: largest deviation from a right angle between probe and wall,
            radians.
        corridor_half_width: least distance from the midpoint to its corner, metres (thesis
            4.8: 0.3).
        corridor_distance_min: least distance from the scanner to a midpoint, metres (thesis
            4.8: 0.5).
        corridor_distance_max: largest distance from the scanner to a midpoint, metres (thesis
            4.8: 3).

    Raises:
        ValueError: a limit is out of its range, or there is no strategy of that name; the message
            gives the range, or the names.
    """

    rupture_range: Annotated[float, Bounds(0.1, 1000.0, "m")] = 10.0
    sigma: Length = 0.02
    veil_angle: Annotated[float, Bounds(0.0, math.pi / 4, "rad")] = 0.0
    median_beams: Annotated[int, Bounds(0, 4)] = 0
    breakpoint_rule: Annotated[str, OneOf(strategy_names(BreakpointRule))] = "certad"
    breakpoint_angle: Annotated[float, Bounds(math.radians(0.1), math.pi / 2, "rad")] = (
        math.radians(4.0)
    )
    breakpoint_distance: Length = 0.2
    breakpoint_ratio: Annotated[float, Bounds(0.0, 0.9)] = 0.05
    dropout_beams: Annotated[int, Bounds(0, 10)] = 2
    segmentation: Annotated[str, OneOf(strategy_names(Segmentation))] = "end_point_fit"
    split_distance: Annotated[float, Bounds(1e-4, 10.0, "m")] = 0.08
    wall_beams: Annotated[int, Bounds(2, 10_000)] = 5
    wall_length: Annotated[float, Bounds(0.01, 100.0, "m")] = 0.2
    merge_gap: Length = 0.3
    merge_offset: Length = 0.015
    robust_fit: bool = False
    confidence: Annotated[float, Bounds(0.0, 10.0)] = 2.0
    door_width_min: Length = _DOOR.width_min
    door_width_max: Length = _DOOR.width_max
    door_width_tolerance: Length = _DOOR.width_tolerance
    door_angle_tolerance: Annotated[float, Bounds(0.0, math.pi / 4, "rad")] = math.radians(4.0)
    door_point_tolerance: Length = 0.05
    door_wall_gap: Length = 0.4
    door_depth: Length = 0.15
    door_clear_fraction: Share = 0.4
    door_recess: Length = 0.2
    door_shadow: Length = 0.3
    door_beams: Annotated[int, Bounds(1, 10_000)] = 3
    door_confidence_min: Share = 0.6
    one_sided_doors: bool = True
    arcs: bool = True
    arc_radius_min: Annotated[float, Bounds(0.01, 1000.0, "m")] = 0.1
    arc_radius_max: Length = 10.0
    arc_extent_min: Annotated[float, Bounds(math.radians(1.0), math.tau, "rad")] = math.radians(
        20.0
    )
    arc_sagitta_min: Length = 0.06
    arc_beams: Annotated[int, Bounds(4, 10_000)] = 8
    arc_residual: Length = 0.03
    corner_angle: Annotated[float, Bounds(math.radians(5.0), math.radians(175.0), "rad")] = (
        math.radians(50.0)
    )
    corner_gap: Length = 0.3
    corner_fuse: Length = 0.1
    corridor_probe: Length = 2.5
    corridor_wall_slack: Length = 0.2
    corridor_angle_tolerance: Annotated[float, Bounds(0.0, math.pi / 2, "rad")] = math.radians(30.0)
    corridor_half_width: Length = 0.3
    corridor_distance_min: Length = 0.5
    corridor_distance_max: Length = 6.0

    def __post_init__(self) -> None:
        check_fields(self)
        require_order(self, *_ORDER)

    @property
    def door_rules(self) -> DoorRules:
        """The door rules of these settings."""
        return DoorRules(self.door_width_min, self.door_width_max, self.door_width_tolerance)

    def with_doors(self, rules: DoorRules) -> ExtractorSettings:
        """The same settings with other door rules."""
        return replace(
            self,
            door_width_min=rules.width_min,
            door_width_max=rules.width_max,
            door_width_tolerance=rules.width_tolerance,
        )

    def as_record(self) -> np.ndarray:
        """The settings as the kernels take them: a structured array of shape (1,)."""
        return np.array(
            [tuple(_recorded(f.name, getattr(self, f.name)) for f in fields(self))], RECORD
        )


def _recorded(name: str, value: float | str) -> float:
    """The value of a field in the record; for a strategy its number."""
    return value if not isinstance(value, str) else _STRATEGIES[name][value.upper()]


_ORDER = (
    ("door_width_min", "door_width_max"),
    ("merge_gap", "door_width_min"),
    ("arc_radius_min", "arc_radius_max"),
    ("corridor_distance_min", "corridor_distance_max"),
)

RECORD = np.dtype([(f.name, _RECORD_TYPES[type(f.default)]) for f in fields(ExtractorSettings)])
"""The layout of `ExtractorSettings.as_record`."""
