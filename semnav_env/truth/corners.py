"""Corners between walls in view, and the corridors that the extractor would make of them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_env.features.frames import Point
from semnav_env.features.reference.corners import FoundCorner
from semnav_env.features.reference.corridors import find_corridors
from semnav_env.features.reference.sweep import Sweep
from semnav_env.features.reference.walls import Piece
from semnav_env.features.scan import Scan
from semnav_env.features.scene import Arc, Corner, CornerKind, CorridorProbe, Wall
from semnav_env.features.settings import ExtractorSettings
from semnav_env.truth.runs import WallRun


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


def true_corridors(
    scan: Scan, walls: list[Wall], joints: list[Joint], settings: ExtractorSettings
) -> tuple[CorridorProbe, ...]:
    """The extractor's corridors (its NumPy reference) of the walls that it would take for walls.

    Args:
        scan: without errors.
        walls: in view.
        joints: of these walls.
        settings: which walls are long and dense enough, and what a corridor is.
    """
    pieces = {
        (wall.start, wall.end): Piece([], np.array((wall.start, wall.end)))
        for wall in walls
        if wall.length >= settings.wall_length and wall.beams >= settings.wall_beams
    }

    def piece(wall: Wall | None) -> Piece | None:
        return None if wall is None else pieces.get((wall.start, wall.end))

    corners = [
        FoundCorner(joint.point, joint.kind, piece(joint.ending), piece(joint.starting))
        for joint in joints
        if all(piece(wall) for wall in (joint.ending, joint.starting) if wall)
    ]
    sweep = Sweep.of(scan, settings)
    return tuple(find_corridors(sweep, list(pieces.values()), corners, settings))
