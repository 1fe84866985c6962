"""How far it still is to the goal of the clause under way, on the floor plan."""

from __future__ import annotations

from semnav_env.features.frames import Pose
from semnav_env.maps.geodesic import Geodesic, WaysTo
from semnav_env.verifier.goals import place
from semnav_env.verifier.verifier import Verifier


class RemainingWay:
    """The shortest way to the goal of the active clause.

    Args:
        verifier: of the episode; knows the active clause and its goal.
        geodesic: shortest ways of the floor plan.
    """

    def __init__(self, verifier: Verifier, geodesic: Geodesic) -> None:
        self._verifier, self._geodesic = verifier, geodesic
        self._completed = -1
        self._ways: WaysTo

    def length(self, pose: Pose) -> float:
        """Length of the shortest way from a pose, metres; 0 when all clauses are done."""
        follower = self._verifier.follower
        if follower.done:
            return 0.0
        if self._completed != self._verifier.completed:
            self._completed = self._verifier.completed
            self._ways = self._geodesic.to(place(follower.goal))
        return self._ways.length((pose[0], pose[1]))
