"""Exact depth images: faces drawn into pixels."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from semnav_env.world.depth.rasterise import NOTHING, rasterise
from tests.support.raised_plans import brute_force_inverse, exact_camera

COORDINATES = st.floats(-3.0, 3.0).map(lambda value: round(value, 3))


def image(corners, camera):
    us, vs = camera.directions
    inverse = np.empty((camera.rows, camera.columns))
    faces = np.empty(inverse.shape, np.int64)
    rasterise(np.ascontiguousarray(corners), us, vs, 1.0 / camera.range_max, inverse, faces)
    return inverse, faces


@given(arrays(np.float64, (5, 3, 3), elements=COORDINATES))
def test_drawn_depths_are_those_of_a_brute_force_caster(triples):
    """Parallelograms anywhere, also around and behind the camera; edges may round either way.

    One whose plane goes through the camera is seen edge-on and has no depth.
    """
    a, b, d = triples[:, 0], triples[:, 1], triples[:, 2]
    normals = np.cross(b - a, d - a)
    flat = np.linalg.norm(normals, axis=1) < 1e-2
    edge_on = np.abs((normals * a).sum(axis=1)) < 1e-3
    corners = np.stack((a, b, b + d - a, d), axis=1)[~flat & ~edge_on]
    camera = exact_camera(range_max=1000.0)
    inverse, _ = image(corners, camera)
    us, vs = camera.directions
    v, u = np.meshgrid(vs, us, indexing="ij")
    directions = np.stack((np.ones_like(u), u, v), axis=-1).reshape(-1, 3)
    exact = np.maximum(brute_force_inverse(corners, directions), 1e-3).reshape(inverse.shape)
    wrong = ~np.isclose(inverse, exact, rtol=1e-6)
    assert wrong.sum() <= 2 * len(corners)


@given(st.floats(0.2, 15.0))
def test_a_wall_square_to_the_view_has_one_depth(distance):
    wall = np.array([[(distance, y, z) for y, z in ((-9, -9), (9, -9), (9, 9), (-9, 9))]])
    wall[..., 1:] *= distance
    inverse, faces = image(wall, exact_camera())
    assert np.allclose(inverse, 1.0 / distance)
    assert (faces == 0).all()


def test_of_two_faces_the_nearer_one_is_seen():
    near, far = ([(x, y, z) for y, z in ((-9, -9), (9, -9), (9, 9), (-9, 9))] for x in (1, 2))
    for corners, expected in (((near, far), 0), ((far, near), 1)):
        assert (image(np.array(corners, dtype=float), exact_camera())[1] == expected).all()


def test_nothing_is_seen_of_what_lies_behind_or_out_of_range():
    behind, far = ([(x, y, z) for y, z in ((-9, -9), (9, -9), (9, 9), (-9, 9))] for x in (-1, 30))
    _, faces = image(np.array((behind, far), dtype=float), exact_camera())
    assert (faces == NOTHING).all()


def test_a_camera_of_one_pixel_sees_what_is_ahead():
    wall = np.array([[(2.0, y, z) for y, z in ((-1, -1), (1, -1), (1, 1), (-1, 1))]])
    assert np.allclose(image(wall, exact_camera(columns=1, rows=1))[0], 0.5)
