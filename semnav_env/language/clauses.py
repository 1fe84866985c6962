"""The clauses of a command: frozen values that can be put in words.

`str(clause)` is canonical English, and `parse(str(clause)).clauses == (clause,)`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import ClassVar

from semnav_env.language.declarations import (
    DEGREES,
    ROOM,
    SECONDS,
    Form,
    Multiples,
    Spoken,
    TokenVerb,
    form,
)
from semnav_env.language.references import (
    ENTRY,
    Distance,
    DoorReference,
    Place,
    PlaceOffset,
    PlaceReference,
    RoomReference,
    Side,
    check_room_name,
)
from semnav_features.validation import shown

MAX_DEGREES, DEGREE_STEP = 360, 5
"""The largest turn by degrees, a full one, and the step of such turns, degrees."""

MAX_BACKING_UP = 10.0
"""How far a robot drives backwards at most, metres: few robots see behind them."""

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


class Speed(StrEnum):
    """How fast a robot drives, by what was said."""

    SLOW = "slow"
    FAST = "fast"


LANDMARK = (PlaceReference, DoorReference, RoomReference)
"""What one goes to or past along a hallway, or faces."""

SIDEWAYS = (Turning.LEFT, Turning.RIGHT)
"""The directions of a turn that lead to a side."""

WALLS = (Side.LEFT, Side.RIGHT)
"""The sides of a hallway that have a wall."""


class Clause(Spoken):
    """Base of all clauses: what a robot is to do, as a frozen dataclass with its `forms`."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Follow(Clause):
    """Follow the hallway: "go down the hallway until the next intersection".

    Attributes:
        until: how far; None if the next clause says it, or the end of the hallway does.
        past: go on until `until` lies behind, so that it no longer counts.
        along: keep along the wall of this side; None for the middle. A token has no room for it.
    """

    until: PlaceReference | DoorReference | RoomReference | PlaceOffset | Distance | None = None
    past: bool = False
    along: Side | None = None
    untokened: ClassVar[tuple[str, ...]] = ("along",)
    forms: ClassVar[tuple[Form, ...]] = (
        form("follow", "follow", "hallway", (TokenVerb.FOLLOW,)),
        form(
            "follow_for", "for {until}", "hallway for {until}", (TokenVerb.FOLLOW,), until=Distance
        ),
        form(
            "follow_until",
            "until {until}",
            "hallway until {until}",
            (TokenVerb.FOLLOW,),
            until=(*LANDMARK, PlaceOffset),
        ),
        form(
            *("follow_past", "past {until}", "hallway past {until}", (TokenVerb.PASS,)),
            until=LANDMARK,
            past=True,
        ),
        form(
            *("follow_along", "follow along {along}", "hallway along {along}"),
            (TokenVerb.FOLLOW,),
            along=WALLS,
            sampled=False,
        ),
        form(
            "follow_along_for",
            "for {until} along {along}",
            "hallway along {along} for {until}",
            (TokenVerb.FOLLOW,),
            until=Distance,
            along=WALLS,
            sampled=False,
        ),
        form(
            "follow_along_until",
            "until {until} along {along}",
            "hallway along {along} until {until}",
            (TokenVerb.FOLLOW,),
            until=(*LANDMARK, PlaceOffset),
            along=WALLS,
            sampled=False,
        ),
        form(
            "follow_along_past",
            "past {until} along {along}",
            "hallway along {along} past {until}",
            (TokenVerb.PASS,),
            until=LANDMARK,
            past=True,
            along=WALLS,
            sampled=False,
        ),
    )

    def __post_init__(self) -> None:
        if self.along not in (None, *WALLS):
            raise ValueError(f"a wall is on the left or on the right, not {self.along}")
        at_end = isinstance(self.until, PlaceReference) and self.until.place is Place.END
        is_far = self.until is None or isinstance(self.until, Distance | PlaceOffset)
        if self.past and (at_end or is_far):
            raise ValueError(f"one can go past a door or a junction, not {self.until}")
        _check_ahead(self.until.place if isinstance(self.until, PlaceOffset) else self.until)


@dataclass(frozen=True, slots=True)
class Turn(Clause):
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
    forms: ClassVar[tuple[Form, ...]] = (
        form("turn", "turn {turning}", "turn {turning}", (TokenVerb.TURN,), turning=SIDEWAYS),
        form(
            "turn:around", "turn_around", "turn around", (TokenVerb.TURN, 3), turning=Turning.AROUND
        ),
        form(
            *("turn_at", "turn {turning} {at}", "turn {turning} at {at}", (TokenVerb.TURN,)),
            turning=SIDEWAYS,
            at=PlaceReference,
        ),
        form(
            *("turn_at:around", "turn_around {at}", "turn around at {at}", (TokenVerb.TURN, 3)),
            turning=Turning.AROUND,
            at=PlaceReference,
        ),
        form(
            *("turn_by", "turn_by {turning} {degrees}", "turn {turning} {degrees}"),
            (TokenVerb.TURN, 0, DEGREES),
            turning=SIDEWAYS,
            degrees=Multiples(DEGREE_STEP, MAX_DEGREES),
        ),
    )

    def __post_init__(self) -> None:
        if self.degrees is None:
            return
        if self.at is not None or self.turning is Turning.AROUND:
            raise ValueError("a turn by degrees is to the left or right, on the spot")
        if not 0 < self.degrees <= MAX_DEGREES or self.degrees % DEGREE_STEP:
            limits = f"{DEGREE_STEP} to {MAX_DEGREES} degrees in steps of {DEGREE_STEP}"
            raise ValueError(f"a turn is by {limits}, not {shown(self.degrees)}")


@dataclass(frozen=True, slots=True)
class GoToDoor(Clause):
    """Go to a door or through it: "go through the second door on the right".

    Attributes:
        door: which door.
        approach: stop in front of it, stop in its doorway, or go through it.
        by_default: the approach was not said; see `defaults`. It does not count in comparisons.
    """

    door: DoorReference
    approach: Approach = Approach.THROUGH
    by_default: bool = field(default=False, compare=False, repr=False)
    forms: ClassVar[tuple[Form, ...]] = (
        form("through", "through {door}", "through {door}", (TokenVerb.GO_THROUGH,)),
        form("to", "to {door}", "to {door}", (TokenVerb.GO_TO,), approach=Approach.TO),
        form(
            "in",
            "in {door}",
            "in {door}",
            (TokenVerb.GO_TO, 1),
            approach=Approach.IN,
            sampled=False,
        ),
    )


@dataclass(frozen=True, slots=True)
class GoToRoom(Clause):
    """Go into a room by its name in the floor plan: "go to the kitchen", "go to room 3.508".

    Attributes:
        name: its plain name: small letters a to z and digits, parted by single spaces, dots,
            hyphens or underscores; at most `MAX_NAME` characters.
        approach: go in, or stop in front of its door.
    """

    name: str
    approach: Approach = Approach.THROUGH
    forms: ClassVar[tuple[Form, ...]] = (
        form("room", "through {name}", "room({name})", (TokenVerb.GO_TO_ROOM, 0, ROOM)),
        form(
            *("room_front", "to {name}", "to room({name})", (TokenVerb.GO_TO_ROOM, 1, ROOM)),
            approach=Approach.TO,
        ),
    )

    def __post_init__(self) -> None:
        check_room_name(self.name)
        if self.approach is Approach.IN:
            raise ValueError("one stops in front of a room or goes in, not in its doorway")


@dataclass(frozen=True, slots=True)
class Leave(Clause):
    """Leave the room in which the robot is: "leave the room"."""

    forms: ClassVar[tuple[Form, ...]] = (form("leave", "leave", "leave", (TokenVerb.LEAVE,)),)


@dataclass(frozen=True, slots=True)
class GoBack(Clause):
    """Go back to the pose at which the command began: "go back to the start"."""

    forms: ClassVar[tuple[Form, ...]] = (form("back", "back", "back", (TokenVerb.GO_BACK,)),)


@dataclass(frozen=True, slots=True)
class BackUp(Clause):
    """Drive backwards without turning: "back up for 2 metres".

    Attributes:
        distance: how far, at most `MAX_BACKING_UP` metres.
    """

    distance: Distance
    forms: ClassVar[tuple[Form, ...]] = (
        form(
            *("back_up", "reverse {distance}", "reverse {distance}", (TokenVerb.GO_BACK,)),
            distance=Distance,
            sampled=False,
        ),
    )

    def __post_init__(self) -> None:
        if self.distance.metres > MAX_BACKING_UP:
            most = f"a robot backs up at most {MAX_BACKING_UP:g} metres"
            raise ValueError(f"{most}, not {self.distance}; turn around first")


@dataclass(frozen=True, slots=True)
class Stop(Clause):
    """Stand still: "stop", "wait for 5 seconds".

    Attributes:
        seconds: for how long, 1 to `MAX_SECONDS`; 0 if the command does not say.
    """

    seconds: int = 0
    forms: ClassVar[tuple[Form, ...]] = (
        form("stop", "stop", "stop", (TokenVerb.STOP,)),
        form(
            *("wait", "wait {seconds}", "wait {seconds}", (TokenVerb.STOP, 0, SECONDS)),
            seconds=Multiples(1, MAX_SECONDS),
        ),
    )

    def __post_init__(self) -> None:
        if not isinstance(self.seconds, int) or not 0 <= self.seconds <= MAX_SECONDS:
            raise ValueError(f"a wait is of 1 to {MAX_SECONDS} seconds, not {shown(self.seconds)}")


@dataclass(frozen=True, slots=True)
class Pace(Clause):
    """Drive slowly, or fast, from here on, until another pace is said: "go slowly".

    It leads nowhere and is done at once. The judge does not judge it.
    """

    speed: Speed
    forms: ClassVar[tuple[Form, ...]] = (
        form("slow", "slow", "slow", (TokenVerb.STOP, 1), speed=Speed.SLOW, sampled=False),
        form("fast", "fast", "fast", (TokenVerb.STOP, 2), speed=Speed.FAST, sampled=False),
    )


def waits_of(seconds: int) -> tuple[Stop, ...]:
    """Waits that are so long together, each of at most `MAX_SECONDS`."""
    count = -int(-seconds // MAX_SECONDS)
    share, more = divmod(seconds, count)
    return tuple(Stop(share + (index < more)) for index in range(count))


@dataclass(frozen=True, slots=True)
class Face(Clause):
    """Turn on the spot until something is ahead: "face the second door on the left".

    Attributes:
        what: is to be ahead; a side: the nearest wall is to be on that side.
    """

    what: DoorReference | PlaceReference | RoomReference | Side
    forms: ClassVar[tuple[Form, ...]] = (
        form("face", "face {what}", "face {what}", (TokenVerb.TURN,), what=LANDMARK, sampled=False),
        form(
            *("face_wall", "wall {what}", "face wall {what}", (TokenVerb.TURN,)),
            what=WALLS,
            sampled=False,
        ),
    )

    def __post_init__(self) -> None:
        if isinstance(self.what, Side) and self.what not in WALLS:
            raise ValueError(f"a wall is on the left or on the right, not {self.what}")


MAX_BRANCHES = 7
"""The most clauses that depend on a condition: all others of a command."""


def _condition_form(absent: bool, then: int, otherwise: int) -> Form:
    """The form of a condition with so many clauses for each case.

    Its symbols have a number only where there is more than one clause: "if door 1 2 else".
    """
    verb, no = ("if_not", "no ") if absent else ("if", "")
    counts = [_summed(then) if then > 1 else "", "else" if otherwise else "", ""]
    counts[2] = _summed(otherwise) if otherwise > 1 else ""
    return form(
        verb,
        " ".join([verb, "{what}", *filter(None, counts)]),
        f"if {no}{{what}}",
        (TokenVerb.IF_THERE, 2 * absent + (otherwise > 0)),
        absent=absent,
        then=then,
        otherwise=otherwise,
        sampled=then == 1 and otherwise < 2,
    )


def _summed(count: int) -> str:
    """A number by the symbols that there are: 3 is "2 1"."""
    return " ".join(["2"] * (count // 2) + ["1"] * (count % 2))


@dataclass(frozen=True, slots=True)
class IfThere(Clause):
    """Carry out the next clauses only if something is there: "if there is a door on the left, ...".

    A token has room for whether something is done otherwise, but not for the numbers of clauses.

    Attributes:
        what: a door or a place ahead.
        absent: carry them out only if that is not there.
        otherwise: how many clauses after them are for the other case; True is 1.
        then: how many clauses are carried out; together at most `MAX_BRANCHES`.
    """

    what: DoorReference | PlaceReference
    absent: bool = False
    otherwise: int | bool = 0
    then: int = 1
    forms: ClassVar[tuple[Form, ...]] = tuple(
        _condition_form(absent, then, otherwise)
        for absent in (False, True)
        for then in range(1, MAX_BRANCHES + 1)
        for otherwise in range(MAX_BRANCHES + 1 - then)
    )

    def __post_init__(self) -> None:
        if not isinstance(self.what, DoorReference | PlaceReference):
            raise ValueError(f"a condition is on a door or a place ahead, not on {self.what!r}")
        _check_ahead(self.what)
        object.__setattr__(self, "otherwise", _checked_count("otherwise", self.otherwise, 0))
        object.__setattr__(self, "then", _checked_count("then", self.then, 1))
        if self.then + self.otherwise > MAX_BRANCHES:
            raise ValueError(f"at most {MAX_BRANCHES} clauses depend on a condition")


def _checked_count(what: str, count: object, least: int) -> int:
    """A number of clauses; programs of old say true for one."""
    if not isinstance(count, int) or not least <= count <= MAX_BRANCHES:
        raise ValueError(f"{what} is {least} to {MAX_BRANCHES} clauses, not {shown(count)}")
    return int(count)


def _check_ahead(reference: object) -> None:
    """Refuse the door by which the robot came where something ahead is to be named."""
    if isinstance(reference, DoorReference) and reference.ordinal == ENTRY:
        raise ValueError(f"{reference} lies behind: one goes to it or through it, or faces it")
