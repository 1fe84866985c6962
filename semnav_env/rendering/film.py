"""A film of an episode."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

from semnav_env.rendering.video import Picture, save_video

STEPS_PER_FRAME = 3
"""Steps of the environment for each frame of a film: 5 frames a second are enough to follow it."""


class FilmedEnvironment(Protocol):
    """An environment in the mode "rgb_array"."""

    metadata: dict[str, Any]

    def render(self) -> Any:
        """The picture, shape (height, width, 3)."""
        ...


class Film:
    """Collects frames of an episode while it is driven.

    Args:
        env: what is filmed; its `render_mode` is "rgb_array".
        steps_per_frame: steps from one frame to the next; the film runs at the rate of
            `STEPS_PER_FRAME`, so more steps make it faster.
        most: largest number of frames, or None for no limit. A film that would have more leaves out
            every other frame, and so runs twice as fast.
    """

    def __init__(
        self,
        env: FilmedEnvironment,
        steps_per_frame: int = STEPS_PER_FRAME,
        most: int | None = None,
    ) -> None:
        self._env = env
        self._steps_per_frame, self._most = steps_per_frame, most
        self._steps = 0
        self.frames: list[Picture] = []

    def note(self, over: bool) -> None:
        """Take a frame if one is due.

        Args:
            over: whether the episode is over, whose last step is always shown.
        """
        if over or self._steps % self._steps_per_frame == 0:
            self._thin()
            self.frames.append(self._env.render())
        self._steps += 1

    def _thin(self) -> None:
        """Leave out every other frame where another one would be too many."""
        if self._most is not None and len(self.frames) >= self._most:
            self.frames = self.frames[::2]
            self._steps_per_frame *= 2

    def save(self, path: str | Path, scale: float = 1.0) -> None:
        """Write the film as the suffix says, see `save_video`."""
        save_video(path, self.frames, self._env.metadata["render_fps"] / STEPS_PER_FRAME, scale)
