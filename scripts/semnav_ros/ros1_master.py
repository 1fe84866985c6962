"""Makes a node of ROS 1 known to a master that came back, which knows nobody any more."""

from __future__ import annotations

import threading
from importlib import import_module
from typing import Any

LOOK_PERIOD = 1.0
"""Time between two looks whether the master still knows the node, seconds."""


class MasterWatch(threading.Thread):
    """Tells the topics of this process again to a master that has forgotten them.

    What is connected stays connected while there is no master, so that a drive goes on. rospy tells
    its topics only once.

    Args:
        node: full name of the node, such as "/semnav".
    """

    def __init__(self, node: str) -> None:
        super().__init__(name="master watch", daemon=True)
        self._node, self._ends = node, threading.Event()
        self._rosgraph, self._topics = import_module("rosgraph"), import_module("rospy.topics")
        self._registration = import_module("rospy.impl.registration")

    def run(self) -> None:
        """Look until `end` is called."""
        master = self._rosgraph.Master(self._node)
        while not self._ends.wait(LOOK_PERIOD):
            try:
                master.lookupNode(self._node)
            except self._rosgraph.MasterError:  # it is there, and does not know this node
                self._tell()
            except OSError:  # it is not there
                continue

    def end(self) -> None:
        """End the thread."""
        self._ends.set()

    def _tell(self) -> None:
        known: Any = self._topics.get_topic_manager()
        listeners: Any = self._registration.get_registration_listeners()
        kinds = self._registration.Registration
        for name, kind in known.get_publications():
            listeners.notify_added(name, kind, kinds.PUB)
        for name, kind in known.get_subscriptions():
            listeners.notify_added(name, kind, kinds.SUB)
