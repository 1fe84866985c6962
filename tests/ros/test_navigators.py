"""The actions of nav2 and move_base, both sides, without a middleware; and rclpy on a stand-in."""

import sys
from types import ModuleType, SimpleNamespace

import pytest

from semnav_ros.goal_state import GoalState
from semnav_ros.move_base import MoveBaseNavigator, MoveBaseServer
from semnav_ros.nav2 import Nav2Navigator, Nav2Server
from semnav_ros.topic_navigator import TopicNavigator, TopicServer
from semnav_ros.topics import NodeTopics
from tests.ros.navigators import LoopWire

GOAL, HERE = (3.0, 1.0, 0.5), (0.5, 0.0, 0.1)
SIDES = [(Nav2Navigator, Nav2Server), (MoveBaseNavigator, MoveBaseServer)]


class Pair:
    """A navigator and a server on one wire, and the goals that came."""

    def __init__(self, sides):
        self.wire, self.taken = LoopWire(), []
        self.server = sides[1](self.wire, self.taken.append)
        self.navigator = sides[0](self.wire)


@pytest.fixture(params=SIDES, ids=["nav2", "move_base"])
def pair(request):
    return Pair(request.param)


def test_a_goal_arrives_as_it_was_sent_and_is_driven_to(pair):
    pair.navigator.send(GOAL, "odom")
    assert pair.taken == [pytest.approx(GOAL)]
    assert pair.navigator.state is GoalState.DRIVING
    pair.server.tell(GoalState.REACHED)
    assert pair.navigator.state is GoalState.REACHED


def test_a_goal_that_is_called_back_is_over(pair):
    pair.navigator.send(GOAL, "odom")
    pair.navigator.cancel(HERE, "odom")
    assert pair.taken[1:] == [None]
    assert pair.navigator.state is GoalState.CANCELLED


def test_what_becomes_of_an_earlier_goal_does_not_count(pair):
    pair.navigator.send(GOAL, "odom")
    status, values = pair.wire.said[-1]
    pair.navigator.send((6.0, 1.0, 0.5), "odom")
    given_up = 6 if isinstance(pair.navigator, Nav2Navigator) else 4
    old = {"states": [values["states"][0] | {"state": given_up}]}
    for take in pair.wire.takers[status]:
        take(old)
    assert pair.navigator.state is GoalState.DRIVING


def test_a_goal_of_somebody_else_is_not_called_back(pair):
    pair.navigator.send(GOAL, "odom")
    other = type(pair.navigator)(pair.wire)
    other.send((9.0, 0.0, 0.0), "odom")
    pair.navigator.cancel(HERE, "odom")
    assert None not in pair.taken


def test_a_goal_that_nav2_does_not_accept_is_refused():
    wire = LoopWire()
    navigator = Nav2Navigator(wire)
    navigator.send(GOAL, "odom")
    _, request = wire.said[-1]
    (take,) = wire.takers["navigate_to_pose/_action/send_goalReply"]
    take({"client": request["client"] + 1, "number": request["number"], "accepted": False})
    assert navigator.state is GoalState.SENT  # the answer to another client
    take({"client": request["client"], "number": request["number"], "accepted": False})
    assert navigator.state is GoalState.REFUSED


def test_a_navigator_on_a_topic_is_sent_to_where_it_is_in_order_to_stop():
    wire, taken, topic = LoopWire(), [], NodeTopics().goal_pose
    TopicServer(wire, taken.append, topic).tell(GoalState.REACHED)
    navigator = TopicNavigator(wire, topic)
    navigator.send(GOAL, "odom")
    navigator.cancel(HERE, "odom")
    assert taken == [pytest.approx(GOAL), pytest.approx(HERE)]
    assert navigator.state is GoalState.UNTOLD


class Future:
    """A future of rclpy: `come` is its result."""

    def __init__(self):
        self.calls = []

    def add_done_callback(self, call):
        self.calls.append(call)

    def come(self, result):
        self.result = lambda: result
        for call in self.calls:
            call(self)


class Client:
    """The part of rclpy's action client that is used."""

    def __init__(self, node, action, name):
        node.client, self.name, self.ready, self.sent = self, name, True, []

    def server_is_ready(self):
        return self.ready

    def send_goal_async(self, goal):
        self.sent.append(goal)
        self.asked = Future()
        return self.asked


class Handle:
    """The part of rclpy's handle of a goal that is used."""

    def __init__(self, accepted=True):
        self.accepted, self.ended, self.cancels = accepted, Future(), 0

    def get_result_async(self):
        return self.ended

    def cancel_goal_async(self):
        self.cancels += 1


def empty_goal():
    place = SimpleNamespace(position=SimpleNamespace(), orientation=SimpleNamespace())
    return SimpleNamespace(pose=SimpleNamespace(header=SimpleNamespace(), pose=place))


@pytest.fixture
def by_rclpy(monkeypatch):
    rclpy, action, nav2 = (ModuleType(n) for n in ("rclpy", "rclpy.action", "nav2_msgs.action"))
    action.ActionClient, nav2.NavigateToPose = Client, SimpleNamespace(Goal=empty_goal)
    for module in (rclpy, action, nav2):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.delitem(sys.modules, "semnav_ros.ros2_navigator", raising=False)
    from semnav_ros.ros2_navigator import Ros2Navigator

    node = SimpleNamespace()
    yield Ros2Navigator(node), node.client
    sys.modules.pop("semnav_ros.ros2_navigator", None)


def test_rclpy_sends_the_goal_and_tells_what_becomes_of_it(by_rclpy):
    navigator, client = by_rclpy
    navigator.send(GOAL, "odom")
    assert client.name == "navigate_to_pose"
    assert client.sent[0].pose.header.frame_id == "odom"
    assert vars(client.sent[0].pose.pose.position) == {"x": 3.0, "y": 1.0}
    assert navigator.state is GoalState.SENT
    handle = Handle()
    client.asked.come(handle)
    assert navigator.state is GoalState.DRIVING
    navigator.cancel(HERE, "odom")
    assert handle.cancels == 1
    handle.ended.come(SimpleNamespace(status=5))
    assert navigator.state is GoalState.CANCELLED


def test_rclpy_hears_only_of_the_last_goal(by_rclpy):
    navigator, client = by_rclpy
    navigator.send(GOAL, "odom")
    first, handle = client.asked, Handle()
    first.come(handle)
    navigator.send((6.0, 0.0, 0.0), "odom")
    handle.ended.come(SimpleNamespace(status=6))
    assert navigator.state is GoalState.SENT
    client.asked.come(Handle(accepted=False))
    assert navigator.state is GoalState.REFUSED


def test_rclpy_calls_a_goal_back_that_was_accepted_too_late(by_rclpy):
    navigator, client = by_rclpy
    navigator.send(GOAL, "odom")
    navigator.cancel(HERE, "odom")
    handle = Handle()
    client.asked.come(handle)
    navigator.cancel(HERE, "odom")  # the sender repeats it until the goal is over
    assert handle.cancels == 1


def test_nothing_is_sent_by_rclpy_where_nobody_listens(by_rclpy):
    navigator, client = by_rclpy
    client.ready = False
    navigator.send(GOAL, "odom")
    assert (client.sent, navigator.state) == ([], GoalState.SENT)
