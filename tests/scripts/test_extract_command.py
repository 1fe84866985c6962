"""`semnav extract`: scenes of logs, tables and bags."""

import gzip
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_scripts import progress
from semnav_scripts.sampling import EvenSample
from tests.support.command_line import run, scenes


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


def test_extract_writes_a_scene_per_scan(capsys, monkeypatch, log, tmp_path):
    monkeypatch.setattr(progress, "BAR_DELAY", 1e6)  # however long the first scan compiles
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
    assert not list(out.parent.glob(".*"))


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
    from tests.support.bags import KINDS, BagFile, Sweep

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
    assert not list(tmp_path.glob(".*"))


def test_an_interruption_keeps_the_finished_lines(tmp_path, monkeypatch, capsys, log):
    out, calls = tmp_path / "scenes.jsonl", []

    def interrupted(record, scene):
        calls.append(record)
        if len(calls) == 5:
            raise KeyboardInterrupt
        return {"line": record.line}

    monkeypatch.setattr("semnav_scripts.extract.document", interrupted)
    code, _, said = run(capsys, "extract", log, "--out", out)
    assert code == 130
    assert said.endswith(f"semnav: interrupted; '{out}' holds the 4 lines so far\n")
    assert [scene["line"] for scene in scenes(out)] == [2, 3, 4, 5]


def test_an_error_says_where_the_lines_before_it_are(tmp_path, monkeypatch, capsys, log):
    out = tmp_path / "scenes.jsonl"

    def full(record, scene):
        if record.line > 2:
            raise OSError(28, "No space left on device")
        return {"line": record.line}

    monkeypatch.setattr("semnav_scripts.extract.document", full)
    code, _, said = run(capsys, "extract", log, "--out", out)
    assert code == 2
    assert said.endswith(f"No space left on device; '{out}' holds the 1 line so far\n")


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


def test_explained_scenes_say_what_was_turned_down(capsys, log, tmp_path):
    out = tmp_path / "scenes.jsonl"
    words = ["extract", log, "--out", out, "--limit", "2", "--settings.wall-length", "30"]
    assert run(capsys, *words, "--explain")[0] == 0
    reasons = [each for scene in scenes(out) for each in scene["rejections"]]
    assert {"kind", "start", "end", "reason"} == set(reasons[0])
    assert "--explain writes its reasons into --out" in run(capsys, "extract", log, "--explain")[2]
    assert run(capsys, *words)[0] == 0
    assert all("rejections" not in scene for scene in scenes(out))
