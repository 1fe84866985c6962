"""Encodes commands as tokens, and decodes them, by what clauses declare."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from numbers import Real
from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from semnav_env.language.clause_kinds import CLAUSE_KINDS
from semnav_env.language.clauses import Clause, Turning
from semnav_env.language.command import MAX_CLAUSES, Command
from semnav_env.language.declarations import (
    Form,
    Multiples,
    Option,
    Spoken,
    field_names,
    form_of,
    is_ordinal,
    open_fields,
)
from semnav_env.language.own_clause import OwnClause
from semnav_env.language.references import ENTRY, OTHER, Place, Side
from semnav_env.language.rooms import plain_name
from semnav_env.language.tokens import (
    CLAUSE_FEATURES,
    COLUMN_SIZES,
    ENTRY_TOKEN,
    LAST_TOKEN,
    MAX_NUMBER,
    OTHER_TOKEN,
    TOKEN_REFERENTS,
    TOKEN_SIDES,
    TOKEN_TURNINGS,
    Row,
)

S = TypeVar("S", bound=Spoken)
Options: TypeAlias = tuple[Option, ...]

_NOTHING: Row = (0, 0, 0, 0, 0)


def encode(command: Command, rooms: Sequence[str] = ()) -> NDArray[np.int64]:
    """The tokens of a command: shape (`MAX_CLAUSES`, `CLAUSE_FEATURES`), one clause a row.

    The columns are verb, turning, referent, number and side, as `tokens` lays them out. Rows after
    the last clause are zero.

    Args:
        command: what to encode.
        rooms: names of the rooms that it may name; the number of a room is its place among them.

    Raises:
        ValueError: the command names a room that is not among the first `MAX_NUMBER` of them.
    """
    tokens = np.zeros((MAX_CLAUSES, CLAUSE_FEATURES), dtype=np.int64)
    tokens[: len(command.clauses)] = [row_of(clause, rooms) for clause in command.clauses]
    return tokens


def row_of(value: Spoken, rooms: Sequence[str]) -> Row:
    """The token of a clause, or the share that a part of one has in it; `rooms` as for `encode`.

    It is the sum of what its form and its open fields say.
    """
    if isinstance(value, OwnClause) and not any(form.token for form in value.forms):
        return row_of(value.stand_in, rooms)
    form = form_of(value)
    parts = [
        _share(getattr(value, name), form.given.get(name), rooms)
        for name in field_names(type(value))
        if name not in form.fixed and name not in value.untokened
    ]
    return _sum([_head(form), *parts])


def _sum(rows: Iterable[Row]) -> Row:
    return tuple(map(sum, zip(*rows, strict=True)))


@cache
def _head(form: Form) -> Row:
    """What a form says of a token."""
    token: list[Any] = [*form.token, *(0, 0, None)[len(form.token) :]]
    verb, turning, referent = token
    return (int(verb or 0), turning, TOKEN_REFERENTS.index(referent), 0, 0)


def _share(value: object, given: object, rooms: Sequence[str]) -> Row:
    """What the value of a field says of a token."""
    match value:
        case Spoken():
            return row_of(value, rooms)
        case Turning():
            return (0, TOKEN_TURNINGS.index(value), 0, 0, 0)
        case Place():
            return (0, 0, TOKEN_REFERENTS.index(value), 0, 0)
        case Side():
            return (0, 0, 0, 0, TOKEN_SIDES.index(value))
        case str():
            return (0, 0, 0, _room_number(value, rooms), 0)
        case Real() if isinstance(given, Multiples):
            return (0, 0, 0, round(float(value) / given.step), 0)
        case int() if is_ordinal(value):
            return (0, 0, 0, _ordinal_token(value), 0)
    return _NOTHING


def _room_number(name: str, rooms: Sequence[str]) -> int:
    names = [plain_name(room) for room in rooms[:MAX_NUMBER]]
    if name not in names:
        known = ", ".join(rooms) or "none"
        raise ValueError(f"there is no room {name!r} to be numbered; there are: {known}")
    return 1 + names.index(name)


def _ordinal_token(ordinal: int) -> int:
    if ordinal in (OTHER, ENTRY):
        return OTHER_TOKEN if ordinal == OTHER else ENTRY_TOKEN
    return ordinal if ordinal > 0 else LAST_TOKEN - ordinal - 1


def decode(
    tokens: ArrayLike,
    rooms: Sequence[str] = (),
    kinds: Sequence[type[Clause]] | None = None,
) -> Command:
    """The command of an array that `encode` made.

    Args:
        tokens: shape (`MAX_CLAUSES`, `CLAUSE_FEATURES`), of integers.
        rooms: the same names that `encode` was given.
        kinds: the classes of the clauses that there may be; by default those of this package.

    Raises:
        ValueError: the array has another shape or type, or a row that is no clause.
    """
    array = np.asarray(tokens)
    if array.shape != (MAX_CLAUSES, CLAUSE_FEATURES) or array.dtype.kind not in "iu":
        wanted = f"integers of shape {(MAX_CLAUSES, CLAUSE_FEATURES)}"
        raise ValueError(f"tokens are {wanted}, not {array.dtype} of shape {array.shape}")
    rows = [tuple(row) for row in array.tolist()]
    while rows and not any(rows[-1]):
        rows.pop()
    known = tuple(CLAUSE_KINDS.values()) if kinds is None else kinds
    return Command(tuple(_clause(number, row, rooms, known) for number, row in enumerate(rows)))


def _clause(number: int, row: Row, rooms: Sequence[str], kinds: Sequence[type[Clause]]) -> Clause:
    """The clause of a row; a row is valid only if encoding its clause gives it again."""
    problem = f"row {number} of the tokens, {row}, is no clause"
    if not all(0 <= token < count for token, count in zip(row, COLUMN_SIZES, strict=True)):
        raise ValueError(f"{problem}: its columns go up to {tuple(n - 1 for n in COLUMN_SIZES)}")
    reasons = []
    for kind in kinds:
        for form, options in open_fields(kind):
            try:
                for clause in _filled(kind, form, options, row, rooms):
                    if row_of(clause, rooms) == row:
                        return clause
            except ValueError as error:
                reasons.append(f": {error}")
    raise ValueError("".join([problem, *reasons[:1]]))


def _filled(
    kind: type[S], form: Form, options: Mapping[str, Options], row: Row, rooms: Sequence[str]
) -> Iterator[S]:
    """The values of a form that a row may stand for; none of a form for which it has no room.

    Raises:
        ValueError: the row has this form, but a number that cannot be.
    """
    if not options.keys().isdisjoint(kind.untokened):
        return
    if form.token[:1] in ((), (None,), (row[0],)) and _fits(_head(form), row):
        for values in _values(list(options.values()), row, rooms):
            yield kind(**form.fixed, **dict(zip(options, values, strict=True)))


def _values(
    fields: Sequence[Options], row: Row, rooms: Sequence[str]
) -> Iterator[tuple[object, ...]]:
    """What fields may be, the first one first; if that cannot be, the others are not looked at."""
    if not fields:
        yield ()
    for first in _chosen(fields[0], row, rooms) if fields else ():
        for others in _values(fields[1:], row, rooms):
            yield (first, *others)


def _chosen(options: Options, row: Row, rooms: Sequence[str]) -> Iterator[Any]:
    """The values of a field that a row may stand for."""
    for option in options:
        if isinstance(option, Multiples):
            yield option.step * row[3]
        elif option is int:
            yield _ordinal(row[3])
        elif option is str:
            yield _room(row[3], rooms)
        elif isinstance(option, type):
            for form, inner in open_fields(option):
                yield from _filled(option, form, inner, row, rooms)
        elif _fits(_share(option, None, rooms), row):
            yield option


def _fits(part: Row, row: Row) -> bool:
    """Whether a row has all that a part of it says."""
    return all(token in (0, whole) for token, whole in zip(part, row, strict=True))


def _ordinal(token: int) -> int:
    if token == OTHER_TOKEN:
        return OTHER
    if not 1 <= token < OTHER_TOKEN:
        raise ValueError(f"{token} is the number of no ordinal")
    return token if token < LAST_TOKEN else LAST_TOKEN - token - 1


def _room(number: int, rooms: Sequence[str]) -> str:
    if not 1 <= number <= len(rooms):
        raise ValueError(f"there are {len(rooms)} rooms")
    return plain_name(rooms[number - 1])
