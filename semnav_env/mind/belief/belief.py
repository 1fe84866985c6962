"""The belief of a robot after a scan."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from semnav_env.language.clauses import Speed
from semnav_env.mind.grounding.goal import Goal
from semnav_features.frames import Pose, Twist
from semnav_features.scene import Scene


class SceneSource(Protocol):
    """Makes a scene on request, because few beliefs are asked for their scene."""

    def scene(self) -> Scene:
        """All walls and doors that count."""
        ...


class Belief(NamedTuple):
    """The belief of a robot after a scan, in the odom frame.

    The origin of the odom frame is the pose at which odometry was zero, as a rule the start.

    Attributes:
        pose: pose of the robot's centre.
        velocity: velocity of the robot by odometry.
        clause: index of the active clause; the number of clauses when all are done.
        goal: goal of that clause.
        target: the goal to drive to now: the goal of the clause, or a place on a known way that is
            still long; the entry "goal" of the observation.
        impossible: reason why the clause cannot be carried out; None if it can.
        memory: the source of `scene`.
        pace: how fast to drive now, by what was said; None for the usual pace.
    """

    pose: Pose
    velocity: Twist
    clause: int
    goal: Goal
    target: Goal
    impossible: str | None
    memory: SceneSource
    pace: Speed | None = None

    @property
    def scene(self) -> Scene:
        """The remembered walls and doors that count, and the walls of the bump map."""
        return self.memory.scene()

    @property
    def reasons(self) -> tuple[str, ...]:
        """The reason for the goal, followed by why the clause is impossible, if it is."""
        goal = (self.goal.because,)
        return goal if self.impossible in (None, *goal) else (*goal, self.impossible)
