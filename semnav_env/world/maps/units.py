"""Detects by the widths of doors that a plan is drawn in another unit than metres."""

from __future__ import annotations

import math
from collections.abc import Iterable
from statistics import median

from semnav_env.world.maps.doorways import WIDE_DOOR

UNITS = {"metres": 1.0, "feet": 0.3048, "inches": 0.0254, "centimetres": 0.01, "millimetres": 0.001}
"""Units that buildings are drawn in, metres."""

USUAL_WIDTH = 0.9
"""Width of most doors, metres."""

CERTAIN_WIDTH = 20.0
"""Width of the doors of a plan, their median, that no building has, metres."""


def unit_fault(widths: Iterable[float]) -> str | None:
    """The fault of a plan whose doors are too wide for metres; None if the widths are plausible.

    Args:
        widths: of the doors, metres if the plan keeps to the rules.
    """
    known = sorted(width for width in widths if math.isfinite(width))
    if not known or known[0] < WIDE_DOOR:
        return None
    middle = median(known)
    unit = min(UNITS, key=lambda name: abs(math.log(middle * UNITS[name] / USUAL_WIDTH)))
    return (
        f"doors are {middle:,.4g} m wide: the plan seems to be drawn in {unit}; "
        f"`semnav map import` makes metres of them with --drawing.scale {UNITS[unit]:g}"
    )


def certain_unit_fault(widths: Iterable[float]) -> str | None:
    """Like `unit_fault`, but only for widths that no building has."""
    known = [width for width in widths if math.isfinite(width)]
    return unit_fault(known) if known and median(known) >= CERTAIN_WIDTH else None
