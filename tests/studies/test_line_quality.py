import json
import math

import numpy as np
import pytest

from semnav_features import Scan, polylines
from studies.lines.command import Arguments
from studies.lines.line_baselines import end_point_fit, greedy_polylines
from studies.lines.line_quality import (
    RANDOM_STREAM,
    compare,
    mean_quality,
    predicted_ranges,
    published_scans,
    published_table,
)
from tests.support.paths import DATA

CARMEN = DATA / "carmen"
ROOM = np.array([(2.0, -1.5), (2.0, 1.5), (-1.0, 1.5)])

needs_logs = pytest.mark.skipif(not CARMEN.is_dir(), reason=f"no real logs at {CARMEN}")


def scan_of(lines, count=120, low=-0.5, high=2.1):
    step = (high - low) / (count - 1)
    blank = Scan(np.full(count, np.nan), low, step)
    return Scan(predicted_ranges(blank, lines), low, step)


def test_the_lines_a_scan_was_made_from_explain_it_all():
    scan = scan_of((ROOM,))
    (row,) = compare(scan, 3, {"truth": lambda scan, n: (ROOM,)})
    assert row.rmse == row.rmse_common == row.rmse_charged == pytest.approx(0.0, abs=1e-9)
    assert (row.explained, row.vertices) == (1.0, 3)
    assert math.isnan(row.quiet)


def test_a_line_before_the_wall_counts_along_the_beams():
    angles = np.arange(-0.5, 0.5, 0.01)
    scan = Scan(np.full(len(angles), 2.0), -0.5, 0.01)
    short = np.array([(1.5 * math.cos(a), 1.5 * math.sin(a)) for a in angles])
    (row,) = compare(scan, 3, {"short": lambda scan, n: (short[:50],)})
    assert row.rmse == pytest.approx(0.5, abs=1e-4)
    assert row.explained == pytest.approx(0.5)
    assert row.rmse_charged == pytest.approx(0.5, abs=1e-4)


def test_a_line_over_missing_returns_is_not_quiet():
    ranges = scan_of((ROOM,)).ranges.copy()
    ranges[30:40] = np.nan
    scan = Scan(ranges, -0.5, 2.6 / 119)
    whole, split = compare(scan, 6, {"whole": end_point_fit, "split": polylines})
    assert (whole.quiet, split.quiet) == (0.0, 1.0)


@pytest.mark.parametrize("extract", [end_point_fit, greedy_polylines, polylines])
def test_every_extractor_finds_two_walls_with_three_vertices(extract):
    scan = scan_of((ROOM,))
    lines = extract(scan, 3)
    assert sum(map(len, lines)) == 3
    assert np.abs(predicted_ranges(scan, lines) - scan.ranges).max() < 0.05


def test_the_mean_leaves_out_scans_without_a_measure():
    scan = scan_of((ROOM,))
    (row,) = compare(scan, 3, {"truth": lambda scan, n: (ROOM,)})
    holed = Scan(np.where(np.arange(120) < 5, np.nan, scan.ranges), -0.5, 2.6 / 119)
    (other,) = compare(holed, 3, {"truth": lambda scan, n: (ROOM,)})
    assert mean_quality([row, other]).quiet == other.quiet == 0.0


@needs_logs
def test_no_choice_of_vertices_by_greed_is_better_on_real_scans():
    scans = published_scans(CARMEN / "intel-corrected.log.gz", RANDOM_STREAM["intel"])[:5]
    for scan in scans:
        best, greedy = compare(
            scan,
            20,
            {
                "best": lambda s, n: polylines(s, n, missed=0.5, refine=False),
                "greedy": greedy_polylines,
            },
        )
        assert best.rmse_charged <= greedy.rmse_charged * 1.001


@needs_logs
def test_the_scans_are_those_whose_published_lines_lie_on_them():
    scans = published_scans(CARMEN / "aces-corrected.log.gz", RANDOM_STREAM["aces"])
    ends = np.array([(25.891307, 32.731878), (27.736006, 32.787227), (29.774632, 29.317547)]) - 30
    scan = scans[0]
    reach = np.hypot(*ends.T)
    hits = scan.ranges[scan.valid]
    assert np.abs(hits[:, None] - reach).min(axis=0).max() < 0.1


@needs_logs
def test_the_published_table_has_every_number_of_vertices():
    table = published_table(CARMEN / "ple_iros2018_eval_means.csv")
    assert table["rmse", "PLE+"][10] == pytest.approx(0.08126)


def test_a_file_that_is_no_such_table_is_named(tmp_path):
    path = tmp_path / "other.csv"
    path.write_text("metric,dataset\nrmse,real\n")
    with pytest.raises(ValueError, match=r"other\.csv is not a table"):
        published_table(path)


def test_a_folder_without_logs_says_what_it_should_hold(tmp_path):
    with pytest.raises(ValueError, match="holds none of aces-corrected"):
        Arguments(tmp_path).run()


@needs_logs
def test_the_command_prints_the_means_of_every_log(tmp_path, capsys, monkeypatch):
    (tmp_path / "aces-corrected.log.gz").symlink_to(CARMEN / "aces-corrected.log.gz")
    monkeypatch.setattr("studies.lines.command.VERTEX_COUNTS", (10,))
    assert Arguments(tmp_path, json=True).run() == 0
    out = json.loads(capsys.readouterr().out)
    assert (out["scans"], out["logs"]) == (20, ["aces"])
    assert out["means"]["polylines"]["10"]["vertices"] == 10
