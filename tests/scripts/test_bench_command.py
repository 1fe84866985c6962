"""`semnav bench`: what is timed, and how it is told."""

import json

import pytest

from semnav_scripts.bench import _in_scans
from tests.support.command_line import run

FEW = ("--runs", "1", "--steps", "20", "--robots", "2", "--threads", "1")


def test_the_benchmark_times_steps_parts_and_a_reset(capsys):
    code, out, _ = run(capsys, "bench", *FEW, "--json")
    timings = {row["name"].split(":")[0].split(",")[0]: row for row in json.loads(out)}
    assert code == 0
    assert {"brute-force scan", "step", "step of one of 2 robots", "sense", "reset"} <= set(timings)
    scan = timings["brute-force scan"]["microseconds"]
    for row in timings.values():
        assert row["ratio"] == pytest.approx(scan / row["microseconds"])


def test_training_on_a_split_is_timed_beside_plain_steps(capsys):
    code, out, _ = run(capsys, "bench", *FEW, "--episodes", "test_real", "--json")
    names = [row["name"] for row in json.loads(out)]
    assert code == 0
    plain = ["step", "step of one of 2 robots, 1 thread"]
    assert names[1:] == [n for p in plain for n in (p, f"{p}, on test_real with resets")]


def test_decisions_are_timed_for_one_robot_and_for_many(capsys):
    code, out, _ = run(capsys, "bench", *FEW, "--agents", "--episodes", "test_real", "--json")
    rows = json.loads(out)
    assert code == 0
    assert [row["name"].split(", ")[-1] for row in rows[1:]] == [
        each for each in ("one robot", "one of 2 robots") for _ in range(2)
    ]
    assert all(row["microseconds"] > 0.0 for row in rows)


def test_a_split_that_is_not_there_is_no_benchmark(capsys):
    code, _, err = run(capsys, "bench", *FEW, "--episodes", "tran")
    assert code == 2
    assert "no split 'tran'" in err


@pytest.mark.parametrize(("ratio", "said"), [(20.0, "1/20.0"), (1.0, "1.0"), (0.5, "2.0")])
def test_a_part_is_told_in_brute_force_scans(ratio, said):
    assert _in_scans(ratio) == said


def test_cold_is_for_start(capsys):
    code, _, err = run(capsys, "bench", "--cold")
    assert (code, err) == (2, "semnav: --cold is for --start; give both\n")


@pytest.mark.slow
def test_starting_is_timed_in_processes_of_their_own(capsys):
    code, out, _ = run(capsys, "bench", "--start", "--cold", "--runs", "1", "--json")
    timings = {row["name"]: row["microseconds"] for row in json.loads(out)}
    assert code == 0
    assert timings["import semnav_env"] < timings["semnav ground"]
    assert timings["compiling all kernels, processor time"] > timings["semnav ground"]
