from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.world.lidar import BARBRET, LIDARS, TIM561, Lidar, LidarSpec, lidar_spec
from semnav_features import extract
from semnav_features.frames import Pose, compose
from tests.support.command_line import run
from tests.support.paths import ROOT
from tests.support.small_plans import empty_hall, furnished_hall

KEY = (1, 2, 3)
coordinates = st.tuples(st.floats(1, 9), st.floats(1, 5), st.floats(-math.pi, math.pi))


def test_presets_have_the_numbers_of_their_sources() -> None:
    assert (TIM561.beams, TIM561.rate_hz, TIM561.sigma) == (811, 15.0, 0.02)
    assert (TIM561.range_min, TIM561.range_max) == (0.05, 10.0)
    assert TIM561.angles[-1] - TIM561.angles[0] == pytest.approx(math.radians(270.0))
    assert TIM561.angles[405] == pytest.approx(0.0, abs=1e-12)
    assert (BARBRET.beams, BARBRET.angle_increment, BARBRET.sigma) == (786, 0.006, 0.03)
    assert BARBRET.angle_min == -2.356


def test_a_spec_is_found_by_name_or_is_itself() -> None:
    assert lidar_spec("tim561") is TIM561
    assert lidar_spec(BARBRET) is BARBRET
    with pytest.raises(ValueError, match="no lidar named 'tim651'; there are: tim561, barbret"):
        lidar_spec("tim651")
    assert all(lidar_spec(name).name == name for name in LIDARS)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("beams", 0),
        ("angle_min", 3.2),
        ("angle_min", math.nan),
        ("angle_increment", 0.0),
        ("angle_increment", -0.01),
        ("angle_increment", 0.02),
        ("range_min", -1.0),
        ("range_max", 0.05),
        ("range_max", math.inf),
        ("rate_hz", 0.0),
        ("sigma", -0.01),
        ("sigma", math.nan),
        ("dropout", 1.5),
        ("systematic", math.inf),
    ],
)
def test_a_spec_with_an_impossible_number_names_it(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"{name} is .*; it must be"):
        replace(TIM561, **{name: value})


@pytest.mark.parametrize("step", [math.pi, 4.0, 5.0])
def test_neighbouring_beams_are_less_than_half_a_turn_apart(step: float) -> None:
    assert LidarSpec("wide", 2, -1.5, 3.0).angles[1] == pytest.approx(1.5)
    with pytest.raises(ValueError, match=f"angle_increment is {step}.*; it must be .* 3"):
        LidarSpec("wide", 2, -1.5, step)


@given(coordinates, st.tuples(st.floats(-0.5, 0.5), st.floats(-0.3, 0.3), st.floats(-3, 3)))
@settings(deadline=None)
def test_a_mounted_lidar_sees_what_one_at_its_place_sees(robot: Pose, mount: Pose) -> None:
    plan = empty_hall()
    mounted = Lidar(plan, TIM561, mount).ranges(robot, KEY)
    in_place = Lidar(plan, TIM561).ranges(compose(robot, mount), KEY)
    np.testing.assert_allclose(mounted, in_place, atol=1e-9)


def test_the_beam_ahead_measures_the_distance_to_the_wall_ahead() -> None:
    lidar = Lidar(empty_hall(10.0, 6.0), TIM561, mount=(0.45, 0.0, 0.0))
    assert lidar.exact_ranges((4.0, 3.0, 0.0))[405] == pytest.approx(10.0 - 4.45)
    assert lidar.exact_ranges((4.0, 3.0, math.pi / 2))[405] == pytest.approx(6.0 - 3.45)


def test_glass_is_not_seen_and_a_door_leaf_is() -> None:
    lidar = Lidar(furnished_hall(), TIM561)
    assert lidar.exact_ranges((8.0, 1.0, 0.0))[405] == pytest.approx(4.0)
    assert lidar.exact_ranges((6.7, 3.0, math.pi / 2))[405] == pytest.approx(4.6)


def test_a_scan_carries_spec_ranges_and_time() -> None:
    lidar = Lidar(empty_hall(), replace(TIM561, rate_hz=5.0))
    scan = lidar.scan((4.0, 3.0, 0.3), (1, 2, 30))
    np.testing.assert_array_equal(scan.ranges, lidar.ranges((4.0, 3.0, 0.3), (1, 2, 30)))
    np.testing.assert_allclose(scan.angles, TIM561.angles)
    assert (scan.range_min, scan.range_max, scan.stamp) == (0.05, 10.0, 6.0)


def test_ranges_are_written_where_the_caller_wants_them() -> None:
    lidar = Lidar(empty_hall())
    out = np.full(811, np.nan)
    assert lidar.ranges((4.0, 3.0, 0.3), KEY, out) is out
    np.testing.assert_array_equal(out, lidar.ranges((4.0, 3.0, 0.3), KEY))


def test_the_same_key_gives_the_same_ranges_whatever_came_before() -> None:
    first, second = Lidar(furnished_hall()), Lidar(furnished_hall())
    for step in range(20):
        second.ranges((1.0 + step / 10, 3.0, 0.0), (9, 9, step))
    pose = (4.5, 3.3, 0.4)
    np.testing.assert_array_equal(first.ranges(pose, KEY), second.ranges(pose, KEY))
    assert not np.array_equal(first.ranges(pose, KEY), first.ranges(pose, (1, 2, 4)))


def test_the_error_of_a_scan_is_that_of_its_spec() -> None:
    lidar = Lidar(empty_hall(), replace(BARBRET, sigma=0.03))
    pose = (4.0, 3.0, 0.3)
    errors = np.concatenate(
        [lidar.ranges(pose, (5, 0, step)) - lidar.exact_ranges(pose) for step in range(50)]
    )
    assert abs(errors.std() - 0.03) < 0.001
    assert abs(errors.mean()) < 0.001


def test_any_number_of_beams_up_to_a_full_turn_is_scanned() -> None:
    for beams in (1, 2, 3, 5000):
        step = min(math.tau / max(beams - 1, 1), 3.0)
        spec = LidarSpec("any", beams, -math.pi, step)
        assert np.isfinite(Lidar(empty_hall(), spec).ranges((5.0, 3.0, 0.1), KEY)).all()


def test_the_page_of_lidars_has_a_row_for_each_with_its_numbers():
    page = (ROOT / "docs" / "guides" / "lidars.md").read_text("utf-8")
    for spec in LIDARS.values():
        (row,) = [line for line in page.splitlines() if line.startswith(f"| `{spec.name}`")]
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        assert cells[2] == str(spec.beams)
        assert cells[4] == f"{spec.range_min:g} to {spec.range_max:g}"
        assert cells[5:7] == [f"{spec.rate_hz:g}", f"{1000 * spec.sigma:g}"]


@pytest.mark.parametrize("spec", LIDARS.values(), ids=list(LIDARS))
def test_every_lidar_says_where_its_numbers_come_from_and_sees_the_walls_of_a_hall(spec):
    assert spec.source
    scan = Lidar(empty_hall(6.0, 4.0), spec).scan((3.0, 2.0, 0.1), KEY)
    assert len(scan.ranges) == spec.beams
    assert len(extract(scan).walls) >= 3


def test_a_lidar_of_no_known_name_is_refused_with_the_names_that_there_are(capsys):
    code, _, said = run(capsys, "evaluate", "val_unseen", "--episodes", "1", "--lidar", "tim999")
    assert (code, said.count("\n")) == (2, 1)
    assert "rplidar_a1" in said
