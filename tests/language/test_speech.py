"""Words that people say: without punctuation, with fillers, corrections and things left out."""

from random import Random

import pytest

from semnav_env.language import AmbiguousCommandError, CommandError, read, readings
from semnav_env.language.languages import english
from semnav_env.language.normalise import MAX_WORDS
from semnav_env.language.vocabulary.lexicon import lexicon_of
from semnav_env.language.vocabulary.recognition import recognised

MEANT = """
if the door on the left is closed, take the door on the right = if you do not see the first door on the left, go through the first door on the right
falls die Tür links zu ist, nimm die Tür rechts = if you do not see the first door on the left, go through the first door on the right
take the door right after the intersection = go down the hallway past the first intersection and go through the first door
right after the second door, turn left = go down the hallway past the second door and turn left
stop. right there. = stop
go right past the door = go down the hallway past the first door / turn right and go down the hallway past the first door
right, go straight = go down the hallway
go straight past three doors. Take the fourth door on your right = go down the hallway past the third door and go through the first door on the right / go down the hallway past the third door on the right and go through the first door on the right
pass two doors and then enter the third one on your left = go down the hallway past the second door and go through the first door on the left / go down the hallway past the second door on the left and go through the first door on the left
fahr an drei Türen vorbei und nimm dann die vierte rechts = go down the hallway past the third door and go through the first door on the right / go down the hallway past the third door on the right and go through the first door on the right
at the first intersection go straight, at the second turn left = go down the hallway past the first intersection and turn left at the first intersection / go down the hallway past the first intersection and from there turn left at the second intersection
cross the room = go down the hallway until the end of the hallway
walk straight through the room = go down the hallway until the end of the hallway
cross the doorway = go through the first door
leave the door on your left and go on = go through the first door on the left and go down the hallway / go down the hallway past the first door on the left and go down the hallway
turn right, wait, turn left = turn left / turn right, stop and turn left
if you come to a door on the right, stop = go to the first door on the right and stop
go back to the last door = turn around and go down the hallway until the first door
turn around and go back to the first intersection = turn around and go down the hallway until the first intersection
geh an der ersten Tür links vorbei und nimm die zweite links = go down the hallway past the first door on the left and go through the first door on the left / go down the hallway past the first door on the left and from there go through the second door on the left
enter the first room on the right and stop just past the doorway = go through the first door on the right and stop
turn left no wait turn right = turn right
not the first door but the second one, go in = go through the second door
take the second door, not the first = go through the second door
uh so go um to the corner and then like turn left = go down the hallway until the first corner and turn left
fahr bis zur Kreuzung bieg links ab nimm die zweite Tür rechts = go down the hallway until the first intersection, turn left and go through the second door on the right
go geradeaus and then turn rechts = go down the hallway and turn right
with your back to the door go straight = face the first door, turn around and go down the hallway
stop in the doorway = stop in the first door
Fahren Sie bitte an zwei Türen vorbei und halten Sie vor der nächsten links = go down the hallway past the second door, go to the first door on the left and stop
walk past the first door, turn right into the second = go down the hallway past the first door and go through the second door on the right / go down the hallway past the first door and go through the first door on the right
enter the second room on the left, come out and enter the third room on the left = go through the second door on the left, leave the room and go through the third door on the left / go through the second door on the left, leave the room and go through the first door on the left
skip the next door and go in the one after = go through the second door
count four doors on the right and go in the fourth = go through the fourth door on the right
go left, I mean right, at the intersection = turn right at the first intersection / turn right and go down the hallway until the first intersection
you'll see two doors on the left, you want the second = go to the second door on the left / go through the second door on the left
go to the second door on the right and stop in front of it = go to the second door on the right and stop
get out of here, out of this room I mean = leave the room
keep going until you pass two doors = go down the hallway past the second door
when you come out of the room turn left = leave the room and turn left
turn right where the hallway ends = turn right at the end of the hallway
fahr nicht in die erste Tür rechts, sondern in die zweite = go through the second door on the right
wenn du aus dem Zimmer kommst, bieg rechts ab = leave the room and turn right
in die Tür rechts nicht, in die linke = go through the first door on the left
an der Gabelung rechts halten = turn right at the first intersection
durch die zweite Tür nach der Kreuzung, rechte Seite = go down the hallway past the first intersection and go through the second door on the right
bis der Gang einen Knick macht und dann links = go down the hallway until the first corner and turn left
bieg rechts ab und sieh nach, ob die Tür links offen ist, und wenn ja, fahr rein, sonst halt an = turn right, if you see the first door on the left, go through the first door on the left, otherwise stop
dreh dich eine Vierteldrehung nach rechts = turn right by 90 degrees
take the door you came in by = go through the door you came in by
turn at the corner = turn left at the first corner / turn right at the first corner
"""  # noqa: E501
CASES = [tuple(line.split(" = ")) for line in MEANT.strip().splitlines()]


@pytest.mark.parametrize(("text", "meant"), CASES)
def test_what_people_say_is_taken_as_meant_or_asked(text: str, meant: str) -> None:
    assert {str(found) for found in readings(text)} == set(meant.split(" / "))


@pytest.mark.parametrize("text", ["go into the corner", "go into the intersection"])
def test_one_does_not_go_past_what_one_goes_into(text: str) -> None:
    with pytest.raises(CommandError):
        read(text)


@pytest.mark.parametrize("text", [text for text, meant in CASES if " / " not in meant])
def test_a_hesitation_changes_nothing(text: str) -> None:
    words, random = text.split(), Random(text)
    for _ in range(3):
        at = random.randrange(len(words) + 1)
        assert readings(" ".join([*words[:at], "äh" if "ü" in text else "uh", *words[at:]])) == (
            readings(text)
        )


def test_a_slip_of_the_pen_is_asked_about() -> None:
    with pytest.raises(AmbiguousCommandError, match='Did you mean "turn"') as caught:
        read("trun left")
    assert caught.value.readings == (read("turn left"),)


def test_a_word_that_both_languages_have_is_of_either() -> None:
    assert read("halt", "de") == read("halt", "en") == read("stop")


def test_a_forced_language_does_not_take_words_of_the_other() -> None:
    with pytest.raises(CommandError, match="this is German"):
        read("bieg links ab", "en")


@pytest.mark.parametrize(
    ("text", "metres"),
    [("go 1,5 metres", "1.5"), ("fahr 1,5 Meter", "1.5"), ("fahr 2.5 Meter", "2.5")],
)
def test_both_decimal_signs_are_read(text: str, metres: str) -> None:
    assert str(read(text)) == f"go down the hallway for {metres} metres"


@pytest.mark.parametrize("text", ["fahr 1.000 Meter", "go 1,000 metres", "go 3² metres"])
def test_thousands_are_no_decimals(text: str) -> None:
    """A point or a comma between thousands would make metres of kilometres."""
    with pytest.raises(CommandError):
        read(text)


def test_no_content_word_is_dropped() -> None:
    for word in ("unicorn", "red", "upstairs", "or", "elevator"):
        for text in ("turn {} left", "turn left {}", "go through the {} door", "{} stop"):
            with pytest.raises(CommandError):
                read(text.format(word))


def test_a_text_with_too_many_clauses_says_so() -> None:
    with pytest.raises(CommandError, match=f"at most {MAX_WORDS}"):
        read("turn left " * MAX_WORDS)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (
            "zorgle to the corner and turn left",
            "go down the hallway until the first corner and turn left",
        ),
        ("I'm so tired, turn left", "turn left"),
        ("Lucy, turn left at the corner", "turn left at the first corner"),
    ],
)
def test_words_that_say_nothing_of_the_way_are_asked_about(text: str, meant: str) -> None:
    with pytest.raises(AmbiguousCommandError, match="I do not know") as caught:
        read(text)
    assert [str(command) for command in caught.value.readings] == [meant]


@pytest.mark.parametrize(
    "text",
    [
        "go to the elevator and turn left",
        "open the door on the left and go in",
        "turn left and take the blue door",
        "fahr mit dem Aufzug nach oben",
        "bring mir ein Glas Wasser",
    ],
)
def test_words_for_what_the_robot_cannot_do_are_never_left_out(text: str) -> None:
    with pytest.raises(CommandError) as caught:
        read(text)
    assert not isinstance(caught.value, AmbiguousCommandError)


def test_what_is_said_in_canonical_words_is_taken_literally() -> None:
    text = "leave the room and leave the room"
    assert str(read(text)) == text
    assert str(read("get out of here, out of the room")) == "leave the room"


def test_separable_verbs_and_compounds_are_taken_apart() -> None:
    text = "an der Gangkreuzung rechts, dann an zwei Türen vorbeischlendern"
    meant = "turn right at the first intersection and go down the hallway past the second door"
    assert str(read(text)) == meant


def test_a_language_that_knows_every_word_is_recognised_alone():
    lexicon_of.cache_clear()
    assert recognised(["go", "left", ",", "then", "right"]) == english()
    assert lexicon_of.cache_info().currsize == 1
