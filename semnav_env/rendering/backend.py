"""The one place that imports pygame, and only when something is drawn."""

from __future__ import annotations

import functools
import os
from importlib import metadata, util
from pathlib import Path
from typing import Any


@functools.cache
def load_pygame() -> Any:
    """The pygame module with its fonts ready; no display is opened or needed.

    Raises:
        ImportError: pygame-ce is missing or broken; says how to install it.
    """
    os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
    try:
        import pygame
        import pygame.font
    except ImportError as error:
        raise ImportError(_how_to_install()) from error
    pygame.font.init()
    return pygame


def open_font(file: Path | None, pixels: int) -> Any:
    """A font of a size; it is opened again if `pygame.quit()` was called in between."""
    pygame = load_pygame()
    try:
        font = _opened_font(file, pixels)
        font.get_height()
    except pygame.error:
        _opened_font.cache_clear()
        pygame.font.quit()
        pygame.font.init()
        font = _opened_font(file, pixels)
    return font


@functools.lru_cache(64)
def _opened_font(file: Path | None, pixels: int) -> Any:
    return load_pygame().font.Font(file, pixels)


def _how_to_install() -> str:
    if _installed("pygame") and _installed("pygame-ce"):
        return (
            "pygame and pygame-ce overwrite each other's files; keep one: "
            "pip uninstall pygame pygame-ce, then pip install pygame-ce"
        )
    return 'pictures need pygame-ce: pip install "semnav-env[render]"'


def _installed(distribution: str) -> bool:
    try:
        metadata.version(distribution)
    except metadata.PackageNotFoundError:
        return False
    return True


def font_file(bold: bool) -> Path | None:
    """DejaVu Sans as matplotlib ships it, the same on every machine; None if it is not there."""
    spec = util.find_spec("matplotlib")  # finds the folder without importing the package
    if spec is None or not spec.submodule_search_locations:
        return None
    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    path = Path(spec.submodule_search_locations[0]) / "mpl-data" / "fonts" / "ttf" / name
    return path if path.exists() else None
