"""What a lidar without errors sees in a floor plan, in the extractor's own types."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from semnav_env.world.lidar.lidar import Lidar
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import FloatArray, Pose, compose, points_to_local
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import lidar_spec
from semnav_features.scan import Scan
from semnav_features.scene import Arc, Scene, Wall
from semnav_features.settings import ExtractorSettings
from studies.truth.corners import find_joints
from studies.truth.corridors import true_corridors
from studies.truth.doors import open_doors, see_door
from studies.truth.runs import cut_into_runs, seam
from studies.truth.shapes import Shapes
from studies.truth.sweep import NO_OWNER, Outline, at_range, crossings, sweep

DEFAULT_SETTINGS = ExtractorSettings()


def true_scene(
    floor_plan: FloorPlan,
    pose: Pose,
    lidar: str | LidarSpec | Lidar = "tim561",
    settings: ExtractorSettings = DEFAULT_SETTINGS,
) -> Scene:
    """Exactly the features that a lidar sees from a pose; see `TrueView.scene`.

    For many poses make one `TrueView`, which prepares the floor plan once.
    """
    return TrueView(floor_plan, lidar, settings).scene(pose)


class TrueView:
    """What a lidar sees in a floor plan if it makes no errors and misses nothing between beams.

    Args:
        floor_plan: where it is; glass is not seen.
        lidar: a lidar's name, its spec, or a `Lidar`, whose mount on the robot then counts.
        settings: what a corner is (`corner_angle`) and what a corridor is.
    """

    def __init__(
        self,
        floor_plan: FloorPlan,
        lidar: str | LidarSpec | Lidar = "tim561",
        settings: ExtractorSettings = DEFAULT_SETTINGS,
    ) -> None:
        spec = lidar.spec if isinstance(lidar, Lidar) else lidar_spec(lidar)
        mount = lidar.mount if isinstance(lidar, Lidar) else (0.0, 0.0, 0.0)
        exact = replace(spec, sigma=0.0, dropout=0.0, systematic=0.0)
        self.lidar = Lidar(floor_plan, exact, mount)
        self.settings = settings
        self._shapes = Shapes.of(floor_plan)
        self._doors = open_doors(floor_plan)
        chords = np.array([(*d.door.start, *d.door.end) for d in self._doors]).reshape(-1, 4)
        self._solid = len(self._shapes.segments)
        self._lines = np.concatenate((self._shapes.segments, chords))
        ends = self._lines.reshape(-1, 2)
        self._marks = np.unique(np.concatenate((ends, crossings(self._lines))), axis=0)

    def scan(self, robot_pose: Pose) -> Scan:
        """What the lidar measures without errors."""
        return self.lidar.scan(robot_pose, (0, 0, 0))

    def scene(self, robot_pose: Pose) -> Scene:
        """The features in view, in the lidar frame.

        They come in beam order; if the lidar sees all around, from a jump of the range on, so
        that no wall is cut in two.

        - A wall comes back as one `Wall` for each stretch in view, the lidar on its left, with
          the share of the whole wall that the stretch is, how many beams meet it, and the flags
          of its ends. So what stands before a wall makes two of it, as it does for an extractor.
          Bends of less than a centimetre are no bends.
        - A round surface (`shapes.fit_circle`) comes back as one `Arc` for each stretch in view.
        - A `Door` is an open one of which any part of the opening is in view; its ends are the
          jambs even if these are hidden, its `visible` is the share in view, and its leaf is
          there if any of it is seen.
        - Corners are where walls in view meet at `corner_angle` or more, and, potential ones,
          where a wall in view ends with a jump of the range or without a return beside it.
        - Corridors are what the extractor's definition makes of these walls and corners.

        Args:
            robot_pose: of the robot's centre in the world; of the lidar if it has no mount.
        """
        pose = compose(robot_pose, self.lidar.mount)
        outline, marks = self._outline(pose)
        runs = cut_into_runs(outline, self._shapes, pose, self.lidar.spec)
        pieces = [piece for run in runs for piece in run.pieces]
        walls = [piece for piece in pieces if isinstance(piece, Wall)]
        joints = [j for run in runs for j in find_joints(run, self.settings.corner_angle)]
        seen = set(self._shapes.surfaces[outline.owners[outline.owners != NO_OWNER]].tolist())
        reach = self.lidar.spec.range_max
        doors = [see_door(door, pose, outline, marks, seen, reach) for door in self._doors]
        return Scene(
            tuple(walls),
            tuple([door for door in doors if door is not None]),
            tuple([joint.corner for joint in joints]),
            true_corridors(self.scan(robot_pose), walls, joints, self.settings),
            tuple([piece for piece in pieces if isinstance(piece, Arc)]),
        )

    def _outline(self, pose: Pose) -> tuple[Outline, FloatArray]:
        """What is seen from the lidar's pose, and where the view of anything may change."""
        spec = self.lidar.spec
        lines = points_to_local(pose, self._lines.reshape(-1, 2, 2)).reshape(-1, 4)
        limits = [at_range(lines, limit) for limit in (spec.range_min, spec.range_max)]
        marks = np.concatenate((points_to_local(pose, self._marks), *limits))
        marks = marks[np.hypot(*marks.T) <= spec.range_max * (1.0 + 1e-9)]
        near = np.flatnonzero(_distances(lines[: self._solid]) <= spec.range_max)
        outline = sweep(lines[near], marks, spec, spec.angle_min)
        if outline.full:
            outline = sweep(lines[near], marks, spec, seam(outline))
        owners = np.append(near, NO_OWNER)[outline.owners]
        return replace(outline, owners=owners), np.append(
            np.arctan2(marks[:, 1], marks[:, 0]), outline.angles
        )


def _distances(segments: FloatArray) -> FloatArray:
    """Of segments from the origin, metres, shape (n,)."""
    a, along = segments[:, :2], segments[:, 2:] - segments[:, :2]
    place = -(a * along).sum(axis=1) / (along**2).sum(axis=1)
    nearest = a + np.clip(place, 0.0, 1.0)[:, None] * along
    return np.asarray(np.hypot(*nearest.T))
