"""Finds commands that people could judge in another way than the rules: closed doors, glass.

The rules of grounding count what a scan can show. An episode whose command is impossible, or whose
route depends on a condition, must be judged alike by people who count closed or wide doors, or who
do not see a pane of glass.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property

from semnav_env.language import Clause, DoorReference, Follow, GoToDoor, IfThere, Turn
from semnav_env.language.command import reference_of
from semnav_env.mind.grounding import Goal, GroundingError, UnclearError, ground
from semnav_env.mind.grounding.conditions import is_met
from semnav_env.mind.grounding.goal import door_of
from semnav_env.mind.grounding.junctions import junctions_ahead
from semnav_env.mind.grounding.search import Known
from semnav_env.mind.grounding.situation import Situation
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.placement import is_clear
from semnav_features.corridor import Corridor, corridor_at
from semnav_features.frames import Pose
from semnav_features.scene import PlainWalls, Scene

MAX_INSPECTED_LENGTH = 40.0
"""Longest stretch of corridor that a person can be asked to search, metres."""

LOOKOUT_DISTANCE = 1.5
"""Distance from the end of a corridor to the place from which it must be possible to look at the
end, metres."""

LOOKOUT_CLEARANCE = 0.45
"""Free radius around that place, metres: half the width of a robot and a little more."""


class AmbiguityFilter:
    """Judges commands in every scene that people could see in a floor plan.

    Args:
        plan: the floor plan.
    """

    def __init__(self, plan: FloorPlan) -> None:
        self._plan = plan

    @cached_property
    def scenes(self) -> tuple[Scene, ...]:
        """The scenes: by the rules, with closed and wide doors that count, and without glass."""
        plan = self._plan
        doors = tuple(door.as_door() for door in plan.doors)
        return (
            plan.scene,
            replace(plan.scene, doors=doors),
            replace(plan.scene, walls=PlainWalls(plan.opaque_segments)),
        )

    def met(self, condition: IfThere, begin: Pose) -> bool | None:
        """Whether a condition is met; None if people could disagree or not find out."""
        answers = {
            is_met(condition, Situation(scene, begin, begin, complete=True))
            for scene in self.scenes
        }
        if len(answers) > 1:
            return None
        (answer,) = answers
        met = isinstance(answer, Known) and answer.value
        there = met is not condition.absent
        return met if there or self._seen_to_end(begin) else None

    def impossible(self, clause: Clause, begin: Pose) -> bool:
        """Whether a clause is impossible in every scene, and the robot can find out that it is.

        A turn is impossible if too few junctions of any kind lead to its side; another place, if
        there are too few of any kind.
        """
        if not self._seen_to_end(begin):
            return False
        views = [corridor_at(scene, begin) for scene in self.scenes]
        if isinstance(reference_of(clause), DoorReference):
            return all(_is_missing(clause, scene, begin) for scene in self.scenes)
        return all(_too_few(clause, view) for view in views)

    def _seen_to_end(self, begin: Pose) -> bool:
        """Whether the end of a corridor can be inspected, and no corridor continues around a bend.

        It is also False if a part beside the corridor is neither a side nor an opening.
        """
        for scene in self.scenes:
            seen = corridor_at(scene, begin)
            if seen.end > MAX_INSPECTED_LENGTH or any(j.is_corner for j in junctions_ahead(seen)):
                return False
        seen = corridor_at(self._plan.scene, begin)
        if any(math.isfinite(seen.unseen(left, 0.0, seen.end)) for left in (True, False)):
            return False
        before = seen.place(max(0.0, seen.end - LOOKOUT_DISTANCE))
        return is_clear(self._plan, before[:2], LOOKOUT_CLEARANCE)

    def is_behind_a_closed_one(self, first: GoToDoor, begin: Pose) -> bool:
        """Whether the first door is closed and the second one is the first open door."""
        doors = [door_of(goal) for goal in self._first_two(first, begin)]
        shut = {door.name for door in self._plan.doors if not door.open}
        if len(doors) < 2 or doors[0] is None or doors[0].name not in shut:
            return False
        try:
            return doors[1] == door_of(ground(first, self._plan.scene, begin, complete=True))
        except GroundingError:
            return False

    def _first_two(self, clause: GoToDoor, begin: Pose) -> Iterator[Goal]:
        for ordinal in (1, 2):
            door = replace(clause.door, ordinal=ordinal)
            try:
                yield ground(replace(clause, door=door), self.scenes[1], begin, complete=True)
            except GroundingError:
                return


def _is_missing(clause: Clause, scene: Scene, begin: Pose) -> bool:
    try:
        ground(clause, scene, begin, complete=True)
    except UnclearError:
        return False
    except GroundingError:
        return True
    return False


def _too_few(clause: Clause, view: Corridor) -> bool:
    place = reference_of(clause)
    if place is None or place.ordinal < 1 or not isinstance(clause, Turn | Follow):
        return False
    turning = clause.turning if isinstance(clause, Turn) else None
    return len(junctions_ahead(view, turning=turning)) < place.ordinal
