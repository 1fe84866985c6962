"""Commands are typed in UTF-8 also where the locale knows ASCII alone."""

from __future__ import annotations

import io
import os
import subprocess
import sys

import pytest

from semnav_scripts.terminal_text import as_utf8, write_utf8

ASCII_LOCALE = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}


@pytest.mark.parametrize("word", ["turn left", "zweite Tür", "日本", "T\udcfcr", "\udc80"])
def test_a_word_comes_back_as_it_was_typed_or_stays(word: str) -> None:
    assert as_utf8(word) == word


def test_an_ascii_stream_writes_utf8_afterwards() -> None:
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding="ascii")
    write_utf8(stream, io.StringIO())
    stream.write("Tür")
    stream.flush()
    assert raw.getvalue() == "Tür".encode()


def test_umlauts_are_understood_and_written_in_an_ascii_locale() -> None:
    code = (
        "import sys; from semnav_scripts.arguments import parse; "
        "from semnav_scripts.demo import Arguments; "
        "from semnav_scripts.terminal_text import write_utf8; write_utf8(sys.stdout); "
        "print(parse(Arguments, sys.argv[1:], 'demo').command)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code, "zweite Tür rechts".encode()],
        env=os.environ | ASCII_LOCALE,
        capture_output=True,
        check=True,
    )
    assert done.stdout.decode() == "zweite Tür rechts\n"
