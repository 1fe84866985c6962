"""Declares clauses and what they refer to: each field once, and what it is in every notation.

A class derives from `Spoken`, is a frozen dataclass, and lists its `forms`. A form covers the
values whose fields are as it says, and tells their words, symbols, step and token. The fields that
it leaves open stand in braces and are written by their types. So words (`say`), tokens
(`encoding`), programs (`program`), random samples (`sampling`), the notation of corpora and the
symbols of the translator all come from these declarations.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass, fields, replace
from enum import Enum, IntEnum
from functools import cache, cached_property, lru_cache
from numbers import Integral, Real
from types import NoneType, UnionType
from typing import (
    TYPE_CHECKING,
    Any,
    ClassVar,
    TypeAlias,
    TypeVar,
    Union,
    cast,
    get_args,
    get_origin,
    get_type_hints,
)

if TYPE_CHECKING:
    from semnav_env.language.language import Language

Function = TypeVar("Function", bound=Callable[..., Any])

Option: TypeAlias = Any
"""What a field may be: a value, `Multiples`, a class that is spoken, int for an ordinal, or str for
the plain name of a room."""


DOOR, DEGREES, SECONDS, ROOM = "door", "degrees", "seconds", "room"
"""What a token refers to beside places and units, see `TOKEN_REFERENTS`."""


class TokenVerb(IntEnum):
    """What a clause asks for: the first column of its token.

    A condition asks for nothing itself; its second column gives the case (`CONDITION_CASES`).
    """

    IF_THERE = 0
    FOLLOW = 1
    TURN = 2
    GO_TO = 3
    GO_THROUGH = 4
    STOP = 5
    PASS = 6
    GO_TO_ROOM = 7
    LEAVE = 8
    GO_BACK = 9


@dataclass(frozen=True)
class Multiples:
    """The multiples of a step that a number may be, such as 5 to 360 degrees in steps of 5.

    Attributes:
        step: the least of them; one of the number of a token.
        most: the greatest.
    """

    step: float
    most: float

    def __contains__(self, value: object) -> bool:
        if not isinstance(value, Real) or isinstance(value, bool):
            return False
        return self.step <= float(value) <= self.most and float(value) % self.step == 0

    @property
    def count(self) -> int:
        """How many there are."""
        return round(self.most / self.step)


@dataclass(frozen=True, eq=False)
class Form:
    """One way to put a value in words, symbols and numbers; `form` makes it.

    Attributes:
        words: a key of `Language.phrases`, with ":" and a grammatical form where it needs one; or,
            for a clause from outside, format strings by the code of their language, with ":one"
            for those where a number is one; a language that is missing is said in the first.
        symbols: what the learned translator says, parted by spaces; empty if it has no symbols.
        step: the step or place in the notation of docs/guides/meanings.md; empty if it has none.
        token: its first columns, where no field gives them: verb, number of the turning, and a
            member of `TOKEN_REFERENTS`. The verb of what is part of a clause is None. A clause from
            outside without a token has that of its `stand_in`.
        given: by field, the value that it has, or a class, `Multiples` or a tuple of such that it
            may be.
        sampled: whether random commands have it.
    """

    words: str | Mapping[str, str]
    symbols: str
    step: str
    token: tuple[Any, ...]
    given: Mapping[str, Any]
    sampled: bool

    @cached_property
    def fixed(self) -> dict[str, Any]:
        """The fields with only one value, and this value."""
        return {name: part for name, part in self.given.items() if not _is_open(part)}

    @property
    def named(self) -> frozenset[str]:
        """The fields that stand in braces."""
        texts = [self.words] if isinstance(self.words, str) else self.words.values()
        return frozenset(re.findall(r"{(\w+)", " ".join([self.symbols, *texts])))

    def covers(self, value: Spoken) -> bool:
        """Whether a value has this form."""
        return all(_is_one_of(getattr(value, name), part) for name, part in self.given.items())


def form(
    words: str | Mapping[str, str],
    symbols: str = "",
    step: str = "",
    token: tuple[Any, ...] = (),
    /,
    *,
    sampled: bool = True,
    **given: Any,
) -> Form:
    """A form of a class; see `Form`.

    A field that is neither given nor in braces has its default, and one in braces that is not given
    may be all that its type says.
    """
    return Form(words, symbols, step, token, given, sampled)


class Spoken:
    """Base of clauses and references: they can be put in the words of a language.

    It is no `ABC`, whose instances take several times as long to tell apart.
    """

    __slots__ = ()
    forms: ClassVar[tuple[Form, ...]] = ()
    untokened: ClassVar[tuple[str, ...]] = ()
    """Fields for which a token has no room."""

    def say(self, language: Language, grammar: str = "") -> str:
        """In the words of a language, in the grammatical form (case) that a phrase asks for."""
        said = form_of(self)
        values = {name: getattr(self, name) for name in field_names(type(self))}
        parts = {
            name: language.ordinal(value) if name not in said.given and is_ordinal(value) else value
            for name, value in values.items()
        }
        is_one = any(
            isinstance(said.given.get(name), Multiples) and values[name] == 1 for name in values
        )
        number = "one" if is_one else ""
        if not isinstance(said.words, str):
            code = language.code
            words = said.words.get(f"{code}:{number}") or said.words.get(code)
            return language.fill(words or next(iter(said.words.values())), parts)
        phrase, _, usual = said.words.format(**values).partition(":")
        return language.say(phrase, grammar or usual or number, **parts)

    def __str__(self) -> str:
        return _kept_in_english(self)


@lru_cache(maxsize=1024)
def _kept_in_english(value: Spoken) -> str:
    return said_in_english(value)


def said_in_english(value: Spoken) -> str:
    """In the words of English."""
    from semnav_env.language.languages import english  # read when first spoken

    return value.say(english())


def form_of(value: Spoken) -> Form:
    """The first form that covers a value.

    Raises:
        TypeError: its class declares no such form.
    """
    for each in forms_of(type(value)):
        if each.covers(value):
            return each
    raise TypeError(f"{type(value).__name__} has no form for {value!r}; declare it in `forms`")


def once_per_class(function: Function) -> Function:
    """`functools.cache` for functions of a class, with their types: those of mypy take no class."""
    return cast(Function, cache(function))


def is_ordinal(value: object) -> bool:
    """Whether a value is a whole number: an ordinal, unless its form has `Multiples` for it."""
    return isinstance(value, Integral) and not isinstance(value, bool)


@once_per_class
def field_names(kind: type) -> tuple[str, ...]:
    """The names of the fields of a dataclass that say what is meant, in order.

    Fields that comparisons leave out say how that was found.
    """
    return tuple(each.name for each in fields(kind) if each.compare)


@once_per_class
def field_types(kind: type) -> dict[str, tuple[Any, ...]]:
    """The classes that each field of a dataclass may be of, by its name."""
    hints = get_type_hints(kind)
    return {name: _members(hints[name]) for name in field_names(kind)}


def _members(hint: Any) -> tuple[Any, ...]:
    return get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)


@once_per_class
def forms_of(kind: type[Spoken]) -> tuple[Form, ...]:
    """The forms of a class, with the defaults of the fields that they leave out."""
    declared = [each for each in fields(cast(Any, kind)) if each.compare]
    defaults = {each.name: each.default for each in declared if each.default is not MISSING}
    return tuple(
        replace(each, given=_without(defaults, each.named) | dict(each.given))
        for each in kind.forms
    )


def _without(values: dict[str, Any], names: frozenset[str]) -> dict[str, Any]:
    return {name: value for name, value in values.items() if name not in names}


@once_per_class
def open_fields(kind: type[Spoken]) -> tuple[tuple[Form, dict[str, tuple[Option, ...]]], ...]:
    """The forms of a class, each with what its open fields may be, by their names."""
    return tuple((each, _open_fields(kind, each)) for each in forms_of(kind))


def _open_fields(kind: type[Spoken], said: Form) -> dict[str, tuple[Option, ...]]:
    found = {}
    for name, types in field_types(kind).items():
        if name not in said.fixed:
            given = said.given.get(name, types)
            parts = given if isinstance(given, tuple) else (given,)
            found[name] = tuple(option for part in parts for option in _expanded(part))
    return found


def _expanded(part: Any) -> tuple[Option, ...]:
    """The members of an enumeration; everything else as it is."""
    if part is NoneType:
        return (None,)
    return tuple(part) if isinstance(part, type) and issubclass(part, Enum) else (part,)


def _is_open(part: Any) -> bool:
    return isinstance(part, tuple | type | Multiples)


def _is_one_of(value: object, part: Any) -> bool:
    if isinstance(part, tuple):
        return any(_is_one_of(value, each) for each in part)
    if isinstance(part, Multiples):
        return value in part
    return isinstance(value, part) if isinstance(part, type) else bool(value == part)
