"""Every limit of the feature extractor, with its unit and its source."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from enum import IntEnum

import numpy as np

from semnav_env.features.rules import DoorRules
from semnav_env.features.strategies import BreakpointRule, Segmentation, strategy_names

_RECORD_TYPES = {"float": "f8", "int": "i8", "bool": "?", "str": "i8"}
_STRATEGIES: dict[str, type[IntEnum]] = {
    "breakpoint_rule": BreakpointRule,
    "segmentation": Segmentation,
}
"""What the fields that hold a name choose from; the kernels get the number behind the name."""

_DOOR = DoorRules()


@dataclass(frozen=True)
class ExtractorSettings:
    """Limits of the chain from a scan to a scene. Lengths in metres, angles in radians.

    "Thesis" is Barbret 2021. Defaults without a source were chosen by measurement on simulated
    office corridors with sigma 20 mm.

    Attributes:
        rupture_range: a longer range counts as no return, metres (thesis (2.1): 6; the
            TiM561 reaches 10, and doors and junctions beyond 6 m are worth having).
        sigma: standard deviation of a range, metres (TiM561 data sheet: 0.02).
        veil_angle: removes mixed pixels, which are beams that ended between two surfaces: there
            the lines to both neighbours are met at less than this angle, radians. 0 keeps all;
            5 to 10 degrees remove the mixed pixels at edges and no wall (`kernels.filters`).
        median_beams: number of beams on either side over which a range is the median, where that
            moves no edge; 0 takes it as it is.
        breakpoint_rule: how far apart neighbouring points may be: "constant", "borges_aldon",
            "certad", "dietmayer", "santos", "lee" or "weerakoon"; the equations are in
            `kernels.breakpoints`. "certad" is the rule of the thesis (2.3), "borges_aldon", made
            the same for both directions of the sweep.
        breakpoint_angle: lambda of the adaptive breakpoint, the flattest incidence at which
            neighbouring points are still joined, radians (thesis (2.3): 10 degrees, which loses
            the far part of a corridor's walls). Not read by "constant", "dietmayer" and "lee".
        breakpoint_distance: C0 of "constant", "dietmayer" and "santos", metres.
        breakpoint_ratio: largest |r1 - r2| / (r1 + r2) of neighbouring ranges, for "lee".
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
        merge_offset: largest step between two walls that are taken for one, metres.
        robust_fit: fit every line once more with less weight on points that are off it.
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
        door_wall_gap: how far before the jamb a supporting wall may end, metres; door frames
            break the fit.
        door_depth: beams through the opening reach this far beyond its chord, metres. The distance
            is measured along the beam and not across the chord, so that an open leaf seen through
            a grazing gap does not hide the door.
        door_clear_fraction: least share of the beams between the jambs that reach `door_depth`.
        door_recess: least depth across the chord that some beam must reach, metres: a closed door
            lies less deep in its frame, and so does a niche.
        door_shadow: if a beam beside a jamb ends this far in front of the chord, metres, the jamb
            is only the edge of a shadow.
        door_beams: fewest beams through an opening.
        door_confidence_min: least confidence of a door, 0 to 1: higher is fewer false doors and
            more missed ones. At 0.6 the F1 in simulated offices full of furniture is highest.
        one_sided_doors: accept doors with a wall in line on one side only, or on none.
        arcs: look for columns and curved walls.
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
        corridor_probe: how far a corner is probed for an opposite wall, metres (thesis 3.3).
        corridor_wall_slack: a probed wall may end this far beside the probe, metres.
        corridor_angle_tolerance: how far from square a probe may meet a wall, radians.
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

    rupture_range: float = 10.0
    sigma: float = 0.02
    veil_angle: float = 0.0
    median_beams: int = 0
    breakpoint_rule: str = "certad"
    breakpoint_angle: float = math.radians(4.0)
    breakpoint_distance: float = 0.2
    breakpoint_ratio: float = 0.05
    dropout_beams: int = 2
    segmentation: str = "end_point_fit"
    split_distance: float = 0.08
    wall_beams: int = 5
    wall_length: float = 0.2
    merge_gap: float = 0.3
    merge_offset: float = 0.015
    robust_fit: bool = False
    confidence: float = 2.0
    door_width_min: float = _DOOR.width_min
    door_width_max: float = _DOOR.width_max
    door_width_tolerance: float = _DOOR.width_tolerance
    door_angle_tolerance: float = math.radians(4.0)
    door_point_tolerance: float = 0.05
    door_wall_gap: float = 0.4
    door_depth: float = 0.15
    door_clear_fraction: float = 0.4
    door_recess: float = 0.2
    door_shadow: float = 0.3
    door_beams: int = 3
    door_confidence_min: float = 0.6
    one_sided_doors: bool = True
    arcs: bool = True
    arc_radius_min: float = 0.1
    arc_radius_max: float = 10.0
    arc_extent_min: float = math.radians(20.0)
    arc_sagitta_min: float = 0.06
    arc_beams: int = 8
    arc_residual: float = 0.03
    corner_angle: float = math.radians(50.0)
    corner_gap: float = 0.3
    corner_fuse: float = 0.1
    corridor_probe: float = 2.5
    corridor_wall_slack: float = 0.2
    corridor_angle_tolerance: float = math.radians(30.0)
    corridor_half_width: float = 0.3
    corridor_distance_min: float = 0.5
    corridor_distance_max: float = 6.0

    def __post_init__(self) -> None:
        for field in fields(self):
            value, kind = getattr(self, field.name), str(field.type)
            checked = _checked_name if kind == "str" else _checked_number
            object.__setattr__(self, field.name, checked(field.name, value, kind))
        for small, large in _ORDER:
            if getattr(self, small) > getattr(self, large):
                raise ValueError(
                    f"{small} is {getattr(self, small)}; it must not exceed {large}, "
                    f"which is {getattr(self, large)}"
                )

    @property
    def door_rules(self) -> DoorRules:
        """What counts as a door by these settings."""
        return DoorRules(self.door_width_min, self.door_width_max, self.door_width_tolerance)

    def with_doors(self, rules: DoorRules) -> ExtractorSettings:
        """The same settings with other doors."""
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
    """What the record holds for a value: of a strategy its number."""
    return value if not isinstance(value, str) else _STRATEGIES[name][value.upper()]


def _checked_name(name: str, value: object, kind: str) -> str:
    names = strategy_names(_STRATEGIES[name])
    if not isinstance(value, str) or value not in names:
        raise ValueError(f"{name} is {value!r}; it must be one of {', '.join(names)}")
    return value


def _checked_number(name: str, value: float, kind: str) -> float:
    number = _number(name, value, kind)
    low, high = _LIMITS.get(name, _LENGTH)
    if not low <= number <= high:
        raise ValueError(f"{name} is {number}; it must be from {low:g} to {high:g}")
    return number


def _number(name: str, value: float, kind: str) -> float:
    if kind == "bool":
        if not isinstance(value, (bool, np.bool_)):
            raise ValueError(f"{name} is {value!r}; it must be True or False")
        return bool(value)
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise ValueError(f"{name} is {value!r}; it must be a number") from None
    if kind == "int":
        if not math.isfinite(number) or number != math.floor(number):
            raise ValueError(f"{name} is {value!r}; it must be a whole number")
        return int(number)
    return number


_LENGTH = (0.0, 1000.0)
_RIGHT_ANGLE = math.pi / 2
_LIMITS = {
    "rupture_range": (0.1, 1000.0),
    "veil_angle": (0.0, _RIGHT_ANGLE / 2),
    "median_beams": (0, 4),
    "breakpoint_angle": (math.radians(0.1), _RIGHT_ANGLE),
    "breakpoint_ratio": (0.0, 0.9),
    "dropout_beams": (0, 10),
    "split_distance": (1e-4, 10.0),
    "wall_beams": (2, 10_000),
    "wall_length": (0.01, 100.0),
    "robust_fit": (0, 1),
    "confidence": (0.0, 10.0),
    "door_angle_tolerance": (0.0, _RIGHT_ANGLE / 2),
    "door_clear_fraction": (0.0, 1.0),
    "door_confidence_min": (0.0, 1.0),
    "door_beams": (1, 10_000),
    "one_sided_doors": (0, 1),
    "arcs": (0, 1),
    "arc_radius_min": (0.01, 1000.0),
    "arc_extent_min": (math.radians(1.0), 2.0 * math.pi),
    "arc_beams": (4, 10_000),
    "corner_angle": (math.radians(5.0), math.radians(175.0)),
    "corridor_angle_tolerance": (0.0, _RIGHT_ANGLE),
}
_ORDER = (
    ("door_width_min", "door_width_max"),
    ("merge_gap", "door_width_min"),
    ("arc_radius_min", "arc_radius_max"),
    ("corridor_distance_min", "corridor_distance_max"),
)

RECORD = np.dtype([(f.name, _RECORD_TYPES[str(f.type)]) for f in fields(ExtractorSettings)])
"""The layout of `ExtractorSettings.as_record`."""
