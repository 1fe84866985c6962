"""Saving pictures and films."""

from __future__ import annotations

import importlib
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from semnav_env.rendering.colours import Palette
from semnav_features.writing import replacing

Picture = NDArray[np.uint8]
"""An image, shape (height, width, 3), RGB."""


PALETTE_FRAMES = 12
"""Number of frames that the shared palette of a GIF is chosen from."""

MAX_GIF_RATE = 50.0
"""Frames per second of the fastest GIF; viewers slow down films whose frames last less than 20
ms."""


def save_video(path: str | Path, frames: Sequence[Picture], fps: float, scale: float = 1.0) -> Path:
    """Save frames as the suffix says: .gif, .mp4, or .png, which holds the last frame.

    Args:
        path: file to write; missing folders are made.
        frames: each of shape (height, width, 3), all alike.
        fps: frames per second.
        scale: size of the saved picture relative to the frames, at most 1.

    Returns:
        The path.

    Raises:
        ValueError: an unknown suffix, no frames, frames that are not alike, or bad numbers.
        ImportError: .mp4 without imageio and PyAV.
    """
    path = Path(path)
    check_suffix(path)
    match path.suffix.lower():
        case ".gif":
            return save_gif(path, frames, fps, scale)
        case ".mp4":
            return save_mp4(path, frames, fps, scale)
    if not len(frames):
        raise ValueError(f"there are no frames to save as {path}")
    return save_png(path, frames[-1], scale)


def check_suffix(path: Path, suffixes: Sequence[str] = (".gif", ".mp4", ".png")) -> None:
    """Refuse a path whose suffix is not one of some.

    Raises:
        ValueError: names the file, and the suffixes that would do.
    """
    if path.suffix.lower() not in suffixes:
        *most, last = suffixes
        wanted = f"{', '.join(most)} or {last}" if most else last
        raise ValueError(f"cannot save {path.name!r}; the name must end in {wanted}")


def save_png(path: str | Path, frame: Picture, scale: float = 1.0) -> Path:
    """Save one picture; see `save_video`."""
    target = _prepared(path, [frame], 1.0, scale)
    with replacing(target) as part:
        for picture in _alike([frame]):
            _image(picture, scale).save(part, optimize=True)
    return target


def save_gif(path: str | Path, frames: Sequence[Picture], fps: float, scale: float = 1.0) -> Path:
    """Save a film that loops, with one palette for all frames; see `save_video`.

    Frames that are equal to the one before are stored as a longer duration of it.
    """
    if fps > MAX_GIF_RATE:
        raise ValueError(f"fps is {fps}; a GIF shows at most {MAX_GIF_RATE:g}")
    target = _prepared(path, frames, fps, scale)
    palette = Palette.of([_image(frame, scale) for frame in _sampled(frames)])
    images = (palette.indexed(_image(frame, scale)) for frame in _alike(frames))
    first = next(images)
    with replacing(target) as part:
        first.save(
            part,
            save_all=True,
            append_images=images,
            duration=_durations(len(frames), fps),
            loop=0,
            optimize=True,  # marks what has not changed since the frame before
            disposal=1,
        )
    return target


def save_mp4(path: str | Path, frames: Sequence[Picture], fps: float, scale: float = 1.0) -> Path:
    """Save a film as H.264; see `save_video`. An odd last row or column is cut off."""
    target = _prepared(path, frames, fps, scale)
    try:
        importlib.import_module("av")
        imageio: Any = importlib.import_module("imageio.v3")
    except ImportError as error:
        raise ImportError(
            '.mp4 needs imageio and PyAV: pip install "semnav-env[render]", or save a .gif'
        ) from error
    with replacing(target) as part, imageio.imopen(part, "w", plugin="pyav") as film:
        film.init_video_stream("libx264", fps=fps)
        for frame in _alike(frames):
            pixels = np.asarray(_image(frame, scale))
            film.write_frame(pixels[: len(pixels) // 2 * 2, : pixels.shape[1] // 2 * 2])
    return target


def _prepared(path: str | Path, frames: Sequence[Picture], fps: float, scale: float) -> Path:
    """Check the arguments of a film."""
    if len(frames) == 0:
        raise ValueError(f"there are no frames to save as {path}")
    if not 0 < scale <= 1:
        raise ValueError(f"scale is {scale}; it must be above 0 and at most 1")
    if not 0 < fps < float("inf"):
        raise ValueError(f"fps is {fps}; it must be positive")
    return Path(path)


def _alike(frames: Iterable[Picture]) -> Iterator[Picture]:
    """The frames one by one, so that a sequence may draw each when it is its turn.

    Raises:
        ValueError: one is no picture, or of another shape than the first.
    """
    first: tuple[int, ...] | None = None
    for frame in frames:
        shape = np.shape(frame)
        first = first or shape
        if shape != first or len(shape) != 3 or shape[2] != 3:
            raise ValueError("all frames must have one shape, (height, width, 3)")
        yield frame


def _image(frame: Picture, scale: float) -> Image.Image:
    image = Image.fromarray(np.ascontiguousarray(frame, dtype=np.uint8))
    if scale == 1:
        return image
    size = max(1, round(image.width * scale)), max(1, round(image.height * scale))
    return image.resize(size, Image.Resampling.HAMMING)


def _sampled(frames: Sequence[Picture]) -> list[Picture]:
    chosen = np.linspace(0, len(frames) - 1, min(PALETTE_FRAMES, len(frames))).round().astype(int)
    return list(_alike(frames[index] for index in chosen.tolist()))


def _durations(count: int, fps: float) -> list[int]:
    """Durations of the frames in milliseconds: whole hundredths of a second that do not drift."""
    ends = np.round(100.0 * np.arange(count + 1) / fps).astype(int)
    return [int(value) for value in 10 * np.diff(ends)]
