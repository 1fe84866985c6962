"""Explains why candidates were rejected, by the tests that the kernels themselves apply.

The kernels record no reasons, as that would cost time at every scan. After a scan their candidates
are still in the working memory; the same predicates are applied to each of them again, so that the
reasons cannot differ from what was done.
"""

from __future__ import annotations

from semnav_features.elements import Rejection
from semnav_features.explain.corners import rejected_corners
from semnav_features.explain.corridors import rejected_corridors
from semnav_features.explain.doors import rejected_doors
from semnav_features.explain.trace import Trace
from semnav_features.explain.walls import rejected_walls

__all__ = ["Trace", "rejections"]


def rejections(trace: Trace) -> tuple[Rejection, ...]:
    """Every rejected candidate, by kind."""
    walls, doors = rejected_walls(trace), rejected_doors(trace)
    return (*walls, *doors, *rejected_corners(trace), *rejected_corridors(trace))
