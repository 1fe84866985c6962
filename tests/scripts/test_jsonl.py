"""Lines of JSON: whole ones only, whatever ends the writing."""

import os
import signal
import subprocess
import sys

import pytest

from semnav_scripts.jsonl import JsonLines
from tests.support.command_line import scenes


def test_a_killed_run_leaves_whole_lines_and_the_older_file(tmp_path):
    path = tmp_path / "lines.jsonl"
    path.write_text("older\n")
    program = (
        "import os, signal, sys, pathlib\n"
        "from semnav_scripts.jsonl import JsonLines\n"
        "with JsonLines(pathlib.Path(sys.argv[1])) as out:\n"
        "    for i in range(100):\n"
        "        out.write({'i': i, 'long': 'x' * 9999})\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run([sys.executable, "-c", program, str(path)])
    assert done.returncode == -signal.SIGKILL
    assert path.read_text() == "older\n"
    [part] = tmp_path.glob(".lines-*.part.jsonl")
    assert [line["i"] for line in scenes(part)] == list(range(100))
    with JsonLines(path) as out:
        out.write({"after": "a kill nobody waits"})
    assert scenes(path) == [{"after": "a kill nobody waits"}]


def test_an_interruption_before_the_first_line_speaks_of_no_file(tmp_path):
    with pytest.raises(KeyboardInterrupt) as caught, JsonLines(tmp_path / "a.jsonl"):
        raise KeyboardInterrupt
    assert not hasattr(caught.value, "__notes__")


def test_a_pipe_is_written_directly(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    with JsonLines(pipe) as out:
        out.write({"a": 1})
        assert os.read(reader, 100) == b'{"a": 1}\n'
    os.close(reader)
    assert pipe.is_fifo()


def test_numbers_that_are_not_finite_are_never_written(tmp_path):
    with pytest.raises(ValueError, match="JSON"), JsonLines(tmp_path / "a.jsonl") as out:
        out.write({"a": float("nan")})
    assert list(tmp_path.iterdir()) == []
