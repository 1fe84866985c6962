"""The measure of how much is understood, and the development sets that it is applied to."""

import hashlib
import json
from pathlib import Path

import pytest

from semnav_env.language import parse
from semnav_env.language.corpora import (
    ParseOutcome,
    judge,
    load_sentences,
    verdicts,
)
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.notation import read_meaning
from semnav_env.language.corpora.sentences import Sentence
from semnav_scripts.main import main
from studies.corpora import development_corpora, held_out_corpora, learned_corpora

FROZEN = {
    "english": "c6715a0370b6e6dec67ecacbe6edee88a9997e0dc590327c044b2aa12eaa3c81",
    "german": "12132d91284b2455446fdde016a53c2e97c7e6b7baeba1ceab6e9e11400cd26d",
    "second_english": "0782ba75a720d58a4f01ac989d689380cde9373281f64f0e4ac611edee776507",
    "second_german": "1654cfef85a8fc453b9a31402a5af4f0438aed32bf1808664d79a2146f62d4f1",
    "third_english": "1b00c91f6d6462157902e5950e404103e278150a729d71a3316cf6e57b8d93e1",
    "third_german": "8318723764e1701ae464d5c9d220dab74d005358f2367a51bb7ff2c0b65e214e",
    "fourth_english": "e0b9b3d74e611426020d854372e3025f0616dd8e63189ffb086862471d6645f9",
    "fifth_english": "5aab194480ea1e28e15293e1ef81331cf0abcd811873259c3c44e51c3931089f",
    "fifth_german": "82f83f92bb88660650fcf7737e88334f9aa43388178c69e47fd322529287f699",
    "sixth_english": "8b1f945cc49e571d23df188317a18f6bf1b95944e9da48cf59bec239b61528e9",
    "sixth_german": "67e531f257647241facc5de894b3e02b2b6c74d9ec2ef4694da94b7cc33aa782",
    "fourth_german": "96fb2dba7245273765d5899874a746eaf16057085c5207441a22009c87ac8be2",
    "seventh_english": "fcdf631c632d264b02ac7a5bcb8185c52630ecd7a000315c9bc7c0ec90a580cd",
    "seventh_german": "9fe59f0da5e876889f1f1dbf9f157d267d01bfde8ef4ea1f39f6d6469f5cdd56",
    "eighth_english": "dec64768b3ad131d7badb370f7e881eaefdf18c189710203d9b3b070b7948840",
    "eighth_german": "9b362e7f4d5dcefbe146bcb8b270903c3277b0d6f8cb1f5baa6260fcd9017db1",
    "ninth_english": "a7b84eeaacf9d059f51db63f1c4d6e8e2b9fddbec7359896c289cc1a639b584e",
    "ninth_german": "1175966f18945b8c80cf3e076f1044868c3647be38d799ad2490620f22e2b8db",
    "tenth_english": "8e3ff4907b662e2f9fddfffa3258eedea8734990dca2a9d26712299df6c730e3",
    "tenth_german": "ade8a8651770fdc52c311e9d9706983d8f9458dc1232b1b92e1a82d03cd1a963",
    "eleventh_english": "85eea99442412ed7e77bc11284a633d957d910c92d6b68dfbf1c2646d1ae5d41",
    "eleventh_german": "8ae04f8e7dac61252d6b8d7b189f7973f7e5fbb9adc801fae81001233784821c",
    "twelfth_english": "42e446857a770c2633bc7bc1eac40fa7fd12871261bacdf36e4456bbe6faa29c",
    "twelfth_german": "e93024a33b6a8ae94765beec6ad079194bc65f218a1abb9358a9430e02af2be6",
    "thirteenth_english": "b858838f5c27a73dcc24826896f5a010f20edc41c8e9ea745656f2a8159b2712",
    "thirteenth_german": "2bffb794f7ddcf6dd157d1b517bfb413f393900f9e5b07d822040eeee8edab54",
    "fourteenth_english": "c4fd306d2389ba0942102d51925c9e709260c324590c7880201f7b99cfb0942b",
    "fourteenth_german": "bd83aec205bd07fcedbd22560065ccd19809248c189417f16d92570f39845253",
    "fifteenth_english": "bf5ea70dfa7d5bffcdb2a5a3ba1bf89a22b14c9deca40ba3632b1778d227314d",
    "fifteenth_german": "f37e497c806e9eb89e1ffe77e5596ecf402c6f21ccc9ec7a274ab4442e56b3ce",
    "sixteenth_english": "b7fab4b154dbb0fcb2225a365c0d346dda5a61d6db5b1dc0d88be56aa7e49dee",
    "sixteenth_german": "de34c896e773c1e0c95090655c5d1d5f03e8f28e1a0c58c0895726245f476adf",
    "seventeenth_english": "b3b00568ee2ae5f86888a8e116d16bbd276394f389a8971a4cdae583bc6520c1",
    "seventeenth_german": "086ab82156b8414cbaec57f9001ebfe9133abd8bb7289c8e92c7e372d9a1f4b3",
    "eighteenth_english": "e39d4b4b01518c8c64630d91c55111a5f854967e76ee8623a24137045c742d8d",
    "eighteenth_german": "4ea7ca43a5492637d1da461248e05671f9bd0ccdd684f53aa910488778ce6990",
}
SIZES = {
    **dict.fromkeys(FROZEN, 170),
    **{path.stem: 400 for path in learned_corpora()},
    **{"english": 330, "german": 330, "thirteenth_german": 401},
}

EQUAL = """
past intersection, door = through door(1,after intersection) = hallway past intersection; through door(1)
counting on = through door(3,left) = hallway past door(2,left); through door(1,left)
until, then turn = turn left at corner = hallway until corner; turn left
until a door, then in = through door(2,right) = hallway until door(2,right); through door(1,right)
back to = back to intersection = turn around; hallway until intersection
cross = cross = hallway until end
the wall ahead = hallway until wall = hallway until end
closed is none = if closed door(1,left): stop end = if no door(1,left): stop end
stop at the end = through door(1); stop = through door(1)
passed places add up = hallway past intersection; hallway past intersection = hallway past intersection#2
a door that is reached = hallway until door(2); stop = to door(2)
a stop before a wait = stop; wait 5 = wait 5
what is done otherwise, too = if no corner: stop else: turn left end = if corner: turn left at corner else: stop end
a turn that depends on a place = if corner: turn left end = if corner: turn left at corner end
a room is open at its door = if open room(lab): room(lab) end = to room(lab); if door(1): through door(1) end
the first open one = if closed door(1): through door(2) else: through door(1) end = through door(1)
some before what says where = hallway for some; turn left = turn left at turning
out by the entry = through door(entry) = leave
a distance after a place = hallway past door(2); hallway for 2 m = hallway until 2 m after door(2)
"""  # noqa: E501


@pytest.mark.parametrize(
    "path",
    [*development_corpora(), *learned_corpora(), *held_out_corpora()],
    ids=lambda path: path.stem,
)
def test_the_sets_are_as_they_were_written(path: Path) -> None:
    assert hashlib.sha256(path.read_bytes()).hexdigest() == FROZEN[path.stem]
    assert len(load_sentences(path)) == SIZES[path.stem]


@pytest.mark.parametrize("line", EQUAL.strip().splitlines())
def test_what_means_the_same_is_written_in_one_form(line: str) -> None:
    _, one, other = line.split(" = ")
    assert normal(read_meaning(one)) == normal(read_meaning(other))


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("turn left", "turn right"),
        ("through door(2,left)", "through door(2)"),
        ("to door(1)", "through door(1)"),
        ("turn left; hallway", "hallway; turn left"),
        ("hallway past door(1); through door(1,left)", "through door(2,left)"),
        ("if door(1): stop end", "if no door(1): stop end"),
        ("hallway for some; turn around", "hallway; turn around"),
        ("hallway until 2 m after door(2)", "hallway until 2 m before door(2)"),
    ],
)
def test_what_means_something_else_differs(one: str, other: str) -> None:
    assert normal(read_meaning(one)) != normal(read_meaning(other))


def test_a_wrong_reading_is_misread_and_an_infeasible_text_is_refused() -> None:
    def sentence(text: str, kind: str, *meant: str) -> Sentence:
        return Sentence("x", text, kind, tuple(map(read_meaning, meant)), "", "test")

    assert (
        judge(sentence("turn left", "feasible", "turn left"), ()).outcome is ParseOutcome.UNDERSTOOD
    )
    assert (
        judge(sentence("turn left", "feasible", "turn right"), ()).outcome is ParseOutcome.MISREAD
    )
    assert judge(sentence("turn left", "infeasible"), ()).outcome is ParseOutcome.MISREAD
    assert judge(sentence("fly", "infeasible"), ()).outcome is ParseOutcome.REFUSED
    asked = sentence("turn 90 degrees", "feasible", "turn left 90")
    assert judge(asked, ()).outcome is ParseOutcome.ASKED


@pytest.mark.parametrize("path", development_corpora(), ids=lambda path: path.stem)
def test_most_of_the_development_sets_is_understood_or_asked(path: Path) -> None:
    """As `semnav evaluate language` counts."""
    found = list(verdicts(load_sentences(path), understand=parse))
    feasible = [v.outcome for v in found if v.sentence.kind == "feasible"]
    right = [outcome in (ParseOutcome.UNDERSTOOD, ParseOutcome.ASKED) for outcome in feasible]
    assert sum(right) >= 0.85 * len(feasible)
    assert feasible.count(ParseOutcome.MISREAD) <= 0.025 * len(feasible)
    infeasible = [v.outcome for v in found if v.sentence.kind == "infeasible"]
    assert infeasible.count(ParseOutcome.MISREAD) <= 0.05 * len(infeasible)
    assert infeasible.count(ParseOutcome.REFUSED) >= 0.75 * len(infeasible)


def test_a_command_is_written_in_the_notation() -> None:
    command = parse("if you see the second door on the left, stop, otherwise turn left")
    steps = meaning_of(command)
    assert steps == read_meaning("if door(2,left): stop else: turn left end")


def test_the_command_line_counts_a_corpus(tmp_path, capsys) -> None:
    corpus = tmp_path / "corpus.jsonl"
    row = {"id": "a", "text": "turn left", "kind": "feasible", "meaning": ["turn left"]}
    corpus.write_text(json.dumps(row) + "\n")
    plain = tmp_path / "plain.txt"
    plain.write_text("turn right\nfly away\n")
    assert main(["evaluate", "language", str(corpus), str(plain), "--json"]) == 0
    counts = json.loads(capsys.readouterr().out)["counts"]
    assert [(row["corpus"], row["understood"], row["refused"]) for row in counts] == [
        ("corpus", 1, 0),
        ("plain", 1, 1),
    ]


def test_a_meaning_that_is_none_is_refused_with_its_line(tmp_path, capsys) -> None:
    corpus = tmp_path / "corpus.jsonl"
    corpus.write_text('{"text": "x", "kind": "feasible", "meaning": ["jump"]}\n')
    assert main(["evaluate", "language", str(corpus)]) == 2
    assert "line 1: 'jump' is no step" in capsys.readouterr().err


def test_without_files_the_sets_of_the_checkout_are_counted(tmp_path, capsys, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["evaluate", "language"]) == 2
    assert "name files of sentences" in capsys.readouterr().err
    folder = tmp_path / "studies" / "corpora"
    folder.mkdir(parents=True)
    row = {"id": "a", "text": "turn left", "kind": "feasible", "meaning": ["turn left"]}
    (folder / "mine.jsonl").write_text(json.dumps(row) + "\n")
    assert main(["evaluate", "language", "--grammar", "--json"]) == 0
    (counts,) = json.loads(capsys.readouterr().out)["counts"]
    assert (counts["corpus"], counts["understood"]) == ("mine", 1)
