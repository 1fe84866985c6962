"""Logs as CSV, npz and BreezySLAM's lines."""

from __future__ import annotations

import gzip
import io
import math
import zipfile
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from semnav_features.readers import Geometry, LogError, TruncatedLogError, open_log
from tests.support.paths import DATA

BREEZY = DATA / "breezyslam" / "exp1.dat.gz"
CLUTTER = DATA / "clutter_slices" / "clutter_slices.npz"

tables = hnp.arrays(
    np.float64,
    st.tuples(st.integers(1, 8), st.integers(2, 60)),
    elements=st.one_of(st.floats(0.1, 9.0), st.sampled_from([math.nan, math.inf, 0.0, -1.0])),
)
in_a_folder = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
FORWARD = Geometry(angle_min=-0.3, angle_increment=0.01)


def read(path, geometry=None):
    with open_log(path, geometry) as log:
        return list(log), log


def written(folder, text, name="log.csv"):
    path = folder / name
    path.write_bytes(gzip.compress(text.encode()) if name.endswith(".gz") else text.encode())
    return path


def rows(table, separator=","):
    return "".join(separator.join(map(repr, map(float, row))) + "\n" for row in table)


@given(tables, st.sampled_from([",", ";", "\t"]), st.sampled_from(["log", "log.csv", "l.csv.gz"]))
@in_a_folder
def test_a_csv_of_bare_ranges_round_trips(tmp_path, table, separator, name):
    records, log = read(written(tmp_path, rows(table, separator), name), FORWARD)
    assert not log.bad
    assert [record.line for record in records] == list(range(1, len(table) + 1))
    for row, record in zip(table, records, strict=True):
        np.testing.assert_array_equal(record.scan.ranges, row)
        assert (record.scan.angle_min, record.scan.angle_increment) == (-0.3, 0.01)
        assert (record.pose, record.odometry, record.stamp) == (None, None, None)


HEADED = """\
# a comment, angle_min=-1.5 angle_increment: 0.5
# range_max = 8
stamp,x,y,theta,r0,r1,r2
1.5,1,2,0.5,3.0,4.0,5.0

# later
2.5,1,2,0.6,3.0,,9.0
"""


def test_a_csv_says_by_header_and_comment_what_its_columns_are(tmp_path):
    first, second = read(written(tmp_path, HEADED))[0]
    assert (first.stamp, first.pose, first.line) == (1.5, (1.0, 2.0, 0.5), 4)
    assert (second.stamp, second.pose, second.line) == (2.5, (1.0, 2.0, 0.6), 7)
    assert first.scan.angles.tolist() == [-1.5, -1.0, -0.5]
    assert first.scan.range_max == 8.0
    assert second.scan.valid.tolist() == [True, False, False]


def test_options_override_the_columns_of_a_csv(tmp_path):
    geometry = Geometry(range_max=4.5, angle_min=0.0, angle_increment=-0.1)
    first, _ = read(written(tmp_path, HEADED), geometry)[0]
    np.testing.assert_allclose(first.scan.angles, [-0.2, -0.1, 0.0], atol=1e-12)
    assert first.scan.ranges.tolist() == [5.0, 4.0, 3.0]
    assert first.scan.valid.tolist() == [False, True, True]


def test_the_csv_of_rostopic_echo_is_understood(tmp_path):
    text = (
        "%time,field.header.seq,field.angle_min,field.angle_increment,field.range_min,"
        "field.range_max,field.ranges0,field.ranges1,field.intensities0,field.intensities1\n"
        "1500000000,7,-0.5,0.25,0.2,9.0,1.0,2.0,100,200\n"
    )
    [record], _ = read(written(tmp_path, text))
    assert record.stamp == 1.5
    assert record.scan.ranges.tolist() == [1.0, 2.0]
    assert (record.scan.angle_min, record.scan.angle_increment) == (-0.5, 0.25)
    assert (record.scan.range_min, record.scan.range_max) == (0.2, 9.0)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1,2,3\n", "does not say where its beams point.*# angle_min="),
        ("# angle_min=-1\n1,2,3\n", "angle_increment"),
        ("# angle_min=left\n1,2,3\n", "line 1: angle_min is 'left'; it must be a number"),
        ("stamp,x,y\n1,2,3\n", "no column of ranges among 'stamp, x, y'; name them r0"),
        ("time,t,r0\n1,2,3\n", "2 columns that mean 'stamp'"),
        ("# angle_min=0 angle_increment=0.1\n", "no laser scan; expected rows of ranges"),
        (
            "# angle_min=0 angle_increment=90\n1,2,3\n",
            "no laser scan.*angle_increment=90 looks like degrees",
        ),
    ],
)
def test_a_csv_that_cannot_be_read_says_why(tmp_path, text, message):
    with pytest.raises(LogError, match=message):
        read(written(tmp_path, text))


def test_bad_rows_are_counted_and_cost_no_good_row(tmp_path):
    text = "1,2,3\n1,2\n1,two,3\n4000,4100,4200\n1,2,3,4\n1,2,3\n"
    records, log = read(written(tmp_path, text), FORWARD)
    assert [record.line for record in records] == [1, 6]
    assert log.bad == {
        "not as many cells as the first row": 2,
        "a cell that is not a number": 1,
        "ranges that are not metres": 1,
    }
    assert log.first_bad["not as many cells as the first row"] == 2


@given(st.binary(max_size=300), st.sampled_from(["log.csv", "log.dat", "log.npz", "log"]))
@in_a_folder
def test_any_bytes_give_scans_or_a_clear_error(tmp_path, data, name):
    path = tmp_path / name
    path.write_bytes(data)
    with suppress(LogError):
        records, log = read(path, FORWARD)
        assert len(records) + log.bad.total() <= 1 + data.count(b"\n") + data.count(b"\r")


def saved(folder, compressed=False, **arrays):
    path = folder / "log.npz"
    (np.savez_compressed if compressed else np.savez)(path, **arrays)
    return path


ANGLES = {"angle_min": -0.3, "angle_increment": 0.01}


@given(
    tables,
    st.sampled_from([np.float64, np.float32, np.float16]),
    st.sampled_from("CF"),
    st.booleans(),
)
@in_a_folder
def test_an_npz_comes_back_as_it_was_saved(tmp_path, table, dtype, order, compressed):
    table = np.asarray(table, dtype, order=order)
    poses, stamps = np.ones((len(table), 3)) * [1, 2, 0.5], np.arange(len(table)) + 0.5
    path = saved(tmp_path, compressed, ranges=table, poses=poses, stamps=stamps, **ANGLES)
    records, log = read(path)
    assert (log.unit, log.fraction, log.bad) == ("row", 1.0, {})
    for row, stamp, record in zip(table, stamps, records, strict=True):
        np.testing.assert_array_equal(record.scan.ranges, row)
        assert (record.stamp, record.pose) == (stamp, (1.0, 2.0, 0.5))
        assert record.scan.angle_min == -0.3
        assert record.scan.range_max == 50.0


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"scans": np.ones((2, 3))}, "no array 'ranges'; it holds scans"),
        ({"ranges": np.ones((2, 3))}, "no array 'angle_min'; give angle_min in radians.*np.savez"),
        ({"ranges": np.ones(3), **ANGLES}, r"shape \(3,\); it must be \(scans, beams\)"),
        ({"ranges": np.array([["a"]]), **ANGLES}, "dtype <U1; it must be real numbers"),
        ({"ranges": np.array([[None]]), **ANGLES}, "dtype object"),
        ({"ranges": np.ones((2, 3)), **ANGLES, "angle_min": np.ones(2)}, "must be one number"),
        ({"ranges": np.ones((2, 3)), **ANGLES, "poses": np.ones((3, 2))}, r"it must be \(2, 3\)"),
        ({"ranges": np.ones((2, 3)), **ANGLES, "stamps": np.ones(3)}, r"it must be \(2,\)"),
        ({"ranges": np.ones((0, 3)), **ANGLES}, "no laser scan; expected an array `ranges`"),
    ],
)
def test_an_npz_that_cannot_be_read_says_why(tmp_path, arrays, message):
    with pytest.raises(LogError, match=message):
        read(saved(tmp_path, **arrays))


def test_an_npz_may_leave_its_angles_to_be_given(tmp_path):
    records, _ = read(saved(tmp_path, ranges=np.ones((2, 3))), FORWARD)
    assert records[1].scan.angle_min == -0.3


def test_bad_rows_of_an_npz_are_counted(tmp_path):
    ranges = np.ones((4, 3))
    ranges[1] = [5000.0, 5100.0, 5200.0]
    poses = np.zeros((4, 3))
    poses[2, 1] = math.nan
    records, log = read(saved(tmp_path, ranges=ranges, poses=poses, **ANGLES))
    assert [record.line for record in records] == [1, 4]
    assert log.first_bad == {"ranges that are not metres": 2, "a pose that is not finite": 3}


def test_a_damaged_npz_gives_the_rows_before_the_damage(tmp_path):
    ranges = np.random.default_rng(1).uniform(1, 9, (200, 300))
    data = bytearray(saved(tmp_path, ranges=ranges, **ANGLES).read_bytes())
    data[len(data) // 2] ^= 0xFF
    path = tmp_path / "damaged.npz"
    path.write_bytes(data)
    records = []
    with pytest.raises(TruncatedLogError, match="truncated or damaged"), open_log(path) as log:
        records.extend(log)
    assert 50 < len(records) <= 200
    path.write_bytes(data[:1000])
    with pytest.raises(TruncatedLogError, match="nothing in it can be read"):
        open_log(path)


def test_a_header_that_promises_too_much_is_damage(tmp_path):
    path, header = tmp_path / "log.npz", io.BytesIO()
    np.lib.format.write_array_header_1_0(
        header, {"descr": "<f8", "fortran_order": False, "shape": (10**9, 4)}
    )
    np.savez(path, **ANGLES)
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr("ranges.npy", header.getvalue() + bytes(64))
    with pytest.raises(TruncatedLogError, match="up to scan 2"):
        read(path)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"\x93NUMPY\x01\0", "bare array.*np.savez"),
        (gzip.compress(b"#ROSBAG V2.0\n", mtime=0), "compressed as a whole"),
        (b"BZh91AY", "compressed as a whole"),
        (b"a,b\n1,2\n", "not a log of scans.*CSV"),
    ],
)
def test_a_near_miss_of_a_log_is_refused_with_advice(tmp_path, data, message):
    path = tmp_path / "log"
    path.write_bytes(data)
    with pytest.raises(LogError, match=message):
        open_log(path)


def test_a_breezyslam_line_is_a_scan_of_the_urg_04lx(tmp_path):
    ranges = [0, 4095, 19, *[1000] * 679]
    good = " ".join(map(str, [2_500_000, *[7] * 23, *ranges, 0]))
    text = f"{good}\n1 2 3\n{good.replace('1000', 'x', 1)}\n{good}\n"
    for name in ("exp.dat", "exp", "exp.dat.gz"):
        records, log = read(written(tmp_path, text, name))
        scan = records[0].scan
        assert [record.line for record in records] == [1, 4]
        assert scan.ranges[:4].tolist() == [0.0, 4.095, 0.019, 1.0]
        assert scan.valid[:4].tolist() == [False, True, False, True]
        assert scan.angles[340] == pytest.approx(0.0)
        assert math.degrees(scan.angles[-1]) == pytest.approx(119.9, abs=0.05)
        assert (records[0].stamp, records[0].pose) == (2.5, None)
        assert log.bad == {"not 706 or 707 fields": 1, "a field that is not a number": 1}


@pytest.mark.skipif(not BREEZY.exists(), reason="the shared recorded logs are not here")
def test_a_real_breezyslam_log_reads_as_its_readme_says():
    records, log = read(BREEZY)
    assert (len(records), log.bad) == (756, {})
    stamps = [record.stamp for record in records]
    assert np.diff(stamps).mean() == pytest.approx(0.1, abs=0.01)


@pytest.mark.skipif(not CLUTTER.exists(), reason="the shared recorded logs are not here")
def test_real_scans_in_an_npz_read_as_their_readme_says():
    records, log = read(CLUTTER)
    assert (len(records), log.bad) == (340, {})
    for record in records:
        assert len(record.scan.ranges) == 1081
        assert math.degrees(record.scan.angle_min) == pytest.approx(-135.0)
