"""The measure of how much is understood, and the development sets that it is applied to."""

import hashlib
import json
from pathlib import Path

import pytest

from semnav_env.language import AmbiguousCommandError, Command, Question, Turn, Turning, parse
from semnav_env.language.corpora import (
    ParseOutcome,
    judge,
)
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.notation import read_meaning
from semnav_env.language.corpora.sentences import Sentence
from semnav_env.language.languages import english
from semnav_scripts.main import main
from studies.corpora import FOLDER, author_of, held_out_corpora, learned_corpora, tuned_corpora

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
whole halves = hallway for 0.914 m = hallway for 1 m
out by the entry, said otherwise = leave door(entry) = leave
a distance after a place = hallway past door(2); hallway for 2 m = hallway until 2 m after door(2)
"""  # noqa: E501


CORPORA = (*learned_corpora(), *tuned_corpora(), *held_out_corpora())
WRITTEN = dict(line.split()[::-1] for line in (FOLDER / "SHA256SUMS").read_text().splitlines())


@pytest.mark.parametrize("path", CORPORA, ids=lambda path: path.stem)
def test_the_sets_are_as_they_were_written(path: Path) -> None:
    name = path.relative_to(FOLDER).as_posix()
    assert hashlib.sha256(path.read_bytes()).hexdigest() == WRITTEN[name]


def test_no_author_is_in_two_roles() -> None:
    roles = (learned_corpora, tuned_corpora, held_out_corpora)
    authors = [author for each in roles for author in set(map(author_of, each()))]
    assert len(authors) == len(set(authors))
    assert len(CORPORA) == len(WRITTEN)


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
        judge(sentence("turn left", "feasible", "turn left"), (), parse).outcome
        is ParseOutcome.UNDERSTOOD
    )
    assert (
        judge(sentence("turn left", "feasible", "turn right"), (), parse).outcome
        is ParseOutcome.MISREAD
    )
    assert judge(sentence("turn left", "infeasible"), (), parse).outcome is ParseOutcome.MISREAD
    assert judge(sentence("fly", "infeasible"), (), parse).outcome is ParseOutcome.REFUSED
    left, right = (Command((Turn(way),)) for way in (Turning.LEFT, Turning.RIGHT))

    def asking(text: str, language: str | None, rooms: object) -> Command:
        raise AmbiguousCommandError(text, Question((right, left), english()))

    asked = sentence("turn", "feasible", "turn left")
    assert judge(asked, (), asking).outcome is ParseOutcome.ASKED


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
    folder = tmp_path / "studies" / "corpora" / "held_out"
    folder.mkdir(parents=True)
    row = {"id": "a", "text": "turn left", "kind": "feasible", "meaning": ["turn left"]}
    (folder / "mine.jsonl").write_text(json.dumps(row) + "\n")
    assert main(["evaluate", "language", "--json"]) == 0
    (counts,) = json.loads(capsys.readouterr().out)["counts"]
    assert (counts["corpus"], counts["understood"]) == ("mine", 1)
