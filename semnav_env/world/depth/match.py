"""Simulates a stereo pair on an exact depth image: gaps, errors and points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.depth.rasterise import NOTHING
from semnav_env.world.lidar.counter_rng import bits, normal, stream, uniform
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

PATCH = 8
"""Side of the patches of pixels that lack texture together, pixels."""

_HIDDEN = 1.08
"""Factor of depth by which a surface that the second camera sees must be nearer to hide a point: a
slanted wall differs by less from pixel to pixel."""

_EDGE = 0.1
"""Relative difference of the reciprocal depths of neighbours that makes an edge."""

_PIXELS, _PATCHES, _EDGES, _MISMATCHES = range(4)
"""Streams of random numbers of a camera."""


@kernel
def match(
    inverse: FloatArray,
    faces: NDArray[np.int64],
    second: FloatArray,
    kinds: NDArray[np.int64],
    missing: FloatArray,
    us: FloatArray,
    vs: FloatArray,
    camera: np.ndarray,
    seed: int,
    number: int,
    points: FloatArray,
    hits: NDArray[np.int64],
) -> int:
    """Write the points that a camera measures; returns how many.

    Args:
        inverse: reciprocal depths of the first camera, 1/m, shape (rows, columns).
        faces: index of the face that each of its pixels sees.
        second: reciprocal depths of the second camera, 1/m.
        kinds: `FaceKind` of each face.
        missing: share of the pixels without a match, by kind.
        us: of the columns.
        vs: of the rows.
        camera: `DepthCamera.record`.
        seed: of the image's errors.
        number: of the camera in its rig.
        points: camera frame, metres, shape (rows * columns, 3); written.
        hits: index of the face of each point; written.
    """
    c = camera[0]
    step = us[0] - us[1] if len(us) > 1 else 1.0
    nearest, farthest = 1.0 / c.range_min, 1.0 / c.range_max
    pixels, patches = stream(seed, number, _PIXELS), stream(seed, number, _PATCHES)
    edges, mismatches = stream(seed, number, _EDGES), stream(seed, number, _MISMATCHES)
    found = 0
    for row in range(inverse.shape[0]):
        for i in range(inverse.shape[1]):
            depth, face = inverse[row, i], faces[row, i]
            if face == NOTHING or depth >= nearest:
                continue
            index = row * inverse.shape[1] + i
            if c.baseline != 0.0:
                across = us[i] + c.baseline * depth
                column = int(np.rint((us[0] - across) / step))
                if not 0 <= column < len(us) or second[row, column] > _HIDDEN * depth:
                    continue
            word = bits(pixels, index)
            patch = uniform(bits(patches, (row // PATCH) * 65536 + i // PATCH))
            share = 0.5 * missing[kinds[face]]
            if patch < share or uniform(word) < share:
                continue
            if uniform(bits(mismatches, index)) < c.mismatch:
                depth = farthest + (nearest - farthest) * uniform(bits(mismatches, ~index))
            else:
                depth = _bled(inverse[row], i, depth, c.bleeding, edges, index)
            depth += c.inverse_sigma * normal(word)
            if farthest < depth < nearest:
                points[found, 0] = 1.0 / depth
                points[found, 1] = us[i] / depth
                points[found, 2] = vs[row] / depth
                hits[found] = face
                found += 1
    return found


@kernel
def _bled(
    row: FloatArray, i: int, depth: float, bleeding: float, edges: np.uint64, index: int
) -> float:
    """The reciprocal depth of a pixel, mixed at an edge with that of the neighbour."""
    for k in (i - 1, i + 1):
        if 0 <= k < len(row) and abs(row[k] - depth) > _EDGE * depth:
            if uniform(bits(edges, index)) < bleeding:
                return float(depth + uniform(bits(edges, ~index)) * (row[k] - depth))
            break
    return depth
