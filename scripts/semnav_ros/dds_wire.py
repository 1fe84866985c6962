"""Talks to ROS 2 without ROS: Cyclone DDS, with the types that ROS 2 puts on the wire."""

from __future__ import annotations

import dataclasses
from dataclasses import field
from functools import cache
from types import new_class
from typing import Any

from cyclonedds.core import (
    InstanceState,
    Policy,
    Qos,
    ReadCondition,
    SampleState,
    ViewState,
    WaitSet,
)
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct, types
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic as DdsTopic
from cyclonedds.util import duration
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from semnav_ros.fields import Values, read, written
from semnav_ros.nav2 import NAVIGATE_TO_POSE, Nav2Navigator, Nav2Server
from semnav_ros.navigator import TakeGoal
from semnav_ros.service_types import HEADER, SERVICE_TYPES
from semnav_ros.topics import Topic
from semnav_ros.wire import Take

NOT_TAKEN = SampleState.Any | ViewState.Any | InstanceState.Any


class DdsWire:
    """A participant in the DDS domain of ROS_DOMAIN_ID (0 if it is not set).

    It has no thread of its own: messages wait in the readers, those of the topic that was heard
    first are given out first.
    """

    def __init__(self) -> None:
        from os import environ

        self._participant = DomainParticipant(int(environ.get("ROS_DOMAIN_ID", "0")))
        self._awaited = WaitSet(self._participant)
        self._readers: list[tuple[Topic, Take, DataReader[Any]]] = []
        self._writers: dict[str, DataWriter[Any]] = {}

    def hear(self, topic: Topic, take: Take) -> None:
        """Give each message of a topic to `take`, in `wait`."""
        reader = DataReader(self._participant, self._place(topic), qos_of(topic))
        self._awaited.attach(ReadCondition(reader, NOT_TAKEN))
        self._readers.append((topic, take, reader))

    def announce(self, topic: Topic) -> None:
        """Say that messages of a topic will come."""
        writer = DataWriter(self._participant, self._place(topic), qos_of(topic))
        self._writers[topic.name] = writer

    def say(self, topic: Topic, values: Values) -> None:
        """Publish a message of a topic that was announced."""
        message = written(topic.kind, values, lambda kind: dds_type(kind)())
        self._writers[topic.name].write(message)

    def listeners(self, topic: Topic) -> int:
        """How many hear a topic that was announced, itself included."""
        return len(self._writers[topic.name].get_matched_subscriptions())

    def wait(self, seconds: float) -> None:
        """Wait for messages for at most this time, and give what came to who takes it."""
        self._awaited.wait(int(seconds * 1e9))
        for topic, take, reader in self._readers:
            for message in reader.take(N=topic.depth):
                if message.sample_info.valid_data:
                    take(read(topic.kind, message))

    def navigator(self, action: str | None) -> Nav2Navigator:
        """What sends goals to nav2."""
        return Nav2Navigator(self, action or NAVIGATE_TO_POSE)

    def navigator_server(self, take: TakeGoal, action: str | None) -> Nav2Server:
        """What hears the goals of nav2 in its place."""
        return Nav2Server(self, take, action or NAVIGATE_TO_POSE)

    def close(self) -> None:
        """Leave the domain."""
        del self._awaited
        self._readers.clear()
        self._writers.clear()
        del self._participant

    def _place(self, topic: Topic) -> DdsTopic[Any]:
        return DdsTopic(self._participant, f"{topic.prefix}/{topic.name}", dds_type(topic.kind))


def qos_of(topic: Topic) -> Qos:
    """The quality of service of a topic."""
    return Qos(
        Policy.Reliability.Reliable(duration(milliseconds=100))
        if topic.reliable
        else Policy.Reliability.BestEffort,
        Policy.Durability.TransientLocal if topic.latched else Policy.Durability.Volatile,
        Policy.History.KeepLast(topic.depth),
    )


@cache
def dds_type(kind: str) -> type[Any]:
    """The class of a message of ROS 2, such as "sensor_msgs/LaserScan", as it is on the wire.

    It is made from the definition that ROS 2 ships, which rosbags holds, or that of a service.
    """
    package, name = kind.split("/")
    group, _ = SERVICE_TYPES.get(kind, ("msg", ""))
    definitions = _type_store().fielddefs[f"{package}/msg/{name}"][1]
    made = [_member(each, description) for each, description in definitions]

    def body(space: dict[str, Any]) -> None:
        space["__annotations__"] = {each: kind for each, kind, _ in made}
        space.update({each: field(default_factory=default) for each, _, default in made})

    typename = f"{package}::{group}::dds_::{name}_"
    base = new_class(name, (IdlStruct,), {"typename": typename}, body)
    return dataclasses.dataclass(base)


@cache
def _type_store() -> Typestore:
    """The definitions of the types."""
    store = get_typestore(Stores.ROS2_HUMBLE)
    for name, (_, text) in SERVICE_TYPES.items():
        store.register(get_types_from_msg(HEADER + text, name.replace("/", "/msg/")))
    return store


def _member(name: str, description: Any) -> tuple[str, Any, Any]:
    """Name, type for Cyclone, and maker of the default of a field."""
    kind, default = _type_of(description)
    return name, kind, default


def _type_of(description: Any) -> tuple[Any, Any]:
    node, detail = description
    if node.name == "BASE":
        plain, _ = detail
        if plain == "string":
            return str, str
        if plain == "bool":
            return bool, bool
        return getattr(types, plain), float if plain.startswith("float") else int
    if node.name == "NAME":
        made = dds_type(detail.replace("/msg/", "/"))
        return made, made
    inner, count = detail
    item, default = _type_of(inner)
    if node.name == "ARRAY":
        row: Any = types.array
        return row[item, count], lambda: [default() for _ in range(count)]
    several: Any = types.sequence
    return several[item], list
