"""What an agent that hears does beside what its network says."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from semnav_agents.hearing.agent import REST_SECONDS, HearingAgent
from semnav_agents.hearing.clause_state import ClauseState
from semnav_agents.hearing.network import NetworkOutput
from semnav_agents.hearing.told import outward_of
from semnav_env.env import SemNavEnv
from semnav_env.language import encode, parse
from semnav_env.mind.grounding import GoalKind
from semnav_env.mind.observations import SeenGoal

DOOR = np.array((0.0, -0.5, 0.0, 0.5))
"""Jambs; who comes from the left of the plane heads through it along x."""

STANDING = np.zeros(2, np.float32)


@pytest.mark.parametrize(
    "places",
    [
        [(-3.8, -0.1), (-2.3, -0.1), (-0.8, -0.1), (0.0, 0.0)],
        [(2.0, -1.7), (1.4, -1.7), (-0.4, -1.5), (0.0, 0.0)],  # around the end of the wall
        [(-0.8, -2.9), (-0.8, -1.4), (0.8, -0.2), (0.0, 0.0)],  # the last but one lies behind
        [(-1.0, 1.1), (0.0, 0.0)],
    ],
)
def test_a_way_leads_through_its_door_on_the_side_from_which_it_comes(places):
    for turn in (0.0, 1.0, 2.5):
        c, s = math.cos(turn), math.sin(turn)
        rotation = np.array([(c, s), (-s, c)])
        turned, jambs = np.array(places) @ rotation, (DOOR.reshape(2, 2) @ rotation).ravel()
        for each in (jambs, np.roll(jambs, 2)):
            assert outward_of(turned, each) @ (c, s) > 0.0


class StubbornNetwork:
    """Says that no clause is over, and that the goal is the robot's pose, moved along."""

    def __init__(self, along: float) -> None:
        self.along = along

    def ground(self, description):
        x, y, heading = description.robot
        pose = (x + self.along * math.cos(heading), y + self.along * math.sin(heading), heading)
        kinds = np.eye(4, dtype=np.float32)[GoalKind.REACH]
        return NetworkOutput(kinds, pose, 0, None, 0.0, np.array((1.0, 0.0, 0.0), np.float32))


def goals_of_a_robot_that_stands(network, seconds):
    """The goals that the driver is given, step by step."""
    goals = []

    def act(observation):
        goals.append(SeenGoal.read(observation["goal"]).kind)
        return STANDING

    driver = SimpleNamespace(observation="all", reset=lambda info: None, act=act)
    env, agent = SemNavEnv(observation="command"), HearingAgent(network, driver)
    options = {"command": "turn left and turn right", "pose": (-2.5, -0.3, 0.24)}
    observation, info = env.reset(seed=0, options=options)
    agent.reset(info)
    for _ in range(round(15 * seconds)):
        observation = env.step(agent.act(observation))[0]
    return goals


def test_a_robot_that_stands_where_a_clause_leads_goes_on_to_the_next():
    goals = goals_of_a_robot_that_stands(StubbornNetwork(0.1), 2.0 * REST_SECONDS + 1.0)
    assert goals[round(15 * REST_SECONDS) - 1] is GoalKind.REACH
    assert goals[-1] is GoalKind.STOP


def test_a_robot_that_stands_elsewhere_keeps_its_clause():
    goals = goals_of_a_robot_that_stands(StubbornNetwork(1.0), 2.0 * REST_SECONDS + 1.0)
    assert set(goals) == {GoalKind.REACH}


def test_what_was_to_be_done_otherwise_is_left_out():
    text = "if there is a door on the left, go through it, otherwise turn right"
    state = ClauseState(encode(parse(text)), (0.0, 0.0, 0.0))
    steps = []
    for clause in range(2):
        state.start_clause(clause, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        steps.append(state.step_when_done)
    assert steps == [1, 2]
