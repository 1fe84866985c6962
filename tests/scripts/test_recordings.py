"""`semnav follow --rerun` and `--mcap`: recordings, read back by the packages of their makers."""

from __future__ import annotations

import base64
import json
import math
import sys
from collections import Counter

import numpy as np
import pytest

from semnav_env.language import parse
from semnav_env.mind.belief.log_following import follow_log
from semnav_features.readers import Geometry, open_log
from tests.scripts.test_log_notes import BEAMS, SCANS, write_drive
from tests.support.command_line import run

COMMAND = "go down the hallway"


@pytest.fixture
def log(tmp_path):
    return write_drive(tmp_path / "drive.log")


def believed(log):
    """Every scan of the log with the belief after it."""
    with open_log(log, Geometry(beam_spacing=1.0)) as records:
        return list(follow_log(records, parse(COMMAND)))


def test_an_mcap_file_holds_each_moment_in_the_schemas_of_foxglove(capsys, tmp_path, log):
    reader = pytest.importorskip("mcap.reader", reason='needs pip install "semnav-env[mcap]"')
    path = tmp_path / "drive.mcap"
    assert f"wrote {path}" in run(capsys, "follow", log, COMMAND, *BEAMS, "--mcap", path)[1]
    with path.open("rb") as file:
        rows = [
            (schema.name, channel.topic, message.log_time, json.loads(message.data))
            for schema, channel, message in reader.make_reader(file).iter_messages()
        ]
    counts = Counter(topic for _, topic, _, _ in rows)
    assert {counts[topic] for topic in ("/tf", "/scan", "/scene", "/goal")} == {SCANS}
    assert 1 <= counts["/said"] < SCANS
    assert {name for name, *_ in rows} == {
        *("foxglove.FrameTransform", "foxglove.PointCloud", "foxglove.SceneUpdate"),
        *("foxglove.PoseInFrame", "foxglove.Log"),
    }
    expected = believed(log)
    moved = [message for _, topic, _, message in rows if topic == "/tf"]
    for (record, belief), message in zip(expected, moved, strict=True):
        x, y, heading = belief.pose
        assert math.isclose(message["translation"]["x"], x, abs_tol=1e-4)
        assert math.isclose(message["translation"]["y"], y, abs_tol=1e-4)
        assert math.isclose(message["rotation"]["z"], math.sin(heading / 2), abs_tol=1e-9)
        stamp = message["timestamp"]
        assert math.isclose(stamp["sec"] + stamp["nsec"] / 1e9, record.stamp, abs_tol=1e-6)
    cloud = next(message for _, topic, _, message in rows if topic == "/scan")
    points = np.frombuffer(base64.b64decode(cloud["data"]), "<f4").reshape(-1, 3)
    assert len(points) == expected[0][0].scan.valid.sum()  # seen from the origin
    ends = np.hypot(points[:, 0], points[:, 1])
    np.testing.assert_allclose(
        ends, expected[0][0].scan.ranges[expected[0][0].scan.valid], rtol=1e-5
    )
    scene = [message for _, topic, _, message in rows if topic == "/scene"][-1]
    assert len(scene["entities"][0]["lines"][0]["points"]) == 2 * len(expected[-1][1].scene.walls)


def test_a_rerun_file_holds_each_moment(capsys, tmp_path, log):
    chunk = pytest.importorskip("rerun.chunk", reason='needs pip install "semnav-env[rerun]"')
    path = tmp_path / "drive.rrd"
    assert f"wrote {path}" in run(capsys, "follow", log, COMMAND, *BEAMS, "--rerun", path)[1]
    expected = believed(log)
    for entity in ("/world/walls", "/world/goal", "/said"):
        assert len(column(chunk, path, entity)) == SCANS, entity
    origins = column(chunk, path, "/world/robot", "Arrows3D:origins")
    poses = [belief.pose for _, belief in expected]
    np.testing.assert_allclose([each[0][:2] for each in origins], [p[:2] for p in poses], atol=1e-6)
    hits = column(chunk, path, "/world/scan", "Points3D:positions")
    assert [len(each) for each in hits] == [record.scan.valid.sum() for record, _ in expected]


def column(chunk, path, entity, name="stamp"):
    """The values of an entity in the order of time; without a name its times, nanoseconds."""
    values = []
    for part in chunk.RrdReader(path).stream():
        if part.entity_path == entity:
            batch = part.to_record_batch()
            times = batch.column("stamp").cast("int64").to_pylist()
            found = times if name == "stamp" else batch.column(name).to_pylist()
            values += zip(times, found, strict=True)
    return [value for _, value in sorted(values, key=lambda pair: pair[0])]


@pytest.mark.parametrize(("option", "module"), [("rerun", "rerun"), ("mcap", "mcap.writer")])
def test_without_its_extra_the_option_says_what_to_install(
    capsys, tmp_path, log, monkeypatch, option, module
):
    monkeypatch.setitem(sys.modules, module, None)
    words = ["follow", log, COMMAND, *BEAMS, f"--{option}", tmp_path / f"a.{option}"]
    code, _, said = run(capsys, *words)
    assert (code, said.count("\n")) == (2, 1)
    assert f'pip install "semnav-env[{option}]"' in said
    assert list(tmp_path.glob("*a.*")) == []


def test_the_log_is_never_written_over(capsys, log):
    before = log.read_bytes()
    assert run(capsys, "follow", log, COMMAND, *BEAMS, "--mcap", log)[0] == 2
    assert log.read_bytes() == before
