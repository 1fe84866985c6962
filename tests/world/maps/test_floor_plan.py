"""The immutable plan and its derived arrays."""

from __future__ import annotations

import math
import pickle
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest
from shapely import box

from semnav_env.world.maps import FloorPlan, Material, PlanDoor, Region, Surface
from semnav_env.world.maps.doorways import DoorState, clear_width, door_state
from semnav_features.rules import DoorRules


def hall(*extra: Surface, door_open: bool = True) -> FloorPlan:
    """A hall of 4 x 3 m with a door of 1 m in its south wall and a room behind it."""
    walls = (
        Surface(((1, 0), (0, 0), (0, 3), (4, 3), (4, 0), (2, 0))),
        Surface(((0, 0), (0, -3), (4, -3), (4, 0)), assumed=True),
    )
    return FloorPlan(
        name="hall",
        surfaces=walls + extra,
        doors=(PlanDoor("south", (1, 0), (2, 0), door_open),),
        rooms=(Region("room", box(0, -3, 4, 0), assumed=True),),
        corridors=(Region("hall", box(0, 0, 4, 3)),),
        intersections=(),
        boundary=box(0, -3, 4, 3),
    )


def leaf(degrees: float, length: float = 1.0) -> Surface:
    """Hung on the jamb (1, 0), opening into the room."""
    angle = math.radians(degrees)
    tip = (1 + length * math.cos(angle), -length * math.sin(angle))
    return Surface(((1, 0), tip), Material.LEAF)


def test_glass_stops_the_body_but_not_the_beam() -> None:
    plan = hall(Surface(((0, 1), (4, 1)), Material.GLASS))
    assert [0, 1, 4, 1] in plan.segments.tolist()
    assert [0, 1, 4, 1] not in plan.opaque_segments.tolist()
    assert len(plan.opaque_segments) == len(plan.segments) - 1


def test_every_segment_knows_its_surface() -> None:
    plan = hall(leaf(90))
    assert plan.owners.tolist() == [0] * 5 + [1] * 3 + [2]
    for segment, owner in zip(plan.segments.tolist(), plan.owners, strict=True):
        assert tuple(segment[:2]) in plan.surfaces[owner].points


def test_the_index_of_solids_follows_the_segments() -> None:
    plan = hall()
    coordinates = [np.ravel(line.coords).tolist() for line in plan.solids.geometries]
    assert coordinates == plan.segments.tolist()


def test_a_plan_without_surfaces_has_no_segments() -> None:
    bare = replace(hall(), surfaces=(), doors=())
    assert bare.segments.shape == bare.opaque_segments.shape == (0, 4)
    assert len(bare.owners) == 0


def test_the_scene_holds_open_doors_only() -> None:
    assert [door.name for door in hall().scene.doors] == ["south"]
    assert hall(leaf(0), door_open=False).scene.doors == ()


def test_openings_wider_than_a_door_are_no_doors_of_the_scene() -> None:
    """The plan may call it a door; the extractor would not."""
    widths = {"door": 1.2, "just": DoorRules().widest, "gate": 1.4}
    doors = tuple(PlanDoor(name, (0.0, 0.0), (width, 0.0)) for name, width in widths.items())
    plan = replace(hall(), doors=doors)
    assert [door.name for door in plan.scene.doors] == ["door", "just"]
    assert plan.door("gate").open
    assert not plan.door("gate").counts(DoorRules())


def test_plans_are_values() -> None:
    assert hall() == hall()
    assert hall() != hall(leaf(90))
    assert pickle.loads(pickle.dumps(hall())) == hall()
    with pytest.raises(FrozenInstanceError):
        hall().name = "other"  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        hall().segments[0, 0] = 1.0


def test_using_a_plan_does_not_change_what_it_equals() -> None:
    used = hall()
    assert used.solids is not None
    assert used.scene.walls
    assert used == hall()


def test_unknown_names_list_the_known_ones() -> None:
    with pytest.raises(KeyError, match="no door 'north'; there are: south"):
        hall().door("north")
    with pytest.raises(KeyError, match="no region 'attic'; there are: room, hall"):
        hall().region("attic")
    assert hall().region("hall").polygon.area == 12
    assert hall().door("south").width == 1


@pytest.mark.parametrize(
    ("angle", "state"),
    [(0, "closed"), (30, "half-open"), (74, "half-open"), (76, "open"), (120, "open")],
)
def test_the_state_of_a_door_is_read_off_its_leaf(angle: float, state: str) -> None:
    plan = hall(leaf(angle))
    assert door_state(plan.doors[0], plan) == state


def test_a_door_without_a_leaf_is_open() -> None:
    assert door_state(hall().doors[0], hall()) is DoorState.OPEN


@pytest.mark.parametrize("angle", [0, 20, 44, 60, 89, 90, 120])
def test_a_leaf_leaves_the_sine_of_its_angle(angle: float) -> None:
    plan = hall(leaf(angle))
    expected = math.sin(math.radians(min(angle, 90)))
    # a surface on the opening counts 2.5 cm to either side
    assert clear_width(plan.doors[0], plan) == pytest.approx(expected, abs=0.08)
    assert clear_width(plan.doors[0], plan) <= expected + 1e-9


def test_two_half_leaves_leave_the_gap_between_their_tips() -> None:
    a, b = leaf(60, 0.5), Surface(((2, 0), (1.75, -0.433)), Material.LEAF)
    plan = hall(a, b)
    assert clear_width(plan.doors[0], plan) == pytest.approx(0.5, abs=1e-3)


def test_a_wall_across_the_opening_is_not_clear() -> None:
    plan = hall(Surface(((1.5, 0.5), (1.5, -0.5))))
    assert clear_width(plan.doors[0], plan) == pytest.approx(0.475, abs=1e-6)
