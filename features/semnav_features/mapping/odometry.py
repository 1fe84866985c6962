"""Odometry from scans alone: each scan is matched with a keyframe."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from semnav_features.frames import ORIGIN, Pose, compose, relative
from semnav_features.mapping.far_matching import match_by_corners
from semnav_features.mapping.matching import (
    DEFAULT_MATCH_SETTINGS,
    Match,
    MatchError,
    ReferenceLines,
    match_surfaces,
    surface_of,
)
from semnav_features.mapping.settings import MatchSettings
from semnav_features.scan import Scan


@dataclass(frozen=True)
class KeyframeRule:
    """Rules for making a scan the next keyframe.

    Attributes:
        distance: distance from the last keyframe at which a scan becomes one, metres.
        angle: the same for the heading change, radians.
        inliers: a scan also becomes a keyframe if a smaller share of its points than this lies on
            the last one.
        trusted: least share of points on the keyframe for a valid match.
        corners: whether a scan that matches badly, or not at all, is matched again from guesses by
            its corners.
        trusted_corners: least share of points on the keyframe for a valid match of that kind.
        lost: number of successive scans without a match after which the last becomes a keyframe.
    """

    distance: float = 0.5
    angle: float = math.radians(20.0)
    inliers: float = 0.6
    trusted: float = 0.3
    corners: bool = False
    trusted_corners: float = 0.5
    lost: int = 3


class _Placed(NamedTuple):
    """A scan and its pose."""

    scan: Scan
    surface: ReferenceLines
    pose: Pose


class ScanOdometry:
    """The pose of the lidar in the frame of its first scan, from scans alone.

    Every scan is matched with the last keyframe rather than with its predecessor, so that errors
    add up only from keyframe to keyframe; where the keyframe shows too little of what the scan
    shows, as behind a door, the predecessor becomes the keyframe. The first guess assumes the same
    motion as between the two scans before.

    Args:
        settings: of the matches.
        rule: when a scan becomes a keyframe.

    Attributes:
        pose: of the last scan in the frame of the first; (0, 0, 0) before any.
        match: of the last scan with its keyframe; None where there is none.
        keyframes: number of keyframes.
        lost: number of scans without a match; for these the guess is taken.
    """

    keyframes: int
    lost: int

    def __init__(
        self,
        settings: MatchSettings = DEFAULT_MATCH_SETTINGS,
        rule: KeyframeRule = KeyframeRule(),
    ) -> None:
        self.pose: Pose = ORIGIN
        self.match: Match | None = None
        self.keyframes = 0
        self.lost = 0
        self._settings = settings
        self._rule = rule
        self._keyframe: _Placed | None = None
        self._last: _Placed | None = None
        self._moved: Pose = ORIGIN
        self._lost_in_a_row = 0

    def update(self, scan: Scan, moved: Pose | None = None) -> Pose:
        """Process the next scan, and return its pose.

        Args:
            scan: the scan.
            moved: a guess of its pose in the frame of the scan before, such as from wheel odometry.

        Returns:
            Its pose in the frame of the first scan.
        """
        surface = surface_of(scan, self._settings)
        if self._last is not None:
            guess = compose(self.pose, self._moved if moved is None else moved)
            found = self._found(surface, guess)
            if self._rule.corners and _inliers(self.match) < self._rule.inliers:
                found = self._found_by_corners(scan, guess) or found
            self._lost_in_a_row = 0 if found else self._lost_in_a_row + 1
            self.lost += found is None
            self._moved = relative(self.pose, found or guess)
            self.pose = found or guess
        self._last = _Placed(scan, surface, self.pose)
        if self._leaves_keyframe():
            self._keep(self._last)
        return self.pose

    def _found(self, surface: ReferenceLines, guess: Pose) -> Pose | None:
        """The pose of a scan, matched with the keyframe or else with the scan before it."""
        assert self._keyframe is not None
        assert self._last is not None
        self.match = self._match(self._keyframe, surface, guess)
        if _inliers(self.match) < self._rule.inliers and self._last is not self._keyframe:
            again = self._match(self._last, surface, guess)
            if _inliers(again) > _inliers(self.match):
                self.match = again
                self._keep(self._last)
        if _inliers(self.match) < self._rule.trusted:
            self.match = None
        return compose(self._keyframe.pose, self.match.pose) if self.match else None

    def _found_by_corners(self, scan: Scan, guess: Pose) -> Pose | None:
        """The pose of a scan far from its guess, by corners; None if that is no better match."""
        for reference in (self._keyframe, self._last):
            assert reference is not None
            start = relative(reference.pose, guess)
            try:
                match = match_by_corners(reference.scan, scan, start, self._settings)
            except MatchError:
                continue
            if match.inliers >= max(self._rule.trusted_corners, _inliers(self.match)):
                if reference is not self._keyframe:
                    self._keep(reference)
                self.match = match
                return compose(reference.pose, match.pose)
        return None

    def _match(self, reference: _Placed, surface: ReferenceLines, guess: Pose) -> Match | None:
        start = relative(reference.pose, guess)
        try:
            return match_surfaces(reference.surface, surface, start, self._settings)
        except MatchError:
            return None

    def _leaves_keyframe(self) -> bool:
        if self._keyframe is None:
            return True
        if self.match is None:
            return self._lost_in_a_row >= self._rule.lost
        x, y, heading_change = self.match.pose
        return (
            math.hypot(x, y) > self._rule.distance
            or abs(heading_change) > self._rule.angle
            or self.match.inliers < self._rule.inliers
        )

    def _keep(self, scan: _Placed) -> None:
        self._keyframe = scan
        self.keyframes += 1
        self._lost_in_a_row = 0


def _inliers(match: Match | None) -> float:
    """Share of the points that lie on the reference, 0 without a match."""
    return match.inliers if match else 0.0
