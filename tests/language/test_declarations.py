"""A clause declares its fields and forms once; words, programs, tokens and samples follow."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

from semnav_env.language import (
    Clause,
    Command,
    DoorReference,
    Follow,
    OwnClause,
    Side,
    decode,
    encode,
    from_program,
    sample_clause,
    sample_command,
    to_program,
)
from semnav_env.language.clause_kinds import CLAUSE_KINDS
from semnav_env.language.command import reference_of
from semnav_env.language.corpora import notation
from semnav_env.language.corpora.meanings import meaning_of
from semnav_env.language.declarations import (
    Form,
    Multiples,
    TokenVerb,
    form,
    form_of,
    forms_of,
    open_fields,
)
from semnav_env.language.languages import languages
from semnav_env.language.references import RoomReference
from semnav_env.language.translating.masking import masked
from semnav_env.language.translating.programs import (
    SYMBOLS,
    UnsayableError,
    command_of,
    symbols_of,
)


@dataclass(frozen=True, slots=True)
class Knock(Clause):
    """Knock at a door: all of a new clause of the package but its words and its goal."""

    door: DoorReference
    loud: bool = False
    forms: ClassVar[tuple[Form, ...]] = (
        form("knock", "stop {door}", "knock {door}", (TokenVerb.STOP, 2)),
        form("knock_loud", "stop else {door}", "knock {door}", (TokenVerb.STOP, 3), loud=True),
    )


WORDS = {
    "en": {"knock": "knock at {door}", "knock_loud": "knock loudly at {door}"},
    "de": {"knock": "klopf an {door}", "knock_loud": "klopf laut an {door}"},
}
KNOCKS = (Knock(DoorReference(2, Side.LEFT)), Knock(DoorReference(0), loud=True))


@pytest.fixture
def knocking(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Puts the clause into the list of clauses, and its words into the languages."""
    monkeypatch.setitem(CLAUSE_KINDS, "Knock", Knock)
    for code, phrases in WORDS.items():
        for key, words in phrases.items():
            monkeypatch.setitem(languages()[code].phrases, key, words)
    notation._verbs.cache_clear()
    yield
    notation._verbs.cache_clear()


@dataclass(frozen=True)
class Reverse(OwnClause):
    """A clause from outside: drive backwards by some metres."""

    metres: float
    stand_in: ClassVar[Clause] = Follow()
    forms: ClassVar[tuple[Form, ...]] = (
        form(
            {"en": "back up {metres} metres", "en:one": "back up {metres} metre"},
            metres=Multiples(0.5, 3.0),
        ),
    )


@pytest.mark.usefixtures("knocking")
@pytest.mark.parametrize("clause", KNOCKS)
def test_a_new_clause_is_its_declaration_and_its_words(clause: Knock) -> None:
    command = Command((Follow(), clause, Follow()))
    assert from_program(to_program(command)) == command
    assert decode(encode(command)) == command
    assert reference_of(clause) == clause.door
    assert meaning_of(command)[1][0] == "knock"
    text = masked("the second one on the left", ())
    assert command_of(symbols_of(command, text), text) == command
    rng = np.random.default_rng(0)
    assert len({sample_clause(rng, 2, (Knock,)) for _ in range(2000)}) == 2 * 5 * 6
    sampled = [each for _ in range(50) for each in sample_command(rng).clauses]
    assert any(isinstance(each, Knock) for each in sampled)


@pytest.mark.usefixtures("knocking")
def test_a_new_clause_is_said_in_every_language() -> None:
    quiet, loud = KNOCKS
    assert str(Command((quiet, loud))) == (
        "knock at the second door on the left and knock loudly at the other door"
    )
    assert Command((loud,)).say("de") == "klopf laut an die andere Tür"


def test_a_clause_from_outside_is_said_and_kept_as_what_it_declares() -> None:
    command = Command((Reverse(1.5), Follow()))
    assert str(command) == "back up 1.5 metres and go down the hallway"
    assert str(Reverse(1.0)) == "back up 1 metre"
    assert command.say("de").startswith("back up 1,5 metres")
    assert to_program(command)[0] == {"kind": "Reverse", "metres": 1.5}
    assert from_program(to_program(command)) == command
    assert np.array_equal(encode(command), encode(Command((Follow(), Follow()))))
    rng = np.random.default_rng(0)
    drawn = {sample_clause(rng, kinds=(Reverse,)) for _ in range(99)}
    assert drawn == {Reverse(0.5 * n) for n in range(1, 7)}
    with pytest.raises(UnsayableError, match="no symbols"):
        symbols_of(command, masked("go", ()))
    with pytest.raises(TypeError, match="no step"):
        meaning_of(command)


def test_a_clause_from_outside_needs_a_name_of_its_own() -> None:
    with pytest.raises(TypeError, match="Stop is a clause of this package"):
        type("Stop", (OwnClause,), {})


def test_a_value_without_a_form_is_named() -> None:
    with pytest.raises(TypeError, match="Reverse has no form for Reverse"):
        str(Reverse(0.3))


@pytest.mark.parametrize("kind", CLAUSE_KINDS.values())
def test_every_form_of_every_clause_says_what_it_covers(kind: type[Clause]) -> None:
    """Each form has words in every language, and symbols that the bundled weights know."""
    for each in forms_of(kind):
        assert isinstance(each.words, str)
        for language in languages().values():
            assert (
                each.words in language.phrases or each.words.partition(":")[0] in language.phrases
            )
        assert {word for word in each.symbols.split() if word[0] != "{"} <= set(SYMBOLS)


@pytest.mark.parametrize("kind", CLAUSE_KINDS.values())
def test_no_two_forms_of_a_clause_cover_one_value(kind: type[Clause]) -> None:
    for value in _examples(kind):
        assert [each for each in forms_of(kind) if each.covers(value)] == [form_of(value)]


def _examples(kind: type[Clause]) -> list[Clause]:
    """A value of each form."""
    found = []
    for each, fields in open_fields(kind):
        values = {name: _example(options[-1]) for name, options in fields.items()}
        found.append(kind(**each.fixed, **values))
    return found


def _example(option: object) -> object:
    if isinstance(option, Multiples):
        return option.step
    if isinstance(option, type):
        known = {str: "kitchen", DoorReference: DoorReference(), RoomReference: RoomReference("a")}
        return known[option] if option in known else _last_example(option)
    return option


def _last_example(kind: type) -> object:
    """A value of the last form of a class."""
    form, fields = open_fields(kind)[-1]
    values = {n: 1 if options[0] is int else _example(options[0]) for n, options in fields.items()}
    return kind(**form.fixed, **values)
