"""Shared control: what the robot does of what its driver wants."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from semnav_agents.assistance.assisted import Assisted, strict_shield
from semnav_agents.assistance.hand import Hand
from semnav_agents.base import Agent
from semnav_agents.evaluation.drive import Drive, drive
from semnav_agents.floors import RandomAgent
from semnav_agents.planning.obstacles import points_of_segments
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.robots import ROBOTS
from semnav_env.world.maps.placement import placement_error
from semnav_env.world.physics import World
from semnav_features.lidars import TIM561
from tests.support.small_office import PLAN

SHARE = st.floats(-1.0, 1.0, width=32)
START = st.tuples(st.floats(0.5, 9.5), st.floats(-1.6, 5.6), st.floats(-3.1, 3.1))
STEPS_OF_A_WISH = 8
"""Control periods for which a driver wants the same."""

COMMAND = "go through the second door on the right"
BEFORE_THE_DOORS = (-2.5, -0.6, 0.25)


@pytest.fixture(scope="module")
def worlds() -> dict[str, World]:
    return {name: World(PLAN, spec, TIM561.rate_hz) for name, spec in ROBOTS.items()}


@pytest.mark.parametrize("robot", ROBOTS)
@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_an_assisted_twist_never_makes_contact(
    robot: str, worlds: dict[str, World], data: st.DataObject
) -> None:
    """In a static scene that is known, from any free start, whatever the driver wants."""
    spec, world = ROBOTS[robot], worlds[robot]
    start = data.draw(START)
    assume(placement_error(PLAN, spec, start) is None)
    solid = points_of_segments(PLAN.segments, spacing=0.01)
    wishes = data.draw(st.lists(st.tuples(*[SHARE] * spec.action_size), min_size=1, max_size=12))
    speeds = np.array((spec.max_speed, spec.max_sideways_speed, spec.max_turn_rate))
    world.reset(start)
    shield = strict_shield(spec, TIM561.rate_hz)
    for wish in np.repeat(np.array(wishes, np.float32), STEPS_OF_A_WISH, axis=0):
        action = shield.checked(wish, solid, world.pose, world.velocity)
        shares = action if spec.holonomic else action[[0, 0, 1]] * (1, 0, 1)
        forward, left, turn = (speeds * shares).tolist()
        world.step((forward, left, turn))
        assert not world.in_contact


def driven(agent: Agent, robot: str = "wheelchair", seconds: float = 40.0, **options: Any) -> Drive:
    env = SemNavEnv(robot, observation=agent.observation, max_seconds=seconds)
    told = {"command": COMMAND, "pose": BEFORE_THE_DOORS, **options}
    return drive(env, agent, 3, told)


@pytest.mark.parametrize("robot", ROBOTS)
def test_who_drives_at_random_hardly_touches_anything(robot: str) -> None:
    """A robot that backs at once may touch what its lidar has not seen yet."""

    class Wild(RandomAgent):
        observation = "all"

    alone, helped = driven(Wild(), robot), driven(Assisted(Wild()), robot)
    assert helped.recording.collisions < 0.3 * alone.recording.collisions


@pytest.mark.parametrize("doors", [True, False])
def test_a_good_driver_carries_out_the_command_all_the_same(doors: bool) -> None:
    alone, helped = (
        driven(agent) for agent in (make_agent("scripted"), Assisted(make_agent("scripted"), doors))
    )
    assert alone.metrics.success
    assert helped.metrics.success
    assert helped.recording.seconds < 1.3 * alone.recording.seconds


def test_assistance_can_be_switched_off_while_driving() -> None:
    assisted = Assisted(make_agent("scripted"))
    assisted.active = False
    alone, off = driven(make_agent("scripted")), driven(assisted)
    assert np.array_equal(alone.recording.poses, off.recording.poses)


def aimed(offset: float, assistance: bool, angle: float = 0.0) -> Drive:
    """A hand that drives straight on, set up before the door, beside the middle of it."""
    env = SemNavEnv(observation="all", max_seconds=12.0)
    door = next(each for each in env.floor_plan.doors if each.name == "south_1")
    along = np.subtract(door.end, door.start) / door.width
    through = np.array((along[1], -along[0]))  # out of the hallway
    x, y = np.array(door.midpoint) - 1.2 * through + offset * along
    heading = float(np.arctan2(through[1], through[0])) + angle
    told = {"command": "go through the first door ahead", "pose": (float(x), float(y), heading)}
    hand: Agent = StraightOn()
    return drive(env, Assisted(hand) if assistance else hand, 0, told)


class StraightOn(Hand):
    """A hand that drives straight on."""

    def reset(self, info: dict[str, Any]) -> None:
        super().reset(info)
        self.hold((0.3, 0.0))


@pytest.mark.parametrize("offset", [-0.25, 0.25])
def test_who_aims_at_a_jamb_is_led_through_the_door(offset: float) -> None:
    alone, helped = aimed(offset, assistance=False), aimed(offset, assistance=True)
    assert alone.recording.collisions > 0
    assert helped.recording.collisions == 0
    (passage,) = helped.passages()
    assert abs(passage.offset) < 0.1


def test_a_hand_does_what_was_set_last() -> None:
    hand = Hand()
    env = SemNavEnv(observation=hand.observation)
    observation, info = env.reset(seed=0)
    hand.reset(info)
    assert hand.act(observation).tolist() == [0.0, 0.0]
    hand.hold((0.5, -0.25))
    assert hand.act(observation).tolist() == [0.5, -0.25]


def test_a_driver_whose_observation_lacks_the_scan_is_told_so() -> None:
    class Unseeing(Hand):
        observation = "truth"

    with pytest.raises(ValueError, match="assistance needs the scan"):
        driven(Assisted(Unseeing()))


def test_a_semantic_driver_gets_the_scan_as_well() -> None:
    class Semantic(Hand):
        observation = "semantic"

    assert Assisted(Semantic()).observation == "all"
