"""What the page asks for: one small JSON object each, checked before anything is done with it."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields
from typing import Annotated, Any, TypeAlias

from semnav_env.world.maps import bundled_names
from semnav_features.checked_fields import Bounds, OneOf, check_fields
from semnav_features.frames import Point
from semnav_features.validation import clipped, require

MAX_REQUEST = 4096
"""Size of the largest request, characters."""

MAX_FILE = 4_000_000
"""Size of the largest file that is taken, bytes."""

MAX_TEXT = 500
"""Length of the longest command, characters."""

MAX_NAME = 80
"""Length of the longest name of a file, a door or a room, characters."""

OWN = "own"
"""The floor plan on the visitor's drawing board."""

MAX_BOXES = 8
"""The most boxes in a scene; and the most boxes, and people, that come into one run."""

AGENTS = ("scripted", "oracle", "drive", "listener", "listener_drives", "blind", "random")
"""Agents that the page offers. Only these: the name of an agent may load code from anywhere."""

OFFICES = ("small", "medium", "large", "hard", "house")
"""Distributions of generated floor plans."""

Metres: TypeAlias = Annotated[float, Bounds(-1000.0, 1000.0, "m")]
Place: TypeAlias = tuple[Metres, Metres]
Heading: TypeAlias = Annotated[float, Bounds(-7.0, 7.0, "rad")]


@dataclass(frozen=True)
class SceneRequest:
    """Begin anew with a floor plan, a body and an agent.

    Attributes:
        plan: a bundled floor plan, "office:medium:17", or "own": that of the drawing board; never
            a path.
        robot: wheelchair or spot.
        agent: one of `AGENTS`.
        seed: of everything that is random.
        pose: start of the robot, (x, y, heading), metres and radians; drawn if not given.
        people: number of people who walk about.
        boxes: places of boxes that are added to the plan, metres.
        leaves: whether doors have leaves, which can be shut by hand.
    """

    plan: str = "heidelberg_hallway"
    robot: Annotated[str, OneOf(("wheelchair", "spot"))] = "wheelchair"
    agent: Annotated[str, OneOf(AGENTS)] = "scripted"
    seed: Annotated[int, Bounds(0, 10**9)] = 0
    pose: tuple[Metres, Metres, Heading] | None = None
    people: Annotated[int, Bounds(0, 12)] = 0
    boxes: tuple[Place, ...] = ()
    leaves: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        listed = (*bundled_names(), OWN)
        known = self.plan in listed or self.plan.split(":")[0] == "office"
        names = ", ".join(listed)
        require(known, "plan", self.plan, f"one of {names}, or such as office:medium:17")
        require(len(self.boxes) <= MAX_BOXES, "boxes", self.boxes, f"at most {MAX_BOXES}")


@dataclass(frozen=True)
class CommandRequest:
    """Carry out a command from the start of the scene.

    Attributes:
        text: what was typed.
        language: "en" or "de"; recognised if not given.
    """

    text: str
    language: Annotated[str, OneOf(("en", "de"))] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        require(self.text.strip(), "text", self.text, "a command")
        require(len(self.text) <= MAX_TEXT, "text", self.text, f"at most {MAX_TEXT} characters")


@dataclass(frozen=True)
class AnswerRequest:
    """Answer the question that was asked last."""

    text: str

    def __post_init__(self) -> None:
        check_fields(self)
        require(len(self.text) <= MAX_TEXT, "text", self.text, f"at most {MAX_TEXT} characters")


@dataclass(frozen=True)
class PlaybackRequest:
    """Pause, go on, make one step, or stop the robot and end the run."""

    action: Annotated[str, OneOf(("pause", "go on", "step", "stop"))]

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class SpeedRequest:
    """Let time pass faster or more slowly.

    Attributes:
        factor: simulated seconds in a second.
    """

    factor: Annotated[float, Bounds(0.1, 16.0)]

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class DoorRequest:
    """Shut or open a door by hand.

    Attributes:
        door: its name in the floor plan.
        shut: whether it is to be shut.
    """

    door: str
    shut: bool

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class PutRequest:
    """Put a box or a person into the run, or the robot elsewhere.

    Attributes:
        what: "box", "person" or "robot".
        place: its middle, metres.
        heading: of the robot, radians; as it is if not given.
    """

    what: Annotated[str, OneOf(("box", "person", "robot"))]
    place: Place
    heading: Heading | None = None

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class KeepRequest:
    """Make a file to keep.

    Attributes:
        what: the film of the run, its command as an episode, the floor plan of the scene, or that
            of the drawing board.
    """

    what: Annotated[str, OneOf(("film", "episode", "plan", "board"))]

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class DrawRequest:
    """Draw on the floor plan, or take a step back.

    Attributes:
        tool: what is drawn: "open" takes the plan of the scene, if there is none yet, and "check"
            searches for faults.
        points: places on the plan: both ends of a line, or one place in a room.
        name: of what is drawn.
        length: the true length of a line, metres, for "scale".
    """

    tool: Annotated[
        str,
        OneOf(
            ("open", "door", "wall", "room", "corridor", "scale", "erase", "undo", "redo", "check")
        ),
    ]
    points: tuple[Place, ...] = ()
    name: str = ""
    length: Annotated[float, Bounds(0.01, 1000.0, "m")] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        require(len(self.name) <= MAX_NAME, "name", self.name, f"at most {MAX_NAME} characters")

    @property
    def place(self) -> Point:
        """The place that was pointed out."""
        require(len(self.points) == 1, "points", self.points, f"one place for {self.tool}")
        return self.points[0]

    @property
    def line(self) -> tuple[Point, Point]:
        """Both ends of the line that was drawn."""
        require(len(self.points) == 2, "points", self.points, f"two places for {self.tool}")
        start, end = self.points
        return start, end


@dataclass(frozen=True)
class FileRequest:
    """Put a floor plan from a file onto the drawing board.

    Attributes:
        name: of the file.
        content: of the file.
    """

    name: str
    content: bytes = b""


PageRequest: TypeAlias = (
    SceneRequest
    | CommandRequest
    | AnswerRequest
    | PlaybackRequest
    | SpeedRequest
    | DoorRequest
    | PutRequest
    | KeepRequest
    | DrawRequest
    | FileRequest
)

KINDS: dict[str, type[PageRequest]] = {
    "scene": SceneRequest,
    "command": CommandRequest,
    "answer": AnswerRequest,
    "playback": PlaybackRequest,
    "speed": SpeedRequest,
    "door": DoorRequest,
    "put": PutRequest,
    "keep": KeepRequest,
    "draw": DrawRequest,
}
"""Requests by the value of their key "type"."""


def read_file(message: bytes) -> FileRequest:
    """The file that a binary message brings: a line with its name in JSON, then its content.

    Raises:
        ValueError: it is something else, or too large; says in one line what would be right.
    """
    head, _, content = message.partition(b"\n")
    try:
        name = json.loads(head[:MAX_REQUEST])["name"]
    except (ValueError, RecursionError, TypeError, KeyError):
        raise ValueError('a binary message begins with a line {"name": "plan.geojson"}') from None
    if not isinstance(name, str) or not 0 < len(name) <= MAX_NAME or not name.isprintable():
        raise ValueError(f"the file's name is {clipped(repr(name))}; give a short one")
    require(len(content) <= MAX_FILE, name, f"{len(content)} bytes", f"at most {MAX_FILE}")
    return FileRequest(name, content)


def read_request(text: str) -> PageRequest:
    """The request that a message is.

    Args:
        text: a JSON object with "type" and the fields of that kind of request.

    Raises:
        ValueError: it is something else; says in one line what would be right.
    """
    if len(text) > MAX_REQUEST:
        raise ValueError(f"the message has {len(text)} characters; at most {MAX_REQUEST} are read")
    try:
        message = json.loads(text)
    except (ValueError, RecursionError):
        raise ValueError(f"the message is no JSON: {clipped(text)!r}") from None
    if not isinstance(message, dict):
        raise ValueError(f"the message is {clipped(text)}; it must be a JSON object")
    kind = message.pop("type", None)
    if not isinstance(kind, str) or kind not in KINDS:
        raise ValueError(f"type is {clipped(repr(kind))}; it must be one of {', '.join(KINDS)}")
    return _made(kind, message)


def _made(kind: str, values: dict[str, Any]) -> PageRequest:
    """The request of a kind with these fields."""
    known = [field.name for field in fields(KINDS[kind])]
    if unknown := [name for name in values if name not in known]:
        raise ValueError(f"{kind} has no {clipped(unknown[0])!r}; it has {', '.join(known) or '-'}")
    try:
        return KINDS[kind](**values)
    except TypeError:
        raise ValueError(f"{kind} lacks something; it has {', '.join(known)}") from None
