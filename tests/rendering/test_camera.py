"""The view of a floor plan: all of a small one, and the robot's surroundings of a large one."""

from __future__ import annotations

import numpy as np
import pytest

from semnav_env.rendering.camera import Viewport, looking_at
from semnav_env.rendering.frame import Frame
from semnav_env.rendering.viewer import Viewer
from semnav_env.robots import SPOT
from tests.support.small_office import office

pytest.importorskip("pygame", reason="pictures need the extra `render`")


def test_a_large_plan_is_followed_at_sixteen_metres_across() -> None:
    view = Viewport(0.0, 0.0, 640.0, 720.0)
    bounds = (0.0, 0.0, 100.0, 80.0)
    camera = looking_at(bounds, (50.0, 40.0), view, 0.5)
    assert camera.scale == pytest.approx(40.0)
    assert camera.pixel((50.0, 40.0)) == pytest.approx((320.0, 360.0), abs=0.5)
    corner = looking_at(bounds, (0.0, 0.0), view, 0.5)
    assert corner.pixel((0.0, 0.0)) == pytest.approx((16.0, 704.0), abs=0.5)


def test_a_small_plan_is_shown_whole_wherever_the_robot_is() -> None:
    view = Viewport(0.0, 0.0, 640.0, 720.0)
    cameras = {looking_at((0.0, 0.0, 10.0, 8.0), (x, 1.0), view, 0.5) for x in (0.0, 5.0, 9.0)}
    assert len(cameras) == 1
    pixels = cameras.pop().pixels([(0.0, 0.0), (10.0, 8.0)])
    assert (pixels > 0).all()
    assert (pixels < (640.0, 720.0)).all()


def test_the_view_follows_the_robot_through_a_large_plan() -> None:
    plan = office(60.0, 40.0)
    viewer = Viewer(plan)
    frames = [Frame(plan, SPOT, (x, 20.0, 0.0)) for x in (20.0, 30.0)]
    first, second = (viewer.draw(frame)[250:470, 230:450] for frame in frames)
    np.testing.assert_allclose(first.mean(), second.mean(), atol=8.0)
    assert first.std() > 10.0, "the body is not in the middle of the view"
