from __future__ import annotations

import math
import shutil
import sqlite3
import struct
import sys
from contextlib import closing, suppress

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from semnav_features.readers import Geometry, LogError, TruncatedLogError, open_log

pytest.importorskip("rosbags", reason="the extra `ros` is not installed")

from tests.support.bags import KINDS, BagFile, Moved, Said, Sweep, storage

every_kind = pytest.mark.parametrize("kind", KINDS)
COMPRESSIONS = [("ros1", "bz2"), ("ros1", "lz4"), ("mcap", "storage"), ("sqlite3", "message")]


def read(path, topic=None, geometry=None):
    with open_log(path, geometry, topic) as log:
        return list(log), log


def sweeps(count, beams=90, topic="/scan"):
    rng = np.random.default_rng(3)
    return [Sweep(rng.uniform(0.2, 11.0, beams), 10.0 + i, topic) for i in range(count)]


@every_kind
def test_a_laser_scan_comes_back_as_it_was_written(tmp_path, kind):
    written = sweeps(5)
    records, log = read(BagFile(kind, [Said(), *written, Said()]).write(tmp_path))
    assert (log.scans, log.unit, log.bad, log.fraction) == (5, "message", {}, 1.0)
    assert [record.line for record in records] == [1, 2, 3, 4, 5]
    for sweep, record in zip(written, records, strict=True):
        np.testing.assert_array_equal(record.scan.ranges, sweep.ranges.astype(np.float32))
        assert record.scan.angle_min == pytest.approx(sweep.angle_min)
        assert record.scan.angle_increment == pytest.approx(sweep.angle_increment)
        assert record.scan.range_min == pytest.approx(sweep.range_min)
        assert record.scan.range_max == pytest.approx(sweep.range_max)
        assert record.stamp == pytest.approx(sweep.time)
        assert (record.pose, record.odometry) == (None, None)


@pytest.mark.parametrize(("kind", "compression"), COMPRESSIONS)
def test_compressed_bags_hold_the_same_scans(tmp_path, kind, compression):
    plain, _ = read(BagFile(kind, sweeps(8)).write(tmp_path, "plain"))
    packed, _ = read(BagFile(kind, sweeps(8), compression).write(tmp_path, "packed"))
    for one, other in zip(plain, packed, strict=True):
        np.testing.assert_array_equal(one.scan.ranges, other.scan.ranges)


@every_kind
def test_the_file_of_a_bag_is_enough_whatever_its_name(tmp_path, kind):
    bag = BagFile(kind, sweeps(4)).write(tmp_path)
    bare = shutil.copy(storage(bag), tmp_path / "recorded")
    for path in (storage(bag), bare):
        assert len(read(path)[0]) == 4


@pytest.mark.parametrize("kind", ["sqlite3", "mcap"])
def test_a_folder_without_metadata_is_read_by_its_files(tmp_path, kind):
    bag = BagFile(kind, sweeps(4)).write(tmp_path)
    (bag / "metadata.yaml").unlink()
    assert len(read(bag)[0]) == 4


@every_kind
@given(st.lists(st.one_of(st.none(), st.floats(-3.0, 3.0)), min_size=1, max_size=8))
@settings(max_examples=10, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_odometry_is_that_of_the_last_message_before(tmp_path, kind, headings):
    messages = [
        Sweep([1.0, 2.0], time=1.0 + i) if heading is None else Moved((i, -i, heading), 1.0 + i)
        for i, heading in enumerate(headings)
    ]
    messages.append(Sweep([1.0, 2.0], time=99.0))
    folder = tmp_path / str(len(list(tmp_path.iterdir())))
    folder.mkdir()
    records, _ = read(BagFile(kind, messages).write(folder))
    expected = None
    answers = iter(records)
    for message in messages:
        if isinstance(message, Moved):
            expected = message.pose
        else:
            odometry = next(answers).odometry
            assert odometry == (expected and pytest.approx(expected))


def test_odometry_is_taken_from_the_topic_with_the_nearest_name(tmp_path):
    messages = [Moved((i, 0.0, 0.0), i, f"/robot{i}/odom") for i in (1, 2, 3)]
    messages += [Sweep([1.0], 5.0, f"/robot{i}/scan") for i in (1, 2, 3)]
    path = BagFile("mcap", messages).write(tmp_path)
    for i in (1, 2, 3):
        [record], _ = read(path, f"/robot{i}/scan")
        assert record.odometry == (i, 0.0, 0.0)


@every_kind
def test_several_topics_are_listed_to_choose_from(tmp_path, kind):
    messages = sweeps(3, topic="/front") + sweeps(2, topic="/rear") + [Moved((0, 0, 0))]
    path = BagFile(kind, messages).write(tmp_path)
    listed = r"/front \(3 messages\), /rear \(2 messages\)$"
    with pytest.raises(LogError, match="several topics.*" + listed):
        open_log(path)
    with pytest.raises(LogError, match="no scans on topic '/side'.*" + listed):
        open_log(path, topic="/side")
    with pytest.raises(LogError, match="no scans on topic '/odom'.*" + listed):
        open_log(path, topic="/odom")
    assert len(read(path, "/front")[0]) == 3
    assert len(read(path, "rear")[0]) == 2


@every_kind
def test_a_bag_without_scans_lists_what_it_has(tmp_path, kind):
    path = BagFile(kind, [Said(), Said()]).write(tmp_path)
    with pytest.raises(
        LogError, match=r"no topic of .*LaserScan.*/chatter \(std_msgs/msg/String, 2"
    ):
        open_log(path)
    with pytest.raises(LogError, match="no messages"):
        open_log(BagFile(kind, []).write(tmp_path, "empty"))


BAD = {
    "angles that do not fit a sweep of one turn": dict(angle_increment=0.0),
    "limits of the range that are out of order": dict(range_min=20.0),
    "ranges that are not metres": dict(ranges=np.arange(4000.0, 4090.0)),
    "no beams": dict(ranges=[]),
    "angles that do not fit a sweep of one turn: angle_min=-135 looks like degrees; give radians": {
        "angle_min": -135.0,
        "angle_increment": 0.25,
    },
    "angles that do not fit a sweep of one turn: angle_increment=0.25 looks like degrees; "
    "give radians": {"angle_increment": 0.25},
}


@every_kind
def test_bad_messages_are_counted_by_reason_and_cost_no_good_one(tmp_path, kind):
    bad = [Sweep(**{"ranges": np.ones(90), **fault}) for fault in BAD.values()]
    good = Sweep(np.ones(90))
    path = BagFile(kind, [good, *bad, good]).write(tmp_path)
    records, log = read(path)
    assert [record.line for record in records] == [1, 2 + len(BAD)]
    assert log.bad == {f"/scan: {reason}": 1 for reason in BAD}
    assert log.first_bad == {f"/scan: {reason}": 2 + i for i, reason in enumerate(BAD)}


def test_a_clockwise_scanner_gives_the_same_scan_turned_over(tmp_path):
    ranges = np.linspace(1.0, 2.0, 90).astype(np.float32)
    there = Sweep(ranges, 1.0, "/there", angle_min=-0.5)
    back = Sweep(ranges[::-1], 1.0, "/back", angle_min=-0.5 + 0.89, angle_increment=-0.01)
    path = BagFile("mcap", [there, back]).write(tmp_path)
    one, other = (read(path, topic)[0][0].scan for topic in ("/there", "/back"))
    np.testing.assert_array_equal(one.ranges, other.ranges)
    np.testing.assert_allclose(one.angles, other.angles, atol=1e-6)


@pytest.mark.parametrize("beams", [360, 361, 725])
def test_a_full_circle_may_repeat_beams(tmp_path, beams):
    step = 2 * math.pi / (beams // 2 * 2 if beams < 700 else 720)
    sweep = Sweep(np.ones(beams), angle_min=-math.pi, angle_increment=step)
    [record], _ = read(BagFile("ros1", [sweep]).write(tmp_path))
    assert len(record.scan.ranges) == beams


def test_no_limit_of_its_own_leaves_the_geometrys(tmp_path):
    bag = BagFile("ros1", [Sweep([1.0, 2.0], range_max=limit) for limit in (0.0, math.inf, 9.0)])
    records, _ = read(bag.write(tmp_path), geometry=Geometry(range_max=20.0))
    assert [record.scan.range_max for record in records] == [20.0, 20.0, 9.0]


def test_a_message_without_a_stamp_has_the_time_of_its_recording(tmp_path):
    bag = BagFile("mcap", [Sweep([1.0], time=0.0), Sweep([1.0], time=5.0)])
    assert [record.stamp for record in read(bag.write(tmp_path))[0]] == [0.0, 5.0]


@every_kind
@given(part=st.floats(0.02, 0.98))
@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_bag_cut_short_gives_what_is_readable_then_one_error(tmp_path, kind, part):
    bag = tmp_path / ("bag.bag" if kind == "ros1" else "bag")
    if not bag.exists():
        BagFile(kind, sweeps(300, 300)).write(tmp_path)
    whole = storage(bag).read_bytes()
    cut = tmp_path / f"cut{storage(bag).suffix}"
    cut.write_bytes(whole[: int(part * len(whole))])
    records = []
    with pytest.raises(TruncatedLogError, match="truncated or damaged"), open_log(cut) as log:
        records.extend(log)
    assert [record.line for record in records] == list(range(1, len(records) + 1))
    if kind == "sqlite3":
        assert len(records) >= 300 * part - 30


@every_kind
@given(st.integers(0, 10**9), st.integers(1, 255))
@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_flipped_byte_costs_at_most_what_follows_it(tmp_path, kind, place, mask):
    bag = tmp_path / ("bag.bag" if kind == "ros1" else "bag")
    if not bag.exists():
        BagFile(kind, sweeps(20)).write(tmp_path)
    data = bytearray(storage(bag).read_bytes())
    data[place % len(data)] ^= mask
    path = tmp_path / "flipped"
    path.write_bytes(data)
    records = []
    with suppress(LogError), open_log(path) as log:
        records.extend(log)
    assert len(records) <= 20


@pytest.mark.parametrize(("kind", "compression"), COMPRESSIONS)
@pytest.mark.parametrize("index", ["with", "without"])
def test_damage_to_compressed_data_is_one_error(tmp_path, kind, compression, index):
    path = storage(BagFile(kind, sweeps(300, 300), compression).write(tmp_path))
    data = bytearray(path.read_bytes())
    middle = len(data) // 2
    data[middle : middle + 200] = bytes(200)
    path.write_bytes(data if index == "with" else data[: len(data) * 3 // 4])
    with pytest.raises(LogError, match=r"truncated or damaged|no laser scan"):
        read(path)


def test_a_bag_of_compressed_files_is_read_by_its_folder(tmp_path):
    bag = BagFile("sqlite3", sweeps(4), "file").write(tmp_path)
    assert len(read(bag)[0]) == 4
    with pytest.raises(LogError, match="compressed as a whole"):
        open_log(storage(bag))
    storage(bag).write_bytes(storage(bag).read_bytes()[:100])
    with pytest.raises(LogError, match=r"damaged, or without its metadata\.yaml"):
        open_log(bag)


@pytest.mark.parametrize("kind", ["sqlite3", "mcap"])
def test_a_folder_whose_file_is_cut_short_gives_what_is_readable(tmp_path, kind):
    bag = BagFile(kind, sweeps(900, 900)).write(tmp_path)
    whole = storage(bag).read_bytes()
    storage(bag).write_bytes(whole[: len(whole) * 9 // 10])
    records = []
    with pytest.raises(TruncatedLogError, match="truncated or damaged"), open_log(bag) as log:
        records.extend(log)
    assert 400 < len(records) < 900


def test_an_unclosed_ros1_bag_gives_all_its_chunks(tmp_path):
    path = BagFile("ros1", sweeps(30)).write(tmp_path)
    data = path.read_bytes()
    index = data.index(b"index_pos=") + len(b"index_pos=")
    path.write_bytes(data[:index] + struct.pack("<Q", 0) + data[index + 8 :])
    records = []
    with pytest.raises(TruncatedLogError, match="up to scan 30"), open_log(path) as log:
        records.extend(log)
    assert len(records) == 30


def test_mcap_of_another_profile_is_read_without_its_index(tmp_path):
    path = storage(BagFile("mcap", sweeps(3)).write(tmp_path))
    path.write_bytes(path.read_bytes().replace(b"ros2", b"none", 1))
    records, log = read(path)
    assert len(records) == 3
    assert log.fraction == 1.0


def test_scans_in_an_encoding_that_is_not_ross_are_named(tmp_path):
    path = storage(BagFile("mcap", sweeps(3)).write(tmp_path))
    path.write_bytes(path.read_bytes().replace(b"\x03\0\0\0cdr", b"\x03\0\0\0xml"))
    with pytest.raises(LogError, match=r"in ROS's encodings; it has /scan .*LaserScan, 3"):
        open_log(path)


def test_a_bag_needs_no_type_definitions(tmp_path):
    bag = BagFile("sqlite3", sweeps(3)).write(tmp_path)
    with closing(sqlite3.connect(storage(bag))) as database:
        database.execute("DELETE FROM message_definitions")
        database.commit()
    assert len(read(bag)[0]) == 3


def test_without_rosbags_the_error_names_the_extra(tmp_path, monkeypatch):
    path = BagFile("ros1", sweeps(1)).write(tmp_path)
    monkeypatch.setitem(sys.modules, "rosbags", None)
    monkeypatch.setitem(sys.modules, "rosbags.rosbag1", None)
    with pytest.raises(ImportError, match=r'pip install "semnav-env\[ros\]"'):
        open_log(path)


def test_only_a_bag_has_topics(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text("1,2,3\n")
    with pytest.raises(LogError, match="no topics; leave out topic '/scan'"):
        open_log(path, topic="/scan")
