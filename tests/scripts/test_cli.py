"""The command `semnav`: help, errors, maps, the doctor and the bar of progress."""

import json
import subprocess
import sys
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Literal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.world.maps import bundled_names, load_floor_plan, save_floor_plan
from semnav_scripts import main as cli
from semnav_scripts import progress
from semnav_scripts.arguments import parse
from semnav_scripts.checks import InstallationCheck
from semnav_scripts.dispatch import LONGEST_LINE
from semnav_scripts.doctor import Arguments as Doctor
from semnav_scripts.map import COMMANDS as MAP
from tests.support.command_line import run

COMMANDS = cli.SEMNAV.commands


@dataclass(frozen=True)
class Optionals:
    """Options that may be absent.

    Attributes:
        number: a number.
        text: a text.
        choice: one of two words.
    """

    number: int | None = None
    text: str | None = None
    choice: Literal["one", "other"] | None = None

    def run(self) -> int:
        return 0


@pytest.mark.parametrize(
    ("option", "name", "message"),
    [("--save", "run.avi", ".gif, .mp4 or .png"), ("--picture", "end.gif", "must end in .png")],
)
def test_a_demo_refuses_a_file_it_cannot_write_before_it_drives(
    capsys, tmp_path, option, name, message
):
    path = tmp_path / name
    code, out, err = run(capsys, "demo", "go through the next door on the right", option, path)
    assert (code, out) == (2, "")
    assert message in err


@pytest.mark.parametrize("words", [("--save", "x.gif"), ("--picture", "x.png")])
def test_a_demo_in_a_window_refuses_a_file_before_it_drives(capsys, words):
    code, out, err = run(capsys, "demo", "turn around", "--show", *words)
    assert (code, out) == (2, "")
    assert "--show opens a window; give it without" in err


def test_a_demo_says_why_the_robot_gave_up(capsys, monkeypatch):
    why = "no second door on the right: the hallway ended after 1"
    end = {"is_success": False, "verdicts": (), "crossed_doors": (), "collisions": 0}
    end |= {"impossible": why, "path_length": 0.0, "route_length": 1.0}
    monkeypatch.setattr("semnav_scripts.demo.steps", lambda *_: [SimpleNamespace(info=end)])
    words = ("demo", "go through the second door on the right")
    code, said, _ = run(capsys, *words)
    assert (code, said.splitlines()[-1]) == (1, f"the robot found the command impossible: {why}")
    assert json.loads(run(capsys, *words, "--json")[1])["impossible"] == why


@pytest.mark.parametrize(
    ("words", "names", "remedy"),
    [
        ([], "no command", "extract"),
        (["extrakt"], "extrakt", "'extract'"),
        (["extract"], "missing", "--help"),
        (["extract", "nowhere.log"], "nowhere.log", "No such file"),
        (["extract", "."], "'.'", "directory"),
        (["extract", __file__], "not a log of scans", "CARMEN"),
        (["extract", "a.log", "--every", "0"], "--every", "at least 1"),
        (["extract", "a.log", "--every", "x"], "--every", "int"),
        (["extract", "a.log", "--evry", "2"], "--evry", "--every"),
        (["extract", "a.log", "--plot", "page.doc"], "page.doc", ".png"),
        (["extract", "a.log", "--out", "a.log"], "a.log", "another file"),
        (["extract", "a.log", "--settings.sigma", "-1"], "sigma", "from 0"),
        (["extract", "a.log", "--range-max", "nan"], "range_max", "from 0.01"),
        (["extract", "a.log", "--beam-spacing", "0"], "beam_spacing", "from 0.001"),
        (["map"], "list", "show"),
        (["map", "show", "vila_hall"], "vila_hall", "villa_hall"),
        (["map", "show", "none.geojson"], "none.geojson", ""),
        (["map", "show", "villa_hall", "--out", "plan.doc"], "doc", "png"),
    ],
)
def test_bad_input_is_one_line_that_names_fault_and_remedy(
    capsys, monkeypatch, tmp_path, words, names, remedy
):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, *words)
    assert (code, out) == (2, "")
    assert err.startswith("semnav: ")
    assert err.count("\n") == 1
    assert names.lower() in err.lower()
    assert remedy in err


@given(st.lists(st.text(max_size=12), max_size=4))
def test_any_words_end_in_an_exit_code(words):
    assert cli.main(["extract", "no such log", *words]) in (0, 2)


def test_debug_shows_where_an_error_comes_from(monkeypatch):
    with pytest.raises(FileNotFoundError):
        cli.main(["extract", "nowhere.log", "--debug"])
    monkeypatch.setenv("SEMNAV_DEBUG", "1")
    with pytest.raises(FileNotFoundError):
        cli.main(["extract", "nowhere.log"])


@pytest.mark.parametrize("words", [["--help"], ["--version"], *([n, "-h"] for n in COMMANDS)])
def test_help_is_printed_and_done(capsys, words):
    code, out, err = run(capsys, *words)
    assert (code, err) == (0, "")
    assert "semnav" in out


@pytest.mark.parametrize("name", ["demo", "evaluate", "train", "extract"])
def test_an_option_that_may_be_absent_is_shown_like_any_other(capsys, name):
    """Nobody types "None" for it: the option is left out."""
    assert "{None}" not in run(capsys, name, "--help")[1]


def test_an_option_that_may_be_absent_can_be_given_as_none():
    """As launch files must."""
    given = parse(
        Optionals, ["--number", "None", "--text", "None", "--choice", "None"], "optionals"
    )
    assert given == Optionals() == parse(Optionals, [], "optionals")


def test_the_help_names_every_command(capsys):
    _, out, _ = run(capsys, "--help")
    for name, (_, help_text) in COMMANDS.items():
        assert name in out
        assert help_text in out


def loaded_by(*words):
    """The modules of a process in which `semnav` was called with these words."""
    program = (
        f"import sys; from semnav_scripts.main import main; main({list(words)});print(*sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    return set(run.stdout.splitlines()[-1].split())


KERNELS = {"numba", "scipy", "matplotlib", "pymunk", "semnav_features.kernels"}


@pytest.mark.parametrize("words", [("--help",), ("map", "--help")])
def test_starting_loads_no_sub_command(words):
    assert not loaded_by(*words) & {"tyro", "shapely", *KERNELS}


@pytest.mark.parametrize("words", [("map", "list"), ("map", "show", "office_cross")])
def test_looking_at_floor_plans_loads_no_kernel(words):
    assert not loaded_by(*words) & KERNELS


def test_grounding_a_plain_command_loads_what_it_needs():
    words = ("ground", "go left", "--map", "office_cross", "--pose", "3,11.5,0")
    assert not loaded_by(*words) & {"typeguard", "jsonschema", "asyncio"}


def test_map_list_and_show_agree(capsys, tmp_path):
    code, out, _ = run(capsys, "map", "list", "--json")
    plans = json.loads(out)
    assert code == 0
    assert [plan["name"] for plan in plans] == list(bundled_names())
    for plan in plans:
        picture = tmp_path / f"{plan['name']}.png"
        code, out, _ = run(capsys, "map", "show", plan["name"], "--json", "--out", picture)
        assert code == 0
        assert json.loads(out) == plan
        assert picture.read_bytes().startswith(b"\x89PNG")


def test_the_help_names_every_sub_command(capsys):
    text = run(capsys, "episodes", "--help")[1]
    words = {"map": set(MAP.commands)}
    words["episodes"] = set(text[text.index("{") + 1 : text.index("}")].split(","))
    for name, sub_commands in words.items():
        assert len(sub_commands) > 3
        line = next(line for line in run(capsys, "--help")[1].splitlines() if f"  {name} " in line)
        assert sub_commands <= set(line.replace(",", "").split())


def test_what_is_grounded_stands_under_headings_with_units(capsys):
    pose = "--pose=-2.5,-0.3,0.24"
    _, text, _ = run(capsys, "ground", "the second door on the right", pose)
    headings, row = text.splitlines()
    assert headings.split() == ["goal", "x,", "m", "y,", "m", "heading,", "rad", "clause"]
    assert row.startswith("pass")
    unsaid = "through it, as nothing else was said"
    assert row.endswith(f"  the second door on the right, {unsaid}  (door south_2)")
    assert headings.index("clause") == row.index("the second")
    assert headings.index("x, m") + len("x, m") == row.index(row.split()[1]) + len(row.split()[1])


def test_map_show_says_which_doors_are_open(capsys, tmp_path):
    save_floor_plan(load_floor_plan("office_cross"), tmp_path / "saved.geojson")
    for plan in ("office_cross", tmp_path / "saved.geojson"):
        _, out, _ = run(capsys, "map", "show", plan)
        doors = [line for line in out.splitlines() if line.startswith("  door ")]
        assert sum("closed" in door for door in doors) == 1
        assert [door for door in doors if "half-open" in door] == [
            "  door west_north_2: half-open, 1.10 m wide"
        ]
        assert len(doors) >= 16


def test_doctor_finds_this_installation_sound(capsys):
    code, out, _ = run(capsys, "doctor", "--json")
    checks = {check["name"]: check for check in json.loads(out)}
    assert code == 0
    assert checks["numpy"]["detail"] == np.__version__
    assert checks["compiled kernels"]["ok"]


@pytest.mark.parametrize(("needed", "code"), [(True, 1), (False, 0)])
def test_doctor_fails_only_for_what_is_needed(capsys, monkeypatch, needed, code):
    missing = InstallationCheck("thing", False, "not installed", "pip install thing", needed)
    monkeypatch.setattr("semnav_scripts.checks.requirements", lambda: [missing])
    monkeypatch.setattr("semnav_scripts.doctor._TRIALS", {})
    assert parse(Doctor, [], "semnav doctor").run() == code
    assert "pip install thing" in capsys.readouterr().out


def test_an_interruption_inside_a_compiled_kernel_is_one_too(monkeypatch, capsys):
    def interrupted(self, words):
        raise SystemError("returned a result with an exception set") from KeyboardInterrupt()

    monkeypatch.setattr(cli.CommandTable, "_run", interrupted)
    assert run(capsys, "doctor")[::2] == (130, "semnav: interrupted\n")


def test_the_bar_appears_only_for_what_takes_long(capsys, monkeypatch):
    def seen(patience):
        monkeypatch.setattr(progress, "BAR_DELAY", patience)
        items = progress.tracked(iter("abc"), lambda n: f"{n} letters", lambda: 1.0)
        word = [next(items)]
        if not patience:
            progress.Timer(0.2, lambda: None).run()
        assert word + list(items) == list("abc")
        return capsys.readouterr().err

    assert seen(60.0) == ""
    assert "3 letters" in seen(0.0)


@pytest.mark.parametrize(
    "words",
    [
        ["x" * 100_000],
        ["map", "show", "x" * 100_000],
        ["ground", "x" * 19_000],
        ["extract", "x" * 100_000],
        ["demo", "stop", "--map", "x" * 100_000],
        ["evaluate", "--suite", "x" * 100_000],
        ["demo", "stop", "--robot", "x" * 100_000],
    ],
)
def test_an_error_repeats_no_long_words(capsys, words):
    code, _, said = run(capsys, *words)
    assert code == 2
    assert len(said) < LONGEST_LINE + 100
    assert said.count("\n") == 1
