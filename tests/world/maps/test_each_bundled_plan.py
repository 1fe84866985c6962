"""The bundled floor plans one by one: true to their sources, and to what they are for."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest
import shapely
from shapely import LineString, Point, Polygon

from semnav_env.robots import WHEELCHAIR
from semnav_env.world.maps import Material, PlanDoor, load_floor_plan
from semnav_env.world.maps.doorways import DoorState, clear_width, door_state
from semnav_env.world.maps.placement import footprint
from tests.support.paths import SHARED
from tests.support.plan_geometry import inward, lane, reachable, solid

REFERENCE = SHARED / "reference"


def reference(name: str) -> dict[str, Any]:
    path = REFERENCE / f"{name}.json"
    if not path.exists():
        pytest.skip(f"the published numbers are not here: {path.name}")
    numbers: dict[str, Any] = json.loads(path.read_text("utf-8"))
    return numbers


class TestHeidelberg:
    plan = load_floor_plan("heidelberg_hallway")

    def test_it_is_the_published_drawing(self) -> None:
        numbers = reference("heidelberg_hallway")
        drawn = solid(self.plan, assumed=False)
        pillar = [numbers["pillar"] + numbers["pillar"][:1]]
        published = shapely.union_all(
            [LineString(line) for line in numbers["walls"] + numbers["door_leaves"] + pillar]
        )
        assert drawn.equals(published)
        assert {d.name for d in self.plan.doors} == {d["id"] for d in numbers["doors"]}
        for door in numbers["doors"]:
            ends = {tuple(end) for end in door["ends"]}
            ours = self.plan.door(door["id"])
            assert {ours.start, ours.end} == ends
            assert ours.width == pytest.approx(door["width"], abs=1e-3)

    def test_only_what_lies_beyond_the_drawing_is_assumed(self) -> None:
        assumed = {room.name for room in self.plan.rooms if room.assumed}
        assert assumed == {"room_north", "room_south_2", "room_south_3"}
        assert sum(surface.assumed for surface in self.plan.surfaces) == 5

    def test_the_north_door_stands_44_degrees_open(self) -> None:
        door, leaf = self.plan.door("north"), self.leaf
        opening = math.atan2(door.start[1] - door.end[1], door.start[0] - door.end[0])
        assert math.degrees(abs(leaf - opening)) == pytest.approx(44, abs=1)
        assert door_state(door, self.plan) is DoorState.HALF_OPEN
        assert clear_width(door, self.plan) == pytest.approx(0.75, abs=0.02)

    @property
    def leaf(self) -> float:
        """Direction from the hinge of the north door to the tip of its leaf."""
        hinge = self.plan.door("north").end
        leaves = [s.points for s in self.plan.surfaces if s.material is Material.LEAF]
        tip = next(tip for start, tip in leaves if start == hinge)
        return math.atan2(tip[1] - hinge[1], tip[0] - hinge[0])

    def test_a_wheelchair_passes_the_north_door_along_its_leaf(self) -> None:
        x, y = self.middle_of_passage()
        heading = self.leaf + math.pi
        back = (x - 2.0 * math.cos(heading), y - 2.0 * math.sin(heading))
        way = lane(back, heading, 2.0 + 2.5 + 0.55, WHEELCHAIR.width + 2 * 0.045)
        assert not way.intersects(solid(self.plan))

    def middle_of_passage(self) -> tuple[float, float]:
        """Halfway between the far jamb and the line of the leaf."""
        door = self.plan.door("north")
        across = clear_width(door, self.plan) / 2
        return (
            door.start[0] + across * math.cos(self.leaf - math.pi / 2),
            door.start[1] + across * math.sin(self.leaf - math.pi / 2),
        )

    def test_the_usual_start_is_free_with_its_spread(self) -> None:
        spread = [(dx, dy, dh) for dx in (-0.2, 0.2) for dy in (-0.2, 0.2) for dh in (-0.2, 0.2)]
        for dx, dy, dh in spread:
            body = footprint(WHEELCHAIR, (-2.5 + dx, -0.3 + dy, 0.24 + dh))
            assert not body.intersects(solid(self.plan))


class TestVilla:
    plan = load_floor_plan("villa_hall")

    def test_the_hall_is_the_published_polygon(self) -> None:
        numbers = reference("villa_hall")
        hall = shapely.union_all([region.polygon for region in self.plan.corridors])
        assert hall.symmetric_difference(Polygon(numbers["room"])).area < 1e-9
        assert (
            solid(self.plan)
            .buffer(1e-6)
            .covers(
                hall.exterior.difference(
                    shapely.union_all([self._opening(d) for d in numbers["doors"]])
                )
            )
        )

    def test_its_doors_are_the_published_ones(self) -> None:
        for door in reference("villa_hall")["doors"]:
            ours = self.plan.door(door["name"].removeprefix("hall to "))
            assert {ours.start, ours.end} == {tuple(map(float, end)) for end in door["ends"]}
            # heading 0 looks along +y there
            turn = inward(ours) - (door["facing_angle"] + math.pi / 2)
            assert math.remainder(turn, 2 * math.pi) == pytest.approx(0, abs=1e-9)

    @staticmethod
    def _opening(door: dict[str, Any]) -> LineString:
        return LineString(door["ends"]).buffer(1e-6)


class TestOffice:
    plan = load_floor_plan("office_cross")

    def test_it_holds_every_kind_of_door_region_and_material(self) -> None:
        states = [door_state(door, self.plan) for door in self.plan.doors]
        assert len(states) >= 16
        assert states.count(DoorState.CLOSED) == 1
        assert states.count(DoorState.HALF_OPEN) == 1
        assert {region.name for region in self.plan.intersections} == {"crossing", "bend"}
        materials = [surface.material for surface in self.plan.surfaces]
        assert set(materials) == set(Material) - {Material.PERSON}
        assert materials.count(Material.GLASS) == 1

    def test_doors_are_between_0_9_and_1_15_m_wide(self) -> None:
        assert all(0.9 - 1e-9 <= door.width <= 1.15 for door in self.plan.doors)

    def test_every_corridor_has_doors_on_both_sides(self) -> None:
        for corridor in self.plan.corridors:
            near = [d for d in self.plan.doors if corridor.polygon.dwithin(Point(d.midpoint), 0.01)]
            headings = {round(math.cos(inward(d) - inward(near[0]))) for d in near}
            assert headings == {-1, 1}, corridor.name

    def test_rooms_measure_at_least_3_by_3_m(self) -> None:
        for room in self.plan.rooms:
            west, south, east, north = room.polygon.bounds
            assert min(east - west, north - south) >= 3.0
            assert any(room.polygon.dwithin(Point(door.midpoint), 0.01) for door in self.plan.doors)

    def test_a_wheelchair_turns_before_every_door_and_drives_in(self) -> None:
        """It turns on the spot about its axle in the middle of the corridor."""
        reach = math.hypot(WHEELCHAIR.length / 2 - WHEELCHAIR.axle, WHEELCHAIR.width / 2)
        for door in self.plan.doors:
            corridors = [c for c in self.plan.corridors if c.polygon.dwithin(_middle(door), 0.01)]
            if door_state(door, self.plan) is not DoorState.OPEN or not corridors:
                continue
            x, y = door.midpoint
            half = _width(corridors[0].polygon) / 2
            heading = inward(door)
            axle = x - half * math.cos(heading), y - half * math.sin(heading)
            turned = Point(axle).buffer(reach)
            into = lane(axle, heading, half + 2.0, WHEELCHAIR.width)
            assert not shapely.union_all([turned, into]).intersects(solid(self.plan)), door.name

    def test_the_half_open_leaf_leaves_a_way_along_it(self) -> None:
        door = self.plan.door("west_north_2")
        assert clear_width(door, self.plan) >= 0.85
        x, y = door.midpoint
        heading = math.radians(60)
        back = x - 1.2 * math.cos(heading), y - 1.2 * math.sin(heading)
        assert not lane(back, heading, 3.5, 0.85).intersects(solid(self.plan))

    def test_obstacles_in_corridors_leave_1_3_m(self) -> None:
        free = reachable(self.plan, 1.3)
        for corridor in self.plan.corridors:
            west, south, east, north = corridor.polygon.bounds
            ends = [(west, south), (east, north)]
            middle = (Point(x, y).buffer(1.6).intersection(corridor.polygon) for x, y in ends)
            assert all(free.intersects(end) for end in middle)
        assert shapely.get_num_geometries(free) == 1

    def test_behind_the_glass_a_beam_meets_a_wall(self) -> None:
        (glass,) = (s for s in self.plan.surfaces if s.material is Material.GLASS)
        opaque = [LineString(((a, b), (c, d))) for a, b, c, d in self.plan.opaque_segments.tolist()]
        middle = LineString(glass.points).interpolate(0.5, normalized=True)
        beam = LineString(((middle.x, middle.y - 1), (middle.x, middle.y + 8)))
        hits = [
            line.intersection(beam).distance(middle) for line in opaque if line.intersects(beam)
        ]
        assert 2.0 < min(hits) < 6.0


def _middle(door: PlanDoor) -> Point:
    return Point(door.midpoint)


def _width(corridor: Polygon) -> float:
    west, south, east, north = corridor.bounds
    return float(min(east - west, north - south))
