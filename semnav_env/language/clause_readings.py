"""What a stretch of text can mean: readings, each made of clauses and of marks for clauses.

A mark is a step that has no meaning by itself. It changes the clause before it, or says how the
clauses around it belong together; `command_readings` applies it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeAlias, get_args

from semnav_env.language.clauses import Clause, Follow, GoToDoor, IfThere, Turn, Turning
from semnav_env.language.references import DoorReference, PlaceReference, Side


@dataclass(frozen=True, slots=True)
class EnterMentionedDoor:
    """Mark: go through the door that was mentioned last ("... and go in")."""


@dataclass(frozen=True, slots=True)
class StopBeforeMentioned:
    """Mark: in front of the door or room that was mentioned last ("... and stop outside")."""


@dataclass(frozen=True, slots=True)
class IntoDoorway:
    """Mark: into a doorway: through it, unless the next clause is to stop there.

    Attributes:
        door: which door.
    """

    door: DoorReference


@dataclass(frozen=True, slots=True)
class TurnBack:
    """Mark: turn around, unless the clause before did ("turn around and go back to ...")."""


@dataclass(frozen=True, slots=True)
class TurnIntoHall:
    """Mark: into the hallway on a side: here behind a door, else at the next turning.

    Attributes:
        turning: left or right.
    """

    turning: Turning


@dataclass(frozen=True, slots=True)
class NextIfClosed:
    """Mark: what to do if the door that was mentioned last is closed ("if it's closed, ...").

    Attributes:
        clause: what to do then.
    """

    clause: Clause


@dataclass(frozen=True, slots=True)
class SideOfMentionedDoor:
    """Mark: the side of the door that was mentioned last ("the second door, left").

    Attributes:
        side: left or right.
    """

    side: Side


@dataclass(frozen=True, slots=True)
class OtherwiseMarker:
    """Mark: the next clause is for the case that the condition before does not hold."""


@dataclass(frozen=True, slots=True)
class Correction:
    """Mark: what is to be done instead of the clause before it ("no, turn right").

    Attributes:
        clause: replaces that clause.
    """

    clause: Clause


Step: TypeAlias = (
    Clause
    | EnterMentionedDoor
    | StopBeforeMentioned
    | TurnBack
    | TurnIntoHall
    | IntoDoorway
    | NextIfClosed
    | SideOfMentionedDoor
    | OtherwiseMarker
    | Correction
)
Steps: TypeAlias = tuple[Step, ...]
Readings: TypeAlias = tuple[Steps, ...]
"""The ways in which a stretch of text can be understood; each is a sequence of steps."""


@dataclass(frozen=True, slots=True)
class ClauseReadings:
    """The readings of one stretch of text, and where it stands.

    Attributes:
        readings: the ways in which it can be understood.
        start: index of its first character in the text.
        stop: index behind its last character.
        anew: it says that counting begins anew ("from there").
        in_any_case: it says that it depends on no condition ("in any case").
    """

    readings: Readings
    start: int
    stop: int
    anew: bool
    in_any_case: bool = False

    @property
    def wants_side(self) -> bool:
        """Whether some reading ends with a door whose side was not said."""
        ends = [reading[-1] for reading in self.readings if reading]
        return any(isinstance(end, GoToDoor) and end.door.side is None for end in ends)

    def without_sides(self) -> ClauseReadings:
        """The same without the readings that give a side to the door mentioned before."""
        kept = [r for r in self.readings if not any(isinstance(s, SideOfMentionedDoor) for s in r)]
        return replace(self, readings=tuple(kept))

    @property
    def longest(self) -> int:
        """Number of clauses in the longest reading."""
        return max(
            sum(isinstance(step, get_args(Clause)) for step in each) for each in self.readings
        )


def at_reference(reference: DoorReference | PlaceReference, steps: Steps) -> Readings:
    """The readings of steps that are taken at a door or place: "at the second door, turn left".

    "At the first door, turn left" can mean the turn beside that door, or that door on the left.
    """
    match steps[0], reference:
        case Turn(_, None, None) as turn, PlaceReference():
            return ((replace(turn, at=reference), *steps[1:]),)
        case Follow(None), PlaceReference():
            return ((Follow(reference, past=True), *steps[1:]),)
        case Turn(Turning.LEFT | Turning.RIGHT as way, None, None), DoorReference(ordinal, side):
            through = GoToDoor(DoorReference(ordinal, Side(way.value)))
            beside_it: Steps = (Follow(reference), *steps)
            may_be_that_door = side in (None, Side(way.value))
            return (beside_it, (through, *steps[1:])) if may_be_that_door else (beside_it,)
    return ((Follow(reference), *steps),)


def on_condition(condition: IfThere, readings: Readings) -> Readings:
    """The readings of a condition with what depends on it: "if you see the second door, ...".

    Raises:
        ValueError: more than one clause would depend on it.
    """
    readings = tuple(steps for steps in readings if len(steps) == 1)
    if not readings:
        raise ValueError('one clause depends on a condition; begin the next with "in any case"')
    return tuple((condition, *steps) for steps in readings)
