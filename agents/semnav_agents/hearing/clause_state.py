"""The memory of an agent that hears the command about its active clause."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semnav_env.language.declarations import TokenVerb
from semnav_env.language.tokens import CLAUSE_FEATURES, CONDITION_CASES
from semnav_env.mind.grounding.ways import WAY_SPACING, Trail
from semnav_features.frames import FloatArray, Point, Pose, to_local

STANDSTILL_SPEED = 0.05
"""Speed below which a robot counts as standing, m/s."""


class ClauseState:
    """The agent's own index of the active clause, and the events since that clause began.

    All places are in the odom frame. Nothing here comes from the environment's grounding.

    Args:
        tokens: of the command, shape (8, 5).
        pose: of the robot where the command begins.

    Attributes:
        tokens: of the command.
        clause: index of the active clause.
        begin: pose at which that clause began.
        farthest: the place at which the robot was farthest along the heading of `begin`.
        still: time for which the robot has stood, seconds.
        way_back: places to the start of the command, shape (n, 2), while the clause is to go back.
    """

    def __init__(self, tokens: NDArray[np.integer], pose: Pose) -> None:
        self.tokens = np.asarray(tokens, np.int64).reshape(-1, CLAUSE_FEATURES)
        self._trail, self.still, self.pose = Trail(pose), 0.0, pose
        self.start_clause(0, pose, pose)

    @property
    def done(self) -> bool:
        """Whether every clause has been carried out."""
        return self.clause >= len(self.tokens) or not self.tokens[self.clause].any()

    @property
    def step_when_done(self) -> int:
        """Number of clauses to advance when the active one is carried out.

        After a branch of a condition, the "otherwise" branch is skipped.
        """
        verb, case = self.tokens[self.clause - 1, :2] if self.clause else (TokenVerb.FOLLOW, 0)
        return 2 if verb == TokenVerb.IF_THERE and CONDITION_CASES[case][1] else 1

    @property
    def heading_at_start(self) -> float:
        """The heading with which the command began, radians."""
        return self._trail.back(self.pose).heading

    def start_clause(self, clause: int, begin: Pose, pose: Pose) -> None:
        """Make a clause the active one.

        Args:
            clause: its index.
            begin: pose at which it begins: the goal of the clause before.
            pose: of the robot.
        """
        self.clause, self.begin, self.farthest, self.still = clause, begin, pose[:2], 0.0
        self._farthest_along = to_local(begin, pose[:2])[0]
        goes_back = not self.done and self.tokens[clause, 0] == TokenVerb.GO_BACK
        self.way_back: FloatArray | None = (
            np.array(self._trail.back(pose).places) if goes_back else None
        )

    def note(self, pose: Pose, speed: float, seconds: float) -> None:
        """Note the robot's pose; call it in every control period."""
        self.pose = pose
        self.still = self.still + seconds if speed < STANDSTILL_SPEED else 0.0
        place: Point = pose[:2]
        along = to_local(self.begin, place)[0]
        if along > self._farthest_along:
            self.farthest, self._farthest_along = place, along
        if np.hypot(*np.subtract(place, self._trail.end)) >= WAY_SPACING:
            self._trail.note(pose)
