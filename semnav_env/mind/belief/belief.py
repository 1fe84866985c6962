"""What a robot believes after a scan."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from semnav_env.mind.grounding.goal import Goal
from semnav_features.frames import Pose, Twist
from semnav_features.scene import Scene


class SceneSource(Protocol):
    """Makes a scene when it is asked for, because few beliefs are asked."""

    def scene(self) -> Scene:
        """All walls and doors that count."""
        ...


class Belief(NamedTuple):
    """What a robot believes after a scan, in the odometry frame.

    The origin of the odometry frame is where odometry was zero, as a rule the start.

    Attributes:
        pose: of the robot's centre.
        velocity: of the robot, as odometry gives it.
        clause: index of the clause under way; the number of clauses when all are done.
        goal: where that clause leads.
        target: where to drive now: the goal, or a place on the way while the known way is long; the
            entry "goal" of the observation.
        impossible: why the clause cannot be carried out; None if it can.
        memory: what `scene` is made of.
    """

    pose: Pose
    velocity: Twist
    clause: int
    goal: Goal
    target: Goal
    impossible: str | None
    memory: SceneSource

    @property
    def scene(self) -> Scene:
        """The remembered walls and doors that count, and the walls that were bumped into."""
        return self.memory.scene()

    @property
    def reasons(self) -> tuple[str, ...]:
        """What the goal was understood from; after it, why the clause cannot be carried out."""
        goal = (self.goal.because,)
        return goal if self.impossible in (None, *goal) else (*goal, str(self.impossible))
