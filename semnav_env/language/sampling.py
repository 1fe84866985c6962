"""Random well-formed commands without regard to a building, for tests and language learning."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from semnav_env.language.clause_kinds import CLAUSE_KINDS
from semnav_env.language.clauses import Clause, IfThere
from semnav_env.language.command import MAX_CLAUSES, Command
from semnav_env.language.declarations import (
    Form,
    Multiples,
    Option,
    Spoken,
    once_per_class,
    open_fields,
)
from semnav_env.language.references import LAST, MAX_FROM_END, MAX_ORDINAL, OTHER

T = TypeVar("T")
S = TypeVar("S", bound=Spoken)

CONDITION_SHARE = 0.1
"""Share of conditions among sampled clauses, where there is room for the clauses that depend on
them."""


MOST_DRAWS = 1000
"""The most random values of a field that are tried until one goes together with the others."""


def check_generator(rng: object) -> None:
    """Refuse anything that is not a NumPy generator, such as a bare seed.

    Raises:
        TypeError: it is not; says how to make one.
    """
    if not isinstance(rng, np.random.Generator):
        raise TypeError(f"rng is {rng!r}; give a generator: np.random.default_rng(0)")


def sample_command(
    rng: np.random.Generator,
    max_clauses: int = MAX_CLAUSES,
    max_ordinal: int = MAX_ORDINAL,
    kinds: Sequence[type[Clause]] | None = None,
) -> Command:
    """A command of 1 to `max_clauses` random clauses.

    Args:
        rng: source of randomness.
        max_clauses: 1 to `MAX_CLAUSES`.
        max_ordinal: the highest ordinal to use, 1 to `MAX_ORDINAL`.
        kinds: the classes of clauses to draw from, beside conditions, as for `sample_clause`.

    Raises:
        TypeError: `rng` is no generator.
    """
    check_generator(rng)
    number = int(rng.integers(1, max_clauses + 1))
    clauses: list[Clause] = []
    while len(clauses) < number:
        left = number - len(clauses)
        begins = [_condition(rng, max_ordinal, left > 2)] if _is_conditional(rng, left) else []
        dependent = 1 + sum(each.otherwise for each in begins)
        clauses += begins
        clauses += [sample_clause(rng, max_ordinal, kinds) for _ in range(dependent)]
    return Command(tuple(clauses))


def _is_conditional(rng: np.random.Generator, left: int) -> bool:
    """Whether a condition is drawn, where so many clauses are left."""
    return left > 1 and rng.random() < CONDITION_SHARE


def sample_clause(
    rng: np.random.Generator,
    max_ordinal: int = MAX_ORDINAL,
    kinds: Sequence[type[Clause]] | None = None,
) -> Clause:
    """A random clause; each kind of clause is equally likely, and each of its forms.

    There are no rooms, whose names belong to a building, and no conditions, which need clauses that
    depend on them.

    Args:
        rng: source of randomness.
        max_ordinal: the highest ordinal to use.
        kinds: the classes of clauses to draw from; by default those of this package.
    """
    known = CLAUSE_KINDS.values() if kinds is None else kinds
    drawn = [kind for kind in known if kind is not IfThere and _sampled(kind)]
    return _drawn(_choose(rng, drawn), rng, max_ordinal)


def _condition(rng: np.random.Generator, max_ordinal: int, may_be_otherwise: bool) -> IfThere:
    condition = _drawn(IfThere, rng, max_ordinal)
    return condition if may_be_otherwise else replace(condition, otherwise=0)


def _drawn(kind: type[S], rng: np.random.Generator, max_ordinal: int) -> S:
    """A random value of a class; its last field is drawn anew until all of them go together."""
    form, fields = _choose(rng, _sampled(kind))
    values = {name: _value(options, rng, max_ordinal) for name, options in fields.items()}
    for _ in range(MOST_DRAWS):
        try:
            return kind(**form.fixed, **values)
        except ValueError:
            last = list(fields)[-1]
            values[last] = _value(fields[last], rng, max_ordinal)
    raise ValueError(f"of {MOST_DRAWS} random values none makes a {kind.__name__}")


def _value(options: Sequence[Option], rng: np.random.Generator, max_ordinal: int) -> Any:
    """A random value of a field."""
    option = _choose(rng, options)
    if isinstance(option, Multiples):
        return option.step * int(rng.integers(1, option.count + 1))
    if option is int:
        from_end = range(LAST, -min(max_ordinal, MAX_FROM_END) - 1, -1)
        return _choose(rng, (OTHER, *range(1, max_ordinal + 1), *from_end))
    return _drawn(option, rng, max_ordinal) if isinstance(option, type) else option


@once_per_class
def _sampled(kind: type[Spoken]) -> tuple[tuple[Form, dict[str, tuple[Option, ...]]], ...]:
    """The forms of a class that are drawn, with the values of their fields that are drawn."""
    found = []
    for form, fields in open_fields(kind):
        if not form.sampled:
            continue
        drawn = {name: tuple(filter(_is_drawn, options)) for name, options in fields.items()}
        if all(drawn.values()):
            found.append((form, drawn))
    return tuple(found)


def _is_drawn(option: Option) -> bool:
    """Whether random values of an option of a field can be drawn; names of rooms cannot."""
    if option is int or not isinstance(option, type):
        return True
    return issubclass(option, Spoken) and bool(_sampled(option))


def _choose(rng: np.random.Generator, choices: Sequence[T]) -> T:
    return choices[int(rng.integers(len(choices)))]
