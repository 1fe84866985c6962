"""Pictures: deterministic, without a display, and everything in a frame leaves its trace."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image
from shapely import box

from semnav_env.features.scene import Corner, CornerKind, Corridor, Door, Scene, Wall
from semnav_env.grounding.goal import Goal, GoalKind
from semnav_env.maps.floor_plan import FloorPlan, Material, PlanDoor, Region, Surface
from semnav_env.rendering import Frame, Viewer, save_gif, save_mp4, save_png, save_video
from semnav_env.rendering.camera import Viewport, looking_at
from semnav_env.rendering.text import harmless, wrap
from semnav_env.robots import SPOT, WHEELCHAIR

pytest.importorskip("pygame", reason="pictures need the extra `render`")

DOOR = Door((4.0, 0.0), (5.0, 0.0))
MAP_WIDTH = 676


def office(width: float = 10.0, height: float = 6.0) -> FloorPlan:
    """A room with a door below, a pane of glass, a cabinet and a pillar."""
    outline = ((4.0, 0.0), (0.0, 0.0), (0.0, height), (width, height), (width, 0.0), (5.0, 0.0))
    cabinet = ((1.0, 5.0), (2.0, 5.0), (2.0, 5.5), (1.0, 5.5), (1.0, 5.0))
    return FloorPlan(
        name="small_office",
        surfaces=(
            Surface(outline),
            Surface(((6.0, 4.0), (8.0, 4.0)), Material.GLASS),
            Surface(((4.0, 0.0), (3.6, -0.8)), Material.LEAF),
            Surface(cabinet, Material.FURNITURE),
            Surface(((0.0, -2.0), (width, -2.0)), assumed=True),
        ),
        doors=(PlanDoor("south", DOOR.start, DOOR.end),),
        rooms=(Region("hall", box(0, 0, width, height)),),
        corridors=(Region("walk", box(0, -2, width, 0)),),
        intersections=(),
        boundary=box(0, -2, width, height),
    )


PLAN = office()
PLAIN = Frame(PLAN, WHEELCHAIR, (3.0, 3.0, 0.3))


@pytest.fixture(scope="module")
def viewer() -> Viewer:
    return Viewer(PLAN)


def changed(before: NDArray[np.uint8], after: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Which pixels differ."""
    return np.any(before != after, axis=2)


def test_a_picture_has_the_size_that_was_asked_for() -> None:
    picture = Viewer(PLAN, size=(640, 480)).draw(PLAIN)
    assert picture.shape == (480, 640, 3)
    assert picture.dtype == np.uint8


def test_the_same_frame_gives_identical_pixels(viewer: Viewer) -> None:
    first = viewer.draw(PLAIN)
    viewer.draw(replace(PLAIN, pose=(7.0, 1.0, 2.0), command=("stop",)))
    np.testing.assert_array_equal(viewer.draw(PLAIN), first)
    np.testing.assert_array_equal(Viewer(PLAN).draw(PLAIN), first)


def test_each_picture_is_a_fresh_array(viewer: Viewer) -> None:
    first = viewer.draw(PLAIN)
    kept = first.copy()
    viewer.draw(PLAIN)[:] = 0
    np.testing.assert_array_equal(first, kept)


@pytest.mark.parametrize("robot", [WHEELCHAIR, SPOT], ids=lambda robot: robot.name)
def test_the_body_is_drawn_where_the_robot_is(viewer: Viewer, robot: object) -> None:
    start = replace(PLAIN, robot=robot, pose=(3.0, 3.0, 0.0))
    there = changed(viewer.draw(start), viewer.draw(replace(start, pose=(7.0, 1.0, 0.0))))
    scale = MAP_WIDTH / 10.8
    for x, y in ((3.0, 3.0), (7.0, 1.0)):
        column, row = round(scale * (x + 0.4)), round(360 - scale * (y - 2.0))
        assert there[row - 4 : row + 5, column - 12 : column + 13].any()
    assert not there[:, MAP_WIDTH + 10 :].any()


FEATURES = {
    "wall": {"scene": Scene(walls=(Wall((0.0, 0.0), (4.0, 0.0)),))},
    "door": {"scene": Scene(doors=(DOOR,))},
    "corridor": {"scene": Scene(corridors=(Corridor((6.0, 0.0), (6.0, 4.0)),))},
    "remembered wall": {"remembered": Scene(walls=(Wall((0.0, 0.1), (4.0, 0.1)),))},
    "remembered door": {"remembered": Scene(doors=(DOOR,))},
    "first door": {"remembered": Scene(doors=(DOOR,)), "door_numbers": {0: 1}},
    "second door": {"remembered": Scene(doors=(DOOR,)), "door_numbers": {0: 2}},
    "hits": {"hits": np.array([(6.0, 1.0), (6.0, 2.0)])},
    "beams": {"hits": np.array([(6.0, 1.0), (6.0, 2.0)]), "lidar": (3.4, 3.1)},
    "trail": {"trail": np.array([(1.0, 1.0), (3.0, 3.0)])},
    "route": {"route": np.array([(1.0, 1.0), (3.0, 3.0)])},
    "contact": {"in_contact": True},
    "status": {"status": ("t = 1.0 s",)},
    **{kind.name: {"scene": Scene(corners=(Corner((6.0, 1.0), kind),))} for kind in CornerKind},
    **{f"goal {kind.name}": {"goal": Goal(kind, (4.5, -1.0, -1.57))} for kind in GoalKind},
    "goal PASS": {"goal": Goal(GoalKind.PASS, (4.5, -1.0, -1.57), DOOR)},
    "goal REACH a door": {"goal": Goal(GoalKind.REACH, (4.5, -1.0, -1.57), DOOR)},
}


def test_every_kind_of_feature_has_a_look_of_its_own(viewer: Viewer) -> None:
    pictures = [viewer.draw(replace(PLAIN, **fields)).tobytes() for fields in FEATURES.values()]
    assert viewer.draw(PLAIN).tobytes() not in pictures
    assert len(set(pictures)) == len(pictures)


def test_progress_through_the_command_shows(viewer: Viewer) -> None:
    command = ("go down the hallway", "turn left", "stop")
    pictures = {
        viewer.draw(replace(PLAIN, command=command, active_clause=active)).tobytes()
        for active in range(4)
    }
    assert len(pictures) == 4


ODD = {
    "long": ("go through the second door on the right " * 40,),
    "one long word": ("x" * 5000,),
    "many clauses": tuple(f"turn left at intersection {n}" for n in range(300)),
    "control characters": ("go\x00to\x1bthe\ndoor\ttoday",),
    "bidi and zero width": ("go \u202eleft\u202c \u200bnow\ufeff",),
    "lone surrogate": ("door \ud800",),
    "other scripts": ("去第二扇门 🚪 الباب",),
    "empty": ("", "   "),
}


@pytest.mark.parametrize("command", ODD.values(), ids=ODD.keys())
def test_odd_commands_stay_in_the_panel(viewer: Viewer, command: tuple[str, ...]) -> None:
    frame = replace(PLAIN, command=command, active_clause=len(command) // 2, status=command[:3])
    difference = changed(viewer.draw(PLAIN), viewer.draw(frame))
    assert difference.any()
    assert not difference[:, : MAP_WIDTH - 1].any()
    assert not difference[-180:].any(), "the legend is covered"


def test_points_that_are_not_finite_are_left_out(viewer: Viewer) -> None:
    good = np.array([(6.0, 1.0), (6.0, 2.0)])
    bad = np.array([good[0], (math.nan, 0.0), good[1], (math.inf, 1.0)])
    expected = viewer.draw(replace(PLAIN, hits=good, lidar=(3.4, 3.1)))
    np.testing.assert_array_equal(viewer.draw(replace(PLAIN, hits=bad, lidar=(3.4, 3.1))), expected)


def test_things_far_outside_the_plan_draw(viewer: Viewer) -> None:
    far = replace(
        PLAIN,
        pose=(1e9, -1e9, 1.0),
        route=np.array([(0.0, 0.0), (1e12, 1e12)]),
        goal=Goal(GoalKind.REACH, (-1e7, 0.0, 0.0)),
    )
    assert viewer.draw(far).shape == (720, 960, 3)


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


def test_a_frame_of_another_plan_draws_that_plan(viewer: Viewer) -> None:
    other = office(7.0, 4.0)
    frame = Frame(other, WHEELCHAIR, (3.0, 3.0, 0.3))
    np.testing.assert_array_equal(viewer.draw(frame), Viewer(other).draw(frame))


DRAW_WITHOUT_DISPLAY = """
import test_rendering, pygame
picture = test_rendering.Viewer(test_rendering.PLAN).draw(test_rendering.PLAIN)
assert picture.std() > 10
assert not pygame.display.get_init() and pygame.display.get_surface() is None
print(picture.sum())
"""


def test_drawing_needs_no_display_and_prints_nothing(viewer: Viewer) -> None:
    names = ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER", "PYGAME_HIDE_SUPPORT_PROMPT")
    bare = {name: value for name, value in os.environ.items() if name not in names}
    done = subprocess.run(
        [sys.executable, "-c", DRAW_WITHOUT_DISPLAY],
        env=bare | {"PYTHONPATH": str(Path(__file__).parent)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == str(viewer.draw(PLAIN).sum())


SHOW_IN_A_WINDOW = """
import os, test_rendering as t, pygame
viewer = t.Viewer(t.PLAN, fps=1000)
assert viewer.show(t.PLAIN) and pygame.display.get_surface().get_size() == (960, 720)
shown = pygame.surfarray.array3d(pygame.display.get_surface()).swapaxes(0, 1)
assert (shown == viewer.draw(t.PLAIN)).all()
pygame.event.post(pygame.event.Event(pygame.QUIT))
assert not viewer.show(t.PLAIN) and not pygame.display.get_init()
assert not viewer.show(t.PLAIN)
viewer.close(); viewer.close()
assert viewer.show(t.PLAIN)
viewer.close()
"""


def run_with_driver(code: str, driver: str) -> subprocess.CompletedProcess[str]:
    environment = {
        **os.environ,
        "PYTHONPATH": str(Path(__file__).parent),
        "SDL_VIDEODRIVER": driver,
        "PYGAME_HIDE_SUPPORT_PROMPT": "1",
    }
    return subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False
    )


def test_the_window_shows_the_picture_until_it_is_closed() -> None:
    done = run_with_driver(SHOW_IN_A_WINDOW, "dummy")
    assert done.returncode == 0, done.stderr


def test_a_window_without_a_display_is_refused_with_the_alternative() -> None:
    code = "import test_rendering as t; t.Viewer(t.PLAN).show(t.PLAIN)"
    done = run_with_driver(code, "no_such_driver")
    assert done.returncode != 0
    assert 'RuntimeError: render_mode="human" needs a display' in done.stderr
    assert '"rgb_array" needs none' in done.stderr


def test_a_missing_pygame_is_only_missed_when_drawing_and_named_with_its_extra() -> None:
    code = (
        "import sys; sys.modules['pygame'] = None\n"
        "import semnav_env.rendering\n"
        "from semnav_env.rendering.backend import load_pygame\nload_pygame()"
    )
    done = run_with_driver(code, "dummy")
    assert 'pip install "semnav-env[render]"' in done.stderr


@pytest.mark.parametrize("size", [(100, 100), (400, 800)])
def test_a_size_that_cannot_hold_the_picture_is_refused(size: tuple[int, int]) -> None:
    with pytest.raises(ValueError, match="at least"):
        Viewer(PLAN, size=size)


def test_a_frame_refuses_a_pose_that_is_not_finite() -> None:
    with pytest.raises(ValueError, match="finite"):
        replace(PLAIN, pose=(math.nan, 0.0, 0.0))


def test_a_frame_refuses_points_of_the_wrong_shape() -> None:
    with pytest.raises(ValueError, match=r"trail has shape \(3,\)"):
        replace(PLAIN, trail=np.zeros(3))


def test_a_frame_refuses_numbers_for_doors_that_are_not_remembered() -> None:
    with pytest.raises(ValueError, match="1 doors are remembered"):
        replace(PLAIN, remembered=Scene(doors=(DOOR,)), door_numbers={1: 1})


@given(st.text(max_size=300), st.floats(1.0, 60.0))
def test_wrapped_lines_fit_and_keep_every_character(text: str, width: float) -> None:
    lines = wrap(text, width, len, most=10_000)
    assert all(len(line) <= width for line in lines)
    assert "".join(lines).replace(" ", "") == harmless(text).replace(" ", "")


@given(st.text(alphabet="ab c", min_size=50, max_size=300))
def test_wrapping_stops_at_the_most_lines_with_an_ellipsis(text: str) -> None:
    full, cut = wrap(text, 9.0, len, most=10_000), wrap(text, 9.0, len, most=3)
    assert len(cut) == min(3, len(full))
    assert cut[-1].endswith("…") == (len(full) > 3)
    assert all(len(line) <= 9 for line in cut)


@given(st.text(max_size=600))
@settings(max_examples=50)
def test_harmless_text_prints_and_stays_harmless(text: str) -> None:
    assert harmless(text).isprintable()
    assert harmless(harmless(text)) == harmless(text)


@pytest.fixture(scope="module")
def film(viewer: Viewer) -> list[NDArray[np.uint8]]:
    return [viewer.draw(replace(PLAIN, pose=(2.0 + 0.2 * k, 3.0, 0.1))) for k in range(7)]


def test_a_gif_has_the_frames_and_the_duration_it_was_given(
    tmp_path: Path, film: list[NDArray[np.uint8]]
) -> None:
    path = save_gif(tmp_path / "new" / "folder" / "run.gif", film, fps=15)
    with Image.open(path) as gif:
        assert gif.n_frames == len(film)
        durations = []
        for index, frame in enumerate(film):
            gif.seek(index)
            durations.append(gif.info["duration"])
            error = np.abs(np.asarray(gif.convert("RGB"), dtype=float) - frame)
            assert error.mean() < 0.5
            assert error.max() < 40.0
    assert sum(durations) == pytest.approx(1000 * len(film) / 15, abs=10)


@pytest.mark.parametrize("shades", [1, 255, 100_000])
def test_a_gif_of_any_number_of_colours_stays_close(tmp_path: Path, shades: int) -> None:
    noise = np.random.default_rng(0).integers(0, shades, (100, 100))
    frame = np.stack((noise % 251, noise // 251 % 251, noise % 7), axis=-1).astype(np.uint8)
    with Image.open(save_gif(tmp_path / "noise.gif", [frame], fps=10)) as gif:
        error = np.abs(np.asarray(gif.convert("RGB"), dtype=float) - frame)
    assert error.mean() < (0.5 if shades < 256 else 20.0)


def test_equal_frames_of_a_gif_last_as_long_as_they_should(
    tmp_path: Path, film: list[NDArray[np.uint8]]
) -> None:
    path = save_gif(tmp_path / "still.gif", [film[0], film[0], film[1]], fps=10)
    with Image.open(path) as gif:
        assert gif.n_frames == 2
        assert gif.info["duration"] == 200


def test_a_film_can_be_saved_smaller(tmp_path: Path, film: list[NDArray[np.uint8]]) -> None:
    with Image.open(save_video(tmp_path / "run.gif", film, fps=10, scale=0.5)) as gif:
        assert gif.size == (480, 360)


def test_an_mp4_has_the_frames_it_was_given(tmp_path: Path, film: list[NDArray[np.uint8]]) -> None:
    imageio = pytest.importorskip("imageio.v3", reason="mp4 needs the extra `render`")
    pytest.importorskip("av", reason="mp4 needs the extra `render`")
    path = save_mp4(tmp_path / "run.mp4", [frame[:, :-1] for frame in film], fps=10)
    frames = imageio.imread(path, plugin="pyav")
    assert frames.shape == (len(film), 720, 958, 3)
    assert np.abs(frames[3].astype(float) - film[3][:, :958]).mean() < 5.0


def test_a_png_holds_the_last_frame_exactly(tmp_path: Path, film: list[NDArray[np.uint8]]) -> None:
    with Image.open(save_video(tmp_path / "end.png", film, fps=10)) as image:
        np.testing.assert_array_equal(np.asarray(image), film[-1])
    assert save_png(tmp_path / "one.png", film[0]).exists()


def test_an_unknown_suffix_is_refused_with_those_there_are(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"\.gif, \.mp4 or \.png"):
        save_video(tmp_path / "run.avi", [np.zeros((4, 4, 3), np.uint8)], fps=10)


@pytest.mark.parametrize("name", ["run.gif", "run.mp4", "run.png"])
def test_no_frames_are_refused_and_leave_no_file(tmp_path: Path, name: str) -> None:
    with pytest.raises(ValueError, match="no frames"):
        save_video(tmp_path / name, [], fps=10)
    assert not (tmp_path / name).exists()


@pytest.mark.parametrize(("fps", "scale"), [(0.0, 1.0), (math.nan, 1.0), (10.0, 0.0), (10.0, 2.0)])
def test_bad_rates_and_scales_are_refused(tmp_path: Path, fps: float, scale: float) -> None:
    with pytest.raises(ValueError, match="it must be"):
        save_gif(tmp_path / "run.gif", [np.zeros((4, 4, 3), np.uint8)], fps, scale)
