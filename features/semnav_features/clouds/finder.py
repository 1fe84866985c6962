"""Finds the jambs of an expected door: one plane through both, solid beside them, open between."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from semnav_features.clouds.crop import CropBox, crop_mask
from semnav_features.clouds.detected_door import DetectedDoor, frame_of
from semnav_features.clouds.evidence import StripRules, strips_along
from semnav_features.clouds.jamb_pair import JambPair, JambRules, best_pair, settled
from semnav_features.clouds.point_cloud import PointCloud
from semnav_features.clouds.reveal import DoorLine, RevealRules, door_line, jamb_middle
from semnav_features.clouds.wall_line import LineSearch, WallLine, wall_lines
from semnav_features.elements import Door
from semnav_features.frames import (
    FloatArray,
    Pose,
    compose,
    points_to_local,
    to_local,
    to_parent,
)
from semnav_features.rules import DoorRules

EDGE_SIGMA, LINE_SIGMA, WIDTH_SIGMA = 0.02, 0.02, 0.08
"""Standard deviations, metres: of a jamb along the wall (a strip), of the line across it (half the
step between wall and frame), and of a width that was not seen."""


MAX_SIGMA = 0.5
"""Largest standard deviation of a door's place that makes the search wider, metres: farther off
another door is as likely."""


@dataclass(frozen=True)
class DoorFinder:
    """Finds a door near where it is expected.

    The cloud is cut around the expected door, with a margin for its uncertainty. First the wall's
    line is found in it, then for each strip of the line how solid it is and how much was seen
    through it. A door is the pair of edges with the most solid wall beside it and the most open
    space between, with a plausible width, near the expected door.

    Attributes:
        margins: of the crop.
        search: for the line.
        strips: sizes of the strips.
        jambs: rules for jambs.
        reveal: how the middles of the jambs are found.
        widths: range of the widths of doors.
    """

    margins: CropBox = field(default_factory=lambda: CropBox(along=0.5, across=0.3, sigmas=3.0))
    search: LineSearch = field(default_factory=LineSearch)
    strips: StripRules = field(default_factory=StripRules)
    jambs: JambRules = field(default_factory=JambRules)
    reveal: RevealRules = field(default_factory=RevealRules)
    widths: DoorRules = field(default_factory=DoorRules)

    def find_door(self, cloud: PointCloud, expected: Door, sigma: float) -> DetectedDoor | None:
        """The door in a cloud; None where neither jamb is found, or `widths` rule it out.

        Args:
            cloud: robot frame; `fused` makes one of several.
            expected: where the door should be, robot frame.
            sigma: standard deviation of that place, metres; at most `MAX_SIGMA` counts.

        Raises:
            ValueError: see `crop`.
        """
        frame, cloud = frame_of(expected), cloud.thinned()
        if not self.widths.narrowest <= expected.width <= self.widths.widest:
            return None
        sigma = min(sigma, MAX_SIGMA)
        near = crop_mask(cloud.points_robot, expected, sigma, self.margins)
        points, origins = (_local(frame, each) for each in (cloud.points_robot, cloud.origins))
        reach = 0.5 * expected.width + self.margins.along + self.margins.sigmas * sigma
        found: list[tuple[JambPair, WallLine]] = []
        for line in wall_lines(points[near], sigma, self.search):
            arrays = _local(line.frame, points), _local(line.frame, origins)
            strips = strips_along(*arrays, reach, self.strips)
            pair = best_pair(strips, expected.width, sigma, self.widths, self.jambs)
            found += [] if pair is None else [(pair, line)]
        if not found:
            return None
        pair, line = max(found, key=lambda each: each[0].score + self._prior(each[1], sigma))
        return self._measured(pair, line, frame, points[near], expected.width)

    def _measured(
        self, pair: JambPair, line: WallLine, frame: Pose, points: FloatArray, width: float
    ) -> DetectedDoor | None:
        """The door of a pair after the measurement of its jambs from the side."""
        pair_found = settled(pair, width, self.jambs)
        if pair_found is None:
            return None
        side = math.copysign(1.0, to_local(line.frame, to_local(frame, (0.0, 0.0)))[1])
        local = _local(line.frame, points)
        jambs = []
        for jamb in (pair_found.start, pair_found.end):
            middle = jamb_middle(local, jamb.place, side, self.reveal) if jamb.seen else None
            jambs += [] if middle is None else [(jamb.place, middle)]
        door = door_line(line, jambs, self.reveal)
        return _placed(pair_found, compose(compose(frame, line.frame), door.frame), door)

    def _prior(self, line: WallLine, sigma: float) -> float:
        """Agreement of a line with the expected one, in the units of `JambPair.score`."""
        offset = line.offset**2 / (sigma**2 + LINE_SIGMA**2)
        turn = (line.slope / self.search.turn_sigma) ** 2
        return line.support - self.jambs.prior * (offset + turn)


def find_door(
    cloud: PointCloud, expected: Door, sigma: float = 0.1, finder: DoorFinder = DoorFinder()
) -> DetectedDoor | None:
    """The door of a cloud that was expected at a place, see `DoorFinder.find_door`.

    Args:
        cloud: robot frame; `fused` makes one of several.
        expected: where the door should be, robot frame; `expect_door` tells.
        sigma: standard deviation of that place, metres.
        finder: its limits.

    Raises:
        ValueError: a sigma that is negative or not finite, or an expected door without a width.
    """
    return finder.find_door(cloud, expected, sigma)


SHUT_DOORS = DoorFinder(
    search=LineSearch(band=0.04, cell=0.02, lines=8), strips=StripRules(band=0.02, beyond=0.03)
)
"""For doors that a leaf shuts: it lies some centimetres behind the front of the frame, so with
smaller limits the leaf is what is seen through the line of both jambs."""


def find_shut_door(
    cloud: PointCloud, expected: Door, sigma: float = 0.1, finder: DoorFinder = SHUT_DOORS
) -> DetectedDoor | None:
    """The door of a cloud that a leaf shuts, see `find_door`; ask that first.

    None where only one jamb is seen: on walls, too, there are edges a few centimetres deep.
    """
    found = finder.find_door(cloud, expected, sigma)
    return found if found is not None and found.start_seen and found.end_seen else None


def _local(frame: Pose, points: FloatArray) -> FloatArray:
    return np.column_stack((points_to_local(frame, points[:, :2]), points[:, 2]))


def _placed(pair: JambPair, frame: Pose, line: DoorLine) -> DetectedDoor:
    """The pair in the robot frame, with its covariance.

    Across the line both jambs err with it; along the line each errs by itself, and one that was
    not seen also by the width of the door.
    """
    ends = pair.start.place, pair.end.place
    across = np.array([[0.0, 0.0], [1.0, ends[0]], [0.0, 0.0], [1.0, ends[1]]])
    covariance = across @ line.covariance @ across.T
    covariance += EDGE_SIGMA**2 * np.diag([1.0, 0.0, 1.0, 0.0])
    for row, seen in ((0, pair.start.seen), (2, pair.end.seen)):
        if not seen:
            covariance[row, row] += WIDTH_SIGMA**2
    c, s = math.cos(frame[2]), math.sin(frame[2])
    turn = np.kron(np.eye(2), np.array([[c, -s], [s, c]]))
    start, end = (to_parent(frame, (along, 0.0)) for along in ends)
    covariance = turn @ covariance @ turn.T
    return DetectedDoor(start, end, pair.confidence, covariance, pair.start.seen, pair.end.seen)
