"""A wire within a process, and a navigator that notes what it is told."""

from __future__ import annotations

from semnav_ros.fields import FIELDS
from semnav_ros.goal_state import GoalState


class LoopWire:
    """Gives what is said to who hears it, at once, and keeps it; what is not given is zero."""

    def __init__(self):
        self.takers, self.said = {}, []

    def hear(self, topic, take):
        self.takers.setdefault(topic.name, []).append(take)

    def announce(self, topic):
        pass

    def wait(self, seconds):
        pass

    def say(self, topic, values):
        values = dict.fromkeys(FIELDS[topic.kind], 0) | values
        self.said.append((topic.name, values))
        for take in self.takers.get(topic.name, ()):
            take(values)


class NotedNavigator:
    """Accepts every goal, and never gets there by itself."""

    def __init__(self):
        self.state, self.goals, self.cancels = GoalState.CANCELLED, [], 0

    def send(self, goal, frame):
        self.goals.append(goal)
        self.state = GoalState.DRIVING

    def cancel(self, here, frame):
        self.cancels += 1
        self.state = GoalState.CANCELLED
