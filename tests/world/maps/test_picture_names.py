"""Pictures are written where they are said to be, or refused before the work."""

from __future__ import annotations

from pathlib import Path

import pytest

from semnav_env.judge.routes.draw import save_routes
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.draw import save_picture
from semnav_scripts.main import main

DRAWING = {
    "show": ["map", "show", "villa_hall", "--out"],
    "check": ["map", "check", "villa_hall", "--plot"],
    "generate": ["map", "generate", "--distribution", "small", "--plot"],
    "describe": ["describe", "--from=1,1.5,0", "--to", "north", "--plot"],
}
NO_PICTURES = ["", "folder", "noext", "plan.txt", "folder.png"]


@pytest.fixture
def empty(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A current folder that holds two folders and no file."""
    monkeypatch.chdir(tmp_path)
    for name in ("folder", "folder.png"):
        (tmp_path / name).mkdir()
    return tmp_path


@pytest.mark.parametrize("path", NO_PICTURES)
@pytest.mark.parametrize("words", DRAWING.values(), ids=list(DRAWING))
def test_a_name_that_is_no_picture_is_refused(
    words: list[str], path: str, empty: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*words, path]) == 2
    error = capsys.readouterr().err
    assert "must end in .png, .pdf or .svg" in error or "is a folder" in error
    assert sorted(p.name for p in empty.rglob("*")) == ["folder", "folder.png"]


@pytest.mark.parametrize("path", NO_PICTURES)
def test_the_functions_that_draw_refuse_it_as_well(path: str, empty: Path) -> None:
    plan = load_floor_plan("villa_hall")
    for save in (lambda: save_picture(plan, path), lambda: save_routes(plan, [], Path(path))):
        with pytest.raises(ValueError, match=r"no picture's name|is a folder"):
            save()


def test_a_picture_lies_where_it_is_said_to_be(
    empty: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*DRAWING["show"], "new/plan.PNG"]) == 0
    assert "wrote new/plan.PNG" in capsys.readouterr().out
    assert (empty / "new" / "plan.PNG").read_bytes().startswith(b"\x89PNG")
