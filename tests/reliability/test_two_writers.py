"""Two writers of one file: a whole file of one, a word to the other, and no link is followed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from semnav_features import writing
from semnav_features.sole_writer import sole_writer
from semnav_features.writing import replacing, write_file
from semnav_scripts.jsonl import JsonLines
from semnav_scripts.main import main
from tests.support.command_line import scenes
from tests.support.paths import ROOT

WRITE_SLOWLY = """
import pathlib, sys, time
from semnav_scripts.jsonl import JsonLines
with JsonLines(pathlib.Path(sys.argv[1])) as out:
    out.write({"of": sys.argv[2]})
    print("begun", flush=True)
    sys.stdin.readline()
    out.write({"of": sys.argv[2]})
"""


def slow_writer(path: Path, name: str) -> subprocess.Popen[str]:
    """A process in the middle of writing; it goes on when it reads a line."""
    pipes: dict[str, Any] = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    command = [sys.executable, "-c", WRITE_SLOWLY, str(path), name]
    return subprocess.Popen(command, cwd=ROOT, text=True, **pipes)


def test_of_two_runs_with_one_file_the_second_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "same.jsonl"
    first = slow_writer(path, "first")
    assert first.stdout is not None
    assert first.stdout.readline() == "begun\n"
    _, said = slow_writer(path, "second").communicate("\n")
    assert "another run is writing it" in said
    first.communicate("\n")
    assert scenes(path) == [{"of": "first"}] * 2
    assert list(tmp_path.iterdir()) == [path]


def test_a_command_says_that_its_file_is_being_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log, path = tmp_path / "a.csv", tmp_path / "scenes.jsonl"
    log.write_text("# angle_min=-0.3 angle_increment=0.01\n" + ",".join(["2.0"] * 60) + "\n")
    with JsonLines(path) as mine:
        assert main(["extract", str(log), "--out", str(path)]) == 2
        mine.write({"of": "mine"})
    [line] = capsys.readouterr().err.splitlines()
    said = "another run is writing it; give another name, or wait for it"
    assert line == f"semnav: cannot open '{path}': {said}"
    assert scenes(path) == [{"of": "mine"}]


def test_a_killed_writer_holds_nobody_up(tmp_path: Path) -> None:
    path = tmp_path / "same.jsonl"
    killed = slow_writer(path, "killed")
    assert killed.stdout is not None
    killed.stdout.readline()
    killed.send_signal(signal.SIGKILL)
    killed.communicate()
    slow_writer(path, "next").communicate("\n")
    assert scenes(path) == [{"of": "next"}] * 2
    assert not list(tmp_path.glob("*.lock"))


def test_a_folder_has_one_writer_at_a_time(tmp_path: Path) -> None:
    folder = tmp_path / "agent"
    with sole_writer(folder), pytest.raises(BlockingIOError, match="another run"):
        sole_writer(folder).__enter__()
    with sole_writer(folder), sole_writer(tmp_path / "other"):
        pass
    assert list(tmp_path.iterdir()) == []


def test_a_lock_that_was_removed_meanwhile_is_made_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who held it removes it after the next one has opened it, and before that one takes it."""
    lock, take = tmp_path / ".agent.lock", pytest.importorskip("fcntl").flock
    calls: list[int] = []

    def late(descriptor: int, operation: int) -> None:
        calls.append(descriptor)
        if len(calls) == 1:
            lock.unlink()
        take(descriptor, operation)

    monkeypatch.setattr("fcntl.flock", late)
    with sole_writer(tmp_path / "agent"):
        assert len(calls) == 2
        assert lock.exists()


def test_writers_of_a_whole_file_leave_one_of_theirs(tmp_path: Path) -> None:
    path, contents = tmp_path / "file", [bytes([k]) * 200_000 for k in range(8)]
    children = []
    for content in contents:
        if not (child := os.fork()):
            for _ in range(20):
                write_file(path, content)
            os._exit(0)
        children.append(child)
    seen = set()
    while children:
        done, status = os.waitpid(-1, os.WNOHANG)
        assert status == 0
        children = [child for child in children if child != done]
        if path.exists():
            seen.add(path.read_bytes())
        time.sleep(0.001)
    assert seen <= set(contents)
    assert list(tmp_path.iterdir()) == [path]


def test_no_link_in_the_place_of_a_part_is_followed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Neither at the name that parts once had, nor at one that somebody guessed."""
    path, precious = tmp_path / "a.jsonl", tmp_path / "precious"
    precious.write_text("precious")
    guessed = tmp_path / f".a-{'0' * 12}.part.jsonl"
    for name in ("a.jsonl.part", guessed.name, ".b.jsonl.lock"):
        (tmp_path / name).symlink_to(precious)
    with JsonLines(path) as out:
        out.write({"a": 1})
    monkeypatch.setattr(writing.uuid, "uuid4", lambda: writing.uuid.UUID(int=0))
    with pytest.raises(FileExistsError):
        write_file(path, "new")
    guessed.symlink_to(precious)
    with pytest.raises(FileExistsError):
        JsonLines(path).__enter__()
    with pytest.raises(OSError, match=r"b\.jsonl"):
        JsonLines(tmp_path / "b.jsonl").__enter__()
    assert scenes(path) == [{"a": 1}]
    assert precious.read_text() == "precious"


def test_a_link_of_another_user_is_refused(tmp_path: Path) -> None:
    precious, link = tmp_path / "precious", tmp_path / "link"
    precious.write_text("precious")
    link.symlink_to(precious)
    if os.geteuid():
        pytest.skip("only root can give a link away")
    os.lchown(link, 12345, 12345)
    for write in (lambda: write_file(link, "new"), lambda: JsonLines(link)):
        with pytest.raises(PermissionError, match="link of another user"):
            write()
    with pytest.raises(PermissionError), replacing(link):
        pass
    assert precious.read_text() == "precious"
