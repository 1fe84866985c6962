"""Pictures without a display, and in a window where there is one."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from semnav_env.rendering.viewer import Viewer
from tests.support.paths import ROOT
from tests.support.small_office import PLAIN, PLAN

pytest.importorskip("pygame", reason="pictures need the extra `render`")


@pytest.fixture(scope="module")
def viewer() -> Viewer:
    return Viewer(PLAN)


IMPORTS = """
from semnav_env.rendering.viewer import Viewer
from tests.support.small_office import PLAIN, PLAN
import pygame
"""

DRAW_WITHOUT_DISPLAY = f"""{IMPORTS}
picture = Viewer(PLAN).draw(PLAIN)
assert picture.std() > 10
assert not pygame.display.get_init() and pygame.display.get_surface() is None
print(picture.sum())
"""


def test_drawing_needs_no_display_and_prints_nothing(viewer: Viewer) -> None:
    names = ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER", "PYGAME_HIDE_SUPPORT_PROMPT")
    bare = {name: value for name, value in os.environ.items() if name not in names}
    done = subprocess.run(
        [sys.executable, "-c", DRAW_WITHOUT_DISPLAY],
        env=bare | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == str(viewer.draw(PLAIN).sum())


SHOW_IN_A_WINDOW = f"""{IMPORTS}
viewer = Viewer(PLAN, fps=1000)
assert viewer.show(PLAIN) and pygame.display.get_surface().get_size() == (960, 720)
shown = pygame.surfarray.array3d(pygame.display.get_surface()).swapaxes(0, 1)
assert (shown == viewer.draw(PLAIN)).all()
pygame.event.post(pygame.event.Event(pygame.QUIT))
assert not viewer.show(PLAIN) and not pygame.display.get_init()
assert not viewer.show(PLAIN)
viewer.close(); viewer.close()
assert viewer.show(PLAIN)
viewer.close()
"""


def run_with_driver(code: str, driver: str) -> subprocess.CompletedProcess[str]:
    environment = {
        **os.environ,
        "PYTHONPATH": str(ROOT),
        "SDL_VIDEODRIVER": driver,
        "PYGAME_HIDE_SUPPORT_PROMPT": "1",
    }
    return subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False
    )


def test_the_window_shows_the_picture_until_it_is_closed() -> None:
    done = run_with_driver(SHOW_IN_A_WINDOW, "dummy")
    assert done.returncode == 0, done.stderr


def test_a_window_without_a_display_is_refused() -> None:
    code = f"{IMPORTS}Viewer(PLAN).show(PLAIN)"
    done = run_with_driver(code, "no_such_driver")
    assert done.returncode != 0
    assert 'NoDisplayError: render_mode="human" needs a display' in done.stderr
    assert '"rgb_array" needs none' in done.stderr


def test_a_window_that_nobody_would_see_is_refused() -> None:
    displays = ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER", "XDG_RUNTIME_DIR")
    bare = {name: value for name, value in os.environ.items() if name not in displays}
    done = subprocess.run(
        [sys.executable, "-c", f"{IMPORTS}Viewer(PLAN).show(PLAIN)"],
        env=bare | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode != 0
    assert 'NoDisplayError: render_mode="human" needs a display' in done.stderr


def test_missing_pygame_is_reported_only_when_drawing() -> None:
    code = (
        "import sys; sys.modules['pygame'] = None\n"
        "import semnav_env.rendering\n"
        "from semnav_env.rendering.backend import load_pygame\nload_pygame()"
    )
    done = run_with_driver(code, "dummy")
    assert 'pip install "semnav-env[render]"' in done.stderr
