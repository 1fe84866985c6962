"""Commands as plain lists and dictionaries, as in JSON, for language models and files."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import Field, fields
from enum import Enum
from typing import Any, get_args

from semnav_env.language.clauses import Approach, Clause, OwnClause, Turning
from semnav_env.language.command import Command
from semnav_env.language.references import (
    DoorReference,
    Place,
    PlaceReference,
    Reference,
    RoomReference,
    Side,
    Unit,
)
from semnav_features.validation import shown

CLAUSE_KINDS: dict[str, Any] = {
    kind.__name__: kind for kind in get_args(Clause) if kind is not OwnClause
}
REFERENCE_KINDS: dict[str, Any] = {kind.__name__: kind for kind in get_args(Reference)}


def to_program(command: Command) -> list[dict[str, Any]]:
    """The clauses of a command as dictionaries of plain values; `from_program` is the inverse.

    For example [{"kind": "GoToDoor", "door": {"kind": "DoorReference", "ordinal": 2,
    "side": "right"}, "approach": "through"}].
    """
    return [_plain(clause) for clause in command.clauses]


def from_program(program: object) -> Command:
    """The command that plain lists and dictionaries describe.

    Fields with a default may be left out.

    Raises:
        ValueError: it describes no command; the message names the clause and what would be right.
    """
    if not isinstance(program, list | tuple):
        raise ValueError(f"a program is a list of clauses, not {type(program).__name__}")
    return Command(
        tuple(_value(each, CLAUSE_KINDS, f"clause {n}") for n, each in enumerate(program))
    )


def _plain(value: Any) -> dict[str, Any]:
    plain: dict[str, Any] = {"kind": type(value).__name__}
    for field in _compared(value):
        part = getattr(value, field.name)
        referring = isinstance(part, tuple(REFERENCE_KINDS.values()))
        plain[field.name] = _plain(part) if referring else getattr(part, "value", part)
    return plain


def _compared(value: Any) -> list[Field[Any]]:
    """The fields that say what is to be done, and not how that was found out."""
    return [field for field in fields(value) if field.compare]


def _value(plain: object, kinds: Mapping[str, Any], where: str) -> Any:
    """The clause or reference of a dictionary."""
    if not isinstance(plain, Mapping):
        raise ValueError(f"{where} is a dictionary with a kind, not {shown(plain)}")
    given = dict(plain)
    kind = kinds.get(str(given.pop("kind", None)))
    if kind is None:
        raise ValueError(f"the kind of {where} is one of {', '.join(kinds)}: {shown(plain)}")
    known = {field.name for field in _compared(kind)}
    if not set(given) <= known:
        strange = ", ".join(map(repr, sorted(set(map(str, given)) - known)))
        raise ValueError(f"{where}, a {kind.__name__}, has no {strange}")
    try:
        return kind(**{name: _read(name, part, where) for name, part in given.items()})
    except TypeError as error:
        raise ValueError(f"{where}, a {kind.__name__}: {error}") from None


def _read(name: str, part: object, where: str) -> Any:
    """The value of a field."""
    inside = f"{name} of {where}"
    if part is None and name in ("until", "at", "side", "degrees"):
        return None
    if name == "what" and part in (Side.LEFT.value, Side.RIGHT.value):
        return Side(part)
    if name in _REFERENCE_FIELDS:
        return _value(part, _REFERENCE_FIELDS[name], inside)
    if name in _ENUM_FIELDS:
        members = [member.value for member in _ENUM_FIELDS[name]]
        if part not in members:
            known = ", ".join(map(repr, members))
            raise ValueError(f"{inside} is one of {known}, not {shown(part)}")
        return _ENUM_FIELDS[name](part)
    check = _FIELD_CHECKS[name]
    if not check(part):
        raise ValueError(f"{inside} cannot be {shown(part)}")
    return part


_ENUM_FIELDS: dict[str, type[Enum]] = {
    "turning": Turning,
    "approach": Approach,
    "side": Side,
    "place": Place,
    "unit": Unit,
}
_REFERENCE_FIELDS: dict[str, dict[str, Any]] = {
    "until": REFERENCE_KINDS,
    "at": {"PlaceReference": PlaceReference},
    "door": {"DoorReference": DoorReference},
    "what": {kind.__name__: kind for kind in (DoorReference, PlaceReference, RoomReference)},
}
_FIELD_CHECKS: dict[str, Callable[[object], bool]] = {
    "past": lambda part: isinstance(part, bool),
    "absent": lambda part: isinstance(part, bool),
    "otherwise": lambda part: isinstance(part, bool),
    "name": lambda part: isinstance(part, str),
    "amount": lambda part: isinstance(part, int | float) and not isinstance(part, bool),
    "ordinal": lambda part: isinstance(part, int) and not isinstance(part, bool),
    "degrees": lambda part: isinstance(part, int) and not isinstance(part, bool),
    "seconds": lambda part: isinstance(part, int) and not isinstance(part, bool),
}
