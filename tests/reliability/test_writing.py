"""Everything that is written goes through one writer, which never loses what was there."""

from __future__ import annotations

import ast
import errno
import os
import resource
import stat
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from semnav_env.rendering.video import save_gif, save_png
from semnav_env.world.maps import load_floor_plan, save_floor_plan
from semnav_features.writing import replacing, write_file
from semnav_scripts.main import main
from tests.test_layers import MODULES

WRITING_METHODS = {
    *("write_text", "write_bytes", "savefig", "savez", "savez_compressed", "imopen"),
    *("save_file", "to_csv", "tofile", "dump"),
}
WRITING_MODES = set("wax+")
WRITE_BY_THEMSELVES = {
    "semnav_features/writing.py": "the writer",
    "semnav_scripts/jsonl.py": "line by line into a part of the writer",
    "semnav_features/sole_writer.py": "an empty file",
    "semnav_scripts/dispatch.py": "what a closed pipe did not take, to nowhere",
    "semnav_env/bench/peers.py": "into a temporary folder",
    "semnav_scripts/warming.py": "into a temporary folder",
}


def writes(tree: ast.AST, inside: bool = False) -> Iterator[int]:
    """Lines of calls that write a file, but for those on a part that `replacing` gave."""
    for node in ast.iter_child_nodes(tree):
        items = node.items if isinstance(node, ast.With) else []
        parts = any(
            isinstance(i.context_expr, ast.Call) and _name(i.context_expr) == "replacing"
            for i in items
        )
        if isinstance(node, ast.Call) and not inside and _writes(node):
            yield node.lineno
        yield from writes(node, inside or parts)


def _name(call: ast.Call) -> str:
    return getattr(call.func, "attr", getattr(call.func, "id", ""))


def _writes(call: ast.Call) -> bool:
    name = _name(call)
    if name in WRITING_METHODS:
        return True
    on = getattr(getattr(call.func, "value", None), "id", "")
    if on == "os":
        return name in {"open", "replace", "rename"}
    if isinstance(call.func, ast.Name) and name == "open" and _is_computed(call.args[1:2]):
        return True
    if name == "open":
        texts = [
            a.value
            for a in [*call.args[:2], *(k.value for k in call.keywords)]
            if isinstance(a, ast.Constant) and isinstance(a.value, str)
        ]
        return any(WRITING_MODES & set(text) and len(text) < 4 for text in texts)
    return False


def _is_computed(mode: list[ast.expr]) -> bool:
    return any(not isinstance(word, ast.Constant) for word in mode)


def test_nothing_is_written_but_by_the_writer() -> None:
    found = {m.place for m in MODULES.values() if next(writes(m.tree), None)}
    assert found == WRITE_BY_THEMSELVES.keys()


@pytest.fixture
def full_disk() -> Iterator[None]:
    """No file can grow beyond 4 kB, as if the disk were full there."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
    yield
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


def test_a_full_disk_leaves_the_old_plan(tmp_path: Path, full_disk: None) -> None:
    path = tmp_path / "plan.geojson"
    path.write_bytes(b"old")
    with pytest.raises(OSError, match=r"plan\.geojson") as error:
        save_floor_plan(load_floor_plan("office_cross"), path)
    assert error.value.errno == errno.EFBIG
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", ["film.gif", "picture.png"])
def test_a_full_disk_leaves_the_old_picture(tmp_path: Path, full_disk: None, name: str) -> None:
    path = tmp_path / name
    path.write_bytes(b"old")
    rng = np.random.default_rng(1)
    frames = [rng.integers(0, 255, (90, 160, 3), dtype=np.uint8) for _ in range(3)]
    with pytest.raises(OSError, match=name):
        save_png(path, frames[0]) if name.endswith("png") else save_gif(path, frames, 10.0)
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_command_on_a_full_disk_names_its_file(
    tmp_path: Path, full_disk: None, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "office.geojson"
    assert main(["map", "generate", "--seed", "3", "--out", str(path)]) == 2
    [line] = capsys.readouterr().err.splitlines()
    assert line == f"semnav: cannot write '{path}': File too large"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("error", [KeyboardInterrupt, MemoryError, ValueError])
def test_an_interrupted_writer_leaves_the_old_file(
    tmp_path: Path, error: type[BaseException]
) -> None:
    path = tmp_path / "file"
    path.write_bytes(b"old")

    def interrupted() -> None:
        with replacing(path) as part:
            part.write_bytes(b"half")
            raise error

    with pytest.raises(error):
        interrupted()
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_killed_writer_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.write_bytes(b"old")
    if not (child := os.fork()):
        with replacing(path) as part:
            part.write_bytes(b"half")
            os.kill(os.getpid(), 9)
    os.waitpid(child, 0)
    assert path.read_bytes() == b"old"


def test_a_failed_sync_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "file"
    write_file(path, b"old")

    def broken(_: int) -> None:
        raise OSError("disk full")

    monkeypatch.setattr("os.fsync", broken)
    with pytest.raises(OSError, match="disk full"):
        write_file(path, b"new")
    assert path.read_bytes() == b"old"


def test_a_file_keeps_its_mode_and_a_link_its_target(tmp_path: Path) -> None:
    path, link = tmp_path / "file", tmp_path / "link"
    path.write_bytes(b"old")
    path.chmod(0o640)
    link.symlink_to(path)
    write_file(link, "new")
    assert link.is_symlink()
    assert path.read_bytes() == b"new"
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_what_is_no_regular_file_is_written_directly() -> None:
    write_file("/dev/null", b"gone")
