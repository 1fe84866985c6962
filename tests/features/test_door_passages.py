"""How a driver passes doorways, from a path and the doors."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features import Door
from semnav_features.door_passages import count_reversals, door_passages, driving_habits
from semnav_features.frames import FloatArray, Pose, compose

DOOR = Door((0.0, 0.5), (0.0, -0.5), "kitchen")
"""A doorway that is passed along x."""

angles = st.floats(-1.0, 1.0)


def straight(angle: float, offset: float, speed: float = 0.5) -> tuple[FloatArray, FloatArray]:
    """A straight path that meets the doorway's line at `offset` after 6 s, and its times."""
    seconds = np.arange(0.0, 10.0, 0.1)
    along = speed * (seconds - 6.0)
    x, y = along * math.cos(angle), offset + along * math.sin(angle)
    return np.stack((x, y, np.full(len(x), angle)), axis=1), seconds


@given(angles, st.floats(-0.4, 0.4), st.floats(0.2, 1.0))
def test_a_straight_drive_keeps_its_angle_offset_and_speed(
    angle: float, offset: float, speed: float
) -> None:
    (passage,) = door_passages(*straight(angle, offset, speed), [DOOR])
    assert passage.door == "kitchen"
    assert passage.angle == pytest.approx(angle, abs=1e-9)
    assert passage.offset == pytest.approx(offset, abs=1e-9)
    assert passage.speed == pytest.approx(speed, rel=1e-6)
    assert passage.seconds == pytest.approx(6.0, abs=1e-6)
    assert passage.corrections == 0


@given(angles, st.floats(-0.4, 0.4), st.tuples(*[st.floats(-3.0, 3.0)] * 3), st.booleans())
def test_a_passage_does_not_depend_on_the_frame_or_the_order_of_the_jambs(
    angle: float, offset: float, frame: Pose, is_turned: bool
) -> None:
    poses, seconds = straight(angle, offset)
    moved = np.array([compose(frame, tuple(pose)) for pose in poses])
    ends = [compose(frame, (*p, 0.0))[:2] for p in (DOOR.start, DOOR.end)]
    door = Door(*(ends[::-1] if is_turned else ends))
    (here,) = door_passages(moved, seconds, [door])
    (there,) = door_passages(poses, seconds, [DOOR])
    assert (here.angle, here.offset) == pytest.approx((there.angle, there.offset), abs=1e-9)


def test_a_mirrored_drive_is_off_to_the_other_side() -> None:
    poses, seconds = straight(0.3, 0.2)
    (here,) = door_passages(poses, seconds, [DOOR])
    (there,) = door_passages(poses * (1.0, -1.0, -1.0), seconds, [DOOR])
    assert (there.angle, there.offset) == pytest.approx((-here.angle, -here.offset))


def test_a_drive_beside_the_doorway_is_no_passage() -> None:
    assert door_passages(*straight(0.0, 0.6), [DOOR]) == ()


def test_who_turns_round_in_the_doorway_does_not_pass_it() -> None:
    x = np.concatenate((np.linspace(-2.0, 0.1, 40), np.linspace(0.1, -2.0, 40)))
    poses = np.stack((x, 0.0 * x, 0.0 * x), axis=1)
    assert door_passages(poses, np.arange(80.0), [DOOR]) == ()


def test_who_sways_in_the_doorway_passes_it_once() -> None:
    x = np.concatenate((np.linspace(-2, 0.1, 40), np.linspace(0.1, -0.1, 9), np.linspace(0, 2, 40)))
    poses = np.stack((x, 0.0 * x, 0.0 * x), axis=1)
    assert len(door_passages(poses, np.arange(89.0), [DOOR])) == 1


def test_a_robot_that_stops_behind_the_doorway_has_passed_it() -> None:
    poses, seconds = straight(0.0, 0.0)
    stop = np.flatnonzero(poses[:, 0] > 0.05)[0]
    assert len(door_passages(poses[: stop + 1], seconds[: stop + 1], [DOOR])) == 1


def test_a_passage_there_and_back_is_two() -> None:
    x = np.concatenate((np.linspace(-2.0, 2.0, 40), np.linspace(2.0, -2.0, 40)))
    heading = np.repeat((0.0, math.pi), 40)
    poses = np.stack((x, 0.0 * x + 0.1, heading), axis=1)
    there, back = door_passages(poses, np.arange(80.0), [DOOR])
    assert (there.offset, back.offset) == pytest.approx((0.1, -0.1))
    assert back.angle == pytest.approx(0.0, abs=1e-9)


def test_weaving_before_the_doorway_counts_as_corrections() -> None:
    poses, seconds = straight(0.0, 0.0)
    weave = 0.2 * np.sin(2.0 * math.pi * poses[:, 0])
    poses[:, 2] = np.where(poses[:, 0] < 0.0, weave, 0.0)
    (passage,) = door_passages(poses, seconds, [DOOR])
    assert passage.corrections == 4  # two waves on the last two metres, each with two turns back


@given(st.lists(st.floats(-0.04, 0.04), min_size=1, max_size=50))
def test_changes_below_the_least_are_no_reversals(values: list[float]) -> None:
    assert count_reversals(np.array(values), 0.0801) == 0


def test_times_that_are_not_known_leave_the_speed_open() -> None:
    poses, seconds = straight(0.0, 0.0)
    (passage,) = door_passages(poses, np.full(len(seconds), math.nan), [DOOR])
    assert math.isnan(passage.speed)
    assert passage.row()["speed"] is None


def test_a_path_without_a_time_for_each_pose_is_refused() -> None:
    poses, seconds = straight(0.0, 0.0)
    with pytest.raises(ValueError, match="one for each pose"):
        door_passages(poses, seconds[1:], [DOOR])


def test_habits_are_medians_over_the_passages() -> None:
    passages = [door_passages(*straight(a, a / 10), [DOOR])[0] for a in (-0.3, 0.1, 0.2)]
    habits = driving_habits(passages)
    assert (habits.passages, habits.angle) == (3, pytest.approx(0.2))
    assert habits.offset == pytest.approx(0.02)
    assert math.isnan(driving_habits([]).angle)
