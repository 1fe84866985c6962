"""The clauses of a command: frozen values that can be put in words.

`str(clause)` is canonical English, and `parse(str(clause)).clauses == (clause,)`.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING, TypeAlias

from semnav_env.language.references import (
    Distance,
    DoorReference,
    Place,
    PlaceReference,
    RoomReference,
    Side,
    Spoken,
    check_room_name,
)
from semnav_features.validation import shown

if TYPE_CHECKING:
    from semnav_env.language.language import Language

MAX_DEGREES, DEGREE_STEP = 360, 5
"""The largest turn by degrees, a full one, and the step of such turns, degrees."""

MAX_SECONDS = 100
"""The longest wait, seconds; the most that a token holds."""


class Turning(StrEnum):
    """The direction of a turn."""

    LEFT = "left"
    RIGHT = "right"
    AROUND = "around"


class Approach(StrEnum):
    """Whether a robot stops in front of a door, stops in the doorway, or goes through it."""

    TO = "to"
    THROUGH = "through"
    IN = "in"


@dataclass(frozen=True, slots=True)
class Follow(Spoken):
    """Follow the hallway: "go down the hallway until the next intersection".

    Attributes:
        until: how far; None if the next clause says it, or the end of the hallway does.
        past: go on until `until` lies behind, so that it no longer counts.
    """

    until: PlaceReference | DoorReference | RoomReference | Distance | None = None
    past: bool = False

    def __post_init__(self) -> None:
        at_end = isinstance(self.until, PlaceReference) and self.until.place is Place.END
        if self.past and (self.until is None or at_end or isinstance(self.until, Distance)):
            raise ValueError(f"one can go past a door or a junction, not {self.until}")

    def say(self, language: Language) -> str:
        """In the words of a language."""
        if self.until is None:
            return language.say("follow")
        distance = isinstance(self.until, Distance)
        relation = "past" if self.past else "for" if distance else "until"
        return language.say(f"follow_{relation}", referent=self.until)


@dataclass(frozen=True, slots=True)
class Turn(Spoken):
    """Change direction: "turn left at the second intersection".

    Attributes:
        turning: which way.
        at: where; None means here.
        degrees: turn on the spot by so much; None means into the arm on that side, or by a quarter
            turn if there is none.
    """

    turning: Turning
    at: PlaceReference | None = None
    degrees: int | None = None

    def __post_init__(self) -> None:
        if self.degrees is None:
            return
        if self.at is not None or self.turning is Turning.AROUND:
            raise ValueError("a turn by degrees is to the left or right, on the spot")
        if not 0 < self.degrees <= MAX_DEGREES or self.degrees % DEGREE_STEP:
            limits = f"{DEGREE_STEP} to {MAX_DEGREES} degrees in steps of {DEGREE_STEP}"
            raise ValueError(f"a turn is by {limits}, not {shown(self.degrees)}")

    def say(self, language: Language) -> str:
        """In the words of a language."""
        turning = language.say(self.turning)
        form = "around" if self.turning is Turning.AROUND else ""
        if self.degrees is not None:
            return language.say("turn_by", turning=turning, degrees=str(self.degrees))
        if self.at is not None:
            return language.say("turn_at", form, turning=turning, place=self.at)
        return language.say("turn", form, turning=turning)


@dataclass(frozen=True, slots=True)
class GoToDoor(Spoken):
    """Go to a door or through it: "go through the second door on the right".

    Attributes:
        door: which door.
        approach: stop in front of it, stop in its doorway, or go through it.
        by_default: the approach was not said; see `defaults`. It does not count in comparisons.
    """

    door: DoorReference
    approach: Approach = Approach.THROUGH
    by_default: bool = field(default=False, compare=False, repr=False)

    def say(self, language: Language) -> str:
        """In the words of a language."""
        return language.say(self.approach, door=self.door)


@dataclass(frozen=True, slots=True)
class GoToRoom(Spoken):
    """Go into a room by its name in the floor plan: "go to the kitchen", "go to room 3.508".

    Attributes:
        name: its plain name: small letters a to z and digits, parted by single spaces, dots,
            hyphens or underscores; at most `MAX_NAME` characters.
        approach: go in, or stop in front of its door.
    """

    name: str
    approach: Approach = Approach.THROUGH

    def __post_init__(self) -> None:
        check_room_name(self.name)
        if self.approach is Approach.IN:
            raise ValueError("one stops in front of a room or goes in, not in its doorway")

    def say(self, language: Language) -> str:
        """In the words of a language."""
        phrase = "room" if self.approach is Approach.THROUGH else "room_front"
        return language.say(phrase, name=self.name)


@dataclass(frozen=True, slots=True)
class Leave(Spoken):
    """Leave the room in which the robot is: "leave the room"."""

    def say(self, language: Language) -> str:
        """In the words of a language."""
        return language.say("leave")


@dataclass(frozen=True, slots=True)
class GoBack(Spoken):
    """Go back to the pose at which the command began: "go back to the start"."""

    def say(self, language: Language) -> str:
        """In the words of a language."""
        return language.say("back")


@dataclass(frozen=True, slots=True)
class SearchHouse(Spoken):
    """Look into every room and report every person that is found: "search the house"."""

    def say(self, language: Language) -> str:
        """In the words of a language."""
        return language.say("search")


@dataclass(frozen=True, slots=True)
class Stop(Spoken):
    """Stand still: "stop", "wait for 5 seconds".

    Attributes:
        seconds: for how long, 1 to `MAX_SECONDS`; 0 if the command does not say.
    """

    seconds: int = 0

    def __post_init__(self) -> None:
        if not isinstance(self.seconds, int) or not 0 <= self.seconds <= MAX_SECONDS:
            raise ValueError(f"a wait is of 1 to {MAX_SECONDS} seconds, not {shown(self.seconds)}")

    def say(self, language: Language) -> str:
        """In the words of a language."""
        if self.seconds:
            return language.say("wait", seconds=str(self.seconds))
        return language.say("stop")


@dataclass(frozen=True, slots=True)
class Face(Spoken):
    """Turn on the spot until something is ahead: "face the second door on the left".

    Attributes:
        what: is to be ahead; a side: the nearest wall is to be on that side.
    """

    what: DoorReference | PlaceReference | RoomReference | Side

    def __post_init__(self) -> None:
        if isinstance(self.what, Side) and self.what not in (Side.LEFT, Side.RIGHT):
            raise ValueError(f"a wall is on the left or on the right, not {self.what}")

    def say(self, language: Language) -> str:
        """In the words of a language."""
        if isinstance(self.what, Side):
            return language.say("face_wall", side=language.say(self.what))
        return language.say("face", referent=self.what)


@dataclass(frozen=True, slots=True)
class IfThere(Spoken):
    """Carry out the next clause only if something is there: "if there is a door on the left, ...".

    Attributes:
        what: a door or a place ahead.
        absent: carry it out only if that is not there.
        otherwise: the clause after the next one is for the other case.
    """

    what: DoorReference | PlaceReference
    absent: bool = False
    otherwise: bool = False

    def __post_init__(self) -> None:
        if not isinstance(self.what, DoorReference | PlaceReference):
            raise ValueError(f"a condition is on a door or a place ahead, not on {self.what!r}")

    def say(self, language: Language) -> str:
        """In the words of a language."""
        return language.say("if_not" if self.absent else "if", referent=self.what)


class OwnClause(Spoken, ABC):
    """Base of clauses that are defined outside this package, see docs/extending.md.

    `semnav_env.mind.grounding.GroundedClause` derives from it and adds where a clause leads. The
    grammar has no words for such a clause: a command with it is given as a `Command`.
    """

    __slots__ = ()

    @abstractmethod
    def say(self, language: Language) -> str:
        """In the words of a language."""

    @property
    @abstractmethod
    def stand_in(self) -> Clause:
        """The clause of this package that a learner sees in its place, as its token."""


Clause: TypeAlias = (
    Follow
    | Turn
    | GoToDoor
    | GoToRoom
    | Leave
    | GoBack
    | SearchHouse
    | Stop
    | Face
    | IfThere
    | OwnClause
)
