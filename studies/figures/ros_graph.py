"""Draw docs/images/ros_graph.png: the topics of `semnav node`, as semnav_ros declares them."""

from __future__ import annotations

from dataclasses import fields

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from semnav_ros.move_base import MOVE_BASE
from semnav_ros.nav2 import NAVIGATE_TO_POSE
from semnav_ros.topics import NodeTopics, Topic
from studies.figures import IMAGES

ENDS = {
    "stop": "switch",
    "command": "person",
    "tf_static": "robot",
    "odom": "base",
    "bumps": "bumper",
    "scan": "lidar",
    "cmd_vel": "base",
    "status": "screen",
    "said": "speaker",
    "belief": "other nodes",
    "goal": "other nodes",
    "goal_pose": "any navigator",
    "markers": "RViz",
}
"""Who is at the other end of each topic."""

HEARD = ("stop", "command", "tf_static", "odom", "bumps", "scan")

ACTION = "nav2, move_base"
"""The end of an action, which is none of the topics of the node."""

COLOURS = {(False, False): "C1", (True, False): "C0", (True, True): "C2"}
"""By whether a topic is reliable and whether it is latched."""

NAMES = {"C1": "best effort", "C0": "reliable", "C2": "reliable, latched"}


def quality(topic: Topic) -> str:
    """The colour of a topic."""
    return COLOURS[topic.reliable, topic.latched]


def said_topics() -> list[str]:
    """The fields of the topics that the node says, in their order."""
    return [field.name for field in fields(NodeTopics) if field.name not in HEARD]


def draw(ax: Axes) -> None:
    """The node in the middle, what it hears on its left, and what it says on its right."""
    topics, said = NodeTopics(), said_topics()
    rows = max(len(HEARD), len(said) + 1)
    ax.add_patch(_box(rows))
    ax.text(0.0, rows / 2, "semnav node", ha="center", va="center", fontsize=12, weight="bold")
    for place, name in zip(_places(len(HEARD), rows), HEARD, strict=True):
        topic: Topic = getattr(topics, name)
        _arrow(ax, -4.2, -1.0, place, topic.name, topic.kind, quality(topic))
        ax.text(-4.4, place, ENDS[name], ha="right", va="center")
    places = _places(len(said) + 1, rows)
    for place, name in zip(places, said, strict=False):
        topic = getattr(topics, name)
        _arrow(ax, 1.0, 4.2, place, topic.name, topic.kind, quality(topic))
        ax.text(4.4, place, ENDS[name], ha="left", va="center")
    _arrow(ax, 1.0, 4.2, places[-1], NAVIGATE_TO_POSE, f"{MOVE_BASE} in ROS 1", "C3")
    ax.text(4.4, places[-1], ACTION, ha="left", va="center")
    for colour, name in (NAMES | {"C3": "action, both ways"}).items():
        ax.plot([], [], color=colour, label=name)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=4, fontsize=9, frameon=False)
    ax.set(xlim=(-5.6, 6.4), ylim=(0.0, rows))
    ax.axis("off")


def _places(count: int, rows: int) -> list[float]:
    """Heights of arrows, from above."""
    step = rows / count
    return [rows - step * (k + 0.5) for k in range(count)]


def _box(rows: int) -> Rectangle:
    return Rectangle((-1.0, 0.1), 2.0, rows - 0.2, facecolor="0.93", edgecolor="0.3")


def _arrow(
    ax: Axes, start: float, end: float, place: float, name: str, kind: str, colour: str
) -> None:
    """One arrow, its name above it and its type below."""
    style = {"arrowstyle": "<->" if colour == "C3" else "->", "color": colour, "linewidth": 1.6}
    ax.annotate("", (end, place), (start, place), arrowprops=style)
    middle = (start + end) / 2
    ax.text(middle, place + 0.06, name, ha="center", va="bottom", family="monospace", fontsize=9)
    ax.text(middle, place - 0.08, kind, ha="center", va="top", fontsize=7, color="0.4")


def main() -> None:
    """Draw the picture."""
    figure = Figure(figsize=(10.0, 5.6), layout="constrained")
    FigureCanvasAgg(figure)
    draw(figure.add_subplot())
    IMAGES.mkdir(exist_ok=True)
    figure.savefig(IMAGES / "ros_graph.png", dpi=110)
