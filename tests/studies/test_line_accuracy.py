import math

import numpy as np
import pytest

from semnav_env.world.maps import load_floor_plan
from semnav_features import Door, ExtractorSettings, Scan, Scene, Wall
from studies.features.cases import Case, CaseSituation, draw_cases
from studies.lines.command import Arguments
from studies.lines.line_accuracy import segmentations, wall_accuracy

SIGMA = 0.01


def wall_ahead(turned=0.0, at=2.0, doors=()):
    """The scan of a wall across x, and as truth the same wall turned about its middle."""
    angles = np.arange(-0.5, 0.5, 0.005)
    scan = Scan(2.0 / np.cos(angles), -0.5, 0.005)
    dx, dy = math.sin(turned), math.cos(turned)
    truth = Scene((Wall((at + dx, -dy), (at - dx, dy)),), doors)
    return Case(CaseSituation("made", "anywhere", False), (0, 0, 0), truth, ((SIGMA, scan),))


def measured(case):
    return wall_accuracy([case], SIGMA, ExtractorSettings())


def test_a_wall_found_where_it_is_has_no_error():
    row = measured(wall_ahead())
    assert (row.walls, row.off, row.bridging) == (1.0, 0.0, 0)
    assert row.median == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("degrees", [-4.0, 1.0, 3.0])
def test_the_angle_error_is_the_angle_between_the_walls(degrees):
    row = measured(wall_ahead(turned=math.radians(degrees)))
    assert row.median == row.p90 == pytest.approx(abs(degrees), abs=1e-6)


def test_a_wall_that_is_not_there_is_off():
    row = measured(wall_ahead(at=2.3))
    assert row.off == 1.0
    assert math.isnan(row.median)


def test_a_wall_across_a_door_is_counted():
    assert measured(wall_ahead(doors=(Door((2.0, -0.4), (2.0, 0.4)),))).bridging == 1
    assert measured(wall_ahead(doors=(Door((2.0, 1.2), (2.0, 2.0)),))).bridging == 0


def test_no_segmentation_draws_a_wall_across_an_open_door():
    plan, rng = load_floor_plan("heidelberg_hallway"), np.random.default_rng(3)
    cases = list(draw_cases(plan, 20, (SIGMA,), False, rng))
    for settings in segmentations(SIGMA).values():
        row = wall_accuracy(cases, SIGMA, settings)
        assert (row.bridging, row.off) == (0, 0.0)
        assert row.walls > 3


def test_the_command_compares_the_segmentations(capsys):
    assert Arguments(poses=1).run() == 0
    out = capsys.readouterr().out
    assert "end_point_fit" in out
    assert "dynamic" in out
