"""The window of `render_mode="human"` and of `semnav play`."""

from __future__ import annotations

import os
from typing import Any

from semnav_env.rendering.backend import load_pygame

UNSEEN = "offscreen"
"""What SDL takes where it finds no display; nobody sees its windows, or could close them."""


class NoDisplayError(RuntimeError):
    """There is no display on which a window could be opened; its cause says why."""


class Window:
    """A window that shows finished pages at a steady rate.

    Args:
        size: pixels, (width, height).
        title: title of the window.
        fps: pages per second that `present` slows down to.

    Raises:
        NoDisplayError: there is no display.
    """

    def __init__(self, size: tuple[int, int], title: str, fps: float) -> None:
        self._pygame, self._fps = load_pygame(), fps
        try:
            self._pygame.display.init()
            if self._pygame.display.get_driver() == UNSEEN and "SDL_VIDEODRIVER" not in os.environ:
                self._pygame.display.quit()
                raise self._pygame.error("none was found")
            self._screen = self._pygame.display.set_mode(size)
        except self._pygame.error as error:
            raise NoDisplayError(
                f'render_mode="human" needs a display ({error}); "rgb_array" needs none'
            ) from error
        self._pygame.display.set_caption(title)
        self._clock = self._pygame.time.Clock()
        self.is_open = True

    def present(self, page: Any) -> bool:
        """Show a page and wait for the time of the next; False once the user closed the window."""
        if self.is_open and self._pygame.event.get(self._pygame.QUIT):
            self.close()
        if self.is_open:
            self._screen.blit(page, (0, 0))
            self._pygame.display.flip()
            self._clock.tick(self._fps)
        return self.is_open

    def events(self) -> list[Any]:
        """What was done since the last call, as events of pygame; none once it is closed."""
        return self._pygame.event.get() if self.is_open else []

    def close(self) -> None:
        """Close the window; a second call does nothing."""
        if self.is_open:
            self.is_open = False
            self._pygame.display.quit()
