"""Strikes a command that writes, by a full disk or a signal, and says what was lost by it."""

from __future__ import annotations

import atexit
import os
import random
import resource
import shutil
import signal
import sys
import tempfile
import time
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import semnav
from semnav_scripts.dispatch import BAD_INPUT, INTERRUPTED, TERMINATED
from semnav_scripts.main import main
from tests.reliability.children import WALL_SECONDS
from tests.reliability.writers import WRITERS, Writer, make_inputs, shorten

OPENED_TO_WRITE = os.O_WRONLY | os.O_RDWR
CHANGES = ("os.rename", "os.remove", "os.mkdir", "os.rmdir", "os.chmod")
"""Events of Python's audit hooks that change files, beside opening one to write."""


class Ending(NamedTuple):
    """How a command ended.

    Attributes:
        code: its exit code; minus the number of the signal that ended it.
        said: what it wrote to stderr.
        seconds: how long it took.
    """

    code: int
    said: str
    seconds: float


class Strike(NamedTuple):
    """What happens to a command.

    Attributes:
        name: in the table.
        arm: called in its process before it runs, with the folder that it writes to, a generator
            of random numbers, and how long it takes undisturbed, seconds.
        ends: exit codes that are right, if it does not end as if nothing had happened.
        leaves_parts: whether unfinished parts may stay.
    """

    name: str
    arm: Callable[[Path, random.Random, float], None]
    ends: tuple[int, ...]
    leaves_parts: bool


def full_disk(out: Path, rng: random.Random, seconds: float) -> None:
    """No file may grow beyond some kilobytes, as if the disk were full there."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (rng.randrange(200, 8192),) * 2)


def killed_writing(out: Path, rng: random.Random, seconds: float) -> None:
    """A signal that ends the process while it writes a file that is longer than that."""
    signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
    full_disk(out, rng, seconds)


def at_a_change(number: int) -> Callable[[Path, random.Random, float], None]:
    """The signal comes when one of the first files is opened, renamed or removed."""

    def arm(out: Path, rng: random.Random, seconds: float) -> None:
        left = rng.randrange(1, 9)

        def watch(event: str, arguments: tuple[Any, ...]) -> None:
            nonlocal left
            opened = event == "open" and arguments[2] & OPENED_TO_WRITE
            if (opened or event in CHANGES) and str(arguments[0]).startswith(str(out)):
                left -= 1
                if not left:
                    os.kill(os.getpid(), number)

        sys.addaudithook(watch)

    return arm


def at_any_time(number: int) -> Callable[[Path, random.Random, float], None]:
    """The signal comes at a moment of the time that the command takes."""

    def arm(out: Path, rng: random.Random, seconds: float) -> None:
        signal.signal(signal.SIGALRM, lambda *_: os.kill(os.getpid(), number))
        signal.setitimer(signal.ITIMER_REAL, rng.uniform(0.0, seconds) + 1e-6)

    return arm


KILLED, CTRL_C, SIGTERM = (-signal.SIGKILL,), (INTERRUPTED,), (TERMINATED,)
STRIKES = (
    Strike("full disk", full_disk, (BAD_INPUT,), False),
    Strike("killed while writing", killed_writing, (-signal.SIGXFSZ, BAD_INPUT), True),
    Strike("killed at a change", at_a_change(signal.SIGKILL), KILLED, True),
    Strike("killed at any time", at_any_time(signal.SIGKILL), KILLED, True),
    Strike("Ctrl-C at a change", at_a_change(signal.SIGINT), CTRL_C, False),
    Strike("Ctrl-C at any time", at_any_time(signal.SIGINT), CTRL_C, False),
    Strike("SIGTERM at a change", at_a_change(signal.SIGTERM), SIGTERM, False),
    Strike("SIGTERM at any time", at_any_time(signal.SIGTERM), SIGTERM, False),
)
"""All of them."""


def run(words: list[str], arm: Callable[[], None] = lambda: None) -> Ending:
    """Run a command in a child process, as a shell would."""
    reading, writing = os.pipe()
    begun = time.monotonic()
    child = os.fork()
    if not child:
        _run_in_child(words, arm, writing)
    os.close(writing)
    with os.fdopen(reading, errors="replace") as pipe:
        said = pipe.read()
    _, status = os.waitpid(child, 0)
    return Ending(os.waitstatus_to_exitcode(status), said, time.monotonic() - begun)


def _run_in_child(words: list[str], arm: Callable[[], None], errors: int) -> None:
    code = 99
    try:
        sys.stdout = open(os.devnull, "w")  # noqa: SIM115 - for as long as the process lives
        os.dup2(errors, 2)
        sys.stderr = os.fdopen(errors, "w", buffering=1)
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.alarm(WALL_SECONDS)
        for number in semnav.WORDS:
            signal.signal(number, semnav.leave_at_once)
        shorten()
        arm()
        code = main(words)
        signal.setitimer(signal.ITIMER_REAL, 0.0)  # it is over; a process would be gone
        for number in semnav.WORDS:
            signal.signal(number, signal.SIG_IGN)
    except BaseException as error:
        sys.stderr.write(f"Traceback: {type(error).__name__}: {error}\n")
    finally:
        sys.stderr.flush()
        os._exit(code)


@lru_cache(maxsize=1)
def inputs() -> Path:
    """The folder of the inputs of all commands."""
    folder = Path(tempfile.mkdtemp(prefix="semnav-inputs-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    make_inputs(folder)
    return folder


def words_of(writer: Writer, out: Path) -> list[str]:
    """The words of a command that writes into a folder."""
    return writer.words.format(inputs=inputs(), out=out).split()


@lru_cache(maxsize=len(WRITERS))
def undisturbed(writer: Writer) -> tuple[Ending, dict[str, bytes]]:
    """How a command ends that nothing happens to, and what it writes."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        prepare(writer, out)
        return run(words_of(writer, out)), contents(out)


def prepare(writer: Writer, out: Path) -> None:
    """Fill the folder that a command writes to with what must not be lost."""
    there = {"mine.txt": b"mine"}
    if writer.follows:
        [before] = (other for other in WRITERS if other.name == writer.follows)
        there |= undisturbed(before)[1]
    elif writer.replaces:
        there |= dict.fromkeys(writer.files, b"old")
    for name, content in there.items():
        (out / name).parent.mkdir(parents=True, exist_ok=True)
        (out / name).write_bytes(content)


def contents(folder: Path) -> dict[str, bytes]:
    """The content of each file in a folder."""
    files = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def fault(writer: Writer, strike: Strike, seed: int) -> str:
    """What is wrong after a strike; empty if nothing is.

    Args:
        writer: the command.
        strike: what happens to it.
        seed: of when it happens.
    """
    seconds = undisturbed(writer)[0].seconds if "any time" in strike.name else 0.0
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder)
        prepare(writer, out)
        before = contents(out)
        ending = run(words_of(writer, out), lambda: strike.arm(out, random.Random(seed), seconds))
        return _wrong_ending(writer, strike, ending) or _loss(writer, strike, before, contents(out))


def _wrong_ending(writer: Writer, strike: Strike, ending: Ending) -> str:
    if "Traceback" in ending.said:
        return f"traceback: {ending.said[-2000:]}"
    if ending.code not in strike.ends:
        same = ending.code == undisturbed(writer)[0].code
        return "" if same else f"exit code {ending.code}: {ending.said[-2000:]}"
    last = (ending.said.splitlines() or [""])[-1]
    refused = last.startswith("semnav: ") and any(n in last for n in writer.named or writer.files)
    return "" if refused or ending.code != BAD_INPUT else f"it ends with {last!r}"


def _loss(writer: Writer, strike: Strike, before: dict[str, bytes], after: dict[str, bytes]) -> str:
    for name in before.keys() - after.keys():
        return f"{name} is gone"
    for name, content in after.items():
        if ".part" in name or name.endswith(".lock"):
            if not strike.leaves_parts:
                return f"{name} is left"
        elif content != before.get(name) and not writer.whole(
            name, content, undisturbed(writer)[1].get(name, b"")
        ):
            return f"{name} is half"
    return ""
