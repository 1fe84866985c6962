"""Commands as plain lists and dictionaries, as in JSON, for language models and files."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import Enum
from types import NoneType
from typing import Any

from semnav_env.language.clause_kinds import CLAUSE_KINDS
from semnav_env.language.command import Command
from semnav_env.language.declarations import Spoken, field_names, field_types
from semnav_env.language.own_clause import own_clause_kinds
from semnav_features.validation import shown


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
    return Command(tuple(_clause(each, f"clause {n}") for n, each in enumerate(program)))


def _plain(value: Spoken) -> dict[str, Any]:
    plain: dict[str, Any] = {"kind": type(value).__name__}
    for name in field_names(type(value)):
        part = getattr(value, name)
        plain[name] = _plain(part) if isinstance(part, Spoken) else getattr(part, "value", part)
    return plain


def _clause(plain: object, where: str) -> Any:
    is_known = isinstance(plain, Mapping) and plain.get("kind") in CLAUSE_KINDS
    return _value(plain, CLAUSE_KINDS if is_known else CLAUSE_KINDS | own_clause_kinds(), where)


def _value(plain: object, kinds: Mapping[str, Any], where: str) -> Any:
    """The clause or reference of a dictionary."""
    if not isinstance(plain, Mapping):
        raise ValueError(f"{where} is a dictionary with a kind, not {shown(plain)}")
    given = dict(plain)
    kind = kinds.get(str(given.pop("kind", None)))
    if kind is None:
        raise ValueError(f"the kind of {where} is one of {', '.join(kinds)}: {shown(plain)}")
    types = field_types(kind)
    if not set(given) <= set(types):
        strange = ", ".join(map(repr, sorted(set(map(str, given)) - set(types))))
        raise ValueError(f"{where}, a {kind.__name__}, has no {strange}")
    try:
        return kind(**{n: _read(types[n], p, f"{n} of {where}") for n, p in given.items()})
    except TypeError as error:
        raise ValueError(f"{where}, a {kind.__name__}: {error}") from None


def _read(types: tuple[Any, ...], part: object, where: str) -> Any:
    """The value of a field that may be of some classes."""
    if part is None and NoneType in types:
        return None
    members = [each for kind in types if issubclass(kind, Enum) for each in kind]
    for member in members:
        if part == member.value:
            return member
    spoken = {kind.__name__: kind for kind in types if issubclass(kind, Spoken)}
    if spoken:
        return _value(part, spoken, where)
    if members:
        right = ", ".join(repr(member.value) for member in members)
        raise ValueError(f"{where} is one of {right}, not {shown(part)}")
    if not any(_PLAIN_CHECKS[kind](part) for kind in types if kind in _PLAIN_CHECKS):
        raise ValueError(f"{where} cannot be {shown(part)}")
    return part


_PLAIN_CHECKS: dict[type, Callable[[object], bool]] = {
    bool: lambda part: isinstance(part, bool),
    str: lambda part: isinstance(part, str),
    int: lambda part: isinstance(part, int) and not isinstance(part, bool),
    float: lambda part: isinstance(part, int | float) and not isinstance(part, bool),
}
