"""Ways to carry out a command, rightly and wrongly, for the tests of what judges them."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np

from semnav_agents.oracle import OracleAgent
from semnav_env.judge import Judge, Motion, place
from semnav_env.judge.metrics import Recording
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import FloatArray, Point, wrap_angle

PERIOD = 1.0 / 15.0


class ErringAgent:
    """An oracle whose steering is off by noise and bias, and that gives up at some time."""

    observation = "truth"

    def __init__(self, seed: int) -> None:
        self._oracle = OracleAgent()
        self._rng = np.random.default_rng(seed)

    def read_plan(self, floor_plan: FloorPlan) -> None:
        self._oracle.read_plan(floor_plan)

    def reset(self, info: dict[str, Any]) -> None:
        self._oracle.reset(info)
        rng = self._rng
        self._noise = rng.choice((0.0, 0.3, 1.0))
        self._bias = rng.choice((0.0, 0.0, 0.4)) * rng.choice((-1.0, 1.0))
        self._patience = rng.choice((30, 120, 10_000))

    def act(self, observation: dict[str, Any]) -> np.ndarray:
        action = self._oracle.act(observation)
        self._patience -= 1
        if self._patience < 0:
            return np.zeros_like(action)
        action = action + self._rng.normal(0.0, self._noise, len(action))
        action[-1] += self._bias
        return np.clip(action, -1.0, 1.0).astype(np.float32)


def ghost(
    judge: Judge,
    points: list[Point],
    rng: np.random.Generator,
    *,
    wobble: float = 0.0,
    pause: float = 0.0,
    stand: float = 0.0,
) -> Recording:
    """Glide from point to point until the judge has seen enough; nothing is solid.

    Args:
        judge: told every step.
        points: where to, by the shortest ways.
        rng: of speed and wobble.
        wobble: how far aside it may get, metres.
        pause: seconds to stand still at each point.
        stand: seconds to stand still at the end.
    """
    speed, start = float(rng.uniform(0.5, 1.5)), judge.mission.start[:2]
    aside = rng.uniform(-1e-3, 1e-3, 2)  # not through the very jambs, which lie on the grid
    path = np.array([start])
    for a, b in pairwise([start, *points]):
        leg = _timed(judge.mission.geodesic.to(b).way(a) + aside, speed)
        if wobble > 0.0:
            errors = np.cumsum(rng.normal(0.0, 0.1 * wobble, leg.shape), axis=0)
            leg += np.clip(errors, -wobble, wobble)
        path = np.vstack((path, leg, np.repeat(leg[-1:], round(pause / PERIOD), axis=0)))
    path = np.vstack((path, np.repeat(path[-1:], round(stand / PERIOD), axis=0)))
    poses = np.column_stack((path, _headings(path, judge.mission.start[2])))
    velocities = np.zeros((len(path), 3))
    velocities[1:, 0] = np.hypot(*np.diff(path, axis=0).T) / PERIOD
    turns = [wrap_angle(turn) for turn in np.diff(poses[:, 2]).tolist()]
    velocities[1:, 2] = np.array(turns) / PERIOD
    rows = _judged(judge, poses, velocities)
    return Recording(
        poses[:rows], velocities[:rows], np.zeros(rows, dtype=np.int64), np.zeros(rows), PERIOD
    )


def targets(plan: FloorPlan, judge: Judge, rng: np.random.Generator) -> list[Point]:
    """The places of the goals, or with errors: others, too few, another door first."""
    points = [_beyond(goal) for goal in judge.mission.goals]
    kind = rng.integers(5)
    door = plan.doors[rng.integers(len(plan.doors))].midpoint
    if kind == 1:
        points = [*points[:-1], door]
    elif kind == 2:
        points = [door, *points]
    elif kind == 3:
        points = points[:-1]
    elif kind == 4:
        corridor = plan.corridors[rng.integers(len(plan.corridors))]
        centre = corridor.polygon.representative_point()
        points = [(centre.x, centre.y), *points]
    return points


def _beyond(goal: Any) -> Point:
    """A little behind where a goal leads to, along its heading."""
    x, y = place(goal)
    return x + 0.4 * math.cos(goal.pose[2]), y + 0.4 * math.sin(goal.pose[2])


def _timed(way: FloatArray, speed: float) -> FloatArray:
    """A point every period at one speed."""
    steps = np.hypot(*np.diff(way, axis=0).T)
    along = np.concatenate(([0.0], np.cumsum(steps)))
    times = np.arange(0.0, along[-1] + speed * PERIOD, speed * PERIOD)
    return np.column_stack([np.interp(times, along, way[:, i]) for i in (0, 1)])


def _headings(path: FloatArray, start: float) -> FloatArray:
    """Along the way, smoothed over a second; the last one while standing."""
    headings, ahead = [start], 7
    for step in range(1, len(path)):
        low, high = path[max(0, step - ahead)], path[min(len(path) - 1, step + ahead)]
        dx, dy = (high - low).tolist()
        headings.append(math.atan2(dy, dx) if math.hypot(dx, dy) > 1e-6 else headings[-1])
    return np.array(headings)


def _judged(judge: Judge, poses: FloatArray, velocities: FloatArray) -> int:
    """Tell the judge every step until it is over; the rows that it was told of."""
    steps = zip(poses[1:].tolist(), velocities[1:].tolist(), strict=True)
    for row, ((x, y, heading), (forward, _, turn)) in enumerate(steps, start=2):
        judge.update(Motion((x, y, heading), forward, turn, False, PERIOD))
        if judge.over:
            return row
    judge.out_of_time()
    return len(poses)
