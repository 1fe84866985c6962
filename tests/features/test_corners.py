"""Corners: where they are, and of which kind, against the geometry of plans."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.robots import WHEELCHAIR
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.placement import sample_pose
from semnav_features import Corner, CornerKind, ExtractorSettings, Scene, extract
from semnav_features.frames import FloatArray, Pose, to_parent
from tests.support.raycaster import cast, polygon, polyline, scan_of
from tests.support.strategies import Opening, Room, openings, rooms

HERE = (0.0, 0.0, 0.0)
seeds = st.integers(0, 2**32 - 1)


def full(scene: Scene) -> list[Corner]:
    return [corner for corner in scene.corners if corner.kind is not CornerKind.POTENTIAL]


def distances(segments: FloatArray, point: FloatArray) -> FloatArray:
    """From a point to each segment, shape (n,)."""
    along = segments[:, 1] - segments[:, 0]
    place = ((point - segments[:, 0]) * along).sum(axis=1) / (along**2).sum(axis=1)
    nearest = segments[:, 0] + np.clip(place, 0.0, 1.0)[:, None] * along
    return np.asarray(np.linalg.norm(nearest - point, axis=1))


def points_into_the_open(segments: FloatArray, pose: Pose, corner: FloatArray) -> bool | None:
    """Whether the smaller angle at a corner of the plan is free: then it is an outer corner.

    A point in that angle, a little off the corner, is in view of the scanner or is not. None if
    it is no corner of two segments.
    """
    ends = segments.reshape(-1, 2)
    others = segments[:, ::-1].reshape(-1, 2)
    here = np.linalg.norm(ends - corner, axis=1) < 1e-3
    sides = others[here] - ends[here]
    sides /= np.linalg.norm(sides, axis=1)[:, None]
    if len(sides) != 2 or np.linalg.norm(sides.sum(axis=0)) < 0.5:
        return None
    if np.count_nonzero(distances(segments, corner) < 1e-3) > 2:
        return None  # a third segment passes through
    inside = corner + 0.02 * sides.sum(axis=0)
    x, y = inside - pose[:2]
    sight = cast(segments, (*pose[:2], 0.0), np.array([math.atan2(y, x)]))[0]
    return bool(sight > math.hypot(x, y))


def test_corner_kinds_agree_with_the_geometry_of_the_plan() -> None:
    kinds, rng = [], np.random.default_rng(4)
    for name in ("heidelberg_hallway", "villa_hall", "office_cross"):
        plan = load_floor_plan(name)
        segments = plan.opaque_segments.reshape(-1, 2, 2)
        vertices = segments.reshape(-1, 2)
        for _ in range(25):
            pose = sample_pose(plan, WHEELCHAIR, rng)
            for corner in full(extract(scan_of(segments, pose, sigma=0.01, rng=rng))):
                place = np.array(to_parent(pose, corner.point))
                vertex = vertices[np.linalg.norm(vertices - place, axis=1).argmin()]
                is_open = points_into_the_open(segments, pose, vertex)
                # farther off it is a corner that two walls would make if they went on
                if np.linalg.norm(vertex - place) < 0.05 and is_open is not None:
                    kinds.append(corner.kind)
                    assert (corner.kind is CornerKind.OUTER) == is_open
    assert min(kinds.count(kind) for kind in (CornerKind.INNER, CornerKind.OUTER)) > 20


@settings(max_examples=40, deadline=None)
@given(rooms(), seeds)
def test_corners_are_found_to_a_hundredth_of_their_range(room: Room, seed: int) -> None:
    rng = np.random.default_rng(seed)
    field = 2.0 * math.pi * 1079 / 1080
    scene = extract(scan_of(room.segments, room.pose, 1080, field, sigma=0.01, rng=rng))
    placed = full(scene.placed(room.pose))
    assert len(placed) == 4
    for corner in room.corners:
        error = min(math.dist(corner, found.point) for found in placed)
        assert error < 0.01 * max(math.dist(corner, room.pose[:2]), 2.0)


@settings(max_examples=40, deadline=None)
@given(openings(0.5, 2.5), seeds)
def test_no_two_corners_are_at_one_place(opening: Opening, seed: int) -> None:
    rng = np.random.default_rng(seed)
    chosen = ExtractorSettings()
    corners = extract(scan_of(opening.segments, opening.pose, sigma=0.02, rng=rng), chosen).corners
    for k, corner in enumerate(corners):
        for other in corners[:k]:
            assert math.dist(corner.point, other.point) >= chosen.corner_fuse


def test_a_corner_is_found_behind_a_post_that_stands_before_it() -> None:
    room = polyline((3.0, -2.0), (3.0, 1.5), (-1.0, 1.5))
    post = polygon((1.97, 0.9), (2.13, 0.9), (2.13, 1.06), (1.97, 1.06))
    segments = np.concatenate((room, post))
    corners = full(extract(scan_of(segments, HERE, 1622)))
    outer = [corner.point for corner in corners if corner.kind is CornerKind.OUTER]
    assert len(outer) == 1
    assert outer[0] == pytest.approx((3.0, 1.5), abs=0.01)


def test_a_chamfered_corner_is_one_corner() -> None:
    """It lies where its two walls would meet."""
    segments = polyline((3.0, -2.0), (3.0, 1.3), (2.8, 1.5), (-1.0, 1.5))
    corners = full(extract(scan_of(segments, HERE)))
    assert [corner.kind for corner in corners] == [CornerKind.OUTER]
    assert corners[0].point == pytest.approx((3.0, 1.5), abs=0.01)


def test_both_ends_of_every_wall_are_looked_at() -> None:
    walls = np.concatenate(
        (polyline((2.0, -1.5), (2.0, -0.5), (3.0, -0.5)), polyline((2.5, 1.0), (2.5, 2.0)))
    )
    scene = extract(scan_of(walls, HERE))
    places = [corner.point for corner in scene.corners]
    for wall in scene.walls:
        for end, is_loose in (
            (wall.start, wall.start_break or wall.start_rupture),
            (wall.end, wall.end_break or wall.end_rupture),
        ):
            near = min(math.dist(end, place) for place in places)
            assert near < 0.1 or not is_loose


@pytest.mark.parametrize("off", [0.15, 0.25])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_box_off_the_wall_makes_no_corner_with_the_wall_behind(off: float, side: float) -> None:
    """The wall is seen on, through the gap, past where the side of the box would meet it."""
    wall = polyline((-4.0, 1.0), (4.0, 1.0))
    box = polygon((0.8, 0.4), (1.6, 0.4), (1.6, 1.0 - off), (0.8, 1.0 - off))
    segments = np.concatenate((wall, box)) * (1.0, side)
    corners = full(extract(scan_of(segments, HERE, 1622)))
    assert [corner.kind for corner in corners] == [CornerKind.INNER]
    assert corners[0].point == pytest.approx((0.8, side * 0.4), abs=0.01)


@settings(max_examples=60, deadline=None)
@given(st.one_of(rooms(), openings(0.5, 2.5)), seeds)
def test_at_every_loose_end_of_a_wall_is_a_corner(place: Room | Opening, seed: int) -> None:
    rng, chosen = np.random.default_rng(seed), ExtractorSettings()
    scene = extract(scan_of(place.segments, place.pose, sigma=0.02, rng=rng), chosen)
    loose = [w.start for w in scene.walls if w.start_break or w.start_rupture]
    loose += [w.end for w in scene.walls if w.end_break or w.end_rupture]
    for end in loose:
        assert any(
            math.dist(end, corner.point)
            <= (chosen.corner_fuse if corner.kind is CornerKind.POTENTIAL else chosen.corner_gap)
            for corner in scene.corners
        )
