"""No text of a file reaches the terminal as more than text."""

from __future__ import annotations

import json
import random
import unicodedata
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.world.maps import load_floor_plan
from semnav_scripts.printable import LAYOUT, UNPRINTABLE, printable
from tests.reliability.readers import READERS, Reader
from tests.support.command_line import run
from tests.support.plan_documents import hall

RED = "\x1b[31mred\x1b[0m"
TURNED = "\u202egnp"
CLEARED = "\x9b2J"
EVIL = (RED, TURNED, CLEARED, "\x07bell", "over\rwritten", "\u2066isolated", "\x7f")


def is_plain(text: str) -> bool:
    """Whether a terminal shows every character of a text."""
    return all(c in LAYOUT or unicodedata.category(c) not in UNPRINTABLE for c in text)


@given(st.text(st.characters()))
def test_what_is_printable_stays_and_all_else_is_written_out(text: str) -> None:
    assert is_plain(printable(text))
    assert not is_plain(text) or printable(text) == text
    printable(text).encode()


@pytest.mark.parametrize("text", ["Küche", "Straße 5 €", "キッチン", "مطبخ", "a\tb\n", "│ ─ ✓"])
def test_words_of_all_languages_and_tables_stay(text: str) -> None:
    assert printable(text) == text


@pytest.mark.parametrize("evil", EVIL)
def test_what_is_written_out_is_valid_json(evil: str) -> None:
    assert json.loads(printable(json.dumps(evil, ensure_ascii=False))) == evil


@pytest.mark.parametrize("evil", EVIL)
@pytest.mark.parametrize("words", ["map show", "map check", "map list"])
def test_the_source_of_a_plan_is_shown_as_text(
    capsys: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: str, evil: str
) -> None:
    path = tmp_path / "hall.geojson"
    path.write_text(json.dumps(hall() | {"source": f"drawn by {evil}"}))
    if words == "map list":
        plan = load_floor_plan(path)
        monkeypatch.setattr("semnav_scripts.map_list.load_floor_plan", lambda name: plan)
    _, out, err = run(capsys, *words.split(), *([] if words == "map list" else [path]))
    assert is_plain(out + err)
    assert "hall" in out


@pytest.mark.parametrize("evil", EVIL)
@pytest.mark.parametrize(
    "words",
    [
        ["map", "show"],
        ["map", "check"],
        ["ground", "go to the door", "--pose", "1,1,0", "--map"],
        ["describe", "--from", "1,1,0", "--to", "hall", "--map"],
    ],
    ids=lambda words: " ".join(words[:2]),
)
def test_a_room_or_plan_named_with_escapes_is_refused_in_plain_text(
    capsys: Any, tmp_path: Path, words: list[str], evil: str
) -> None:
    path = tmp_path / "hall.geojson"
    for part in ("plan", "corridor", "door", "kind"):
        document = hall()
        if part == "plan":
            document["name"] = evil
        else:
            feature = next(
                f for f in document["features"] if f["properties"]["kind"] in (part, "door")
            )
            feature["properties"]["kind" if part == "kind" else "name"] = evil
        path.write_text(json.dumps(document))
        code, out, err = run(capsys, *words, path)
        assert code == 2
        assert is_plain(out + err)
        assert err.count("\n") == 1


@pytest.mark.parametrize("evil", EVIL)
def test_a_file_named_with_escapes_is_named_in_plain_text(
    capsys: Any, tmp_path: Path, evil: str
) -> None:
    code, out, err = run(capsys, "map", "show", tmp_path / f"{evil}.geojson")
    assert code == 2
    assert is_plain(out + err)


@pytest.mark.parametrize("reader", READERS, ids=lambda reader: reader.name)
def test_no_message_of_a_reader_holds_an_escape_sequence(
    capsys: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, reader: Reader
) -> None:
    """Escapes are put into a sound file; a command reads it as the reader does."""
    sound = reader.make(tmp_path)
    data = sound.read_bytes()

    def show(path: str) -> None:
        reader.read(Path(path))
        raise ValueError(f"{path} was read")

    monkeypatch.setattr("semnav_scripts.map_show.load_floor_plan", show)
    for seed in range(12):
        chance = random.Random(seed)
        at = chance.randrange(len(data))
        sound.write_bytes(
            data[:at] + chance.choice(EVIL).encode() + data[at + chance.randrange(9) :]
        )
        _, out, err = run(capsys, "map", "show", sound)
        assert is_plain(out + err), (seed, out + err)
