"""How well scans are matched: against exact simulated pairs, and against a corrected log."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from semnav_env.robots import WHEELCHAIR
from semnav_env.world.lidar import Lidar, LidarSpec, lidar_spec
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.placement import sample_pose
from semnav_features.frames import FloatArray, Point, Pose, compose, relative
from semnav_features.mapping import Match, MatchError, MatchSettings, match_scans
from semnav_features.readers import LogRecord
from semnav_features.scan import Scan

Way = tuple[Point, Point]
"""A straight way that a robot can take, metres."""

POSE_CLEARANCE = 0.3
"""Least distance from a sampled pose to anything, metres."""

CHI_SQUARE_95 = 7.815
"""95 % of a chi-square with three degrees of freedom lies below this."""


@dataclass(frozen=True)
class PairSpec:
    """How simulated pairs are drawn.

    Attributes:
        sigma: standard deviation of every range, metres.
        moved: least and largest distance between the two poses, metres.
        turned: least and largest angle between them, radians; either way.
        guess_position: how far off the first guess is, metres, in any direction.
        guess_angle: how far off its heading is, radians, either way.
    """

    sigma: float = 0.01
    moved: tuple[float, float] = (0.1, 0.3)
    turned: tuple[float, float] = (math.radians(5.0), math.radians(15.0))
    guess_position: float = 0.06
    guess_angle: float = math.radians(2.0)


@dataclass(frozen=True, eq=False, slots=True)
class Pair:
    """Two scans, the true pose of the second in the frame of the first, and a first guess."""

    reference: Scan
    scan: Scan
    pose: Pose
    guess: Pose


@dataclass(frozen=True, slots=True)
class PairError:
    """One match against the truth.

    Attributes:
        position: metres.
        angle: radians, not negative.
        nees: normalised error squared e^T C^-1 e, chi-square with three degrees of freedom if
            the covariance C is right.
        seconds: that it took.
        undetermined: whether the match says so.
    """

    position: float
    angle: float
    nees: float
    seconds: float
    undetermined: bool


def poses_on(ways: Sequence[Way], rng: np.random.Generator) -> Iterator[Pose]:
    """Poses uniform along the ways, any heading, without end."""
    lengths = np.array([math.dist(*way) for way in ways])
    while True:
        (x1, y1), (x2, y2) = ways[rng.choice(len(ways), p=lengths / lengths.sum())]
        share = rng.random()
        yield x1 + share * (x2 - x1), y1 + share * (y2 - y1), rng.uniform(-math.pi, math.pi)


def poses_in(plan: FloorPlan, rng: np.random.Generator) -> Iterator[Pose]:
    """Poses in the corridors of a plan where a wheelchair can stand, without end."""
    while True:
        yield sample_pose(plan, WHEELCHAIR, rng)


def read_ways(path: str | Path) -> tuple[Way, ...]:
    """The edges of a `.navigation.json` graph, the companion of a vector map.

    Raises:
        ValueError: not such a file.
        OSError: the file cannot be opened.
    """
    try:
        graph = json.loads(Path(path).read_text("utf-8"))
        places = {n["id"]: (float(n["loc"]["x"]), float(n["loc"]["y"])) for n in graph["nodes"]}
        return tuple([(places[edge["s0_id"]], places[edge["s1_id"]]) for edge in graph["edges"]])
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(
            f"{path}: not a navigation graph ({error}); it must have nodes with an id and a loc, "
            "and edges with s0_id and s1_id"
        ) from None


def simulated_pairs(
    plan: FloorPlan,
    poses: Iterable[Pose],
    rng: np.random.Generator,
    spec: PairSpec = PairSpec(),
    lidar: str | LidarSpec = "tim561",
) -> Iterator[Pair]:
    """A pair of scans for each pose; none for a pose that has no room around it.

    Args:
        plan: what the lidar sees.
        poses: of the lidar for the first scan of a pair.
        rng: source of everything random.
        spec: how the second is drawn.
        lidar: its sigma is replaced by that of `spec`; it never drops a beam.
    """
    sensor = Lidar(plan, replace(lidar_spec(lidar), sigma=spec.sigma, dropout=0.0))
    for first in poses:
        pose = _moved((0.0, 0.0, 0.0), rng.uniform(*spec.moved), rng.uniform(*spec.turned), rng)
        second = compose(first, pose)
        if min(_clearance(sensor, first), _clearance(sensor, second)) < POSE_CLEARANCE:
            continue
        guess = _moved(pose, spec.guess_position, spec.guess_angle, rng)
        key = int(rng.integers(2**31))
        yield Pair(sensor.scan(first, (key, 0, 0)), sensor.scan(second, (key, 0, 1)), pose, guess)


@dataclass(frozen=True, slots=True)
class LogDifference:
    """Three successive scans a, b, c of a log: how well their matches agree.

    Attributes:
        position: between the match of a with b and the log's poses, metres.
        angle: the same, radians.
        loop_position: between the match of a with c and those of a with b and b with c, one after
            the other, metres: no pose of the log has a part in it.
        loop_angle: the same, radians.
    """

    position: float
    angle: float
    loop_position: float
    loop_angle: float


def log_differences(
    records: Iterable[LogRecord], settings: MatchSettings = MatchSettings()
) -> Iterator[LogDifference]:
    """Match the successive scans of a log that has poses, from the motion before as a guess.

    Scans without a match are left out.
    """
    moved: Pose = (0.0, 0.0, 0.0)
    last: list[LogRecord] = []
    for record in records:
        last = [*last[-2:], record]
        if len(last) < 3:
            continue
        a, b, c = last
        if a.pose is None or b.pose is None:
            raise ValueError("the log says no poses to compare with")
        try:
            first = match_scans(a.scan, b.scan, moved, settings).pose
            second = match_scans(b.scan, c.scan, first, settings).pose
            both = match_scans(a.scan, c.scan, compose(first, second), settings).pose
        except MatchError:
            moved = (0.0, 0.0, 0.0)
            continue
        moved = first
        x, y, turn = relative(relative(a.pose, b.pose), first)
        u, v, loop = relative(compose(first, second), both)
        yield LogDifference(math.hypot(x, y), abs(turn), math.hypot(u, v), abs(loop))


def errors_of(
    pairs: Iterable[Pair], settings: MatchSettings = MatchSettings()
) -> Iterator[PairError]:
    """Match each pair and compare; a pair that cannot be matched is infinitely wrong."""
    for pair in pairs:
        start = time.perf_counter()
        try:
            match = match_scans(pair.reference, pair.scan, pair.guess, settings)
        except MatchError:
            yield PairError(math.inf, math.inf, math.inf, time.perf_counter() - start, False)
            continue
        yield _error(match, pair.pose, time.perf_counter() - start)


def _error(match: Match, truth: Pose, seconds: float) -> PairError:
    turn = relative(truth, match.pose)[2]
    error: FloatArray = np.array((match.pose[0] - truth[0], match.pose[1] - truth[1], turn))
    nees = float(error @ np.linalg.solve(match.covariance, error))
    position = math.hypot(error[0], error[1])
    return PairError(position, abs(turn), nees, seconds, match.undetermined is not None)


def _moved(pose: Pose, distance: float, turn: float, rng: np.random.Generator) -> Pose:
    """A pose so far away in any direction, turned so far either way."""
    heading = rng.uniform(-math.pi, math.pi)
    side = 1.0 if rng.random() < 0.5 else -1.0
    x, y = pose[0] + distance * math.cos(heading), pose[1] + distance * math.sin(heading)
    return x, y, pose[2] + side * turn


def _clearance(sensor: Lidar, pose: Pose) -> float:
    return float(sensor.exact_ranges(pose).min())
