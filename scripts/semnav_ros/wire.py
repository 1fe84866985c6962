"""What carries messages: ROS 1, ROS 2 or DDS alone, behind one protocol."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from threading import Condition
from typing import Any, Protocol, TypeAlias

from semnav_ros.fields import Values, read
from semnav_ros.navigator import Navigator, NavigatorServer, TakeGoal
from semnav_ros.topics import Topic

Take: TypeAlias = Callable[[Values], None]
"""What a message is given to, as plain data."""


class Wire(Protocol):
    """Publishes and hears topics, in one thread."""

    def hear(self, topic: Topic, take: Take) -> None:
        """Give each message of a topic to `take`, in `wait`."""

    def announce(self, topic: Topic) -> None:
        """Say that messages of a topic will come."""

    def say(self, topic: Topic, values: Values) -> None:
        """Publish a message of a topic that was announced."""

    def listeners(self, topic: Topic) -> int:
        """How many hear a topic that was announced, itself included."""

    def wait(self, seconds: float) -> None:
        """Wait for messages for at most this time, and give what came to who takes it."""

    def navigator(self, action: str | None) -> Navigator:
        """What sends goals to an action; the usual one if no name is given."""

    def navigator_server(self, take: TakeGoal, action: str | None) -> NavigatorServer:
        """What hears the goals of an action, in place of a navigator.

        Raises:
            ValueError: this wire has none.
        """

    def close(self) -> None:
        """End the connection."""


class Waiting:
    """Messages that wait, by topic; those of the topic that was added first come first."""

    def __init__(self) -> None:
        self._came = Condition()
        self._queues: list[tuple[Topic, Take, deque[Any]]] = []

    def add(self, topic: Topic, take: Take) -> Callable[[Any], None]:
        """Add a topic; returns what its messages are put in with, from any thread."""
        queue: deque[Any] = deque(maxlen=topic.depth)
        self._queues.append((topic, take, queue))

        def put(message: Any) -> None:
            with self._came:
                queue.append(message)
                self._came.notify()

        return put

    def give(self, seconds: float) -> None:
        """Wait for at most this time for messages, and give them out."""
        with self._came:
            if not any(queue for *_, queue in self._queues):
                self._came.wait(seconds)
        for topic, take, message in self._taken():
            take(read(topic.kind, message))

    def _taken(self) -> Iterator[tuple[Topic, Take, Any]]:
        """The messages that wait, until none is left or a scan was given out."""
        while found := next((entry for entry in self._queues if entry[2]), None):
            topic, take, queue = found
            yield topic, take, queue.popleft()
            if found is self._queues[-1]:
                return
