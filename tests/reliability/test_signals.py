"""Ctrl-C and SIGTERM at random moments end a command in one line, with nothing half."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from semnav_features.interruption import Terminated, interruption_in, uninterrupted
from semnav_scripts import dispatch
from tests.reliability.signals import COMMANDS, SIGNALS, fault
from tests.support.paths import ROOT


@pytest.mark.slow
@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize("command", COMMANDS)
def test_a_signal_at_any_time_ends_in_one_line(command: str, number: int) -> None:
    for seed in range(3):
        assert not (wrong := fault(command, number, seed)), wrong


INTERRUPTED_AT_AN_IMPORT = """
import os, signal, sys
sys.path.insert(0, {root!r})

class Interrupting:
    left = {count}
    def find_spec(self, name, path=None, target=None):
        self.left -= 1
        if not self.left:
            os.kill(os.getpid(), {number})

import semnav
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.meta_path.insert(0, Interrupting())
sys.argv[1:] = {words!r}
sys.exit(semnav.main())
"""


@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize("count", [1, 40, 200, pytest.param(330, marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    "words",
    [
        ["map", "list"],
        pytest.param(["--help"], marks=pytest.mark.slow),
        pytest.param(["ground", "stop", "--json"], marks=pytest.mark.slow),
    ],
)
def test_a_signal_while_loading_ends_in_one_line(words: list[str], count: int, number: int) -> None:
    program = INTERRUPTED_AT_AN_IMPORT.format(
        root=str(ROOT), count=count, words=words, number=int(number)
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    if done.returncode == 128 + number:
        word = "interrupted" if number == signal.SIGINT else "terminated"
        assert done.stderr == f"semnav: {word}\n"
    else:  # it was done before so many modules were loaded
        assert "Traceback" not in done.stderr
        assert count > 1


TERMINATED_AT_WORK = """
import os, signal, sys
sys.path.insert(0, {root!r})
import semnav
from semnav_scripts.map_list import Arguments

def run(self):
    try:
        os.kill(os.getpid(), signal.SIGTERM)
        signal.pause()
    finally:
        print("put away")

Arguments.run = run
sys.argv[1:] = ["map", "list"]
sys.exit(semnav.main())
"""


def test_sigterm_lets_a_command_put_away_what_it_has_begun() -> None:
    program = TERMINATED_AT_WORK.format(root=str(ROOT))
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (
        143,
        "put away\n",
        "semnav: terminated\n",
    )


def chained(depth: int, first: BaseException) -> BaseException:
    """A chain of errors such as nested calls of compiled code make of an interruption."""
    for _ in range(depth):
        error = SystemError("returned a result with an exception set")
        error.__cause__ = first
        first = error
    return first


@pytest.mark.parametrize("depth", [0, 1, 2, 40])
@pytest.mark.parametrize(
    ("first", "code", "word"),
    [(KeyboardInterrupt, 130, "interrupted"), (Terminated, 143, "terminated")],
)
def test_a_chain_of_errors_over_an_interruption_is_one(
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    depth: int,
    first: type[BaseException],
    code: int,
    word: str,
) -> None:
    def raising(*_: object) -> int:
        raise chained(depth, first())

    monkeypatch.setattr(dispatch.CommandTable, "_run", raising)
    assert dispatch.CommandTable("semnav", "", {}).main(["demo"]) == code
    assert capsys.readouterr().err == f"semnav: {word}\n"


def test_an_error_without_an_interruption_is_none() -> None:
    assert interruption_in(chained(3, ValueError())) is None
    assert interruption_in(None) is None


def test_a_system_error_of_its_own_is_not_hidden(monkeypatch: pytest.MonkeyPatch) -> None:
    def raising(*_: object) -> int:
        raise chained(2, SystemError("a true one"))

    monkeypatch.setattr(dispatch.CommandTable, "_run", raising)
    with pytest.raises(SystemError):
        dispatch.CommandTable("semnav", "", {}).main(["demo"])


INTERRUPTED_WHERE_NOBODY_HEARS = """
import os, signal, sys, time
sys.path.insert(0, {root!r})
import semnav
from semnav_scripts import dispatch

class Deaf:
    def __del__(self):
        os.kill(os.getpid(), {number})
        time.sleep(0.01)

def run(self, words):
    dispatch._end_loading()
    Deaf()
    time.sleep({wait})
    return 0

dispatch.CommandTable._run = run
sys.exit(semnav.main())
"""


@pytest.mark.parametrize(("number", "word"), [(2, "interrupted"), (15, "terminated")])
def test_a_signal_where_python_drops_exceptions_is_raised_again(number: int, word: str) -> None:
    program = INTERRUPTED_WHERE_NOBODY_HEARS.format(root=str(ROOT), number=number, wait=60)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (128 + number, f"semnav: {word}\n")


AFTER_THE_END = """
import atexit, os, sys, time
sys.path.insert(0, {root!r})
import semnav
atexit.register(lambda: (os.kill(os.getpid(), {number}), time.sleep(60)))
sys.argv[1:] = ["map", "list"]
sys.exit(semnav.main())
"""


@pytest.mark.parametrize(("number", "word"), [(2, "interrupted"), (15, "terminated")])
def test_a_signal_after_the_end_loses_no_output(number: int, word: str) -> None:
    program = AFTER_THE_END.format(root=str(ROOT), number=number)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (128 + number, f"semnav: {word}\n")
    assert "office_cross" in done.stdout


@pytest.mark.parametrize("number", SIGNALS)
def test_a_signal_waits_for_what_must_not_be_cut(number: int) -> None:
    done: list[int] = []

    def handle(*_: object) -> None:
        assert done == [1]
        raise Terminated

    def work() -> None:
        with uninterrupted():
            os.kill(os.getpid(), number)
            done.append(1)

    before = signal.signal(number, handle)
    try:
        with pytest.raises(Terminated):
            work()
    finally:
        signal.signal(number, before)


@pytest.mark.slow
def test_ctrl_c_on_a_terminal_ends_workers_without_a_word(tmp_path: Path) -> None:
    """A terminal sends it to all processes of the command."""
    words = ["evaluate", "val_seen", "--agent", "random", "--episodes", "40", "--workers", "2"]
    command = [sys.executable, str(ROOT / "semnav.py"), *words]
    for wait in (1.0, 3.0, 6.0):
        process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, process_group=0
        )
        try:
            process.communicate(timeout=wait)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGINT)
        _, said = process.communicate()
        assert process.returncode in (0, 130), said
        assert "Traceback" not in said
