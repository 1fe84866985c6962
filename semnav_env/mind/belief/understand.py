"""One compiled call per scan: features, drift, memory, and what calls for thinking.

Handing an array to a compiled function costs a third of a microsecond, and there are some twenty
of them: more than all the work. They are put into one structure beforehand.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_env.mind.belief.attention import is_look_due
from semnav_env.mind.belief.bump_kernels import forget_passed, note_contacts
from semnav_env.mind.grounding.clause_progress import note_pose
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.chain import extract_arrays
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.memory import how_many_count, relocate, remember
from semnav_features.kernels.structures import Structure, numba_type

FIRST_SCAN, LOOK_DUE = 8, 16
"""Events beside those of `clause_progress`, as bits: the command is to be begun; the clause is to
be grounded anew, as after a bump into what was not known."""


class Workbench(Structure):
    """Working memory of the extractor, for one scan at a time.

    Attributes:
        scratch: `Scratch`.
    """

    scratch: Any


WorkbenchType = numba_type(Workbench)


class Senses(Structure):
    """The arrays that a belief is made of.

    Attributes:
        limits: `LidarSpec.sensor`: directions and limits of the ranges, shape (1,).
        beams: unit vector of each beam, lidar frame, shape (n, 2).
        record: `ExtractorSettings.as_record()`.
        workbench: of the extractor; threads put their own in its place.
        mount: pose of the lidar in the robot frame.
        ranges: of the last scan, metres, shape (n,).
        features: of the last scan, lidar frame; written at every scan.
        remembered: `SceneMemory.arrays`; updated at every scan.
        bumps: `BumpMap.arrays`.
        estimate: dtype `ESTIMATE`, shape (1,): what is given with a scan, and what is believed.
        progress: `Follower.progress`.
        told: `ToldWays.arrays`.
    """

    limits: np.ndarray
    beams: FloatArray
    record: np.ndarray
    workbench: Workbench
    mount: Pose
    ranges: FloatArray
    features: Any
    remembered: Any
    bumps: Any
    estimate: np.ndarray
    progress: np.ndarray
    told: Any


SensesType = numba_type(Senses)


@kernel
def read_ranges_in(senses: Senses, ranges: FloatArray) -> None:
    """Replace the array of the ranges; making the senses anew would take milliseconds."""
    senses.ranges = ranges


@kernel(shared=True)
def understand(senses: Senses) -> int:
    """Take in the scan and the motion that stand in the senses; returns events.

    The first scan after `scan` was set to -1 is only remembered: its event is `FIRST_SCAN`.

    Args:
        senses: of one robot, with ranges and the given fields of the estimate written; the other
            fields are written here.
    """
    estimate = senses.estimate[0]
    before = _pose(estimate.pose)
    pose = perceive(senses, _pose(estimate.odometry), (_pose(estimate.last_odometry), before))
    for i in range(3):
        estimate.pose[i], estimate.last_odometry[i] = pose[i], estimate.odometry[i]
    estimate.scan += 1
    bumped = _feel(senses, pose)
    if estimate.scan == 0:
        return FIRST_SCAN
    velocity = estimate.velocity
    speed = math.hypot(velocity[0], velocity[1])
    events = note_pose(senses.progress, pose, speed, estimate.seconds)
    forget_passed(senses.bumps, before, pose)
    if bumped or is_look_due(estimate, senses.remembered):
        events |= LOOK_DUE
    return events


@kernel
def _feel(senses: Senses, pose: Pose) -> bool:
    """Note what the body touches unseen; returns whether something new is known."""
    estimate = senses.estimate[0]
    if estimate.contact_count == 0:
        return False
    felt = estimate.contacts[: estimate.contact_count]
    return bool(note_contacts(senses.bumps, felt, senses.ranges, senses.limits, senses.mount, pose))


@kernel
def note_look(senses: Senses) -> None:
    """Note that the clause has been grounded."""
    estimate = senses.estimate[0]
    for i in range(3):
        estimate.look_pose[i] = estimate.pose[i]
    estimate.look_scan = estimate.scan
    estimate.look_walls, estimate.look_doors = how_many_count(senses.remembered)


@kernel
def perceive(senses: Senses, odometry: Pose, before: tuple[Pose, Pose]) -> Pose:
    """Extract the features of the last scan and remember them; returns the believed pose.

    If the estimate corrects drift, walls that are seen again tell where the robot is, and odometry
    only about where; otherwise odometry is believed.

    Args:
        senses: the arrays to read and write.
        odometry: pose of the robot by odometry, odometry frame.
        before: odometry at the last scan, and the pose that was believed then.
    """
    corrects_drift = senses.estimate[0].corrects_drift
    features, limits = senses.features[0], senses.limits[0]
    extract_features(senses, senses.estimate[0].observes_features)
    robot = _advanced(odometry, before) if corrects_drift else odometry
    lidar = _mounted(robot, senses.mount)
    if corrects_drift:
        lidar = relocate(features.walls, features.counts, lidar, senses.remembered)
        robot = _carrying(lidar, senses.mount)
    remember(
        features.walls,
        features.doors,
        features.counts,
        senses.ranges,
        limits.angle_min,
        limits.angle_increment,
        lidar,
        senses.remembered,
    )
    return robot


@kernel(inline=True)
def _pose(field: FloatArray) -> Pose:
    return field[0], field[1], field[2]


@kernel
def extract_features(senses: Senses, all_of_them: bool) -> None:
    """Extract the features of the last scan; corners and corridors only if all are wanted."""
    extract_arrays(
        senses.ranges,
        senses.beams,
        senses.limits[0],
        senses.record[0],
        senses.workbench.scratch[0],
        senses.features[0],
        all_of_them,
    )


@kernel
def _mounted(robot: Pose, mount: Pose) -> Pose:
    """Pose of a lidar on its mount; its heading is not wrapped."""
    c, s = math.cos(robot[2]), math.sin(robot[2])
    x, y = robot[0] + c * mount[0] - s * mount[1], robot[1] + s * mount[0] + c * mount[1]
    return x, y, robot[2] + mount[2]


@kernel
def _carrying(lidar: Pose, mount: Pose) -> Pose:
    """Pose of the robot whose lidar has this pose; the inverse of `_mounted`."""
    heading = lidar[2] - mount[2]
    heading -= 2.0 * math.pi * np.rint(heading / (2.0 * math.pi))
    c, s = math.cos(heading), math.sin(heading)
    return lidar[0] - c * mount[0] + s * mount[1], lidar[1] - s * mount[0] - c * mount[1], heading


@kernel
def _advanced(odometry: Pose, before: tuple[Pose, Pose]) -> Pose:
    """Last believed pose advanced by the odometry increment; its heading is not wrapped."""
    last, pose = before
    x, y, offset = odometry[0] - last[0], odometry[1] - last[1], pose[2] - last[2]
    c, s = math.cos(offset), math.sin(offset)
    return pose[0] + c * x - s * y, pose[1] + s * x + c * y, odometry[2] + offset
