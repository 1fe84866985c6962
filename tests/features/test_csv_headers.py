"""Logs as CSV whose columns other programs named."""

from __future__ import annotations

import math

import numpy as np
import pytest

from semnav_features.readers import Geometry, LogError
from tests.features.test_tables import FORWARD, read, written

ROSTOPIC = """\
%time,field.header.seq,field.header.stamp,field.header.frame_id,field.angle_min,\
field.angle_increment,field.range_min,field.range_max,field.ranges0,field.ranges1,\
field.intensities0,field.intensities1
1500000000,1,1500000000,laser,-0.5,0.25,0.2,9.0,2.5,2.6,0,0
2500000000,2,2500000000,laser,-0.5,0.25,0.2,9.0,far,2.6,0,0
"""


def test_words_in_columns_that_are_passed_over_cost_no_row(tmp_path):
    """What `rostopic echo -p` prints names the frame; a word among the ranges is a bad row."""
    records, log = read(written(tmp_path, ROSTOPIC), Geometry())
    assert [record.scan.ranges.tolist() for record in records] == [[2.5, 2.6]]
    assert records[0].stamp == 1.5
    assert log.bad == {"a cell that is not a number": 1}


@pytest.mark.parametrize("index", ["", "7"])
def test_the_numbers_that_pandas_writes_over_its_columns_are_a_header(tmp_path, index):
    """`DataFrame(ranges).to_csv()`, with its index and without."""
    comma = "," if index else ""
    text = f"{comma}0,1,2,3\n" + 2 * f"{index}{comma}2.5,,2.7,2.8\n"
    records, log = read(written(tmp_path, text), FORWARD)
    assert not log.bad
    assert [record.line for record in records] == [2, 3]
    for record in records:
        np.testing.assert_array_equal(record.scan.ranges, [2.5, math.nan, 2.7, 2.8])


@pytest.mark.parametrize("first", ["0.0,1.0,2.0", "0,1,3", "1,2,3", ",1,2"])
def test_a_first_row_that_does_not_count_from_nought_is_a_scan(tmp_path, first):
    records, _ = read(written(tmp_path, f"{first}\n2,2,2\n"), FORWARD)
    assert [record.line for record in records] == [1, 2]


GERMAN = "stamp;x;y;theta;r0;r1;r2\n0,25;1,5;0;-0,5;2,51;;2\n"


def quoted(text):
    return "\n".join(
        ";".join(f'"{cell}"' for cell in line.split(";")) for line in text.splitlines()
    )


@pytest.mark.parametrize("first", ["", "sep=;\n", "\ufeff"])
@pytest.mark.parametrize("change", [str, lambda text: text.replace(";", "\t"), quoted])
def test_decimal_commas_are_read_where_commas_do_not_separate(tmp_path, first, change):
    """As pandas writes with `sep=";", decimal=","`, and German spreadsheets."""
    [record], log = read(written(tmp_path, first + change(GERMAN)), FORWARD)
    assert not log.bad
    assert (record.stamp, record.pose) == (0.25, (1.5, 0.0, -0.5))
    np.testing.assert_array_equal(record.scan.ranges, [2.51, math.nan, 2.0])


@pytest.mark.parametrize("row", ["2,51;2,50;2,49", "2;3;4", "2,51;;4"])
def test_bare_ranges_may_have_decimal_commas(tmp_path, row):
    records, _ = read(written(tmp_path, f"{row}\n2,5;2,4;2,3\n", "log"), FORWARD)
    ranges = [float(cell.replace(",", ".") or "nan") for cell in row.split(";")]
    np.testing.assert_array_equal(records[0].scan.ranges, ranges)
    np.testing.assert_array_equal(records[1].scan.ranges, [2.5, 2.4, 2.3])


def test_a_comment_may_have_decimal_commas(tmp_path):
    text = "# angle_min=-2,356 angle_increment=0,25, range_max=10\nr0;r1\n2;3\n"
    [record], _ = read(written(tmp_path, text))
    scan = record.scan
    assert (scan.angle_min, scan.angle_increment, scan.range_max) == (-2.356, 0.25, 10.0)


TWO_ROWS = "{0},r0,r1\n{1},2.5,2.4\n{2},2.5,2.4\n"


@pytest.mark.parametrize(
    ("names", "before", "after"),
    [
        ("stamp", "1700000000125000000", "1700000000375000000"),
        ("stamp_ns", "5000000000", "5250000000"),
        ("header.stamp.sec,header.stamp.nanosec", "1700000000,125000000", "1700000000,375000000"),
    ],
)
def test_times_in_nanoseconds_are_read_as_seconds(tmp_path, names, before, after):
    (a, b), _ = read(written(tmp_path, TWO_ROWS.format(names, before, after)), FORWARD)
    assert b.stamp - a.stamp == pytest.approx(0.25, abs=1e-6)


@pytest.mark.parametrize("digits", [12, 13, 16, 18, 20])
def test_times_that_cannot_be_seconds_are_refused(tmp_path, digits):
    stamps = [("17" + k + "0" * digits)[:digits] for k in "12"]
    with pytest.raises(LogError, match=r"2 x a time beyond .* divide milliseconds by 1000"):
        read(written(tmp_path, TWO_ROWS.format("stamp", *stamps)), FORWARD)


@pytest.mark.parametrize(
    "names",
    ["r0,r1,r10,r2", "r3,r2,r1,r0", "r0,r1,r2,r4", "r0,r1,d0,d1", "1700000000,12,laser,-3.1,0.5"],
)
def test_columns_of_ranges_out_of_order_are_refused(tmp_path, names):
    """Sorted as words, reversed, one dropped, two lidars, and `ros2 topic echo --csv`."""
    row = ",".join("2" for _ in names.split(","))
    with pytest.raises(LogError, match="not numbered in equal steps"):
        read(written(tmp_path, f"{names}\n{row}\n"), FORWARD)


@pytest.mark.parametrize(
    "names", ["a.r8,a.r9,a.r10", "range_-1,range_0,range_1", "r-0,r-4,r-8", "t,-0.5,-0.25,0.0"]
)
def test_columns_of_ranges_may_be_numbered_in_any_equal_steps(tmp_path, names):
    row = ",".join("2" for _ in names.split(","))
    [record], _ = read(written(tmp_path, f"{names}\n{row}\n"), FORWARD)
    assert record.scan.ranges.tolist() == [2.0, 2.0, 2.0]


def test_places_without_a_heading_are_refused_as_half_a_pose(tmp_path):
    with pytest.raises(LogError, match=r"x and y without a heading.*theta or yaw or heading"):
        read(written(tmp_path, "x,y,r0,r1\n1,2,2.5,2.6\n"), FORWARD)


def test_a_table_in_utf_16_is_refused_with_what_to_do(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text(ROSTOPIC, encoding="utf-16")
    with pytest.raises(LogError, match=r"is a text in UTF-16; save it in UTF-8$"):
        read(path)


def test_an_npz_may_hold_times_in_nanoseconds(tmp_path):
    stamps = np.array([1700000000125000000, 1700000000375000000])
    np.savez(tmp_path / "log.npz", ranges=np.full((2, 3), 2.0), stamps=stamps)
    (a, b), _ = read(tmp_path / "log.npz", FORWARD)
    assert b.stamp - a.stamp == pytest.approx(0.25, abs=1e-6)
