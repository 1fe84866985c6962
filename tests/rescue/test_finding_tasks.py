"""Which room a robot searches that is told to, and where it turns to look around."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from semnav_agents.searching.finding_tasks import (
    MOST_PLACES,
    FaceTask,
    FindingStep,
    LookTask,
    Percepts,
    PersonTask,
    _clearest,
)
from semnav_agents.searching.house_plan import HousePlan, numbers_of, room_entered
from semnav_agents.searching.settings import SearchSettings
from semnav_agents.searching.views import Looker
from semnav_env.rescue.microphones import USUAL_MICROPHONES
from semnav_env.rescue.voice_fix import HeardVoice, PersonVoice
from semnav_env.robots import SPOT, WHEELCHAIR, RobotSpec
from semnav_env.world.maps import load_floor_plan
from semnav_features.frames import Point, Pose, to_local

VILLA = load_floor_plan("villa_hall")
CHART = HousePlan(VILLA, (0.0, 0.0, 0.0)).chart(SearchSettings())
[KITCHEN] = numbers_of(VILLA, "kitchen")
LIVING_ROOM = VILLA.room_names.index("living room")
ALL = numbers_of(VILLA, None)
AHEAD, BACKWARD, STANDS = (0.4, 0.0, 0.0), (-0.4, 0.0, 0.0), (0.0, 0.0, 0.0)
LEFT = (0.0, 0.4, 0.0)


@pytest.mark.parametrize(
    ("heading", "velocity"),
    [(-90.0, AHEAD), (90.0, BACKWARD), (180.0, LEFT), (-90.0, STANDS)],
)
def test_a_robot_in_a_doorway_is_in_the_room_into_which_it_drives(
    heading: float, velocity: tuple[float, float, float]
) -> None:
    in_door: Pose = (1.35, -0.1, math.radians(heading))
    assert room_entered(CHART, ALL, in_door, velocity, WHEELCHAIR.width) == KITCHEN


def test_a_robot_that_backs_into_a_named_room_searches_that_room() -> None:
    inside: Pose = (2.75, 1.66, math.pi)
    for velocity in (AHEAD, BACKWARD, STANDS):
        found = room_entered(CHART, [LIVING_ROOM], inside, velocity, WHEELCHAIR.width)
        assert found == LIVING_ROOM


@given(st.floats(-math.pi, math.pi), st.sampled_from([AHEAD, BACKWARD, LEFT, STANDS]))
def test_a_robot_beside_a_wall_is_not_in_the_room_behind_it(
    heading: float, velocity: tuple[float, float, float]
) -> None:
    """Its side is 5 cm from the wall to the living room."""
    pose: Pose = (2.4 - WHEELCHAIR.width / 2 - 0.05, 3.0, heading)
    assert room_entered(CHART, ALL, pose, velocity, WHEELCHAIR.width) != LIVING_ROOM


@given(
    st.floats(2.8, 6.8),
    st.floats(0.5, 4.4),
    st.floats(-math.pi, math.pi),
    st.sampled_from([SPOT, WHEELCHAIR]),
)
def test_a_body_that_turns_where_it_goes_to_look_around_touches_no_wall(
    x: float, y: float, heading: float, robot: RobotSpec
) -> None:
    looker = Looker(robot, math.radians(120.0), 6.0)
    pose: Pose = (x, y, heading)
    step = LookTask(CHART, looker, pose).next_step(pose, Percepts([]))
    assume(step.target is not None)
    assert step.target is not None
    place_x, place_y, turned = step.target
    axle = place_x + robot.axle * math.cos(turned), place_y + robot.axle * math.sin(turned)
    walls = CHART.grid.points(np.argwhere(CHART.solid))
    reach = math.hypot(robot.length / 2 + abs(robot.axle), robot.width / 2)
    assert np.hypot(*(walls - axle).T).min() > reach + 0.2


def test_a_robot_that_something_holds_up_looks_around_to_the_other_side() -> None:
    """It can turn to the left by 100 degrees, and to the right by all the others."""
    looker = Looker(WHEELCHAIR, math.radians(120.0), 6.0)
    x, y, turned, least = 4.8, 2.4, 0.0, 0.0
    task = LookTask(CHART, looker, (x, y, 0.0))
    for _ in range(400):
        step = task.next_step((x, y, turned), Percepts([]))
        turned = min(turned + step.yaw_rate / 15.0, math.radians(100.0))
        least = min(least, turned)
    assert least <= math.radians(100.0) - math.tau
    assert step.yaw_rate == 0.0


KITCHEN_DOOR = (1.35, 0.0)


@given(st.floats(0.6, 1.3), st.floats(0.9, 3.5), st.floats(0.3, 2.8))
def test_a_robot_turns_to_the_door_of_a_room_that_it_is_to_search(
    x: float, y: float, heading: float
) -> None:
    looker = Looker(WHEELCHAIR, math.radians(120.0), 6.0)
    pose: Pose = (x, y, heading)
    task = FaceTask(CHART, looker, pose, KITCHEN_DOOR)
    for _ in range(200):
        step = task.next_step(pose, Percepts([]))
        place_x, place_y, turned = step.target or pose
        pose = place_x, place_y, turned + step.yaw_rate / 15.0
    assert step.is_idle
    ahead, left = to_local(pose, KITCHEN_DOOR)
    assert abs(math.atan2(left, ahead)) < math.radians(35.0)


def test_a_robot_that_cannot_turn_goes_to_the_door_as_it_stands() -> None:
    pose: Pose = (0.95, 0.88, math.pi / 2)
    task = FaceTask(CHART, Looker(WHEELCHAIR, math.radians(120.0), 6.0), pose, KITCHEN_DOOR)
    assert any(task.next_step(pose, Percepts([])).is_idle for _ in range(300))


def person_task(visited: list[Point] | None = None) -> PersonTask:
    """A robot in the living room that is to go to somebody."""
    looker = Looker(SPOT, math.radians(120.0), 6.0)
    return PersonTask(CHART, looker, USUAL_MICROPHONES, visited or [], again=False)


INSIDE: Pose = (4.8, 2.4, 0.0)
SUSPECT = (6.4, 1.0)


def test_where_nobody_was_found_the_robot_looks_at_who_may_be_a_person() -> None:
    step = person_task().next_step(INSIDE, Percepts([(SUSPECT, 0.5, False)]))
    assert step.target is not None
    assert 0.9 <= math.dist(step.target[:2], SUSPECT) <= 1.7


def test_who_turns_out_to_be_nobody_is_left_for_somebody_else() -> None:
    task, other = person_task(), (3.4, 4.0)
    task.next_step(INSIDE, Percepts([(SUSPECT, 0.5, False), (other, 0.2, False)]))
    for _ in range(2):
        step = task.next_step(INSIDE, Percepts([(other, 0.2, False)]))
    assert step.target is not None
    assert 0.9 <= math.dist(step.target[:2], other) <= 1.7


def test_a_person_is_looked_at_from_six_places_with_a_margin_and_six_without() -> None:
    """The robot stands before each of them, and the person is never reported."""
    task, steps = person_task(), list[FindingStep]()
    pose, seen = INSIDE, Percepts([(SUSPECT, 0.95, False)])
    for _ in range(13 * 50):
        steps.append(task.next_step(pose, seen))
        pose = steps[-1].target or pose
    for careful in (True, False):
        places = {each.target[:2] for each in steps if each.target and each.careful is careful}
        assert len(places) == MOST_PLACES
    assert steps[-1].target is None


def voice(person: int, ear: Point, place: Point, std: float = 0.1) -> PersonVoice:
    """The exact direction of somebody at a place."""
    bearing = math.atan2(place[1] - ear[1], place[0] - ear[0])
    return PersonVoice(person, HeardVoice((*ear, 0.0), bearing, std))


def test_the_voice_of_somebody_to_whom_it_went_leads_nowhere() -> None:
    ear = (3.0, 0.5)
    known, other = voice(0, ear, SUSPECT, 0.05), voice(1, ear, (3.4, 4.0))
    assert _clearest([known, other], []) == [known.voice]
    assert _clearest([known, other], [SUSPECT]) == [other.voice]
    assert person_task([SUSPECT]).next_step(INSIDE, Percepts([], [known])).target is None


def test_a_robot_that_cannot_turn_at_all_stops_trying() -> None:
    pose: Pose = (4.8, 2.4, 0.0)
    task = LookTask(CHART, Looker(WHEELCHAIR, math.radians(120.0), 6.0), pose)
    for _ in range(100):
        step = task.next_step(pose, Percepts([]))
    assert step.target is None
    assert step.yaw_rate == 0.0
