"""One clear error for commands that open a window where there is no display."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from semnav_env.rendering.window import NoDisplayError


@contextmanager
def needing_display(instead: str) -> Iterator[None]:
    """Refuse what opens a window if there is no display.

    Args:
        instead: what to do without one.

    Raises:
        ValueError: there is none; says what to do instead.
    """
    try:
        yield
    except NoDisplayError as error:
        raise ValueError(f"a window needs a display ({error.__cause__}); {instead}") from error
