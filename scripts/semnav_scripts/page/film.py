"""A GIF of a run, drawn when somebody asks for it."""

from __future__ import annotations

import tempfile
import threading
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.rendering.film import STEPS_PER_FRAME
from semnav_env.rendering.frame import Frame

if TYPE_CHECKING:
    from semnav_env.rendering.viewer import Viewer

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
        pictures = Drawn(Viewer(frames[0].floor_plan), frames)
        path = save_gif(Path(folder) / "run.gif", pictures, control_hz / STEPS_PER_FRAME, SCALE)
        return path.read_bytes()


class Drawn(Sequence[NDArray[np.uint8]]):
    """Pictures that are drawn when they are asked for: all at once would take up to 1.6 GB.

    Args:
        viewer: draws them.
        frames: what they show.
    """

    def __init__(self, viewer: Viewer, frames: Sequence[Frame]) -> None:
        self._viewer, self._frames = viewer, frames

    def __len__(self) -> int:
        return len(self._frames)

    def __getitem__(self, index: Any) -> Any:
        return self._viewer.draw(self._frames[index])
