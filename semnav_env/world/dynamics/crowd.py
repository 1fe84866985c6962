"""People who walk in a floor plan."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely

from semnav_env.world.dynamics.destinations import Destinations, look_ahead
from semnav_env.world.dynamics.nearby import culled_walls
from semnav_env.world.dynamics.orca import orca
from semnav_env.world.dynamics.settings import Dynamics
from semnav_env.world.dynamics.social_force import social_force
from semnav_env.world.dynamics.walking import walk
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.geodesic import WaysTo
from semnav_features.frames import FloatArray, Point, Pose

MAX_PLACEMENT_DRAWS = 400
"""Largest number of places drawn for one person; where none of them is free, the plan counts as
full."""

START_CLEARANCE = 1.5
"""Least distance from the robot's centre at which a person begins, metres: nobody stands in the way
of its first steps."""

ARRIVAL_DISTANCE = 0.5
"""Length of way left at which a person has arrived and chooses another place, metres."""

LEAST_PROGRESS = 0.2
"""Least decrease of the remaining path that counts as progress, metres; less is swaying in a
jam."""


class Crowd:
    """People, each on the way to a room, corridor or intersection, and then to another.

    Args:
        plan: the plan as drawn; ways lead through the doors that are open there.
        still: the plan without what can move.
        dynamics: number of people and how they walk.

    Attributes:
        places: positions, metres, shape (n, 2).
        velocities: velocities after collisions, m/s, shape (n, 2).
    """

    def __init__(self, plan: FloorPlan, still: FloorPlan, dynamics: Dynamics) -> None:
        self._plan, self._dynamics = plan, dynamics
        self._stand_still()
        self._walls = culled_walls(still.segments)
        self._model = orca if dynamics.model == "orca" else social_force
        self._routes = Destinations(plan)

    def begin(self, start: Pose, rng: np.random.Generator) -> None:
        """Put each person at a free place and choose their first destinations.

        Args:
            start: pose of the robot; no person begins near it.
            rng: source of randomness for the whole episode.

        Raises:
            ValueError: there is no room for so many people.
        """
        self._stand_still()
        walking, count = self._dynamics.walking, len(self.places)
        self._rng = rng
        spread = np.clip(rng.standard_normal(count), -2.0, 2.0) * walking.spread
        self._speeds = walking.speed + spread
        self._ways: list[WaysTo] = []
        for i in range(count):
            self.places[i], ways = self._free_place(i, start)
            self._ways.append(ways)
        self._best = np.full(count, np.inf)
        self._waited = np.zeros(count)

    def _stand_still(self) -> None:
        """As many people as the settings say, before they have places."""
        count = self._dynamics.pedestrians
        self.places, self.velocities, self._wishes = (np.zeros((count, 2)) for _ in range(3))

    def add(self, place: Point, robot: Pose) -> None:
        """Let one more person walk from a place, until the next episode.

        Args:
            place: metres.
            robot: its pose; the person keeps `START_CLEARANCE` from it.

        Raises:
            ValueError: the place is not free, or leads nowhere.
        """
        count = len(self.places)
        rng = np.random.default_rng(count)  # of its own: who is refused draws nothing
        free = self._is_free(place, count, robot)
        ways = self._ways_to_another_place(place, rng) if free else None
        if ways is None:
            right = f"a free place {START_CLEARANCE} m or more from the robot, with a way elsewhere"
            raise ValueError(f"person is {place}; it must be {right}")
        self._ways.append(ways)
        self.places = np.vstack((self.places, place))
        self.velocities, self._wishes = (
            np.vstack((rows, (0.0, 0.0))) for rows in (self.velocities, self._wishes)
        )
        self._speeds = np.append(self._speeds, self._dynamics.walking.speed)
        self._best, self._waited = np.append(self._best, np.inf), np.append(self._waited, 0.0)

    def step(
        self, body: FloatArray, leaves: FloatArray, guard: float, touch: float, seconds: float
    ) -> None:
        """Let all people walk for a time step.

        Args:
            body: the robot, see `nearest_on_body`.
            leaves: segments that move, shape (m, 4).
            guard: distance of `walk`, metres.
            touch: distance of `walk`, metres.
            seconds: length of the step.
        """
        if len(self.places) == 0:
            return
        walking = self._dynamics.walking
        self._update_wishes(seconds)
        wanted = np.empty_like(self.velocities)
        around = walking.radius, self._walls, leaves, body
        self._model(
            self.places, self.velocities, self._wishes, *around, walking.see_robot, seconds, wanted
        )
        self.velocities[:] = wanted
        walk(self.places, self.velocities, *around, guard, touch, seconds)

    def __getstate__(self) -> dict[str, Any]:
        """Without the ways, which are large; `begin` finds them again."""
        return {key: value for key, value in self.__dict__.items() if key != "_ways"}

    def _update_wishes(self, seconds: float) -> None:
        """Update the desired velocities; arrived and stuck people choose another place."""
        for i, ways in enumerate(self._ways):
            x, y = self.places[i]
            ahead, aside, left = look_ahead(*ways.field, x, y)
            self._wishes[i] = self._speeds[i] * ahead, self._speeds[i] * aside
            nearer = left < self._best[i] - LEAST_PROGRESS
            self._best[i] = left if nearer else self._best[i]
            self._waited[i] = 0.0 if nearer else self._waited[i] + seconds
            if left < ARRIVAL_DISTANCE or self._waited[i] > self._dynamics.walking.patience:
                self._ways[i] = self._ways_to_another_place((x, y), self._rng) or ways
                self._best[i], self._waited[i] = math.inf, 0.0

    def _ways_to_another_place(self, place: Point, rng: np.random.Generator) -> WaysTo | None:
        """The ways to a place that can be reached from there; None if none was found."""
        for index in rng.permutation(len(self._routes.places))[:8]:
            ways = self._routes.to(int(index))
            if ARRIVAL_DISTANCE < look_ahead(*ways.field, *place)[2] < math.inf:
                return ways
        return None

    def _free_place(self, i: int, start: Pose) -> tuple[Point, WaysTo]:
        for _ in range(MAX_PLACEMENT_DRAWS):
            place = self._random_place()
            if self._is_free(place, i, start):
                ways = self._ways_to_another_place(place, self._rng)
                if ways is not None:
                    return place, ways
        raise ValueError(
            f"{self._plan.name} has room for {i} people beside the robot, not for "
            f"{len(self.places)}; ask for fewer pedestrians"
        )

    def _random_place(self) -> Point:
        """Uniform over the rectangle around a random region, or around the boundary."""
        regions = self._plan.regions
        area = regions[self._rng.integers(len(regions))].polygon if regions else self._plan.boundary
        west, south, east, north = area.bounds
        x, y = self._rng.uniform((west, south), (east, north))
        return float(x), float(y)

    def _is_free(self, place: Point, i: int, start: Pose) -> bool:
        if math.dist(place, start[:2]) < START_CLEARANCE:
            return False
        radius, point = self._dynamics.walking.radius, shapely.Point(place)
        apart = np.hypot(*(self.places[:i] - place).T)
        if (apart < 2.5 * radius).any() or not self._plan.boundary.contains(point):
            return False
        return len(self._plan.solids.query(point, "dwithin", radius + 0.05)) == 0
