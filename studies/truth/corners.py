"""Corners between walls in view."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_features.frames import Point
from semnav_features.scene import Arc, Corner, CornerKind, Wall
from studies.truth.runs import WallRun


@dataclass(frozen=True)
class Joint:
    """A corner and the walls that end and start there."""

    point: Point
    kind: CornerKind
    ending: Wall | None
    starting: Wall | None

    @property
    def corner(self) -> Corner:
        """As a scene holds it."""
        return Corner(self.point, self.kind)


def find_joints(run: WallRun, least_turn: float) -> list[Joint]:
    """The corners of a run in beam order.

    Walls that meet at a turn of at least `least_turn` radians make a full corner: an outer one
    if they turn left, away from the lidar, an inner one if they turn right (Barbret (3.1)). An
    end with a rupture or a break is a potential corner.
    """
    joints = []
    first, last = run.pieces[0], run.pieces[-1]
    if isinstance(first, Wall) and (first.start_break or first.start_rupture):
        joints.append(Joint(first.start, CornerKind.POTENTIAL, None, first))
    following = [*run.pieces[1:], *([first] if run.closed else [])]
    for a, b in zip(run.pieces, following, strict=False):
        if joint := _meeting(a, b, least_turn):
            joints.append(joint)
    if isinstance(last, Wall) and (last.end_break or last.end_rupture):
        joints.append(Joint(last.end, CornerKind.POTENTIAL, last, None))
    return joints


def _meeting(a: Wall | Arc, b: Wall | Arc, least_turn: float) -> Joint | None:
    if isinstance(a, Arc) or isinstance(b, Arc):
        return None
    turn = math.remainder(b.heading - a.heading, math.tau)
    if abs(turn) < least_turn:
        return None
    return Joint(b.start, CornerKind.OUTER if turn > 0.0 else CornerKind.INNER, a, b)
