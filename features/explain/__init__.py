"""Why candidates were turned down: the kernels' own tests, asked once more about each.

The kernels keep no notes, as that would cost time at every scan. What they worked with is still in
their working memory afterwards, so the same predicates are put to it again, one by one, and the
reasons cannot differ from what was done.
"""

from __future__ import annotations

from semnav_env.features.elements import Rejection
from semnav_env.features.explain.corners import rejected_corners
from semnav_env.features.explain.corridors import rejected_corridors
from semnav_env.features.explain.trace import Trace
from semnav_env.features.explain.walls import rejected_walls

__all__ = ["Trace", "rejections"]


def rejections(trace: Trace) -> tuple[Rejection, ...]:
    """Every candidate that was turned down, by kind."""
    return (*rejected_walls(trace), *rejected_corners(trace), *rejected_corridors(trace))
