"""What is sent to a navigator: the first goal, changes of it, retries, and the end of it."""

import pytest

from semnav_ros.goal_sender import CANCEL_TIME, CORRECTION_PERIOD, RETRY_AFTER, GoalSender
from semnav_ros.goal_state import GoalState
from tests.ros.navigators import NotedNavigator

GOAL, HERE = (3.0, 1.0, 0.5), (0.0, 0.0, 0.0)


class Rig:
    """A sender with a navigator, and a clock."""

    def __init__(self):
        self.navigator, self.now = NotedNavigator(), 10.0
        self.sender = GoalSender(self.navigator)

    def want(self, goal, later=0.1):
        """Want a goal a little later; returns the problem."""
        self.now += later
        return self.sender.want(goal, HERE, "odom", self.now)


@pytest.fixture
def rig():
    return Rig()


def test_a_goal_is_sent_once(rig):
    assert [rig.want(GOAL) for _ in range(100)] == [""] * 100
    assert rig.navigator.goals == [GOAL]


def test_a_goal_that_moves_less_than_the_margin_is_not_sent_anew(rig):
    rig.want(GOAL)
    for k in range(50):
        rig.want((3.0 + 0.09 * (-1) ** k, 1.0, 0.5 + 0.09 * (-1) ** k))
    assert rig.navigator.goals == [GOAL]


@pytest.mark.parametrize("other", [(3.15, 1.0, 0.5), (3.0, 1.0, 0.7)])
def test_a_goal_that_moves_by_more_is_corrected_but_not_at_every_scan(rig, other):
    rig.want(GOAL)
    rig.want(other)
    assert rig.navigator.goals == [GOAL]
    rig.want(other, CORRECTION_PERIOD)
    assert rig.navigator.goals == [GOAL, other]


def test_another_goal_is_sent_at_once(rig):
    rig.want(GOAL)
    rig.want((6.0, 1.0, 0.5))
    assert len(rig.navigator.goals) == 2


def test_a_goal_that_is_not_wanted_any_more_is_called_back_in_the_same_call(rig):
    rig.want(GOAL)
    rig.want(None)
    assert rig.navigator.cancels == 1
    rig.want(None)
    assert rig.navigator.cancels == 1  # the navigator has said that it is over


def test_a_goal_is_called_back_again_until_the_navigator_says_that_it_is_over(rig):
    rig.navigator.cancel = lambda here, frame: calls.append(rig.now)
    calls = []
    rig.want(GOAL)
    for _ in range(50):
        rig.want(None)
    assert len(calls) > 3
    assert calls[-1] - calls[0] <= CANCEL_TIME


def test_nothing_is_called_back_where_nothing_was_sent(rig):
    rig.want(None)
    assert rig.navigator.cancels == 0


def test_the_same_goal_is_sent_again_after_it_was_called_back(rig):
    for goal in (GOAL, None, GOAL):
        rig.want(goal)
    assert rig.navigator.goals == [GOAL, GOAL]


@pytest.mark.parametrize(
    ("state", "why"),
    [
        (GoalState.GIVEN_UP, "given up"),
        (GoalState.REFUSED, "refused"),
        (GoalState.CANCELLED, "somebody else"),
        (GoalState.REACHED, "is there, but the clause is not done"),
        (GoalState.SENT, "no navigator has answered"),
    ],
)
def test_what_does_not_lead_on_is_said_and_sent_again_after_a_while(rig, state, why):
    rig.want(GOAL)
    rig.navigator.state = state
    said = [rig.want(GOAL) for _ in range(int(0.9 * RETRY_AFTER / 0.1))]
    assert why in said[-1]
    assert rig.navigator.goals == [GOAL]
    rig.want(GOAL, RETRY_AFTER)
    assert rig.navigator.goals == [GOAL, GOAL]


def test_a_navigator_that_tells_nothing_hears_a_goal_once_and_an_end_once(rig):
    rig.navigator.send = lambda goal, frame: rig.navigator.goals.append(goal)
    rig.navigator.cancel = lambda here, frame: rig.navigator.goals.append(here)
    rig.navigator.state = GoalState.UNTOLD
    assert {rig.want(GOAL) for _ in range(100)} == {""}
    for _ in range(50):
        rig.want(None)
    assert rig.navigator.goals == [GOAL, HERE]
