"""A vector map that grows scan by scan: walls as lines, and the doors between them."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.elements import Door, Wall
from semnav_features.frames import Point, Pose, relative, to_local, to_parent, wrap_angle
from semnav_features.mapping.association import LineIndex
from semnav_features.mapping.duplicate_walls import without_duplicates
from semnav_features.mapping.line_cells import MAX_BEAM_LENGTH
from semnav_features.mapping.lines import Line, gap, line_of
from semnav_features.mapping.map_doors import MapDoors
from semnav_features.mapping.map_settings import MapSettings
from semnav_features.mapping.map_wall import MapWall
from semnav_features.scan import Scan
from semnav_features.scene import Scene

_CLEANUP_PERIOD = 50
"""Period in which false walls are removed, scans."""


class LineMap:
    """Walls and doors of many scans, joined in one frame.

    A new wall is compared with the known lines that are its neighbours in (theta, d). If one
    differs by no more than both uncertainties allow, and the two segments overlap or nearly so,
    they are fused, weighted by their covariances, and the known one is extended (Weerakoon et al.,
    II-E and figure 5). This closes no passage, because a wall exists only where beams ended: every
    scan says for every cell of the walls around it whether a beam ended there, and cells that were
    seen through are not part of the wall.

    Args:
        settings: every limit.

    Attributes:
        scans: number of scans that were added.
        repeated: number of scans that were left out, because the lidar had not moved.
    """

    scans: int
    repeated: int

    def __init__(self, settings: MapSettings | None = None) -> None:
        self._settings = settings or MapSettings()
        self._walls: list[MapWall | None] = []
        self._table = np.zeros((0, 5))
        self._doors = MapDoors(self._settings)
        self.scans = self.repeated = 0
        self._last: Pose | None = None

    def add(self, scene: Scene, scan: Scan, pose: Pose) -> None:
        """Add a scan, unless the lidar has not moved since the last one.

        Args:
            scene: the scene of the scan, lidar frame.
            scan: the scan itself, whose beams show occupied and free space.
            pose: of the lidar in the map's frame.
        """
        if self._last is not None and not self._moved(self._last, pose):
            self.repeated += 1
            return
        self._last = pose
        self.scans += 1
        self._add_walls(scene, pose)
        for k in self._within_reach(pose[:2]):
            if (wall := self._walls[k]) is not None:
                wall.observe(scan, pose)
        self._doors.add(scene.doors, scan, pose)
        if self.scans % _CLEANUP_PERIOD == 0:
            self._tidy()

    @property
    def walls(self) -> tuple[Wall, ...]:
        """The existing parts of the walls, in the map's frame."""
        s = self._settings
        there = [
            wall.as_wall(stretch)
            for wall in self._walls
            if wall is not None
            for stretch in wall.solid(s.wall_hits, s.wall_share, s.gap)
            if stretch[1] - stretch[0] >= s.wall_length
        ]
        return without_duplicates(there)

    @property
    def doors(self) -> tuple[Door, ...]:
        """The doors that were seen often enough and stayed open, in the order first seen."""
        return self._doors.believed

    @property
    def scene(self) -> Scene:
        """Walls and doors in the map's frame."""
        return Scene(self.walls, self.doors)

    def _add_walls(self, scene: Scene, pose: Pose) -> None:
        s = self._settings
        names = np.array(self._within_reach(pose[:2]), dtype=np.intp)
        index = LineIndex(self._table[names, :3], names, pose[:2])
        for wall in scene.walls:
            if _distance(wall) > s.wall_reach:
                continue
            line = line_of(wall, pose, s.position, s.angle)
            ends = to_parent(pose, wall.start), to_parent(pose, wall.end)
            new = MapWall.of(line, *ends, self.scans)
            same = [k for k in self._candidates(new, index) if self._is_one(k, new)]
            if same:
                self._join(same, new)
            else:
                self._set(len(self._walls), new)

    def _join(self, same: list[int], new: MapWall) -> None:
        """Fuse a new wall with a known one, and the result with other walls that now match."""
        first, *others = same
        known = self._walls[first]
        assert known is not None
        known.absorb(new)
        for k in others:
            other = self._walls[k]
            if other is not None and self._is_one(k, known):
                known.absorb(other)
                self._set(k, None)
        self._set(first, known)

    def _set(self, k: int, wall: MapWall | None) -> None:
        """Store a wall, or none, under number k, and update its row of the table."""
        if k == len(self._walls):
            self._walls.append(wall)
        if k == len(self._table):
            self._table = np.concatenate((self._table, np.full((max(k, 64), 5), np.nan)))
        self._walls[k] = wall
        self._table[k] = np.nan if wall is None else (*_place(wall.line), *wall.extent)

    def _moved(self, last: Pose, pose: Pose) -> bool:
        s = self._settings
        x, y, heading_change = relative(last, pose)
        return math.hypot(x, y) >= s.least_move or abs(heading_change) >= s.least_turn

    def _tidy(self) -> None:
        """Remove false walls: seen long ago and never again, or seen through everywhere."""
        fewest = self._settings.wall_hits
        kept = [
            wall
            for wall in self._walls
            if wall is not None
            and (self.scans - wall.born < _CLEANUP_PERIOD or wall.solid(fewest, 0.0, 0.0))
        ]
        self._walls = []
        for wall in kept:
            self._set(len(self._walls), wall)
        self._table[len(kept) :] = np.nan

    def _within_reach(self, point: Point) -> list[int]:
        """Numbers of the walls of which a part is near enough for beams to count."""
        x, y, heading, first, last = self._table.T
        c, s = np.cos(heading), np.sin(heading)
        along = c * (point[0] - x) + s * (point[1] - y)
        along = np.minimum(np.maximum(along, first), last)
        off = np.hypot(x + along * c - point[0], y + along * s - point[1])
        return [int(k) for k in np.flatnonzero(off < MAX_BEAM_LENGTH)]

    def _candidates(self, new: MapWall, index: LineIndex) -> list[int]:
        """Numbers of the walls that may be the same as a new one, by direction and extent."""
        s = self._settings
        angle = s.angle_tolerance + s.confidence * math.sqrt(new.line.angle_variance + s.angle**2)
        offset = self._tolerance(2.0 * new.line.offset_variance) + 2.0 * s.wall_reach * angle
        names = np.array(index.near(new.line, angle, offset), dtype=np.intp)
        x, y, heading, first, last = self._table[names].T
        c, s_ = np.cos(heading), np.sin(heading)
        places = [c * (px - x) + s_ * (py - y) for px, py in map(new.line.point, new.extent)]
        apart = np.maximum(np.minimum(*places), first) - np.minimum(np.maximum(*places), last)
        return [int(k) for k in names[apart <= s.gap]]

    def _is_one(self, k: int, new: MapWall) -> bool:
        """Whether known wall `k` and a new one are the same: same direction, same line, no gap."""
        s, known = self._settings, self._walls[k]
        if known is None:
            return False
        heading_change = abs(wrap_angle(new.line.heading - known.line.heading))
        spread = math.sqrt(known.line.angle_variance + new.line.angle_variance + s.angle**2)
        if heading_change > s.angle_tolerance + s.confidence * spread:
            return False
        stretch = known.stretch_of(new)
        if gap(known.extent, stretch) > s.gap:
            return False
        low, high = max(stretch[0], known.extent[0]), min(stretch[1], known.extent[1])
        place = 0.5 * (low + high)
        point = known.line.point(place)
        variance = known.line.variance(place) + new.line.variance(new.line.along(point))
        return abs(new.line.across(point)) < self._tolerance(variance)

    def _tolerance(self, variance: float) -> float:
        """Largest distance between two estimates of one line, metres.

        The scans of one pass share an error of their poses that does not average out.
        """
        s = self._settings
        return s.offset_tolerance + s.confidence * math.sqrt(variance + s.position**2)


def _place(line: Line) -> Pose:
    return line.x, line.y, line.heading


def _distance(wall: Wall) -> float:
    """Distance from the origin of the wall's frame to the nearest point of the wall, metres."""
    x, y = to_local((*wall.start, wall.heading), (0.0, 0.0))
    return math.hypot(max(-x, 0.0, x - wall.length), y)
