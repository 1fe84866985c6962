"""The palette of a GIF: few colours for many frames."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.spatial import cKDTree

PALETTE_SIZE = 255
"""Number of colours of a palette; a GIF holds 256, and one is left to mark unchanged pixels."""

EXACT_COLOURS = 96
"""Number of the commonest colours, which are kept exactly: drawings have large even areas."""

_UNKNOWN = 255


class Palette:
    """Maps colours to the nearest of a few, remembering each answer.

    Args:
        colours: shape (n, 3), at most `PALETTE_SIZE`.
    """

    def __init__(self, colours: NDArray[np.uint8]) -> None:
        self.colours = colours
        self._nearest = cKDTree(colours.astype(np.float64))
        self._index = np.full(1 << 24, _UNKNOWN, dtype=np.uint8)

    @classmethod
    def of(cls, samples: Sequence[Image.Image]) -> Palette:
        """The commonest colours of the samples, and others so that none is far from all."""
        codes, counts = np.unique(
            np.concatenate([_codes(image).ravel() for image in samples]), return_counts=True
        )
        colours = _colours(codes[np.argsort(-counts, kind="stable")])
        exact, others = colours[:EXACT_COLOURS], colours[EXACT_COLOURS:]
        if len(others) == 0:
            return cls(exact)
        gathered = Image.fromarray(others[None]).quantize(
            PALETTE_SIZE - EXACT_COLOURS, Image.Quantize.MAXCOVERAGE
        )
        rest = np.array(gathered.getpalette(), dtype=np.uint8).reshape(-1, 3)[
            : PALETTE_SIZE - EXACT_COLOURS
        ]
        return cls(np.concatenate((exact, rest)))

    def indexed(self, image: Image.Image) -> Image.Image:
        """The image with the nearest colours of the palette, mode P."""
        codes = _codes(image)
        unknown = np.unique(codes[self._index[codes] == _UNKNOWN])
        if len(unknown):
            self._index[unknown] = self._nearest.query(_colours(unknown).astype(np.float64))[1]
        result = Image.fromarray(self._index[codes])
        result.putpalette(self.colours.tobytes())
        return result


def _codes(image: Image.Image) -> NDArray[np.uint32]:
    """Each pixel's colour as one number, shape (height, width)."""
    weights = np.array([1 << 16, 1 << 8, 1], dtype=np.uint32)
    codes: NDArray[np.uint32] = np.asarray(image.convert("RGB")).astype(np.uint32) @ weights
    return codes


def _colours(codes: NDArray[np.uint32]) -> NDArray[np.uint8]:
    """The inverse of `_codes`, shape (n, 3)."""
    return np.stack((codes >> 16, codes >> 8 & 255, codes & 255), axis=-1).astype(np.uint8)
