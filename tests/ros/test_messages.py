"""The table of fields against the definitions of ROS, and its messages there and back."""

from functools import reduce
from types import SimpleNamespace

import numpy as np
import pytest

from semnav_ros import conversions
from semnav_ros.fields import FIELDS, read, written
from semnav_ros.messages import MarkerMessage, OdometryMessage, ScanMessage
from semnav_ros.topics import NodeTopics

typesys = pytest.importorskip("rosbags.typesys")
ROS1 = typesys.get_typestore(typesys.Stores.ROS1_NOETIC)
ROS2 = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)


def full(kind):
    package, name = kind.split("/")
    return f"{package}/msg/{name}"


def members(store, kind):
    return dict(store.fielddefs[kind][1])


def kind_at(store, kind, path):
    """The description of the field at a path of a message."""
    *way, last = path.split(".")
    inner = reduce(lambda at, name: members(store, at)[name][1], way, kind)
    return members(store, inner)[last]


def new(kind):
    """An empty message whose attributes are those of ROS 2."""
    values = {"BASE": lambda d: "" if d[0] == "string" else 0, "NAME": lambda d: new(d)}
    fields = members(ROS2, kind if "/msg/" in kind else full(kind))
    made = {
        name: values.get(node.name, lambda _: [])(detail) for name, (node, detail) in fields.items()
    }
    return SimpleNamespace(**made)


@pytest.mark.parametrize(
    ("store", "kind"),
    [(s, k) for s in (ROS1, ROS2) for k in FIELDS if full(k) in s.fielddefs],  # ROS 1 lacks tf2
)
def test_every_field_lies_where_ros_says_it_lies(store, kind):
    for field in FIELDS[kind].values():
        path, items = (field, None) if isinstance(field, str) else field
        node, detail = kind_at(store, full(kind), path)
        if items is not None:
            assert node.name == "SEQUENCE"
            assert detail[0][1] == full(items)


def test_every_topic_has_a_type_of_the_table():
    topics = vars(NodeTopics()).values()
    assert {topic.kind for topic in topics} <= FIELDS.keys()
    assert len({topic.name for topic in topics}) == len(topics)


def test_a_topic_can_have_another_name():
    assert NodeTopics().renamed({"scan": "/front/scan"}).scan.name == "front/scan"
    with pytest.raises(ValueError, match="no topic 'scans'; there are: stop, command"):
        NodeTopics().renamed({"scans": "/front"})


def test_a_scan_survives_its_message():
    scan = ScanMessage(1234567890.25, np.array([1.0, 2.5]), -1.5, 0.01, 0.05, 8.0, 0.1, "laser")
    kind = "sensor_msgs/LaserScan"
    back = conversions.scan_message(read(kind, written(kind, conversions.scan_values(scan), new)))
    assert np.array_equal(back.ranges, scan.ranges)
    assert vars(back) | {"ranges": 0} == vars(scan) | {"ranges": 0}


def test_odometry_survives_its_message():
    odometry = OdometryMessage(7.5, (1.0, -2.0, 3.0), (0.5, 0.1, -0.2), "odom")
    kind = "nav_msgs/Odometry"
    message = written(kind, conversions.odometry_values(odometry, "base_link"), new)
    back = conversions.odometry_message(read(kind, message))
    assert back.pose == pytest.approx(odometry.pose)
    assert (back.stamp, back.twist, back.frame) == (7.5, odometry.twist, "odom")


def test_the_time_of_ros_1_is_read_and_written():
    header = SimpleNamespace(stamp=SimpleNamespace(secs=0, nsecs=0), frame_id="")
    message = SimpleNamespace(header=header, poses=[])
    written("geometry_msgs/PoseArray", {"stamp": 1700000000.5}, lambda kind: message)
    assert (header.stamp.secs, header.stamp.nsecs) == (1700000000, 500000000)
    assert read("geometry_msgs/PoseArray", message)["stamp"] == 1700000000.5


def test_markers_are_lines_in_the_frame_of_odometry():
    marker = MarkerMessage("doors", np.array([[0.0, 1.0], [0.0, 2.0]]), (0.0, 1.0, 0.0), 0.1)
    values = conversions.marker_values((marker,), "odom")
    message = written("visualization_msgs/MarkerArray", values, new).markers[0]
    assert (message.type, message.header.frame_id, message.ns) == (5, "odom", "doors")
    assert [(point.x, point.y) for point in message.points] == [(0.0, 1.0), (0.0, 2.0)]
    assert message.pose.orientation.w == 1.0
