"""The learned translator: what it sees of a text, its symbols and its network."""

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given

from semnav_agents.networks.bundled import BUNDLED_FOLDER
from semnav_env.language import Command, CommandError, parse
from semnav_env.language.canonical import read
from semnav_env.language.command import room_of
from semnav_env.language.corpora.meanings import key_of
from semnav_env.language.references import Side
from semnav_env.language.translating.masking import MAX_VALUES, masked
from semnav_env.language.translating.network import (
    TRAINED_FOLDER,
    Beams,
    TranslatorNetwork,
    TranslatorShape,
    load_translator,
)
from semnav_env.language.translating.programs import (
    SYMBOLS,
    UnsayableError,
    command_of,
    sayable,
    symbols_of,
)
from semnav_env.language.translating.translator import MAX_TRANSLATED_WORDS, translate
from semnav_env.networks.card import CARD_FILE, Card
from semnav_env.networks.weights import WEIGHTS_FILE, save_weights
from tests.support.command_strategies import commands


def test_values_sides_and_rooms_are_taken_out() -> None:
    text = masked("Take the third door on the left, then right into the Küche, 2.5 m.", ("Küche",))
    assert text.values == (3.0, 2.5)
    assert text.sides == (Side.LEFT, Side.RIGHT)
    assert text.rooms == ("kueche",)
    assert text.words[2:4] == ("third", "door")


@pytest.mark.parametrize(
    ("said", "named"),
    [
        ("Wohnzimmer", "living room"),
        ("Wartezimmer", "Waiting room 2"),
        ("meeting room", "Besprechungsraum"),
        ("Esszimmer", "dining room"),
    ],
)
def test_a_kind_of_room_is_known_in_both_languages(said: str, named: str) -> None:
    numbered = f"{said} 2" if named.endswith("2") else said
    assert masked(f"go to the {numbered}", (named,)).rooms == (named.lower(),)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("the twenty-fifth door", (25.0,)),
        ("twenty third door on the left", (23.0,)),
        ("go 0 metres", (0.0,)),
        ("go 0.1 metres", (0.5,)),
        ("go 80 inches", (2.0,)),
        ("fahr 80 Zoll vor", (2.0,)),
        ("fahr 10 Fuß vor", (3.0,)),
    ],
)
def test_a_value_is_what_was_said(text: str, values: tuple[float, ...]) -> None:
    assert masked(text, ()).values == values


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
        ("<refuse>",),
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


def test_a_side_that_was_not_said_may_be_either() -> None:
    text = masked("turn ninety degrees", ())
    for side in ("left", "right"):
        command = read(f"turn {side} by 90 degrees")
        assert command_of(symbols_of(command, text), text) == command
        assert sayable(text)[SYMBOLS.index(side)]


def test_where_a_side_was_said_no_other_can_be() -> None:
    text = masked("turn left ninety degrees", ())
    with pytest.raises(UnsayableError):
        symbols_of(read("turn right by 90 degrees"), text)
    assert not any(sayable(text)[SYMBOLS.index(side)] for side in ("left", "right"))


def test_the_network_says_the_same_as_that_of_torch() -> None:
    torch = pytest.importorskip("torch")
    from studies.translating.arrays import EncodedText, TextArrays
    from studies.translating.torch_network import TorchTranslator

    shape = TranslatorShape(8, 2, 2, 16, decoder_layers=1, buckets=64, classes=32)
    model = TorchTranslator(shape, 0, 0.0).eval()
    kinds = (("verb go",), ("prep past", "det"), ("det",), ("ordinal",), ("noun door",))
    words = ("go", "past", "the", "third", "door")
    text = EncodedText(words, (0, 0, 0, 1, 0), kinds, (0, 5, 9, 1))
    longer = EncodedText(("turn",) * 9, (0,) * 9, kinds[:1] * 9, (0, 7, 1))
    batch = TextArrays.of([text, longer], shape).batch(torch.arange(2), 9, 4)
    with torch.no_grad():
        seen = torch.ones_like(batch.mask)
        expected = model(batch, seen, batch.symbols[:, :-1].clamp(min=0))[0].log_softmax(dim=-1)
    network = TranslatorNetwork(shape, model.arrays())
    beams = Beams(network, network.encode(text.words, text.marks, kinds))
    for count, symbol in enumerate(text.symbols[:3]):
        found = beams.log_shares([symbol])[0]
        np.testing.assert_allclose(found, expected[count].numpy(), atol=1e-5)


def briefly_trained(
    rate: float,
    begun: TranslatorNetwork | None = None,
    teachers: Sequence[TranslatorNetwork] = (),
    taught: int = 9,
) -> TranslatorNetwork:
    """A small network after three steps on nine texts."""
    pytest.importorskip("torch")
    from studies.translating.arrays import TextArrays
    from studies.translating.texts import TrainingText
    from studies.translating.training import TranslatorTraining, encoded_texts, trained

    shape = TranslatorShape(width=8, heads=2, layers=1, hidden=16, buckets=64, classes=32)
    settings = TranslatorTraining(steps=3, batch=4, rate=rate, warm_up=1, shape=shape)
    said = ("turn left", "go to the third door", "stop") * 3
    texts = [TrainingText(each, "en", (), (parse(each),)) for each in said]
    arrays = TextArrays.of(encoded_texts(texts), shape)
    return trained(arrays, settings, 7, teachers, begun, taught)


def test_training_is_the_same_for_the_same_seed() -> None:
    first, second = (briefly_trained(1e-3).tensors for _ in range(2))
    assert all(np.array_equal(first[name], second[name]) for name in first)


def test_a_network_that_goes_on_learning_begins_with_its_own_weights() -> None:
    begun = briefly_trained(1e-2)
    after = briefly_trained(1e-9, begun)
    for name, weights in begun.tensors.items():
        np.testing.assert_allclose(after.tensors[name], weights, atol=1e-6)


def test_teachers_say_nothing_of_texts_that_are_new_to_them() -> None:
    teachers = (briefly_trained(1e-2),)
    alone, new, known = (
        briefly_trained(1e-3, None, *by).tensors for by in (((), 9), (teachers, 0), (teachers, 9))
    )
    for name, weights in alone.items():
        np.testing.assert_allclose(new[name], weights, atol=1e-6)
    assert any(abs(known[name] - alone[name]).max() > 1e-4 for name in alone)


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


@pytest.mark.parametrize("text", GOLDEN)
def test_a_beam_finds_no_less_likely_command_than_each_symbol_by_itself(text: str) -> None:
    plain, network = masked(text, ()), load_translator()
    encoded = network.encode(plain.words, plain.marks, plain.classes)
    narrow, wide = (network.candidates(encoded, count, sayable(plain))[0] for count in (1, 5))
    assert wide[1] >= narrow[1] - 1e-6


@pytest.mark.parametrize("text", GOLDEN)
def test_translations_differ_in_meaning(text: str) -> None:
    found = translate(text, (), load_translator())
    assert found is not None
    meanings = [key_of(each.command) for each in found.translations]
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


def test_every_symbol_is_one_of_a_kind() -> None:
    assert len(set(SYMBOLS)) == len(SYMBOLS)


def test_what_is_cited_is_read_like_other_words() -> None:
    cited = masked('it says "after the lab turn left" here', ("lab",))
    assert cited.words == masked("it says after the lab turn left here", ("lab",)).words
    assert masked('to "tea kitchen"', ()).rooms == ("tea kitchen",)


def test_the_network_says_no_number_that_the_text_has_not() -> None:
    network, plain = load_translator(), masked("go past the door and turn", ())
    encoded = network.encode(plain.words, plain.marks, plain.classes)
    said = {s for symbols, _ in network.candidates(encoded, 5, sayable(plain)) for s in symbols}
    assert not any(symbol.startswith(("value", "side", "room")) for symbol in said)


def test_a_long_text_is_not_translated() -> None:
    assert translate("turn left " * (MAX_TRANSLATED_WORDS // 2 + 1), (), load_translator()) is None


def test_the_same_text_gives_the_same_question() -> None:
    found = (translate("mosey to the third door", (), load_translator()) for _ in range(2))
    first, second = (each.translations for each in found if each is not None)
    assert first == second


def test_the_weights_are_small() -> None:
    assert (TRAINED_FOLDER / WEIGHTS_FILE).stat().st_size <= 9_000_000


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
