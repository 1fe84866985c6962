"""Robots get out of cluttered rooms through the named door; see `python -m studies exits`."""

from __future__ import annotations

import json
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from shapely import Point

from semnav_agents.door_exit import DoorExit
from semnav_agents.planning.exit_via_door import PAUSE, ExitViaDoor
from semnav_agents.planning.obstacles import points_of_segments
from semnav_agents.planning.planner import plan
from semnav_env.approach import DoorSide
from semnav_env.robots import ROBOTS, SPOT, RobotSpec
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.simulator import RobotSetup, Simulator
from semnav_features.frames import FloatArray, Pose
from studies.exits.cases import ExitCase, exit_cases, side_of
from studies.exits.command import Arguments, judged_pose
from studies.exits.drives import driven
from studies.exits.exit_rules import exit_via_door, lining_up

DOOR = DoorSide((0.45, 0.0), (-0.45, 0.0))
VILLA = load_floor_plan("villa_hall")
ROOM, NAME = "daughter's bedroom", "daughter"
HERE = (0.0, -1.0, 0.0)
NOTHING: FloatArray = np.empty((0, 2))
SHARE, SLOW_SHARE = 8, 100


def leaving_the_daughters_room(start: Pose) -> ExitCase:
    return ExitCase(0, VILLA, ROOM, VILLA.door(NAME), start)


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=list(ROBOTS))
def test_one_gets_out_into_a_hall_too_narrow_to_stand_across(robot: RobotSpec) -> None:
    """No place lies straight behind the door: the hall is 1.1 m wide, as the bodies are long."""
    case = leaving_the_daughters_room((-4.8, 6.5, -1.0))
    assert not driven(case, robot, lining_up).passed
    result = driven(case, robot, exit_via_door)
    assert result.passed
    assert not result.contact


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=list(ROBOTS))
def test_one_gets_through_a_door_of_another_room(robot: RobotSpec) -> None:
    """From the kitchen through the hall into the daughter's room."""
    start = (0.5, -2.0, 0.3)
    leaving = DoorExit.named(VILLA, NAME, start, robot)
    simulator = Simulator(VILLA, RobotSetup(robot, exact=True))
    sensed = simulator.reset(start, np.random.default_rng(0))
    for _ in range(60 * 15):
        sensed = simulator.step(leaving.twist(sensed.motion.pose, sensed.velocity))
        if leaving.is_out(sensed.motion.pose):
            break
    assert VILLA.region(ROOM).polygon.contains(Point(sensed.motion.pose[:2]))


@pytest.mark.parametrize("robot", ROBOTS.values(), ids=list(ROBOTS))
def test_every_case_of_a_share_is_passed_without_contact(robot: RobotSpec) -> None:
    check(list(islice(exit_cases(), SHARE)), robot)


@pytest.mark.slow
@pytest.mark.parametrize("robot", ROBOTS.values(), ids=list(ROBOTS))
def test_ninety_nine_in_a_hundred_cases_are_passed(robot: RobotSpec) -> None:
    check(list(islice(exit_cases(), SLOW_SHARE)), robot)


def check(cases: list[ExitCase], robot: RobotSpec) -> None:
    results = [driven(case, robot, exit_via_door) for case in cases]
    assert sum(not result.passed for result in results) <= len(cases) / 100
    assert not any(judged_pose(case, robot)["contact"] for case in cases)


def test_the_first_target_is_the_region_straight_behind() -> None:
    target = ExitViaDoor(SPOT).target(DOOR)
    assert target.heading_tolerance is None
    assert target.pose[1] > 1.0
    assert target.gate is not None


def test_after_a_failure_come_poses_behind_and_then_before_the_door() -> None:
    passing = ExitViaDoor(SPOT)
    passing.target(DOOR)
    targets = []
    while passing.failed(NOTHING, HERE):
        targets.append(passing.target(DOOR))
    behind = [k for k, target in enumerate(targets[:-1]) if target.pose[1] > 0.0]
    before = [k for k, target in enumerate(targets) if target.pose[1] < 0.0]
    assert len(behind) > 1
    assert max(behind) < min(before)
    assert targets[0].pose[2] == pytest.approx(np.pi / 2)
    assert all(target.gate is None for target in targets if target.pose[1] < 0.0)


def test_a_door_that_seems_too_narrow_has_no_other_way() -> None:
    narrow = DoorSide((0.2, 0.0), (-0.2, 0.0))
    passing = ExitViaDoor(SPOT)
    passing.target(narrow)
    passing.failed(NOTHING, HERE)
    assert passing.target(narrow).heading_tolerance is None


def test_a_path_that_ends_far_from_the_door_is_driven() -> None:
    passing = ExitViaDoor(SPOT)
    passing.target(DOOR)
    assert not passing.failed(NOTHING, (0.0, -9.0, 0.0))
    assert passing.target(DOOR).heading_tolerance is None


def test_from_a_pose_before_the_door_one_goes_on_through_it() -> None:
    passing = ExitViaDoor(SPOT)
    while passing.target(DOOR).pose[1] > 0.0:
        assert passing.failed(NOTHING, HERE)
    passing.reached()
    assert passing.target(DOOR).pose[1] > 0.0


def test_all_ways_are_tried_anew_after_a_pause() -> None:
    passing = ExitViaDoor(SPOT)
    passing.target(DOOR)
    while passing.failed(NOTHING, HERE):
        pass
    assert not any(passing.failed(NOTHING, HERE) for _ in range(PAUSE - 1))
    assert passing.failed(NOTHING, HERE)


def test_another_door_begins_with_the_region_behind_it() -> None:
    passing = ExitViaDoor(SPOT)
    passing.target(DOOR)
    passing.failed(NOTHING, HERE)
    assert passing.target(DOOR).heading_tolerance is not None
    moved = DoorSide((0.55, 0.0), (-0.35, 0.0))
    assert passing.target(moved).heading_tolerance is not None
    assert passing.target(DoorSide((3.45, 0.0), (2.55, 0.0))).heading_tolerance is None


def test_poses_behind_the_door_can_be_reached_through_it() -> None:
    case = leaving_the_daughters_room((-4.8, 6.5, -1.0))
    points = points_of_segments(VILLA.segments)
    side, passing = case.side, ExitViaDoor(SPOT)
    assert side == side_of(VILLA, VILLA.door(NAME), VILLA.region(ROOM))
    passing.target(side)
    assert passing.failed(points, case.start)
    target = passing.target(side)
    path = plan(points, case.start, target, SPOT)
    assert path.complete
    assert path.crosses(side.right, side.left)


def test_a_stopped_study_is_taken_up_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "drives.jsonl"
    study = Arguments(cases=1, rules=("exit_via_door",), robots=("spot",), out=out)
    assert study.run() == 0
    assert study.run() == 0
    [row] = [json.loads(line) for line in out.read_text().splitlines()]
    assert row["passed"]
    said = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ["exit_via_door", "spot", "1", "1.0000", "0.0000"] in [
        line[:4] + line[7:8] for line in said
    ]
    with pytest.raises(ValueError, match="no rule nix; there are: one_metre, lining_up"):
        Arguments(rules=("nix",)).run()
