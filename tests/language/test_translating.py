"""The learned translator: its symbols, its network, and what it asks where the grammar refuses."""

import pickle
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given

from semnav_agents.networks.bundled import BUNDLED_FOLDER
from semnav_env.language import (
    AmbiguousCommandError,
    Command,
    CommandError,
    Interpreter,
    parse,
    read,
    sample_command,
)
from semnav_env.language.command import room_of
from semnav_env.language.references import Side
from semnav_env.language.translating import candidates
from semnav_env.language.translating.interpreter import (
    AskingLimits,
    LearnedInterpreter,
)
from semnav_env.language.translating.masking import MAX_VALUES, masked
from semnav_env.language.translating.network import (
    TRAINED_FOLDER,
    Beams,
    TranslatorNetwork,
    TranslatorShape,
    load_translator,
    rows_of_classes,
)
from semnav_env.language.translating.programs import UnsayableError, command_of, sayable, symbols_of
from semnav_env.language.translating.ranking import ranked
from semnav_env.language.translating.support import TextSupport
from semnav_env.language.translating.translator import MAX_TRANSLATED_WORDS, translate
from semnav_env.networks.card import CARD_FILE, Card
from semnav_env.networks.weights import WEIGHTS_FILE, save_weights
from tests.support.command_strategies import commands

INTERPRETER = LearnedInterpreter()


def test_values_sides_and_rooms_are_taken_out() -> None:
    text = masked("Take the third door on the left, then right into the Küche, 2.5 m.", ("Küche",))
    assert text.values == (3.0, 2.5)
    assert text.sides == (Side.LEFT, Side.RIGHT)
    assert text.rooms == ("kueche",)
    assert text.words[2:4] == ("third", "door")


def test_first_is_no_value() -> None:
    assert masked("the first door, the next one", ()).values == ()


def test_a_text_with_too_many_values_is_refused() -> None:
    numbers = ", ".join(str(n) for n in range(2, 4 + MAX_VALUES))
    with pytest.raises(CommandError, match="more than 6 different numbers"):
        masked(numbers, ())


@given(commands)
def test_a_command_comes_back_from_its_symbols(command: Command) -> None:
    rooms = tuple(filter(None, map(room_of, command.clauses)))
    try:
        text = masked(command.say(), rooms)
        symbols = symbols_of(command, text)
    except (CommandError, UnsayableError):
        return
    assert command_of(symbols, text) == command


@pytest.mark.parametrize(
    "symbols",
    [
        (),
        ("door",),
        ("turn", "value 0"),
        ("through", "intersection", "1"),
        ("refuse",),
        ("if",),
        ("wait", "0.5"),
        ("to", "door", "side 0"),
        ("until", "room 0"),
        ("else",),
    ],
)
def test_symbols_that_are_no_command_are_refused(symbols: tuple[str, ...]) -> None:
    with pytest.raises(UnsayableError):
        command_of(symbols, masked("go", ()))


def test_the_network_says_the_same_as_that_of_torch() -> None:
    torch = pytest.importorskip("torch")
    from studies.translating.torch_network import TorchTranslator
    from studies.translating.training import EncodedText, TranslatorTraining, _tensors

    shape = TranslatorShape(width=8, heads=2, layers=2, hidden=16, buckets=64, classes=32)
    model = TorchTranslator(shape, 0, 0.0).eval()
    settings = TranslatorTraining(shape=shape, word_dropout=0.0, value_dropout=0.0)
    kinds = (("verb go",), ("prep past", "det"), ("det",), ("ordinal",), ("noun door",))
    rows = tuple(rows_of_classes(each, shape.classes) for each in kinds)
    words = ("go", "past", "the", "third", "door")
    text = EncodedText(words, (0, 0, 0, 1, 0), rows, (0, 5, 9, 1))
    longer = EncodedText(("turn",) * 9, (0,) * 9, rows[:1] * 9, (0, 7, 1))
    batch = _tensors([text, longer], settings, np.random.default_rng(0))
    with torch.no_grad():
        expected = model(*batch[:-1], batch[-1][:, :-1].clamp(min=0))[0].log_softmax(dim=-1)
    network = TranslatorNetwork(shape, model.arrays())
    beams = Beams(network, network.encode(text.words, text.marks, kinds))
    for count, symbol in enumerate(text.symbols[:3]):
        found = beams.log_shares([symbol])[0]
        np.testing.assert_allclose(found, expected[count].numpy(), atol=1e-5)


def test_training_is_the_same_for_the_same_seed() -> None:
    pytest.importorskip("torch")
    from studies.translating.texts import TrainingText
    from studies.translating.training import TranslatorTraining, trained

    shape = TranslatorShape(width=8, heads=2, layers=1, hidden=16, buckets=64, classes=32)
    settings = TranslatorTraining(steps=3, batch=4, warm_up=1, shape=shape)
    said = ("turn left", "go to the third door", "stop")
    texts = [TrainingText(each, "en", (), (parse(each),)) for each in said]
    first, second = (trained(texts, settings, 7).tensors for _ in range(2))
    assert all(np.array_equal(first[name], second[name]) for name in first)


def test_what_the_grammar_understands_stays() -> None:
    known: Interpreter = INTERPRETER
    found = known.interpret("nimm die zweite Tür links")
    assert found.command == parse("take the second door on the left")
    assert found.by == "grammar"
    assert found.echo == "fahr durch die zweite Tür links"


GOLDEN = {
    "geh die dritte links rein durch die Tür": "go through the third door on the left",
    "you will want the second of the doors on your left": "go through the second door on the left",
    "door number three on the right, that one is yours": "go through the third door on the right",
    "mosey to the third door": "go to the third door",
    "nimm die zweite Tür links": "go through the second door on the left",
}
"""Texts outside the development sets, and what they mean."""


@pytest.mark.parametrize("text", GOLDEN)
def test_golden_sentences_are_translated(text: str) -> None:
    found = translate(text, (), load_translator())
    assert found is not None
    first = found.translations[0]
    assert str(first.command) == GOLDEN[text]
    assert first.likeness >= 0.3
    assert found.refusal < 0.2
    assert not first.unsaid


@pytest.mark.parametrize("text", GOLDEN)
def test_a_beam_finds_no_less_likely_command_than_each_symbol_by_itself(text: str) -> None:
    plain, network = masked(text, ()), load_translator()
    encoded = network.encode(plain.words, plain.marks, plain.classes)
    narrow, wide = (network.candidates(encoded, count, sayable(plain))[0] for count in (1, 5))
    assert wide[1] >= narrow[1] - 1e-6
    assert network.log_share_of(wide[0], encoded) == pytest.approx(wide[1], abs=1e-4)


def refusing(text: str, language: object, rooms: object) -> tuple[Command, ...]:
    """A grammar that refuses every text."""
    raise CommandError("nothing is understood", text)


def turning(text: str, language: object, rooms: object) -> tuple[Command, ...]:
    """A grammar that takes every text for a turn."""
    return (read("turn left"),)


NEVER_ACTING, ALWAYS_ACTING = AskingLimits(acting=1.01), AskingLimits(acting=0.0)


def test_a_likely_translation_of_what_the_grammar_refuses_is_a_candidate(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(candidates, "readings", refusing)
    text, meant = "geh bitte durch die dritte Tür links", "go through the third door on the left"
    with pytest.raises(AmbiguousCommandError) as asked:
        LearnedInterpreter(limits=NEVER_ACTING).interpret(text)
    assert asked.value.readings[0] == parse(meant)
    assert len(asked.value.readings) <= AskingLimits().choices
    assert asked.value.question.text.startswith("Durch die dritte Tür links")
    assert pickle.loads(pickle.dumps(asked.value)).readings == asked.value.readings
    acted = LearnedInterpreter(limits=ALWAYS_ACTING).interpret(text)
    assert (acted.command, acted.by) == (parse(meant), "translator")


def test_a_text_with_words_that_would_be_lost_is_not_acted_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(candidates, "readings", refusing)
    with pytest.raises(CommandError):
        INTERPRETER.interpret("go through the blue door on the left")


def test_what_the_translator_contradicts_is_not_acted_on(monkeypatch: pytest.MonkeyPatch) -> None:
    text = "now take the second door on the right"
    right = parse("go through the second door on the right")
    assert INTERPRETER.interpret(text).command == right
    monkeypatch.setattr(candidates, "readings", turning)
    with pytest.raises(AmbiguousCommandError) as asked:
        LearnedInterpreter(limits=NEVER_ACTING).interpret(text)
    assert set(asked.value.readings) == {read("turn left"), right}


def test_words_left_out_of_what_is_no_command_are_not_acted_on() -> None:
    with pytest.raises(CommandError):
        INTERPRETER.interpret("go to the room where people are laughing")


def test_the_probabilities_of_the_candidates_and_of_none_are_one() -> None:
    found = candidates.heard("take the second right, door", None, (), TRAINED_FOLDER)
    shares = [share for _, share in ranked(found, TRAINED_FOLDER)]
    assert shares == sorted(shares, reverse=True)
    assert 0.0 < sum(shares) <= 1.0


def test_candidates_differ_in_meaning() -> None:
    found = candidates.heard(
        "go to the end of the hall and turn left there", None, (), TRAINED_FOLDER
    )
    meanings = [candidates.meaning(each.command) for each in found.candidates]
    assert len(set(meanings)) == len(meanings)


@pytest.mark.parametrize(
    ("text", "rooms", "values", "sides", "named"),
    [
        ("go 20 feet, then rihgt", (), (6.0,), ("right",), ()),
        ("wait two minutes", (), (120.0,), (), ()),
        ("eine halbe Minute warten, Linksdrehung", (), (30.0,), ("left",), ()),
        ("wait a minute", (), (60.0,), (), ()),
        ("wait for 1 second, then take the second door", (), (2.0,), (), ()),
        ("wait for 2 seconds", (), (2.0,), (), ()),
        ("90 degrees counterclockwise", (), (90.0,), ("left",), ()),
        ("to the libary", ("library",), (), (), ("library",)),
        ("zum Büchereiraum, in die bücher ei", ("Bücherei",), (), (), ("buecherei",)),
        ("into room twenty one", ("room 21",), (), (), ("room 21",)),
        ("three doors down", ("room 3",), (3.0,), (), ()),
        ("tonight the light is bright", (), (), (), ()),
    ],
)
def test_values_sides_and_rooms_are_known_as_people_say_them(
    text: str, rooms: tuple[str, ...], values: object, sides: object, named: object
) -> None:
    found = masked(text, rooms)
    assert (found.values, tuple(found.sides), found.rooms) == (values, sides, named)


def test_the_network_says_no_number_that_the_text_has_not() -> None:
    network, plain = load_translator(), masked("go past the door and turn", ())
    encoded = network.encode(plain.words, plain.marks, plain.classes)
    said = {s for symbols, _ in network.candidates(encoded, 5, sayable(plain)) for s in symbols}
    assert not any(symbol.startswith(("value", "side", "room")) for symbol in said)


@pytest.mark.parametrize("code", ["en", "de"])
def test_canonical_words_are_never_doubted(code: str) -> None:
    rng = np.random.default_rng(0)
    for command in (sample_command(rng) for _ in range(30)):
        assert INTERPRETER.interpret(command.say(code)).command == command


@pytest.mark.parametrize(
    "text",
    [
        "",
        "?!",
        "asdf qwer zxcv",
        "what time is it",
        "sing me a song",
        "Wie spät ist es?",
        "take the elevator to the third floor",
        "bring me the blue cup",
        "\x00",
        "x " * 299,
    ],
)
def test_nonsense_is_refused_without_a_question(text: str) -> None:
    with pytest.raises(CommandError) as refused:
        INTERPRETER.interpret(text)
    assert not isinstance(refused.value, AmbiguousCommandError)


def test_a_long_text_is_not_translated() -> None:
    assert translate("turn left " * (MAX_TRANSLATED_WORDS // 2 + 1), (), load_translator()) is None


def test_the_same_text_gives_the_same_question() -> None:
    found = (translate("mosey to the third door", (), load_translator()) for _ in range(2))
    first, second = (each.translations for each in found if each is not None)
    assert first == second


def test_the_weights_are_small() -> None:
    assert (TRAINED_FOLDER / WEIGHTS_FILE).stat().st_size <= 2_000_000


def test_weights_come_back_from_their_files(tmp_path) -> None:
    shape = TranslatorShape(width=8, heads=2, layers=1, hidden=16, buckets=64, classes=32)
    rng = np.random.default_rng(0)
    tensors = {
        name: rng.normal(size=size).astype(np.float16).astype(np.float32)
        for name, size in shape.tensors().items()
    }
    save_weights(tmp_path, {name: each.astype(np.float16) for name, each in tensors.items()})
    Card(shape, {}, 3).write(tmp_path)
    back = load_translator(tmp_path)
    assert back.shape == shape
    assert all(np.array_equal(back.tensors[name], tensors[name]) for name in tensors)


def test_a_broken_card_is_named(tmp_path) -> None:
    (tmp_path / CARD_FILE).write_text('{"shape": {"width": 7}}')
    with pytest.raises(ValueError, match="has format None"):
        load_translator(tmp_path)


def test_another_network_is_refused_by_its_kind() -> None:
    with pytest.raises(ValueError, match="the card of a 'policy', not of a 'translator'"):
        load_translator(BUNDLED_FOLDER / "drive")


def test_asking_needs_no_torch() -> None:
    code = (
        "import sys\n"
        "from semnav_env.language.translating.interpreter import LearnedInterpreter\n"
        "try: LearnedInterpreter().interpret('mosey to the third door')\n"
        "except ValueError: pass\n"
        "assert 'torch' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize(
    ("words", "impossible"),
    [
        (("take", "the", "elevator"), True),
        (("bring", "die", "post"), True),
        (("mach", "einen", "rueckwaertssalto"), True),
        (("stop", "just", "before", "the", "corner"), False),
        (("you", "know", "kind", "of", "left"), False),
    ],
)
def test_a_thing_is_one_unless_its_phrase_means_something_else(
    words: tuple[str, ...], impossible: bool
) -> None:
    assert TextSupport.of(words).is_impossible is impossible


@pytest.mark.parametrize(
    ("text", "meant", "speaks"),
    [
        ("look at me when i talk", "face the first intersection", False),
        ("where do you come from", "go back to the start", False),
        ("follow me", "go down the hallway", False),
        ("halt", "stop", False),
        ("whizz to the crossing", "go down the hallway until the first intersection", True),
        ("und dann die dritte", "go through the third door", True),
    ],
)
def test_a_text_speaks_of_all_that_its_translation_names(
    text: str, meant: str, speaks: bool
) -> None:
    assert TextSupport.of(text.split()).speaks_of(parse(meant)) is speaks


def test_a_question_is_answered_by_a_refusal() -> None:
    with pytest.raises(CommandError, match="a question is not a command") as refused:
        INTERPRETER.interpret("is the door on the left open?")
    assert not isinstance(refused.value, AmbiguousCommandError)


@pytest.mark.parametrize(
    "text",
    [
        "don't turn left",
        "do not enter the first door on the left",
        "geh nicht durch die erste Tür rechts",
        "go through the first or the second door on the left",
        "move 30 cm forward",
        "fahr 20 Zentimeter vor",
    ],
)
def test_nothing_is_asked_about_what_forbids_leaves_a_choice_or_is_too_short(text: str) -> None:
    with pytest.raises(CommandError) as caught:
        LearnedInterpreter().interpret(text)
    assert not isinstance(caught.value, AmbiguousCommandError)
