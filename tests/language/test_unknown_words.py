"""A word that nobody knows is never carried out as something else."""

from __future__ import annotations

import pytest

from semnav_env.language import AmbiguousCommandError, CommandError, parse, read
from semnav_env.language.question import MOST_WORDS

ENGLISH_ROOMS = ("Library", "Bakery", "Toilet", "Cafeteria", "Meeting room")
TWO_ROOMS = ("Toilet", "Library")
GERMAN_ROOMS = ("Bibliothek", "Küche", "Toilette", "Besprechungsraum")

MISSPELT = {
    "go to the libary": "libary",
    "go to the bakary": "bakary",
    "go to the toilte": "toilte",
    "go to the cafetria": "cafetria",
    "go to the libarie": "libarie",
    "please drive to the zeppelin": "zeppelin",
    "geh zur Bibliotek": "Bibliotek",
    "geh zur Kuche": "Kuche",
    "fahr zur Toilte": "Toilte",
    "fahr zum Atelje": "Atelje",
}
"""Texts with an unknown word for a room, and that word."""


@pytest.mark.parametrize(("text", "word"), MISSPELT.items())
def test_without_rooms_an_unknown_word_is_named(text: str, word: str) -> None:
    with pytest.raises(CommandError, match=f'"{word}"') as refused:
        parse(text)
    assert not isinstance(refused.value, AmbiguousCommandError)


@pytest.mark.parametrize("text", MISSPELT)
@pytest.mark.parametrize("rooms", [(), ENGLISH_ROOMS, GERMAN_ROOMS], ids=("none", "en", "de"))
def test_an_unknown_word_is_no_person(text: str, rooms: tuple[str, ...]) -> None:
    try:
        assert "room" in str(parse(text, rooms=rooms))
    except CommandError:
        return


@pytest.mark.parametrize(
    "text",
    [
        "search the zeppelin",
        "search the tannery for people",
        "such im Atelje nach Verletzten",
        "look for people in this room, then go to the zeppelin",
        "fahr zur Person und dann zum zeppelin",
        "back to the kitcen with you",
        "go back to the famly",
        "fahr zurück zur boutque",
        "off to the cantteen with you, but stop at the corner for five seconds first",
    ],
)
def test_an_unknown_place_is_not_passed_over(text: str) -> None:
    with pytest.raises(CommandError):
        parse(text)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("go to the victim", "go to the person you found"),
        ("over to him", "go to the person you found"),
        ("fahr zu dem Verletzten, den du gefunden hast", "go to the person you found"),
        ("ask for the name", "ask for the name"),
        ("frag sie nach dem Namen", "ask for the name"),
        ("search the house", "search the house"),
        ("Alle Räume nach Leuten absuchen!", "search the house"),
    ],
)
def test_people_and_the_house_are_known_by_many_words(text: str, meant: str) -> None:
    assert parse(text) == read(meant)


@pytest.mark.parametrize(
    ("text", "rooms", "question", "yes", "room"),
    [
        ("go to the libarie", ENGLISH_ROOMS, 'Did you mean "Library"?', "yes", "library"),
        ("drive to the meating room", ENGLISH_ROOMS, "", "", "meeting room"),
        ("go to the toilet and to the libarie", TWO_ROOMS, 'Did you mean "Library"?', "yes", ""),
        ("geh zur Biblotekk", GERMAN_ROOMS, 'Meinst du "Bibliothek"?', "ja", "bibliothek"),
        ("fahr zur Bieblihotek", GERMAN_ROOMS, 'Meinst du "Bibliothek"?', "ja", "bibliothek"),
        ("fahr in den Bespechungraum", GERMAN_ROOMS, "", "", "besprechungsraum"),
    ],
)
def test_a_word_near_a_room_is_that_room_or_asked_about(
    text: str, rooms: tuple[str, ...], question: str, yes: str, room: str
) -> None:
    both = 'go to room "toilet" and go to room "library"'
    meant = read(f'go to room "{room}"' if room else both)
    if not question:
        assert parse(text, rooms=rooms) == meant
        return
    with pytest.raises(AmbiguousCommandError) as asked:
        parse(text, rooms=rooms)
    assert asked.value.question.text == question
    assert len(question.split()) <= MOST_WORDS
    assert asked.value.question.answer(yes) == meant
    assert parse(text, rooms=rooms, ask=lambda _: yes) == meant


def test_no_to_a_room_is_no_command() -> None:
    with pytest.raises(CommandError, match="other words"):
        parse("go to the libarie", rooms=ENGLISH_ROOMS, ask=lambda _: "no")


def test_a_word_of_the_name_of_a_room_is_no_slip() -> None:
    with pytest.raises(CommandError):
        parse("throw the boots away", rooms=("Boots room", "Office"))


@pytest.mark.parametrize(
    "text",
    [
        "see if somebody is in here, leave the room and go left",
        "go through every room, and when you have found somebody go to them and ask their name",
        "geh in die Küche, schau dich um und ruf, ob jemand antwortet",
    ],
)
def test_no_refusal_blames_a_word_for_people_or_for_calling(text: str) -> None:
    with pytest.raises(CommandError) as refused:
        parse(text, rooms=("Küche",))
    for word in ("somebody", "every", "ask", "ruf", "jemand"):
        assert f'"{word}"' not in refused.value.problem
