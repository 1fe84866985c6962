"""Doors that open and close at random times and stop before what is in their way."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.world.dynamics.leaves import PlanLeaf
from semnav_env.world.dynamics.nearby import nearest_on_body, nearest_on_segment
from semnav_env.world.dynamics.settings import Dynamics
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.validation import require


class SwingingDoors:
    """The leaves of a plan's doors.

    All of them stand at first as the plan draws them. Those that change in an episode close and
    open again and again, each after a random time. A leaf that would come too near to somebody or
    to the robot stops, and goes on once there is room.

    Args:
        leaves: leaves of the doors that can open and close.
        dynamics: settings of how many do, and how.

    Attributes:
        leaves: the leaves as given.
        angles: angle by which each stands open, radians, with the sign of its swing, shape (m,).
        segments: hinge and tip of each, metres, shape (m, 4); always the same array.
    """

    def __init__(self, leaves: tuple[PlanLeaf, ...], dynamics: Dynamics) -> None:
        self.leaves, self._dynamics = leaves, dynamics
        self.angles = np.zeros(len(leaves))
        self.segments = np.zeros((len(leaves), 4))
        self.begin(np.random.default_rng(0))

    def begin(self, rng: np.random.Generator) -> None:
        """Open all of them and draw which ones will change, and when first."""
        self._rng = rng
        chosen = rng.random(len(self.leaves)) < self._dynamics.changing_doors
        self._closing = chosen.copy()
        self._held = np.zeros(len(self.leaves), dtype=bool)
        self._wait = np.full(len(self.leaves), np.inf)
        self._wait[chosen] = rng.uniform(0.0, self._dynamics.swinging.open_for[1], chosen.sum())
        for i, leaf in enumerate(self.leaves):
            self._turn(i, leaf.swing)

    def hold(self, door: str, shut: bool) -> None:
        """Shut a door by hand, or open it; it stays so until the next episode.

        Its leaf swings as the others do. See `World.hold_door`.

        Args:
            door: name of a door that is among `leaves`.
            shut: whether it is to be shut.

        Raises:
            ValueError: none of the leaves is that door's.
        """
        names = [leaf.door for leaf in self.leaves]
        require(
            door in names,
            "door",
            door,
            f"one of those with a leaf that can swing: {', '.join(names) or 'there is none'}",
        )
        i = names.index(door)
        self._closing[i], self._held[i], self._wait[i] = shut, True, 0.0

    @property
    def closed(self) -> tuple[str, ...]:
        """Names of the doors that are shut."""
        pairs = zip(self.leaves, self.angles, strict=True)
        return tuple(leaf.door for leaf, angle in pairs if angle == 0.0)

    def step(
        self, seconds: float, places: FloatArray, radius: float, body: FloatArray, guard: float
    ) -> None:
        """Let leaves swing for a time step.

        Args:
            seconds: length of the step.
            places: positions of people, metres, shape (n, 2).
            radius: radius of a person, metres.
            body: the robot, see `nearest_on_body`.
            guard: metres that stay free between a leaf that moves and the robot.
        """
        swinging = self._dynamics.swinging
        for i, leaf in enumerate(self.leaves):
            self._wait[i] -= seconds
            if self._wait[i] > 0.0:
                continue
            goal = 0.0 if self._closing[i] else leaf.swing
            if self.angles[i] == goal and self._held[i]:
                continue
            if self.angles[i] == goal:
                self._closing[i] = not self._closing[i]
                times = swinging.open_for if goal else swinging.closed_for
                self._wait[i] = self._rng.uniform(*times)
                continue
            most = swinging.rate * seconds
            angle = self.angles[i] + min(max(goal - self.angles[i], -most), most)
            if _has_way(leaf.hinge, leaf.tip(angle), places, radius, body, guard):
                self._turn(i, angle)

    def _turn(self, i: int, angle: float) -> None:
        leaf = self.leaves[i]
        self.angles[i] = angle
        self.segments[i] = (*leaf.hinge, *leaf.tip(angle))


@kernel
def _has_way(
    hinge: tuple[float, float],
    tip: tuple[float, float],
    places: FloatArray,
    radius: float,
    body: FloatArray,
    guard: float,
) -> bool:
    """Whether a leaf in some position keeps its distance from people and the robot."""
    for k in range(len(places)):
        x, y = places[k]
        near_x, near_y = nearest_on_segment(x, y, hinge[0], hinge[1], tip[0], tip[1])
        if math.hypot(x - near_x, y - near_y) < radius + 0.02:
            return False
    pieces = math.ceil(math.hypot(tip[0] - hinge[0], tip[1] - hinge[1]) / 0.05)
    for k in range(pieces + 1):
        share = k / pieces
        x, y = hinge[0] + share * (tip[0] - hinge[0]), hinge[1] + share * (tip[1] - hinge[1])
        near_x, near_y = nearest_on_body(x, y, body)
        if math.hypot(x - near_x, y - near_y) < guard:
            return False
    return True
