"""A GIF of a run, drawn when somebody asks for it."""

from __future__ import annotations

import tempfile
import threading
from collections.abc import Sequence
from pathlib import Path

from semnav_env.rendering.film import STEPS_PER_FRAME
from semnav_env.rendering.frame import Frame

SCALE = 0.6
"""Size of the film relative to other films: small enough to send and to show on a page."""

_ONE_AT_A_TIME = threading.Lock()
"""Drawing takes memory and a core, and pygame is not made for several threads."""


def gif(frames: Sequence[Frame], control_hz: float) -> bytes:
    """The film as the bytes of a GIF.

    Args:
        frames: in order, each `STEPS_PER_FRAME` steps after the one before.
        control_hz: steps in a second.

    Raises:
        ValueError: there are no frames.
        ImportError: the extra "render" is not installed.
    """
    if not frames:
        raise ValueError("there is no film yet; give a command first")
    from semnav_env.rendering.video import save_gif
    from semnav_env.rendering.viewer import Viewer

    with _ONE_AT_A_TIME, tempfile.TemporaryDirectory() as folder:
        viewer = Viewer(frames[0].floor_plan)
        pictures = [viewer.draw(frame) for frame in frames]
        path = save_gif(Path(folder) / "run.gif", pictures, control_hz / STEPS_PER_FRAME, SCALE)
        return path.read_bytes()
