from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.mind.localization import pose_from_door
from semnav_env.mind.localization.door_pose import seen_jambs
from semnav_features.clouds.detected_door import DetectedDoor
from semnav_features.frames import Pose
from tests.mind.localization.doors import JAMB_SIGMA, LEFT, door_seen_from, poses, turned_about


@given(poses)
@settings(deadline=None)
def test_a_door_seen_exactly_gives_the_pose_exactly(pose: Pose) -> None:
    found, _ = pose_from_door(LEFT, door_seen_from(pose, LEFT))
    assert found[:2] == pytest.approx(pose[:2], abs=1e-9)
    assert math.cos(found[2] - pose[2]) == pytest.approx(1.0)


@given(poses, st.integers(0, 3))
@settings(deadline=None)
def test_the_covariance_is_that_of_the_poses_of_noisy_doors(pose: Pose, coordinate: int) -> None:
    """Each column of the Jacobian is a difference quotient."""
    size, exact = 1e-6, door_seen_from(pose, LEFT)
    spread = np.zeros((4, 4))
    spread[coordinate, coordinate] = 1.0
    ends = np.array((*exact.start, *exact.end))
    ends[coordinate] += size
    moved = DetectedDoor((ends[0], ends[1]), (ends[2], ends[3]))
    change = np.subtract(pose_from_door(LEFT, moved)[0], pose_from_door(LEFT, exact)[0]) / size
    change[2] = math.remainder(change[2] * size, math.tau) / size
    _, covariance = pose_from_door(LEFT, DetectedDoor(exact.start, exact.end, covariance=spread))
    assert covariance == pytest.approx(np.outer(change, change), abs=1e-3)


@given(st.floats(0.5, 5.0))
def test_one_door_tells_least_along_its_wall(distance: float) -> None:
    """From before a door, the error of the heading over the distance adds to that along it."""
    pose = LEFT.midpoint[0], LEFT.midpoint[1] - distance, 0.5 * math.pi
    detected = door_seen_from(pose, LEFT, JAMB_SIGMA**2 * np.eye(4))
    _, covariance = pose_from_door(LEFT, detected)
    heading = 2.0 * (JAMB_SIGMA / LEFT.width) ** 2
    assert covariance[2, 2] == pytest.approx(heading)
    assert covariance[1, 1] == pytest.approx(0.5 * JAMB_SIGMA**2)
    assert covariance[0, 0] == pytest.approx(0.5 * JAMB_SIGMA**2 + heading * distance**2)


@given(poses, st.floats(-3.0, 3.0))
@settings(deadline=None)
def test_one_jamb_looks_the_same_from_a_circle(pose: Pose, angle: float) -> None:
    one = door_seen_from(pose, LEFT, end_seen=False)
    residual, jacobian, noise = seen_jambs(turned_about(LEFT.start, pose, angle), LEFT, one)
    assert residual == pytest.approx(np.zeros(2), abs=1e-9)
    assert jacobian.shape == (2, 3)
    assert noise.shape == (2, 2)
    with pytest.raises(ValueError, match="circle"):
        pose_from_door(LEFT, one)
