"""The clauses to find people have words, tokens, symbols and steps; old weights do not say them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.language import (
    AskName,
    CallOut,
    Command,
    GoToPerson,
    LookAround,
    RoomReference,
    SearchHouse,
    SearchRoom,
    decode,
    encode,
    parse,
    read,
)
from semnav_env.language.clause_kinds import CLAUSE_KINDS
from semnav_env.language.corpora.meanings import key_of, normal
from semnav_env.language.corpora.notation import notation_of, read_meaning
from semnav_env.language.translating.masking import masked
from semnav_env.language.translating.network import (
    TRAINED_FOLDER,
    TranslatorNetwork,
    TranslatorShape,
)
from semnav_env.language.translating.programs import SYMBOLS, command_of, sayable, symbols_of
from semnav_env.networks.card import Card
from studies.translating.programs import command_of_meaning

FINDING = (
    *(SearchHouse(), SearchRoom(), SearchRoom(RoomReference("kitchen"))),
    *(LookAround(), CallOut(), GoToPerson(), AskName()),
)


@pytest.mark.parametrize("clause", FINDING, ids=str)
@pytest.mark.parametrize("language", ["en", "de"])
def test_what_a_clause_says_is_read_as_that_clause(clause, language: str) -> None:
    command = Command((clause,))
    assert read(command.say(language), language) == command
    assert parse(command.say(language), language) == command


@pytest.mark.parametrize("clause", FINDING, ids=str)
def test_a_token_is_of_one_clause(clause) -> None:
    rooms = ("hall", "kitchen")
    assert decode(encode(Command((clause,)), rooms), rooms) == Command((clause,))


@given(st.lists(st.sampled_from(FINDING), min_size=1, max_size=8))
def test_the_notation_of_a_command_means_that_command(clauses) -> None:
    command = Command(tuple(clauses))
    again = command_of_meaning(read_meaning(notation_of(command)))
    assert again is not None
    assert key_of(again) == key_of(command)


@pytest.mark.parametrize(
    ("long", "short"),
    [
        ("room(kitchen); search here", "search room(kitchen)"),
        ("to person; ask", "ask"),
    ],
)
def test_two_ways_to_say_the_same_are_the_same(long: str, short: str) -> None:
    assert normal(read_meaning(long)) == normal(read_meaning(short))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("search here", "search house"),
        ("look", "turn around"),
        ("call", "stop"),
        ("room(kitchen)", "search room(kitchen)"),
        ("through door(1); search here", "search here"),
    ],
)
def test_two_meanings_are_told_apart(one: str, other: str) -> None:
    assert normal(read_meaning(one)) != normal(read_meaning(other))


@pytest.mark.parametrize("clause", FINDING, ids=str)
def test_symbols_of_a_clause_are_that_clause(clause) -> None:
    text = masked("search the kitchen", ("kitchen",))
    symbols = symbols_of(Command((clause,)), text)
    assert command_of(symbols, text) == Command((clause,))


OLD_SYMBOLS = SYMBOLS.index("all")
"""How many symbols there were before these clauses."""


def network_of(symbols: int, seed: int = 0) -> TranslatorNetwork:
    """A small random network that knows the first symbols."""
    shape = TranslatorShape(8, 2, 1, 16, decoder_layers=1, buckets=64, classes=32, symbols=symbols)
    rng = np.random.default_rng(seed)
    return TranslatorNetwork(
        shape, {name: rng.normal(size=size) for name, size in shape.tensors().items()}
    )


@pytest.mark.parametrize("symbols", [40, OLD_SYMBOLS, len(SYMBOLS) - 1])
def test_a_network_never_says_a_symbol_that_it_does_not_know(symbols: int) -> None:
    network, plain = network_of(symbols), masked("search the second room on the left", ())
    encoded = network.encode(plain.words, plain.marks, plain.classes)
    for said, _ in network.candidates(encoded, 5, sayable(plain)):
        assert set(said) <= set(SYMBOLS[:symbols])


def after_learning(teacher: TranslatorNetwork, begun: TranslatorNetwork) -> TranslatorNetwork:
    """What has gone on learning from the canonical words of the clauses."""
    pytest.importorskip("torch")
    from studies.translating.arrays import TextArrays
    from studies.translating.texts import TrainingText
    from studies.translating.training import TranslatorTraining, encoded_texts, trained

    shape = TranslatorShape(8, 2, 1, 16, decoder_layers=1, buckets=64, classes=32)
    settings = TranslatorTraining(steps=2, batch=4, rate=1e-3, warm_up=1, shape=shape)
    texts = [TrainingText(str(c), "en", ("kitchen",), (Command((c,)),)) for c in FINDING]
    return trained(TextArrays.of(encoded_texts(texts), shape), settings, 7, [teacher], begun)


def test_going_on_learning_begins_with_the_rows_of_a_network_with_fewer_symbols() -> None:
    begun = network_of(OLD_SYMBOLS)
    after = after_learning(begun, begun)
    assert after.tensors["symbols"].shape[0] == len(SYMBOLS)
    for name, weights in begun.tensors.items():
        np.testing.assert_allclose(after.tensors[name][: len(weights)], weights, atol=5e-3)


def test_a_teacher_says_nothing_of_texts_with_symbols_that_it_does_not_know() -> None:
    begun = network_of(OLD_SYMBOLS)
    first, second = (after_learning(network_of(OLD_SYMBOLS, seed), begun) for seed in (1, 2))
    assert all(np.array_equal(first.tensors[name], second.tensors[name]) for name in first.tensors)


def test_the_bundled_card_says_how_many_symbols_its_weights_know() -> None:
    assert Card.read(TRAINED_FOLDER, TranslatorShape).settings.symbols <= len(SYMBOLS)


def test_all_clauses_are_known_by_their_names() -> None:
    assert {type(clause).__name__ for clause in FINDING} <= set(CLAUSE_KINDS)
