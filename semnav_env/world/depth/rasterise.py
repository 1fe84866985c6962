"""Exact depth images by drawing faces into the pixels, the lidar's interval raster in space.

A face with the normal N through the point a (camera frame) is seen by the pixel that looks along
d = (1, u, v) at the depth z with z (N . d) = N . a. So 1 / z is linear in u and v, and the nearest
of all faces is the largest of the reciprocals. The pixel meets the face if it lies on the inner
side of each edge: d . (p_i x p_i+1) has the sign of N . a for all of them, which also holds for
faces that reach behind the camera (Olano and Greer 1997, "Triangle scan conversion using 2D
homogeneous coordinates"). In a row of pixels each edge bounds u from one side.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

NOTHING = -1
"""In an image of faces: no face is in range."""

_EDGE_ON = 1e-12
"""|N . a| in cubic metres below which a face is seen edge-on, and so not at all."""


@kernel
def rasterise(
    corners: FloatArray,
    us: FloatArray,
    vs: FloatArray,
    farthest: float,
    inverse: FloatArray,
    faces: NDArray[np.int64],
) -> None:
    """Write the depth image of faces.

    Args:
        corners: of the faces in order around them, camera frame, metres, shape (n, 4, 3).
        us: of the columns, falling, shape (columns,).
        vs: of the rows, shape (rows,).
        farthest: reciprocal of the largest depth, 1/m.
        inverse: reciprocal depth of each pixel, 1/m, shape (rows, columns); written.
        faces: index of the face that each pixel sees, or `NOTHING`; written.
    """
    inverse[:] = farthest
    faces[:] = NOTHING
    for k in range(len(corners)):
        _draw_face(corners[k], k, us, vs, inverse, faces)


@kernel
def _draw_face(
    corners: FloatArray,
    k: int,
    us: FloatArray,
    vs: FloatArray,
    inverse: FloatArray,
    faces: NDArray[np.int64],
) -> None:
    """Raise the reciprocal depths to those of one face."""
    a, b, d = corners[0], corners[1], corners[3]
    ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    wx, wy, wz = d[0] - a[0], d[1] - a[1], d[2] - a[2]
    nx, ny, nz = uy * wz - uz * wy, uz * wx - ux * wz, ux * wy - uy * wx
    offset = nx * a[0] + ny * a[1] + nz * a[2]
    if abs(offset) < _EDGE_ON or max(a[0], b[0], corners[2, 0], d[0]) <= 0.0:
        return
    gx, gy, gz = nx / offset, ny / offset, nz / offset
    sign = 1.0 if offset > 0.0 else -1.0
    last = len(us) - 1
    step = us[0] - us[1] if last > 0 else 1.0
    for row in range(len(vs)):
        low, high = _span(corners, sign, vs[row])
        if low > high or low > us[0] + step or high < us[last] - step:
            continue
        # Columns from left to right have falling u: high bounds the first, low the last.
        first = math.ceil((us[0] - min(high, us[0])) / step - 1e-9)
        stop = math.floor((us[0] - max(low, us[last])) / step + 1e-9)
        for i in range(first, min(stop, last) + 1):
            found = gx + gy * us[i] + gz * vs[row]
            if found > inverse[row, i]:
                inverse[row, i] = found
                faces[row, i] = k


@kernel
def _span(corners: FloatArray, sign: float, v: float) -> tuple[float, float]:
    """Smallest and largest u of the pixels of a row that meet a face; empty if low > high."""
    low, high = -np.inf, np.inf
    for i in range(4):
        p, q = corners[i], corners[(i + 1) & 3]
        ex = sign * (p[1] * q[2] - p[2] * q[1])
        ey = sign * (p[2] * q[0] - p[0] * q[2])
        ez = sign * (p[0] * q[1] - p[1] * q[0])
        rest = ex + ez * v
        if ey > 0.0:
            low = max(low, -rest / ey)
        elif ey < 0.0:
            high = min(high, -rest / ey)
        elif rest < 0.0:
            return np.inf, -np.inf
    return low, high
