"""Finds the door opposite: the door that faces another door, or the robot."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_env.language.references import LAST, OTHER, Side
from semnav_env.language.told import told
from semnav_env.mind.grounding.door_geometry import heading_through, shared_width
from semnav_env.mind.grounding.search import Known, Searching
from semnav_env.mind.grounding.situation import Situation
from semnav_env.mind.grounding.visible_doors import doors_across, own_doorway
from semnav_features.frames import Pose, compose, heading_between, to_local
from semnav_features.kernels.corridor_rays import BODY_WIDTH
from semnav_features.scene import Door

ORDINALS_OF_ONE = (1, LAST, OTHER)
"""Ordinals that are allowed for a single door."""

VIEW_HEADINGS = {Side.AHEAD: 0.0, Side.LEFT: math.pi / 2, Side.RIGHT: -math.pi / 2}
"""Headings of the views from the robot's own place, from the corridor's axis, radians."""


@dataclass(frozen=True, slots=True)
class AcrossView:
    """A view straight across.

    Attributes:
        pose: pose of the view, scene frame.
        side: side of the view.
        door: the door from whose middle the view starts; None for the robot's position.
    """

    pose: Pose
    side: Side
    door: Door | None = None

    @property
    def half_width(self) -> float:
        """Half of the width of the view, metres."""
        return (BODY_WIDTH if self.door is None else self.door.width) / 2

    def faced(self, situation: Situation) -> Door | None:
        """The door with the largest overlap with this width; None if no door overlaps."""
        rules = situation.rules.grounding
        from_robot = self.door is None
        most = rules.opposite_robot_distance if from_robot else rules.opposite_door_distance
        shares = {
            door: shared_width(door, self.pose, self.half_width)
            for door in doors_across(situation.scene, self.pose, self.door, rules)
            if to_local(self.pose, door.midpoint)[0] <= most
        }
        best = max(shares, key=shares.__getitem__, default=None)
        return best if best is not None and shares[best] > 0.0 else None

    def is_done(self, situation: Situation) -> bool:
        """Whether everything in this view has been seen."""
        if self.door is None:
            return self._is_inspected(situation)
        out = to_local(self.pose, situation.pose[:2])[0]
        stepped_out = out > situation.rules.grounding.across_distance
        return stepped_out and situation.looks_along(self.pose[2])

    def search(self, situation: Situation, what: object) -> Searching:
        """The search in this view: by turning, or by coming out of the doorway."""
        if not situation.scene.walls:
            return Searching(told(what), situation.begin)
        if not situation.looks_along(self.pose[2]):
            return situation.turn_to(self.pose[2], what)
        step = situation.rules.grounding.lookout_step
        return Searching(told(what), compose(self.pose, (step, 0.0, 0.0)))

    def _is_inspected(self, situation: Situation) -> bool:
        """Whether a robot in a corridor has seen this side.

        The robot faces ahead and sees the walls beside it, so it turns only to a gap on one side;
        gaps on both sides are a crossing.
        """
        if self.side is Side.AHEAD:
            return bool(situation.scene.walls)
        left = self.side is Side.LEFT
        one_gap = self._is_gap(situation, left) and not self._is_gap(situation, not left)
        return not one_gap or situation.looks_along(self.pose[2])

    def _is_gap(self, situation: Situation, left: bool) -> bool:
        """Whether a part of a side, within the width of the view, is no wall or unseen."""
        here = situation.corridor.along(self.pose[:2])
        width = (here - self.half_width, here, here + self.half_width)
        return any(math.isinf(situation.corridor.side_at(left, along)) for along in width)


def doors_opposite(
    reference: object, situation: Situation
) -> Known[dict[AcrossView, Door]] | Searching:
    """The doors opposite, by the views that meet them.

    After a clause to a door, or past it, the view starts at that door. In a doorway the view goes
    through the doorway. In other cases there are views ahead and to both sides.
    """
    view = view_from_door(situation)
    views = _views_from_robot(situation) if view is None else [view]
    met = {each: door for each in views if (door := each.faced(situation)) is not None}
    missing = [each for each in views if not each.is_done(situation)]
    if met or situation.complete or not missing:
        return Known(met)
    return missing[0].search(situation, reference)


def view_from_door(situation: Situation) -> AcrossView | None:
    """The view from the door of the clause before, or from the doorway of the robot."""
    begin, door = situation.begin, situation.beside
    about = begin[2]
    if door is not None:
        about = heading_between(door.midpoint, begin[:2])
    else:
        door = own_doorway(situation.scene, begin, situation.rules.grounding)
    if door is None:
        return None
    return AcrossView((*door.midpoint, heading_through(door, about)), Side.OPPOSITE, door)


def _views_from_robot(situation: Situation) -> list[AcrossView]:
    axis = (*situation.begin[:2], situation.corridor.frame[2])
    return [
        AcrossView(compose(axis, (0.0, 0.0, heading)), side)
        for side, heading in VIEW_HEADINGS.items()
    ]
