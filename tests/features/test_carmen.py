import gzip
import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features.readers import Geometry, LogError, TruncatedLogError, open_log
from tests.support.paths import DATA

INTEL = DATA / "carmen" / "intel-corrected.log.gz"

metres = st.floats(0.0, 100.0, allow_nan=False)
poses = st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(-math.pi, math.pi))
sizes = st.sampled_from([180, 181, 360, 361, 400, 401])


def words(*values):
    return " ".join(repr(float(value)) for value in values)


def flaser(ranges, pose=(0, 0, 0), stamp=0.0):
    return f"FLASER {len(ranges)} {words(*ranges, *pose, *pose, stamp)} robot {stamp!r}"


def robotlaser(ranges, pose=(0, 0, 0), stamp=0.0, start=-2.0, step=0.01, longest=30.0, echoes=()):
    setup = words(start, step * len(ranges), step, longest, 0.01)
    tail = words(*pose, *pose, 0, 0, 0, 0, 0, stamp)
    return (
        f"ROBOTLASER1 0 {setup} 0 {len(ranges)} {words(*ranges)} {len(echoes)} "
        f"{words(*echoes)} {tail} robot {stamp!r}"
    )


def odom(pose):
    return f"ODOM {words(*pose)} 0 0 0 1.0 robot 1.0"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("logs")


def written(folder, lines, compress=False):
    path = folder / ("log.gz" if compress else "log")
    data = ("\n".join(lines) + "\n").encode()
    path.write_bytes(gzip.compress(data) if compress else data)
    return path


def read(path, geometry=None):
    with open_log(path, geometry) as log:
        return list(log), log


@given(sizes, st.data(), poses, st.floats(0, 2e9), st.booleans())
def test_a_flaser_line_comes_back_as_it_was_written(folder, n, data, pose, stamp, compress):
    ranges = data.draw(st.lists(metres, min_size=n, max_size=n))
    [record], log = read(written(folder, [flaser(ranges, pose, stamp)], compress))
    np.testing.assert_array_equal(record.scan.ranges, ranges)
    assert (record.pose, record.stamp, record.line) == (pose, stamp, 1)
    assert record.odometry is None
    assert not log.bad


@given(st.lists(metres, min_size=2, max_size=50), poses, st.lists(metres, max_size=5))
def test_a_robotlaser_line_comes_back_as_it_was_written(folder, ranges, pose, echoes):
    line = robotlaser(ranges, pose, 7.5, -2.0, 0.01, 30.0, echoes)
    [record], _ = read(written(folder, [line]))
    scan = record.scan
    np.testing.assert_array_equal(scan.ranges, ranges)
    assert (scan.angle_min, scan.angle_increment, scan.range_max) == (-2.0, 0.01, 30.0)
    assert (record.pose, record.stamp) == (pose, 7.5)


@given(st.lists(st.one_of(st.none(), poses), min_size=1, max_size=12))
def test_odometry_is_that_of_the_last_odom_line(folder, messages):
    scan = flaser([1.0] * 180)
    lines = [scan if pose is None else odom(pose) for pose in messages]
    records, _ = read(written(folder, [*lines, scan]))
    for record in records:
        before = [pose for pose in messages[: record.line - 1] if pose is not None]
        assert record.odometry == (before[-1] if before else None)


@pytest.mark.parametrize(("n", "last"), [(180, 89), (181, 90), (360, 89.5), (361, 90), (401, 50)])
def test_the_middle_beam_of_a_flaser_line_looks_forward(folder, n, last):
    [record], _ = read(written(folder, [flaser([1.0] * n)]))
    angles = np.degrees(record.scan.angles)
    assert angles[n // 2] == pytest.approx(0.0)
    assert angles[-1] == pytest.approx(last)


def test_no_returns_are_not_valid_and_the_spacing_can_be_given(folder):
    path = written(folder, [flaser([1.0] * 539 + [50.0, 81.91])])
    [record], _ = read(path, Geometry(beam_spacing=0.5))
    assert record.scan.valid.sum() == 539
    assert math.degrees(record.scan.angle_min) == pytest.approx(-135)
    with pytest.raises(LogError, match="give the spacing"):
        read(path)


GOOD = flaser([1.0] * 180)
BAD = {
    "FLASER: fewer fields than its format has": "FLASER",
    "FLASER: fewer fields than its count of beams asks for": GOOD.rsplit(" ", 1)[0],
    "FLASER: more fields than its count of beams asks for": GOOD + " 1",
    "FLASER: its count is not a whole number": GOOD.replace("180", "1.5", 1),
    "FLASER: its count is not from 1 to 100000": GOOD.replace("180", "-3", 1),
    "FLASER: a field that is not a number": GOOD.replace("1.0", "x", 1),
    "FLASER: a pose that is not finite": flaser([1.0] * 180, (math.nan, 0, 0)),
    "FLASER: a time that is not finite": flaser([1.0] * 180, stamp=math.inf),
    "FLASER: ranges that are not metres": flaser([*range(3000, 3180)]),
    "ROBOTLASER1: angles that do not fit a sweep of one turn: angle_increment=1.5 looks like "
    "degrees; give radians": robotlaser([1.0] * 9, step=1.5),
    "ROBOTLASER1: fewer fields than its format has": "ROBOTLASER1 0 1 2 3",
    "ODOM: a field that is not a number": "ODOM 1 2 north",
    "not a CARMEN message": "\x1b[2J\u202e",
}


@given(st.lists(st.sampled_from(sorted(BAD)), max_size=20), st.randoms(use_true_random=False))
def test_bad_lines_are_counted_by_reason_and_cost_no_good_line(folder, reasons, random):
    lines = [BAD[reason] for reason in reasons] + [GOOD] * 3
    random.shuffle(lines)
    records, log = read(written(folder, lines))
    assert [lines[record.line - 1] for record in records] == [GOOD] * 3
    assert log.bad == {reason: reasons.count(reason) for reason in reasons}
    for reason, line in log.first_bad.items():
        assert lines.index(BAD[reason]) == line - 1


@given(st.binary(max_size=300))
def test_any_bytes_give_scans_or_a_clear_error(folder, data):
    path = folder / "bytes"
    path.write_bytes(GOOD.encode() + b"\n" + data)
    if b"\0" in data:
        with pytest.raises(LogError, match="binary"):
            read(path)
    else:
        records, log = read(path)
        assert records[0].line == 1
        assert len(records) + log.bad.total() <= 2 + data.count(b"\n")


@given(st.floats(0.01, 0.999))
def test_a_truncated_gz_log_is_read_to_the_cut_then_refused(folder, part):
    scans = [flaser(np.random.default_rng(i).uniform(0, 50, 180)) for i in range(60)]
    whole = written(folder, scans, compress=True).read_bytes()
    path = folder / "cut.gz"
    path.write_bytes(whole[: max(3, int(part * len(whole)))])
    records = []
    with pytest.raises(TruncatedLogError, match="truncated or damaged"), open_log(path) as log:
        records.extend(log)
    assert [record.line for record in records] == list(range(1, len(records) + 1))
    assert len(records) >= (60 * part - 15)


def test_a_damaged_gz_log_is_an_error_and_not_silence(folder):
    data = bytearray(written(folder, [GOOD] * 50, compress=True).read_bytes())
    data[-8] ^= 0xFF  # the checksum
    path = folder / "damaged.gz"
    path.write_bytes(data)
    with pytest.raises(TruncatedLogError, match="up to scan 50"):
        read(path)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "is empty"),
        (gzip.compress(b"", mtime=0), "is empty"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\r", "binary file"),
        (gzip.compress(b"\0" * 99, mtime=0), "binary file"),
        (b"\x1f\x8b", "truncated"),
        (b"time,range\n0,1\n", "not a log of scans"),
        (b"PARAM robot_width 0.5 host 0\n", "no laser scan"),
        (b"FLASER 180 1 2\n", "no laser scan.*fewer fields"),
    ],
)
def test_a_file_that_is_no_log_is_refused_with_what_is_right(folder, data, message):
    path = folder / "other"
    path.write_bytes(data)
    with pytest.raises(LogError, match=message):
        read(path)


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
def test_a_geometry_is_positive_and_finite(value):
    with pytest.raises(ValueError, match="range_max"):
        Geometry(range_max=value)
    with pytest.raises(ValueError, match="beam_spacing"):
        Geometry(beam_spacing=value)


def test_an_endless_line_is_passed_over(folder):
    records, log = read(written(folder, [GOOD, "FLASER 180 " + "1 " * 2**20, GOOD]))
    assert [record.line for record in records] == [1, 3]
    assert log.bad.total() == 1


def test_a_missing_file_is_an_os_error(tmp_path):
    with pytest.raises(FileNotFoundError):
        open_log(tmp_path / "none.log")


@pytest.mark.skipif(not INTEL.exists(), reason="the shared recorded logs are not here")
def test_a_real_log_reads_as_its_readme_says():
    with open_log(INTEL) as log:
        records = list(itertools.islice(log, 200))
        assert 0 < log.fraction <= 1
    assert not log.bad
    stamps = [record.stamp for record in records]
    assert stamps == sorted(stamps)
    for record in records:
        assert len(record.scan.ranges) == 180
        assert 0 < record.scan.valid.sum() <= 180
        assert math.dist(record.pose[:2], record.odometry[:2]) < 60
