"""Antialiased drawing in memory: shapes on a fine surface, text on the finished page.

Positions and widths are in units of the page, of which `zoom` fine pixels make one.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from semnav_env.rendering.backend import font_file, load_pygame, open_font
from semnav_env.rendering.camera import Viewport
from semnav_env.rendering.palette import WHITE, Colour
from semnav_env.rendering.text import harmless
from semnav_features.frames import FloatArray, Point, distances_along

MAX_COORDINATE = 2.0e4
"""Largest distance from the page that positions are held within, fine pixels: pygame's integers are
safe there."""

PAGE_HEIGHT = 720.0
"""Height of every page, units; all sizes show the same picture."""

SUPERSAMPLING = 2
"""Fine pixels per final pixel along each axis."""


class ShapeCanvas:
    """A surface for shapes.

    Args:
        size: fine pixels, (width, height).
        zoom: fine pixels per unit.
    """

    def __init__(self, size: tuple[int, int], zoom: float) -> None:
        self._pygame = load_pygame()
        self._surface = self._pygame.Surface(size, 0, 32)
        self.zoom = zoom

    def fill(self, colour: Colour) -> None:
        """Fill the whole surface with a colour."""
        self._surface.fill(colour)

    def polygon(self, points: ArrayLike, colour: Colour) -> None:
        """A filled polygon, shape (n, 2)."""
        fine = self._fine(points)
        if len(fine) >= 3:
            self._pygame.draw.polygon(self._surface, colour, fine)

    def stroke(self, points: ArrayLike, colour: Colour, width: float) -> None:
        """A polyline with round joints and ends, shape (n, 2)."""
        fine, thickness = self._fine(points), self._thickness(width)
        if len(fine) >= 2:
            self._pygame.draw.lines(self._surface, colour, False, fine, thickness)
        if thickness > 3:
            for point in fine:
                self._pygame.draw.circle(self._surface, colour, point, thickness / 2)

    def dashes(
        self, points: ArrayLike, colour: Colour, width: float, dash: float = 7.0, gap: float = 5.0
    ) -> None:
        """A dashed polyline, shape (n, 2)."""
        within_reach = np.clip(
            np.asarray(points, dtype=np.float64), -MAX_COORDINATE, MAX_COORDINATE
        )
        for piece in dashed(within_reach, dash, gap):
            self.stroke(piece, colour, width)

    def rays(self, start: Point, ends: ArrayLike, colour: Colour, width: float) -> None:
        """Lines from one point to many, shape (n, 2)."""
        (hub,), thickness = self._fine([start]), self._thickness(width)
        for end in self._fine(ends):
            self._pygame.draw.line(self._surface, colour, hub, end, thickness)

    def discs(self, centres: ArrayLike, radius: float, colour: Colour) -> None:
        """Filled discs, shape (n, 2)."""
        for centre in self._fine(centres):
            self._pygame.draw.circle(self._surface, colour, centre, radius * self.zoom)

    def ring(self, centre: Point, radius: float, colour: Colour, width: float) -> None:
        """A circle's outline."""
        (hub,) = self._fine([centre])
        reach = (radius + width / 2) * self.zoom
        self._pygame.draw.circle(self._surface, colour, hub, reach, self._thickness(width))

    def box(self, where: Viewport, colour: Colour, corner: float = 0.0) -> None:
        """A filled rectangle with round corners."""
        round_by = max(0, round(corner * self.zoom))
        self._pygame.draw.rect(self._surface, colour, self._rect(where), border_radius=round_by)

    def engrave(self, at: Point, text: str, colour: Colour, size: float) -> None:
        """Draw text centred at a point; later shapes may cover it. Softer than `Canvas.text`."""
        image = _font(max(4, round(size * self.zoom)), False).render(harmless(text), True, colour)
        left, top = (value * self.zoom for value in at)
        self._surface.blit(image, (left - image.get_width() / 2, top - image.get_height() / 2))

    def text_width(self, text: str, size: float, bold: bool = False) -> float:
        """Width of a text, units of the page."""
        return float(_font(self._font_pixels(size), bold).size(text)[0] * SUPERSAMPLING / self.zoom)

    def paste(self, other: ShapeCanvas, at: tuple[int, int]) -> None:
        """Copy a surface of the same zoom to a place in fine pixels."""
        self._surface.blit(other._surface, at)

    @contextmanager
    def within(self, where: Viewport) -> Iterator[None]:
        """Draw nothing outside a rectangle."""
        before = self._surface.get_clip()
        self._surface.set_clip(self._rect(where))
        try:
            yield
        finally:
            self._surface.set_clip(before)

    @contextmanager
    def highlighter(self) -> Iterator[None]:
        """Multiply colours with what lies beneath, so that dark lines show through."""
        paper, clip = self._surface, self._surface.get_clip()
        self._surface = self._blank
        self._surface.set_clip(clip)
        self._surface.fill(WHITE)
        try:
            yield
        finally:
            ink, self._surface = self._surface, paper
        paper.blit(ink, clip, clip, special_flags=self._pygame.BLEND_RGB_MULT)

    @functools.cached_property
    def _blank(self) -> Any:
        return self._pygame.Surface(self._surface.get_size(), 0, 32)

    def _fine(self, points: ArrayLike) -> list[Point]:
        array = np.asarray(points, dtype=np.float64).reshape(-1, 2) * self.zoom
        if not np.isfinite(array).all():
            array = array[np.isfinite(array).all(axis=1)]
        fine: list[Point] = np.minimum(np.maximum(array, -MAX_COORDINATE), MAX_COORDINATE).tolist()
        return fine

    def _thickness(self, width: float) -> int:
        return max(1, round(width * self.zoom))

    def _font_pixels(self, size: float) -> int:
        return max(4, round(size * self.zoom / SUPERSAMPLING))

    def _rect(self, where: Viewport) -> Any:
        corners = (where.left, where.top), (where.left + where.width, where.top + where.height)
        (x1, y1), (x2, y2) = ((round(x * self.zoom), round(y * self.zoom)) for x, y in corners)
        return self._pygame.Rect(x1, y1, x2 - x1, y2 - y1)


class Canvas(ShapeCanvas):
    """A page of shapes and text; text lies above all shapes.

    Args:
        size: final pixels, (width, height). The page is `PAGE_HEIGHT` units high at any size.
    """

    def __init__(self, size: tuple[int, int]) -> None:
        super().__init__(
            (SUPERSAMPLING * size[0], SUPERSAMPLING * size[1]),
            SUPERSAMPLING * size[1] / PAGE_HEIGHT,
        )
        self._page = self._pygame.Surface(size, 0, 32)
        self._texts: list[tuple[Any, Point, Any]] = []
        self.width, self.height = PAGE_HEIGHT * size[0] / size[1], PAGE_HEIGHT
        self.pixel = SUPERSAMPLING / self.zoom
        """Units that one final pixel is wide."""
        self._image = functools.lru_cache(512)(self._uncached_image)

    def text(
        self,
        at: Point,
        text: str,
        colour: Colour,
        size: float,
        bold: bool = False,
        centred: bool = False,
    ) -> None:
        """One line of harmless text, `at` its left or its centre, halfway up the line."""
        image = self._image(harmless(text), colour, size, bold)
        scale = self.zoom / SUPERSAMPLING
        x = at[0] * scale - (image.get_width() / 2 if centred else 0)
        place = round(x), round(at[1] * scale - image.get_height() / 2)
        self._texts.append((image, place, self._surface.get_clip()))

    def begin(self) -> None:
        """Start a page; what is not painted over keeps the shapes of the last one."""
        self._texts.clear()

    def finish(self) -> Any:
        """The pygame surface with everything drawn since `begin`."""
        self._pygame.transform.smoothscale(self._surface, self._page.get_size(), self._page)
        for image, place, clip in self._texts:
            self._page.set_clip([value // SUPERSAMPLING for value in clip])
            self._page.blit(image, place)
        self._page.set_clip(None)
        return self._page

    def _uncached_image(self, text: str, colour: Colour, size: float, bold: bool) -> Any:
        return _font(self._font_pixels(size), bold).render(text, True, colour)


def _font(pixels: int, bold: bool) -> Any:
    return open_font(font_file(bold), pixels)


def image_array(surface: Any) -> NDArray[np.uint8]:
    """A fresh array of a pygame surface, shape (height, width, 3)."""
    width, height = surface.get_size()
    data = load_pygame().image.tobytes(surface, "RGB")
    return np.frombuffer(data, np.uint8).reshape(height, width, 3).copy()


def dashed(points: FloatArray, dash: float, gap: float) -> list[FloatArray]:
    """The dashes along a polyline of shape (n, 2), each of shape (2, 2)."""
    points = points[np.isfinite(points).all(axis=1)]
    if len(points) < 2:
        return []
    along = distances_along(points)
    starts = np.arange(0.0, along[-1], dash + gap)
    ends = np.minimum(starts + dash, along[-1])
    ticks = np.stack((starts, ends), axis=1)
    x, y = (np.interp(ticks, along, points[:, axis]) for axis in (0, 1))
    return list(np.stack((x, y), axis=-1))
