"""Reads images of maps safely: which pixels are solid."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError
from scipy.ndimage import binary_closing

from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.frames import FloatArray
from semnav_features.reading import check_file

MAX_PIXELS = 25_000_000
"""Number of pixels beyond which an image is refused before it is decoded."""

MAX_IMAGE_BYTES = 200_000_000
"""Size of the largest image file that is read, bytes: `MAX_PIXELS` of eight bytes."""

IMAGE_FORMATS = ("PPM", "PNG", "BMP", "TIFF", "GIF")
"""Formats of images that Pillow may read."""


def read_grey(path: Path) -> FloatArray:
    """Brightness of every pixel, 0 black to 255 white, shape (rows, columns).

    Colours are averaged, as in ROS's map_server; transparent pixels count as unknown grey.

    Raises:
        FloorPlanError: no such file, no image, or too many pixels.
    """
    try:
        check_file(path, MAX_IMAGE_BYTES, FloorPlanError)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            with Image.open(path, formats=IMAGE_FORMATS) as image:
                _check_size(path, image.width, image.height)
                return _brightness(image)
    except UnidentifiedImageError:
        raise FloorPlanError(
            f"{path}: no image that can be read; give a {', '.join(IMAGE_FORMATS)} file"
        ) from None
    except Image.DecompressionBombError:
        raise FloorPlanError(_too_large(path, "far more")) from None
    except (OSError, SyntaxError, ValueError, EOFError) as error:
        if isinstance(error, FloorPlanError):
            raise
        raise FloorPlanError(f"{path}: cannot be read: {_reason(error)}") from None


def _check_size(path: Path, width: int, height: int) -> None:
    if width * height > MAX_PIXELS:
        raise FloorPlanError(_too_large(path, f"{width} x {height} ="))


def _too_large(path: Path, what: str) -> str:
    return (
        f"{path}: {what} pixels; at most {MAX_PIXELS:,} are read: crop the map or "
        "make its resolution coarser"
    )


def _reason(error: Exception) -> str:
    stated = error.strerror if isinstance(error, OSError) else None
    return stated or str(error) or type(error).__name__


def _brightness(image: Image.Image) -> FloatArray:
    if image.mode.startswith("I;16") or image.mode in ("I", "F"):
        values = np.asarray(image, dtype=np.float64)
        return values / 257.0 if values.max(initial=0.0) > 255.0 else values
    if image.mode in ("1", "L"):
        return np.asarray(image.convert("L"), dtype=np.float64)
    rgba = np.asarray(image.convert("RGBA"))
    grey = np.empty(rgba.shape[:2])
    for row, pixels in enumerate(rgba):  # all at once would take eight times the memory
        grey[row] = pixels[:, :3].mean(axis=1)
        grey[row][pixels[:, 3] == 0] = UNKNOWN_GREY
    return grey


UNKNOWN_GREY = 205.0
"""Brightness that map_saver writes for unknown pixels."""


def solid_pixels(grey: FloatArray, threshold: float, negate: bool) -> NDArray[np.bool_]:
    """Mask of the occupied pixels: darker than the threshold, or lighter if `negate`.

    The occupancy is (255 - brightness) / 255, or brightness / 255 if `negate` (ROS map_server).
    """
    occupancy = grey / 255.0 if negate else (255.0 - grey) / 255.0
    return np.asarray(occupancy > threshold)


def free_pixels(grey: FloatArray, threshold: float, negate: bool) -> NDArray[np.bool_]:
    """Which pixels are known to be free."""
    occupancy = grey / 255.0 if negate else (255.0 - grey) / 255.0
    return np.asarray(occupancy < threshold)


def mended(solid: NDArray[np.bool_], gap: int) -> NDArray[np.bool_]:
    """The solid pixels with small gaps closed, as walls in maps of robots have them."""
    if not gap:
        return solid
    wide = np.pad(solid, gap + 1)
    closed = binary_closing(wide, np.ones((gap + 1, gap + 1), dtype=bool))
    inside = slice(gap + 1, -gap - 1)
    return np.asarray(solid | closed[inside, inside])
