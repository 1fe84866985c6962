"""What the page asks for: one small JSON object each, checked before anything is done with it."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields
from typing import Annotated, Any, TypeAlias

from semnav_env.world.maps import bundled_names
from semnav_features.checked_fields import Bounds, OneOf, check_fields
from semnav_features.validation import clipped, require

MAX_REQUEST = 4096
"""Size of the largest request, characters."""

MAX_TEXT = 500
"""Length of the longest command, characters."""

MAX_BOXES = 8
"""The most boxes that can be put into a scene."""

AGENTS = ("scripted", "oracle", "drive", "listener", "listener_drives", "blind", "random")
"""Agents that the page offers. Only these: the name of an agent may load code from anywhere."""

OFFICES = ("small", "medium", "large", "hard", "house")
"""Distributions of generated floor plans."""

Metres: TypeAlias = Annotated[float, Bounds(-1000.0, 1000.0, "m")]
Place: TypeAlias = tuple[Metres, Metres]


@dataclass(frozen=True)
class SceneRequest:
    """Begin anew with a floor plan, a body and an agent.

    Attributes:
        plan: a bundled floor plan, or "office:medium:17"; never a path.
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
    pose: tuple[Metres, Metres, Annotated[float, Bounds(-7.0, 7.0, "rad")]] | None = None
    people: Annotated[int, Bounds(0, 12)] = 0
    boxes: tuple[Place, ...] = ()
    leaves: bool = True

    def __post_init__(self) -> None:
        check_fields(self)
        known = self.plan in bundled_names() or self.plan.split(":")[0] == "office"
        names = ", ".join(bundled_names())
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
class FilmRequest:
    """Make a GIF of the run so far."""


PageRequest: TypeAlias = (
    SceneRequest
    | CommandRequest
    | AnswerRequest
    | PlaybackRequest
    | SpeedRequest
    | DoorRequest
    | FilmRequest
)

KINDS: dict[str, type[PageRequest]] = {
    "scene": SceneRequest,
    "command": CommandRequest,
    "answer": AnswerRequest,
    "playback": PlaybackRequest,
    "speed": SpeedRequest,
    "door": DoorRequest,
    "film": FilmRequest,
}
"""Requests by the value of their key "type"."""


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
