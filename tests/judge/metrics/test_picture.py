"""Pictures of episodes among people and changing doors."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from semnav_env.judge.metrics import Recorder, Recording
from semnav_env.judge.metrics.final_belief import FinalBelief
from semnav_env.judge.metrics.picture import TRAIL_LENGTH, draw_belief, draw_episode, save_episode
from semnav_env.robots import WHEELCHAIR
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.physics import World
from semnav_features.frames import path_length
from semnav_features.scene import Door

ROUTE = np.array([(1.3, 9.1), (5.0, 9.1)])


@pytest.fixture(scope="module")
def recording() -> Recording:
    """Eight seconds of standing among people and doors."""
    dynamics = Dynamics(pedestrians=5, changing_doors=1.0)
    world = World(load_floor_plan("office_cross"), WHEELCHAIR, 15, dynamics=dynamics)
    world.reset((1.3, 9.1, 0.0), np.random.default_rng(3))
    recorder = Recorder(world)
    for _ in range(120):
        world.step((0.0, 0.0, 0.0))
        recorder.note()
    assert world.moving is not None
    made = recorder.recording()
    assert made.people is not None
    np.testing.assert_array_equal(made.people[-1], world.moving.discs)
    np.testing.assert_array_equal(made.leaves, world.moving.doors.segments)
    return made


def test_people_are_drawn_at_the_end_with_their_last_metres(
    recording: Recording,
) -> None:
    ax = Figure().add_subplot()
    draw_episode(ax, recording, WHEELCHAIR, ROUTE)
    assert recording.people is not None
    circles = [patch for patch in ax.patches if isinstance(patch, Circle)]
    drawn = np.array([(*circle.center, circle.radius) for circle in circles])
    np.testing.assert_allclose(drawn, recording.people[-1])
    lines = [np.asarray(line.get_xydata()) for line in ax.lines]
    for number, end in enumerate(recording.people[-1, :, :2]):
        (tail,) = [line for line in lines if np.array_equal(line[-1], end)]
        walked = path_length(recording.people[:, number, :2])
        assert path_length(tail) == pytest.approx(min(TRAIL_LENGTH, walked), abs=0.15)


def test_doors_stand_as_they_did_at_the_end(recording: Recording) -> None:
    ax = Figure().add_subplot()
    draw_episode(ax, recording, WHEELCHAIR, ROUTE)
    assert recording.leaves is not None
    lines = [np.asarray(line.get_xydata()) for line in ax.lines]
    for leaf in recording.leaves.reshape(-1, 2, 2):
        assert any(np.array_equal(line, leaf) for line in lines)


def test_what_the_robot_believed_is_drawn() -> None:
    ax = Figure().add_subplot()
    doors = Door((1.0, 0.0), (1.9, 0.0)), Door((4.0, 0.0), (4.9, 0.0))
    draw_belief(ax, FinalBelief(doors, (2.0, 3.0)))
    lines = [np.asarray(line.get_xydata()).tolist() for line in ax.lines]
    assert lines == [[[1.0, 0.0], [1.9, 0.0]], [[4.0, 0.0], [4.9, 0.0]], [[2.0, 3.0]]]


def test_a_recording_among_people_is_drawn_and_read_back(
    recording: Recording, tmp_path: Path
) -> None:
    recording.save(tmp_path / "a.npz")
    again = Recording.load(tmp_path / "a.npz")
    np.testing.assert_array_equal(again.people, recording.people)
    np.testing.assert_array_equal(again.leaves, recording.leaves)
    picture = tmp_path / "a.png"
    save_episode(picture, load_floor_plan("office_cross"), again, WHEELCHAIR, ROUTE)
    assert picture.stat().st_size > 0
    assert recording.people is not None
    with pytest.raises(ValueError, match=r"people .* shape \(120, .* must be \(121, any, 3\)"):
        replace(recording, people=recording.people[1:])
