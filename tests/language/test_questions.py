"""A question is short, in the speaker's language, and settled by a short answer."""

import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.language import (
    AmbiguousCommandError,
    Command,
    CommandError,
    GoToDoor,
    Question,
    Stop,
    parse,
    read,
    sample_command,
)
from semnav_env.language.languages import languages
from semnav_env.language.question import MOST_QUESTIONS, MOST_WORDS, ask_until_clear
from semnav_env.language.references import ENTRY, DoorReference, Side
from tests.support.asked import asked_about


def of_readings(language: str, *texts: str) -> Question:
    return Question(tuple(map(read, texts)), languages()[language], parse)


DOOR = ("go through the second door on the left", "go to the second door on the left")
SIDES = ("go through the second door on the left", "go through the second door on the right")
ORDINALS = ("turn left at the second corner", "turn left at the third corner")
BACK = ("go back to the start", "turn around and go down the hallway")
ALONE = ("go through the first door",)

ANSWERS = [
    (DOOR, "en", "Through it, or only up to it?", {0: ["in", "through", "go in please"]}),
    (DOOR, "en", "Through it, or only up to it?", {1: ["up to it", "in front of it", "not in"]}),
    (DOOR, "de", "Hindurch oder nur davor?", {0: ["rein", "durch", "hindurch bitte"]}),
    (DOOR, "de", "Hindurch oder nur davor?", {1: ["nur davor", "davor", "bis vor die Tür"]}),
    (SIDES, "en", "Left, or right?", {0: ["left", "the left one", "no, not right"]}),
    (SIDES, "en", "Left, or right?", {1: ["the right one", "no, the other one", "the second"]}),
    (SIDES, "de", "Links oder rechts?", {0: ["die linke", "links", "ich meine links"]}),
    (SIDES, "de", "Links oder rechts?", {1: ["nein, die andere", "nicht links sondern rechts"]}),
    (ORDINALS, "en", "The second, or the third?", {0: ["the second", "second one", "2nd"]}),
    (ORDINALS, "en", "The second, or the third?", {1: ["third", "no, the third one", "other"]}),
    (ORDINALS, "de", "Die zweite oder die dritte?", {0: ["die zweite"], 1: ["dritte"]}),
    (BACK, "en", "Back to the start, or around and down the hallway?", {0: ["the former"]}),
    (
        *(BACK, "en", "Back to the start, or around and down the hallway?"),
        {1: ["turn around", "around", "turn around and go down the hallway"]},
    ),
    (ALONE, "en", "Through the first door?", {0: ["yes", "yes please", "ok", "the first door"]}),
    (ALONE, "de", "Durch die erste Tür?", {0: ["ja", "genau", "ja, durch die erste Tür"]}),
]


@pytest.mark.parametrize(("readings", "language", "asked", "answers"), ANSWERS)
def test_a_short_answer_settles_it(
    readings: tuple[str, ...], language: str, asked: str, answers: dict[int, list[str]]
) -> None:
    question = of_readings(language, *readings)
    assert question.text == asked
    for number, texts in answers.items():
        for text in texts:
            assert question.answer(text) == read(readings[number]), text


@pytest.mark.parametrize(
    ("readings", "text"), [(DOOR, "yes"), (SIDES, "left or right"), (SIDES, "hm?"), (ALONE, "")]
)
def test_what_leaves_it_open_is_asked_again(readings: tuple[str, ...], text: str) -> None:
    question = of_readings("en", *readings)
    with pytest.raises(AmbiguousCommandError) as again:
        question.answer(text)
    assert again.value.question == question


LONG = (
    "go through the second door on the left and turn left at the third corner",
    "go down the hallway past the second door on the right and wait for 5 seconds",
)


def test_of_two_long_choices_only_the_likelier_is_named_and_then_the_other() -> None:
    question = of_readings("en", *LONG)
    assert question.text == "Through the second door on the left and left at the third corner?"
    assert question.answer("yes") == read(LONG[0])
    assert question.answer("the right one") == read(LONG[1])
    with pytest.raises(AmbiguousCommandError) as again:
        question.answer("no")
    assert again.value.readings == (read(LONG[1]),)
    assert again.value.question.answer("yes") == read(LONG[1])


def test_no_to_the_only_reading_is_no_command() -> None:
    with pytest.raises(CommandError, match="in other words"):
        of_readings("en", *ALONE).answer("no")
    with pytest.raises(CommandError, match="mit anderen Worten"):
        of_readings("de", *ALONE).answer("nein")


@pytest.mark.parametrize("text", ["no", "neither", "none", "nope"])
def test_no_to_both_choices_is_no_command(text: str) -> None:
    with pytest.raises(CommandError, match="in other words"):
        of_readings("en", *SIDES).answer(text)


@pytest.mark.parametrize("text", ["stop", "Stopp!", "no, stop", "never mind", "vergiss es"])
def test_stop_is_an_answer_to_every_question(text: str) -> None:
    assert of_readings("en", *SIDES).answer(text) == Command((Stop(),))


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("turn around and go down the hallway", BACK[1]),
        ("no, turn left at the next corner", "turn left at the first corner"),
        ("yes, back to the start", BACK[0]),
    ],
)
def test_a_whole_command_is_an_answer(text: str, meant: str) -> None:
    assert of_readings("en", *BACK).answer(text) == read(meant)


@given(st.randoms(use_true_random=False), st.sampled_from(sorted(languages())))
def test_a_choice_in_its_own_words_is_always_that_choice(random, language: str) -> None:
    import numpy as np

    rng = np.random.default_rng(random.getrandbits(32))
    first, second = sample_command(rng), sample_command(rng)
    if first == second:
        return
    question = Question((first, second), languages()[language], read)
    for command in (first, second):
        assert question.answer(command.say(language)) == command


@pytest.mark.parametrize("language", sorted(languages()))
@pytest.mark.parametrize("side", [side for side in Side if side is not Side.LEFT])
def test_two_doors_on_any_two_sides_are_asked_about_by_their_sides(side, language: str) -> None:
    spoken = languages()[language]
    both = tuple(Command((GoToDoor(DoorReference(1, each)),)) for each in (Side.LEFT, side))
    asked = Question(both, spoken, read)
    assert spoken.say(side).split()[0] in asked.text.lower()
    assert asked.answer(spoken.say(side)) == both[1]


def test_the_door_one_came_in_by_is_asked_about_by_its_name() -> None:
    both = tuple(Command((GoToDoor(DoorReference(n)),)) for n in (2, ENTRY))
    asked = Question(both, languages()["en"], read)
    assert "the door you came in by" in asked.text
    assert asked.answer("the door you came in by") == both[1]


def test_parse_asks_until_it_is_clear() -> None:
    text, question = asked_about()
    asked, answers = [], iter(["what?", question.choices[1].name])

    def ask(text: str) -> str:
        asked.append(text)
        return next(answers)

    assert parse(text, ask=ask) == question.readings[1]
    assert asked == [question.text] * 2


def test_a_person_is_not_asked_for_ever() -> None:
    asked: list[str] = []

    def ask(text: str) -> str:
        asked.append(text)
        return "what?"

    with pytest.raises(AmbiguousCommandError):
        parse(asked_about()[0], ask=ask)
    assert len(asked) == MOST_QUESTIONS


def test_a_question_survives_pickling() -> None:
    error = AmbiguousCommandError("turn", of_readings("en", *SIDES))
    copy = pickle.loads(pickle.dumps(error))
    assert str(copy) == str(error)
    assert copy.question.answer("left") == read(SIDES[0])
    assert ask_until_clear(copy, lambda _: "right") == read(SIDES[1])


VILLA = ("parents' bedroom", "daughter's bedroom", "kitchen", "living room")
THREE = ("Büro Nord", "Büro Süd", "Büro West", "Labor")


@pytest.mark.parametrize(
    ("text", "question"),
    [
        ("go to the bedroom", 'Room "parents bedroom", or room "daughters bedroom"?'),
        ("please drive into the bedroom", 'Room "parents bedroom", or room "daughters bedroom"?'),
        ("stop in front of the bedroom", 'Room "parents bedroom", or room "daughters bedroom"?'),
        ("fahr ins Schlafzimmer", 'Raum "parents bedroom" oder Raum "daughters bedroom"?'),
    ],
)
@pytest.mark.parametrize(("answer", "number"), [("daughter's", 1), ("parents", 0), ("1", 0)])
def test_a_kind_of_which_there_are_two_rooms_is_asked_about_by_their_names(
    text: str, question: str, answer: str, number: int
) -> None:
    with pytest.raises(AmbiguousCommandError) as asked:
        parse(text, rooms=VILLA)
    assert asked.value.question.text == question
    assert len(question.split()) <= MOST_WORDS
    command = asked.value.question.answer(answer)
    assert f'room "{("parents", "daughters")[number]} bedroom"' in str(command)


def test_of_three_rooms_of_a_kind_the_third_is_asked_about_when_two_are_not_meant() -> None:
    with pytest.raises(AmbiguousCommandError) as asked:
        parse("fahr ins Büro", rooms=THREE)
    with pytest.raises(AmbiguousCommandError) as again:
        asked.value.question.answer("keine von beiden")
    assert again.value.question.text == 'In Raum "buero west"?'
    assert str(again.value.question.answer("ja")) == 'go to room "buero west"'


@pytest.mark.parametrize(
    "text", ["go to the parents' bedroom", "leave the bedroom", "go to the bedroom on the left"]
)
def test_where_one_reading_is_meant_no_room_of_a_kind_is_asked_about(text: str) -> None:
    parse(text, rooms=VILLA)
