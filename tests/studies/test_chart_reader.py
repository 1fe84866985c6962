"""The chart reader: its lattice, chart, frames, edits, programs and ranker."""

from __future__ import annotations

from itertools import chain

import numpy as np
import pytest

from semnav_env.language import Command, Distance, DoorReference, Follow, GoToDoor, GoToRoom, parse
from semnav_env.language.corpora import Sentence
from semnav_env.language.corpora.notation import read_meaning
from semnav_env.language.question import AmbiguousCommandError
from semnav_env.language.references import Side
from studies.chart_reader.chart import Chart, grammar_of
from studies.chart_reader.edits import replaced
from studies.chart_reader.examples import Example, example_of
from studies.chart_reader.features import features, merged, read_features
from studies.chart_reader.frames import frames_by_verb
from studies.chart_reader.lattice import SLIP, Lattice
from studies.chart_reader.lexicon import lexicon_of
from studies.chart_reader.measuring import Limits, outcome_of
from studies.chart_reader.reader import candidates, chart_of
from studies.chart_reader.reading import read, understand
from studies.chart_reader.templates import NoClauseError, clause_of, template_of
from studies.chart_reader.training import Trainer

ROOMS = ("kitchen", "room_12")


def symbols(text: str, code: str = "en", rooms: tuple[str, ...] = ()) -> set[tuple[int, str]]:
    """The number of the first word and the symbol of all spans of a text."""
    lattice = Lattice(text, lexicon_of(code), rooms)
    return {(at, edge.symbol) for at, row in enumerate(lattice.edges) for edge in row}


def cheapest(text: str, code: str = "en", rooms: tuple[str, ...] = ROOMS) -> Command | None:
    """The command of the cheapest candidate."""
    return candidates(chart_of(text, code, rooms))[0].command


def test_contradicting_features_do_not_merge() -> None:
    door = read_features("kind=door ord=2")
    assert merged(door, read_features("ord=3")) is None
    assert merged(door, read_features("side=left")) == read_features("kind=door ord=2 side=left")


def test_a_misspelt_word_costs_a_slip_and_a_known_one_nothing() -> None:
    lattice = Lattice("turn lfet", lexicon_of("en"))
    sides = [edge.cost for edge in lattice.edges[1] if edge.symbol == "SIDE"]
    assert sides == [SLIP]
    assert all(edge.cost == 0.0 for edge in lattice.edges[0])


def test_a_german_compound_is_its_last_noun_and_its_particle_a_word() -> None:
    assert (1, "NPLACE") in symbols("zweite Gangkreuzung", "de")
    chart = chart_of("reinfahren", "de")
    assert {"V": "go", "in": 1}.items() <= dict(chart.find("C", 0)[0][1]).items()


def test_rooms_are_spans_under_the_names_that_people_say() -> None:
    assert (2, "ROOMNAME") in symbols("go to room twelve", rooms=ROOMS)
    assert (2, "ROOMNAME") not in symbols("go to room twelve")


def test_a_number_is_never_made_up() -> None:
    for text in ("go to the door", "go past doors", "wait"):
        assert not any("NUM" in spans for spans in chart_of(text, "en").at), text


def test_a_word_is_no_slip_of_a_number() -> None:
    assert "NUM" not in {symbol for _, symbol in symbols("go twoo metres")}


def test_a_noun_phrase_nests_what_it_is_counted_from() -> None:
    chart = chart_of("the second door on the left after the corner", "en")
    whole = {given for stop, given, _ in chart.find("DOOR", 0) if stop == len(chart.at)}
    corner = features({"kind": "place", "place": "corner"})
    assert any(
        {"ord": 2, "side": "left", "after.place": corner}.items() <= dict(given).items()
        for given in whole
    )


def test_a_chart_finds_the_same_when_asked_twice() -> None:
    lattice = Lattice("go past the second door and turn left", lexicon_of("en"))
    first, second = (Chart(lattice, grammar_of("english")) for _ in range(2))
    once = [first.find("C", at) for at in range(len(first.at))]
    again = [second.find("C", at) for at in reversed(range(len(second.at)))]
    assert [set(row) for row in once] == [set(row) for row in reversed(again)]


def test_every_step_of_every_frame_is_declared_by_a_clause() -> None:
    frames = chain.from_iterable(frames_by_verb().values())
    steps = {step for frame in frames for step in frame.steps}
    for step in steps:
        if step != "unsayable" and not step.startswith("note "):
            template_of(step)


def test_a_step_takes_only_what_its_field_may_be() -> None:
    door = DoorReference(2, Side.LEFT)
    assert clause_of("through $x", {"$x": door}) == GoToDoor(door)
    assert clause_of("hallway for $x", {"$x": Distance(3.0)}) == Follow(Distance(3.0))
    with pytest.raises(NoClauseError):
        clause_of("through $x", {"$x": Distance(3.0)})


def test_the_steps_of_a_door_are_those_of_a_room_that_is_meant() -> None:
    assert cheapest("go to the kitchen") == Command((GoToRoom("kitchen"),))
    assert cheapest("find the kitchen and go in") == Command((GoToRoom("kitchen"),))


def test_a_correction_replaces_only_what_it_says() -> None:
    door = features({"kind": "door", "ord": 2, "side": "left"})
    said = features({"V": "take", "obj.door": door})
    right = replaced(said, features({"side": "right"}))
    third = replaced(said, ((("obj.door"), features({"kind": "door", "ell": 1, "ord": 3})),))
    assert right is not None
    assert third is not None
    assert dict(dict(right)["obj.door"]) == {"kind": "door", "ord": 2, "side": "right"}
    assert dict(dict(third)["obj.door"]) == {"kind": "door", "ord": 3, "side": "left"}


SAME = {
    "second door on the right": "go through the second door on the right",
    "it's the second door on the right": "go through the second door on the right",
    "turn left, no, right": "turn right",
    "take the second left": "turn left at the second turning",
    "not the first door but the second": "go through the second door",
    "take the door on the left, and if there is none, turn around": (
        "if you see the first door on the left, go through the first door on the left, "
        "otherwise turn around"
    ),
    "go past the kitchen and take the next door on the left": (
        'go down the hallway past room "kitchen" and go through the first door on the left'
    ),
}


@pytest.mark.parametrize("text", SAME)
def test_english_is_read_as_its_canonical_words(text: str) -> None:
    assert cheapest(text) == parse(SAME[text], "en", ROOMS)


GERMAN = {
    "zweite Tür rechts": "go through the second door on the right",
    "bieg an der Kreuzung links ab": "turn left at the first intersection",
    "an der Küche vorbei und dann die zweite Tür links rein": (
        'go down the hallway past room "kueche" and go through the second door on the left'
    ),
    "Zimmer verlassen, bis zum Flurende fahren und dort anhalten": (
        "leave the room, go down the hallway until the end of the hallway and stop"
    ),
    "Fahr zur Ecke. Ist da links keine Tür, dreh um.": (
        "go down the hallway until the first corner, "
        "if you do not see the first door on the left, turn around"
    ),
}


@pytest.mark.parametrize("text", GERMAN)
def test_german_is_read_by_the_same_code(text: str) -> None:
    assert cheapest(text, "de", ("kueche",)) == parse(GERMAN[text], "en", ("kueche",))


def test_what_no_clause_can_say_is_a_candidate() -> None:
    assert cheapest("take the door next to the kitchen") is None
    assert cheapest("drive through the wall") is None


def test_probabilities_of_a_reading_and_of_none_add_up() -> None:
    reading = read("go through the second door on the left", "en")
    total = sum(each.probability for each in reading.ranked) + reading.none
    assert total == pytest.approx(1.0)
    assert reading.ranked[0].command == understand("go through the second door on the left", "en")


def example(text: str, meaning: str) -> Example:
    """A feasible text of one meaning with its candidates."""
    sentence = Sentence("1", text, "feasible", (read_meaning(meaning),), "", "a")
    return example_of(sentence, "en", (), "a")


def test_training_makes_the_right_candidates_likelier() -> None:
    doors = [example("second left", "through door(2,left)")] * 5
    turns = [example("take the second left", "turn left at turning#2")] * 5
    trainer = Trainer([*turns, *doors])
    right = np.array(turns[0].right)
    few, all_of_them = (trainer.train(which) for which in ([5], range(10)))
    before, after = (trainer.probabilities(0, weights) for weights in (few, all_of_them))
    assert after[right].sum() > before[right].sum()


def test_a_reading_is_acted_on_only_from_the_limit_on() -> None:
    known = example("turn left", "turn left")
    chances = np.zeros(len(known.right))
    chances[known.right.index(True)], chances[-1] = 0.75, 0.25
    assert outcome_of(known, chances, Limits(act=0.7)) == "understood"
    assert outcome_of(known, chances, Limits(act=0.8)) == "asked"


def test_a_text_that_is_likely_no_command_is_refused() -> None:
    known = example("turn left", "turn left")
    chances = np.zeros(len(known.right))
    chances[known.right.index(True)], chances[-1] = 0.4, 0.6
    assert outcome_of(known, chances, Limits(act=0.3)) == "refused"


def test_a_question_has_the_two_likeliest_readings() -> None:
    text = "take the second left"
    with pytest.raises(AmbiguousCommandError) as caught:
        understand(text, "en", limits=Limits(act=1.01))
    ranked = [each.command for each in read(text, "en").ranked]
    assert list(caught.value.question.readings) == ranked[:2]
