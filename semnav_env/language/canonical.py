"""Reads the canonical words of a command: the inverse of `Command.say`, from the same forms."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from enum import StrEnum
from functools import cache
from itertools import product
from string import Formatter
from typing import Any, TypeAlias

from semnav_env.language.clause_kinds import CLAUSE_KINDS
from semnav_env.language.clauses import Clause, IfThere
from semnav_env.language.command import MAX_CLAUSES, Command, Link
from semnav_env.language.declarations import Multiples, Option, Spoken, field_types, open_fields
from semnav_env.language.errors import CommandError
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.normalise import normalise
from semnav_env.language.references import MAX_FROM_END, MAX_ORDINAL, OTHER

Found: TypeAlias = Iterator[tuple[Any, int]]
"""Values that the words at a place may be, each with the place behind them."""

OTHERWISE, ANYWAY = BRANCHES = (Link.OTHERWISE.value, Link.IN_ANY_CASE.value)
"""Adverbs with which the other case of a condition begins, and what depends on it no more."""

_NAME = re.compile(r"[a-z0-9][a-z0-9 ._-]*")
_NUMBER = re.compile(r"[0-9]+(?:[.,][0-9]+)?")


def read(text: str, language: str | Language = "en") -> Command:
    """The command of canonical words: `read(command.say(language), language) == command`.

    Args:
        text: as `Command.say` puts it; case, spaces and a sign at its end do not matter.
        language: "en", "de" or a loaded one.

    Raises:
        CommandError: these are no canonical words; `semnav_env.language.parse` takes all others.
        ValueError: there is no such language.
    """
    spoken = language_of(language)
    command = read_canonical(text, spoken)
    if command is None:
        raise CommandError("these are not the canonical words of a command", text[:200])
    return command


def read_canonical(text: str, language: Language) -> Command | None:
    """The command whose canonical words a text is; None if it is that of none.

    Raises:
        CommandError: it has characters that no command has, or is too long to be read.
    """
    said = normalise(text, language).text.rstrip(language.punctuation + " ")
    for parts in _parts(said, 0, "", language, MAX_CLAUSES):
        try:
            command = Command(_with_branches(parts))
        except ValueError:
            continue
        if _plain(command.say(language), language) == said:
            return command
    return None


def _parts(
    said: str, at: int, adverb: str, language: Language, most: int
) -> Iterator[tuple[tuple[Clause, str], ...]]:
    """The clauses that words may be, at most so many, each with the adverb before it."""
    for kind in CLAUSE_KINDS.values() if most else ():
        for clause, stop in _spoken(kind, said, at, language, ""):
            if isinstance(clause, IfThere) and (clause.then, clause.otherwise) != (1, 0):
                continue  # what depends on it is counted by what comes behind it
            if stop == len(said):
                yield ((clause, adverb),)
            elif joint := _joint(language).match(said, stop):
                link = next(
                    (k for k in BRANCHES if joint[1] == _plain(language.say(k), language)), ""
                )
                behind = _parts(said, joint.end(), link, language, most - 1)
                yield from (((clause, adverb), *each) for each in behind)


def _with_branches(parts: Sequence[tuple[Clause, str]]) -> tuple[Clause, ...]:
    """The clauses, with the number of those that depend on each condition."""
    clauses = []
    for at, (clause, _) in enumerate(parts):
        if isinstance(clause, IfThere):
            adverbs = [adverb for _, adverb in parts[at + 1 :]]
            end = adverbs.index(ANYWAY) if ANYWAY in adverbs else len(adverbs)
            then = adverbs.index(OTHERWISE) if OTHERWISE in adverbs[:end] else end
            clause = replace(clause, then=then, otherwise=end - then)
        clauses.append(clause)
    return tuple(clauses)


@cache
def _joint(language: Language) -> re.Pattern[str]:
    """What stands between two clauses: a sign or a word, and perhaps an adverb."""
    adverbs = ("from_there", *BRANCHES, Link.THEN.value)
    return re.compile(f"{_one_of(('comma', 'and'), language)}({_one_of(adverbs, language)})")


def _one_of(phrases: Sequence[str], language: Language) -> str:
    """A pattern for one of several phrases, of which the longest is tried first."""
    words = (_plain(language.say(each), language) for each in phrases)
    return f"(?:{'|'.join(map(re.escape, sorted(words, key=len, reverse=True)))})"


def _spoken(kind: type[Spoken], said: str, at: int, language: Language, grammar: str) -> Found:
    """The values of a class that the words at a place may be, in a grammatical form."""
    for form, fields in open_fields(kind):
        if not isinstance(form.words, str):
            continue
        only = {name: each[0] for name, each in fields.items() if _is_value(each)}
        fields = fields | {name: (value,) for name, value in form.fixed.items()}
        chosen = re.findall(r"{(\w+)}", form.words)
        for values in product(*(fields[name] for name in chosen)):
            given = {**form.fixed, **only, **dict(zip(chosen, values, strict=True))}
            for template in _templates(form.words.format(**given), language, grammar):
                for found, stop in _filled(template, kind, fields, said, at, language):
                    try:
                        yield kind(**{**given, **found}), stop
                    except ValueError:
                        continue


@cache
def _templates(words: str, language: Language, grammar: str) -> tuple[Any, ...]:
    """The format strings of a phrase, also of that for one, in parts."""
    phrase, _, usual = words.partition(":")
    forms = (grammar,) if grammar else (usual, "one")
    phrases = language.phrases
    texts = {phrases.get(f"{phrase}:{form}") or phrases[phrase]: None for form in forms}
    return tuple(
        tuple((_plain(text, language), *field) for text, *field in Formatter().parse(template))
        for template in texts
    )


def _filled(
    template: Sequence[Any],
    kind: type[Spoken],
    fields: Mapping[str, tuple[Option, ...]],
    said: str,
    at: int,
    language: Language,
) -> Found:
    """The values of the fields of a template that stands at a place."""
    if not template:
        yield {}, at
        return
    text, name, grammar, _ = template[0]
    if not said.startswith(text, at):
        return
    at += len(text)
    if name is None:
        yield from _filled(template[1:], kind, fields, said, at, language)
        return
    for option in fields[name]:
        for value, stop in _values(option, said, at, language, grammar):
            if isinstance(option, Multiples) and int in field_types(kind)[name]:
                value = int(value)
            for others, end in _filled(template[1:], kind, fields, said, stop, language):
                yield {name: value, **others}, end


def _values(option: Option, said: str, at: int, language: Language, grammar: str) -> Found:
    """The values of an option of a field that the words at a place may be."""
    if isinstance(option, Multiples):
        if found := _NUMBER.match(said, at):
            yield float(found[0].replace(",", ".")), found.end()
    elif option is int:
        for word, number in _ordinals(language):
            if said.startswith(word, at):
                yield number, at + len(word)
    elif option is str:
        if found := _NAME.match(said, at):
            yield found[0], found.end()
    elif isinstance(option, StrEnum):
        word = _plain(language.say(option), language)
        if said.startswith(word, at):
            yield option, at + len(word)
    elif isinstance(option, type):
        yield from _spoken(option, said, at, language, grammar)


def _is_value(options: Sequence[Option]) -> bool:
    """Whether a field can be only one thing."""
    return len(options) == 1 and not isinstance(options[0], type | Multiples)


@cache
def _ordinals(language: Language) -> tuple[tuple[str, int], ...]:
    """The usual word of each ordinal."""
    numbers = (OTHER, *range(1, MAX_ORDINAL + 1), *range(-1, -MAX_FROM_END - 1, -1))
    return tuple((_plain(language.ordinal(n), language), n) for n in numbers)


def _plain(words: str, language: Language) -> str:
    """Words as they stand in a normalised text."""
    return language.folded(words.casefold())
