"""Doors that are met at a slant: their far jamb's side, the reveal, is all that is seen of them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from semnav_features import ExtractorSettings, Scan, Scene, extract
from semnav_features.frames import FloatArray, Point, Pose
from tests.support.raycaster import FIELD_OF_VIEW, polygon, polyline, scan_of

NEAR, FAR = 2.6, 3.6
"""Where the jambs of the door are along the corridor, metres."""

SIDE = 0.55
"""Distance of the wall with the door from the scanner, metres."""


def corridor(
    thickness: float, recess: float | None = None, ends_at_door: bool = False
) -> FloatArray:
    """A corridor along x with a door in its right wall, walls of that thickness.

    Args:
        thickness: of the wall with the door, metres.
        recess: depth of a closed leaf behind the wall's face, metres; the door is open if None.
        ends_at_door: the wall beyond the door leads away from the corridor.
    """
    back = -SIDE - thickness
    beyond = (
        polyline((FAR, back), (FAR, -SIDE), (FAR + 0.05, -SIDE), (FAR + 0.05, back))
        if ends_at_door
        else polyline((FAR, back), (FAR, -SIDE), (6.0, -SIDE), (6.0, back))
    )
    parts = [
        polyline((-2.0, -SIDE), (NEAR, -SIDE), (NEAR, back), (-2.0, back)),
        beyond,
        polyline((7.0, 1.2), (-2.0, 1.2)),
        polygon((-2.0, back), (7.0, back), (7.0, back - 3.0), (-2.0, back - 3.0))[1:],
    ]
    if recess is not None:
        parts.append(polyline((NEAR, -SIDE - recess), (FAR, -SIDE - recess)))
    return np.concatenate(parts)


def seen(segments: FloatArray, seed: int, mirrored: bool = False) -> Scan:
    here: Pose = (0.0, 0.0, 0.0)
    rng = np.random.default_rng(seed)
    return scan_of(segments * (1.0, -1.0) if mirrored else segments, here, sigma=0.01, rng=rng)


def has_door(scene: Scene, start: Point, end: Point, within: float = 0.25) -> bool:
    """Whether both jambs of a door are within a distance of these points, metres."""
    pairs = [{door.start, door.end} for door in scene.doors]
    return any(
        all(min(math.dist(p, q) for q in pair) < within for p in (start, end)) for pair in pairs
    )


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("thickness", [0.14, 0.2, 0.3])
def test_an_open_door_met_at_eighty_degrees_is_found(thickness: float, mirrored: bool) -> None:
    """All its beams end on the reveal, which is less deep than a recess in the thinnest wall."""
    side = SIDE if mirrored else -SIDE
    for seed in range(5):
        scene = extract(seen(corridor(thickness), seed, mirrored))
        assert has_door(scene, (NEAR, side), (FAR, side))


@pytest.mark.parametrize("recess", [0.02, 0.05, 0.1])
def test_a_closed_door_met_at_eighty_degrees_is_none(recess: float) -> None:
    for seed in range(5):
        scene = extract(seen(corridor(0.2, recess), seed))
        assert not has_door(scene, (NEAR, -SIDE), (FAR, -SIDE))


def test_the_near_end_of_a_reveal_is_a_jamb_where_its_wall_is_not_seen() -> None:
    """The best gap of all is placed to 5 cm; whether it is a door is left to the scorer."""
    chosen = ExtractorSettings(door_confidence_min=0.1)
    for seed in range(5):
        scene = extract(seen(corridor(0.3, ends_at_door=True), seed), chosen)
        assert has_door(scene, (NEAR, -SIDE), (FAR, -SIDE), within=0.05)


@pytest.mark.parametrize(("pose", "edge"), [((1.51, 0.44), 1.0), ((-0.07, 4.54), -1.0)])
def test_a_wall_at_the_edge_of_the_field_of_view_is_no_reveal(pose: Point, edge: float) -> None:
    """Past the corner of an angled hall 0.3 m of the wall across are seen before the view ends.

    The mouth of the hall beyond, 1.1 m wide, is no door.
    """
    hall = polygon((0, 0), (2.4, 0), (2.4, 4.9), (-6.2, 4.9), (-6.2, 3.8), (0, 3.8))
    direction = math.atan2(4.9 - pose[1], -0.03 - pose[0])
    here: Pose = (*pose, direction + edge * 0.5 * FIELD_OF_VIEW)
    for seed in range(5):
        scene = extract(scan_of(hall, here, sigma=0.02, rng=np.random.default_rng(seed)))
        assert not scene.doors


def test_a_closed_door_at_a_slant_is_turned_down_for_its_depth() -> None:
    scene = extract(seen(corridor(0.2, 0.1), seed=0), explain=True)
    reasons = [
        r.reason
        for r in scene.rejections
        if r.kind == "door" and math.dist(r.start, r.end) > 0.8 and r.start[0] > 2.0
    ]
    assert any("too few end at the side of the far jamb" in reason for reason in reasons)
