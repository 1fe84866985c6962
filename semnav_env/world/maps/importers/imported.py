"""Result of every importer: a floor plan and a report of what was read."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from shapely import Polygon, box

from semnav_env.world.maps.floor_plan import FloorPlan, Surface

BOUNDARY_MARGIN = 1.0
"""Distance from the outermost wall to the boundary, metres."""


@dataclass(frozen=True)
class ImportReport:
    """Report of an import: what was read, and what was not.

    Attributes:
        source: the files.
        kind: kind of map, in words.
        taken: number of things of each kind in the plan.
        left_out: parts that were not imported, one line each with the reason.
        notes: further remarks, one line each.
    """

    source: tuple[str, ...]
    kind: str
    taken: dict[str, int]
    left_out: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def with_left_out(self, more: Sequence[str]) -> ImportReport:
        """The report with further lines of what was left out."""
        return replace(self, left_out=(*self.left_out, *more))

    def __str__(self) -> str:
        """The report as lines of text."""
        taken = ", ".join(counted(count, name) for name, count in self.taken.items())
        lines = [f"{self.kind}: {', '.join(self.source)}", f"taken: {taken or 'nothing'}"]
        lines += [f"left out: {line}" for line in self.left_out]
        return "\n".join([*lines, *(f"note: {line}" for line in self.notes)])


def counted(number: int, things: str) -> str:
    """A number of things, as "1 open door" and "2 open doors"."""
    return f"{number} {things.removesuffix('s') if number == 1 else things}"


class ImportedPlan(NamedTuple):
    """A plan and the report of how it was read; unpack it as `plan, report = ...`."""

    plan: FloorPlan
    report: ImportReport


def boundary_of(surfaces: Sequence[Surface]) -> Polygon:
    """A rectangle around everything solid, with a margin."""
    points = [point for surface in surfaces for point in surface.points]
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return box(
        min(xs) - BOUNDARY_MARGIN,
        min(ys) - BOUNDARY_MARGIN,
        max(xs) + BOUNDARY_MARGIN,
        max(ys) + BOUNDARY_MARGIN,
    )
