"""Measures of one episode, and their means over many."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from semnav_env.judge.metrics.motion import collisions_per_100m
from semnav_env.judge.metrics.risk import cvar

COST_METRICS = frozenset(
    (
        "collisions",
        "collisions_per_100m",
        "goal_distance",
        "jerk",
        "path_length",
        "route_length",
        "seconds",
    )
)
"""Names of the measures whose high values are bad."""


@dataclass(frozen=True)
class Metrics:
    """The measures of one episode; docs/concepts/metrics.md gives their formulas.

    NaN stands for a measure that an episode does not have: an impossible command has no SPL and
    sDTW.

    Attributes:
        success: the whole command was carried out; doors count by their identity.
        within_1m: ended within 1 m of the goal, geodesic.
        within_3m: ended within 3 m of the goal, geodesic.
        oracle_success: the last clause's goal was met at any time.
        oracle_within_1m: some point of the path lies within 1 m of the goal, geodesic.
        oracle_within_3m: some point of the path lies within 3 m of the goal, geodesic.
        spl: success weighted by path length.
        soft_spl: progress weighted by path length.
        ndtw: normalised dynamic time warping.
        sdtw: success weighted by it.
        cls: coverage weighted by length score.
        clauses: share of the clauses that were done.
        contact_free: nothing was touched.
        collisions: contacts that began.
        collisions_per_100m: of path.
        least_clearance: least distance of the body from anything solid, metres.
        mean_clearance: mean of it over time, metres.
        jerk: root mean square, m/s^3.
        goal_distance: distance from the end of the path to the goal, geodesic, metres.
        path_length: length of the path of the robot's centre, Euclidean, metres.
        route_length: length of the shortest way through all goals, geodesic, metres.
        seconds: simulated time.
    """

    success: bool
    within_1m: bool
    within_3m: bool
    oracle_success: bool
    oracle_within_1m: bool
    oracle_within_3m: bool
    spl: float
    soft_spl: float
    ndtw: float
    sdtw: float
    cls: float
    clauses: float
    contact_free: bool
    collisions: int
    collisions_per_100m: float
    least_clearance: float
    mean_clearance: float
    jerk: float
    goal_distance: float
    path_length: float
    route_length: float
    seconds: float


METRIC_NAMES = tuple(Metrics.__dataclass_fields__)
"""Names of all measures, in the order of the columns of a table."""


def means(episodes: Sequence[Metrics]) -> dict[str, float]:
    """The mean of each measure; for collisions per 100 m, the mean over the path of all episodes.

    Raises:
        ValueError: no episodes.
    """
    average = worst(episodes, 1.0)
    count, way = (sum(getattr(e, name) for e in episodes) for name in ("collisions", "path_length"))
    return average | {"collisions_per_100m": collisions_per_100m(count, way)}


def worst(episodes: Sequence[Metrics], share: float) -> dict[str, float]:
    """The mean of each measure over its own worst episodes that have it, see `cvar`; or NaN.

    Args:
        episodes: measures of at least one episode.
        share: share of the episodes, in (0, 1].

    Raises:
        ValueError: no episodes, or a share outside (0, 1].
    """
    found = {}
    for name in METRIC_NAMES:
        values = [float(getattr(episode, name)) for episode in episodes]
        known = [value for value in values if not math.isnan(value)]
        found[name] = cvar(known or values, share, name in COST_METRICS)
    return found
