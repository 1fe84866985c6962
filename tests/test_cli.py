import gzip
import json
import os
import signal
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.maps import bundled_names
from semnav_env.scripts import main as cli
from semnav_env.scripts import progress
from semnav_env.scripts.arguments import parse
from semnav_env.scripts.checks import Check
from semnav_env.scripts.doctor import Arguments as Doctor
from semnav_env.scripts.jsonl import JsonLines
from semnav_env.scripts.sampling import EvenSample


def room(seed):
    """A FLASER line taken in the middle of a room of 4 m by 4 m."""
    angles = np.radians(np.arange(180) - 90.0)
    ranges = 2.0 / np.maximum(np.abs(np.cos(angles)), np.abs(np.sin(angles)))
    ranges += np.random.default_rng(seed).normal(0.0, 0.01, 180)
    numbers = " ".join(f"{r:.2f}" for r in ranges)
    return f"FLASER 180 {numbers} 1 2 0.5 1 2 0.5 {seed}.5 robot {seed}.5\n"


LOG = "".join(room(seed) for seed in range(20))


@pytest.fixture
def log(tmp_path):
    path = tmp_path / "log.txt"
    path.write_text("ODOM 1 2 0.5 0 0 0 1 robot 1\n" + LOG + "FLASER 180 1 2\nODOM 1\n")
    return path


def run(capsys, *words):
    code = cli.main([str(word) for word in words])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def scenes(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


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


def test_extract_writes_a_scene_per_scan(capsys, monkeypatch, log, tmp_path):
    monkeypatch.setattr(progress, "PATIENCE", 1e6)  # however long the first scan compiles
    out, page = tmp_path / "new" / "scenes.jsonl", tmp_path / "page.png"
    code, text, err = run(capsys, "extract", log, "--out", out, "--plot", page)
    assert (code, err) == (0, "")
    assert "20 scans" in text
    assert "2 bad lines" in text
    assert "line 22" in text
    assert text.endswith(f"wrote {out}\nwrote {page}\n")
    written = scenes(out)
    assert [scene["line"] for scene in written] == list(range(2, 22))
    assert [scene["stamp"] for scene in written] == [seed + 0.5 for seed in range(20)]
    for scene in written:
        assert (scene["pose"], scene["odometry"]) == ([1, 2, 0.5], [1, 2, 0.5])
        assert len(scene["walls"]) == 3
        ahead = max(scene["walls"], key=lambda wall: wall["start"][0] + wall["end"][0])
        assert ahead["start"] == pytest.approx([2, -2], abs=0.1)
        assert ahead["end"] == pytest.approx([2, 2], abs=0.1)
    assert page.stat().st_size > 10_000
    assert not list(out.parent.glob("*.part"))


def test_every_and_limit_choose_the_scans(capsys, log, tmp_path):
    out = tmp_path / "scenes.jsonl"
    code, text, _ = run(capsys, "extract", log, "--out", out, "--every", 3, "--limit", 4, "--json")
    assert code == 0
    assert (json.loads(text)["scans"], json.loads(text)["wrote"]) == (4, [str(out)])
    assert [scene["line"] for scene in scenes(out)] == [2, 5, 8, 11]


def test_extract_reads_tables_with_the_angles_that_are_given(capsys, tmp_path):
    table, out = tmp_path / "log.csv", tmp_path / "scenes.jsonl"
    rows = [line.split()[2:182] for line in LOG.splitlines()]
    table.write_text("".join(",".join(row) + "\n" for row in rows))
    angles = ("--angle-min", "-1.5708", "--angle-increment", "0.0174533")
    code, text, _ = run(capsys, "extract", table, "--out", out, *angles)
    assert code == 0
    assert "20 scans" in text
    assert [len(scene["walls"]) for scene in scenes(out)] == [3] * 20
    assert scenes(out)[0]["pose"] is None


def test_extract_reads_the_topic_of_a_bag_that_is_chosen(capsys, tmp_path):
    pytest.importorskip("rosbags", reason="the extra `ros` is not installed")
    from tests.bags import KINDS, BagFile, Sweep

    ranges = np.array([line.split()[2:182] for line in LOG.splitlines()], float)
    angles = {"angle_min": -np.pi / 2, "angle_increment": np.pi / 180}
    messages = [Sweep(row, topic=name, **angles) for row in ranges for name in ("/scan", "/back")]
    for kind in KINDS:
        bag = BagFile(kind, messages).write(tmp_path, kind)
        code, _, err = run(capsys, "extract", bag)
        assert (code, err.count("\n")) == (2, 1)
        assert "/back (20 messages), /scan (20 messages)" in err
        code, text, _ = run(capsys, "extract", bag, "--topic", "/scan")
        assert (code, text.splitlines()[-1]) == (0, "0 bad messages")
        assert "60 walls" in text


def test_settings_reach_the_extractor(capsys, log):
    walls = [
        json.loads(run(capsys, "extract", log, "--json", *more)[1])["found"]["walls"]
        for more in ([], ["--settings.wall-length", "5"])
    ]
    assert walls == [60, 0]


def test_a_truncated_log_is_written_as_far_as_it_goes(capsys, tmp_path):
    whole = gzip.compress(LOG.encode())
    path, out = tmp_path / "cut.gz", tmp_path / "scenes.jsonl"
    path.write_bytes(whole[: len(whole) * 2 // 3])
    code, text, err = run(capsys, "extract", path, "--out", out, "--json")
    summary = json.loads(text)
    assert code == 2
    assert 0 < summary["scans"] < 20
    assert not summary["log_whole"]
    assert len(scenes(out)) == summary["scans"]
    assert err.count("\n") == 1
    assert f"up to scan {summary['scans']}" in err


def test_a_failed_run_leaves_an_older_file_alone(capsys, tmp_path):
    empty, out = tmp_path / "empty.log", tmp_path / "scenes.jsonl"
    empty.write_text("PARAM a b\n")
    out.write_text("older\n")
    assert run(capsys, "extract", empty, "--out", out)[0] == 2
    assert out.read_text() == "older\n"
    assert not list(tmp_path.glob("*.part"))


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
        (["extract", "a.log", "--range-max", "nan"], "range_max", "positive"),
        (["extract", "a.log", "--beam-spacing", "0"], "beam_spacing", "positive"),
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


@pytest.mark.parametrize("words", [["--help"], ["--version"], *([n, "-h"] for n in cli.COMMANDS)])
def test_help_is_printed_and_done(capsys, words):
    code, out, err = run(capsys, *words)
    assert (code, err) == (0, "")
    assert "semnav" in out


def test_the_help_names_every_command(capsys):
    _, out, _ = run(capsys, "--help")
    for name, (_, help_text) in cli.COMMANDS.items():
        assert name in out
        assert help_text in out


def test_starting_loads_no_sub_command():
    program = (
        "import sys; from semnav_env.scripts.main import main; main(['--help']);"
        "print([m for m in ('tyro', 'numba', 'matplotlib', 'shapely') if m in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.stdout.splitlines()[-1] == "[]"


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


def test_map_show_says_which_doors_are_open(capsys):
    _, out, _ = run(capsys, "map", "show", "office_cross")
    doors = [line for line in out.splitlines() if line.startswith("  door ")]
    assert sum("closed" in door for door in doors) == 1
    assert len(doors) >= 16


def test_doctor_finds_this_installation_sound(capsys):
    code, out, _ = run(capsys, "doctor", "--json")
    checks = {check["name"]: check for check in json.loads(out)}
    assert code == 0
    assert checks["numpy"]["detail"] == np.__version__
    assert checks["compiled kernels"]["ok"]


@pytest.mark.parametrize(("needed", "code"), [(True, 1), (False, 0)])
def test_doctor_fails_only_for_what_is_needed(capsys, monkeypatch, needed, code):
    missing = Check("thing", False, "not installed", "pip install thing", needed)
    monkeypatch.setattr("semnav_env.scripts.checks.requirements", lambda: [missing])
    monkeypatch.setattr("semnav_env.scripts.doctor._TRIALS", {})
    assert parse(Doctor, [], "semnav doctor").run() == code
    assert "pip install thing" in capsys.readouterr().out


def test_an_interruption_keeps_the_finished_lines(tmp_path, monkeypatch, capsys, log):
    out, calls = tmp_path / "scenes.jsonl", []

    def interrupted(record, scene):
        calls.append(record)
        if len(calls) == 5:
            raise KeyboardInterrupt
        return {"line": record.line}

    monkeypatch.setattr("semnav_env.scripts.extract.document", interrupted)
    assert run(capsys, "extract", log, "--out", out)[0] == 130
    assert [scene["line"] for scene in scenes(out)] == [2, 3, 4, 5]


def test_a_killed_run_leaves_whole_lines_and_the_older_file(tmp_path):
    path = tmp_path / "lines.jsonl"
    path.write_text("older\n")
    program = (
        "import os, signal, sys, pathlib\n"
        "from semnav_env.scripts.jsonl import JsonLines\n"
        "with JsonLines(pathlib.Path(sys.argv[1])) as out:\n"
        "    for i in range(100):\n"
        "        out.write({'i': i, 'long': 'x' * 9999})\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run([sys.executable, "-c", program, str(path)])
    assert done.returncode == -signal.SIGKILL
    assert path.read_text() == "older\n"
    assert [line["i"] for line in scenes(tmp_path / "lines.jsonl.part")] == list(range(100))


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


@given(st.integers(1, 20), st.integers(0, 500))
def test_a_sample_is_evenly_spread(size, count):
    sample = EvenSample(size)
    for item in range(count):
        sample.offer(item)
    items = sample.items()
    assert len(items) == min(size, count)
    assert items == sorted(set(items))
    if count > 4 * size:
        gaps = np.diff([0, *items, count])
        assert gaps.max() <= 2.5 * count / size


def test_the_bar_appears_only_for_what_takes_long(capsys, monkeypatch):
    def seen(patience):
        monkeypatch.setattr(progress, "PATIENCE", patience)
        items = progress.tracked(iter("abc"), lambda n: f"{n} letters", lambda: 1.0)
        word = [next(items)]
        if not patience:
            progress.Timer(0.2, lambda: None).run()
        assert word + list(items) == list("abc")
        return capsys.readouterr().err

    assert seen(60.0) == ""
    assert "3 letters" in seen(0.0)


def test_a_misspelt_second_word_is_answered_with_the_right_one(capsys):
    code, _, error = run(capsys, "evaluate", "feature")
    assert code == 2
    assert "did you mean 'evaluate features'?" in error
