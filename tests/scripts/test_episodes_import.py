"""`semnav episodes import`: every part of every floor, and what is left out is said."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import shapely
from shapely import affinity, box

from semnav_env.judge.episodes import SPLITS, load_episodes
from semnav_env.judge.episodes.generate import TooBareError, generate_episode
from semnav_env.judge.episodes.site import Site
from semnav_env.world.maps import (
    FloorPlan,
    PlanDoor,
    Region,
    generate_office,
    load_floor_plan,
    save_floor_plan,
)
from semnav_features.frames import Point
from tests.support.command_line import run
from tests.support.small_plans import closed

HALL = load_floor_plan("heidelberg_hallway")
AWAY = 60.0
"""Distance between the two parts of a floor, metres."""


def moved(plan: FloorPlan, x: float, name: str) -> FloorPlan:
    """A plan a distance to the east, with a name before those of its parts."""

    def at(point: Point) -> Point:
        return point[0] + x, point[1]

    def region(each: Region) -> Region:
        return Region(f"{name} {each.name}", affinity.translate(each.polygon, x))

    return replace(
        plan,
        name=name,
        surfaces=tuple(replace(s, points=tuple(map(at, s.points))) for s in plan.surfaces),
        doors=tuple(
            PlanDoor(f"{name} {d.name}", at(d.start), at(d.end), d.open) for d in plan.doors
        ),
        rooms=tuple(map(region, plan.rooms)),
        corridors=tuple(map(region, plan.corridors)),
        intersections=tuple(map(region, plan.intersections)),
        areas=tuple(map(region, plan.areas)),
        boundary=affinity.translate(plan.boundary, x),
    )


def in_two_parts() -> FloorPlan:
    """Two hallways on one floor, and no way from one to the other."""
    west, east = moved(HALL, 0.0, "west"), moved(HALL, AWAY, "east")
    return FloorPlan(
        "two parts",
        west.surfaces + east.surfaces,
        west.doors + east.doors,
        west.rooms + east.rooms,
        west.corridors + east.corridors,
        west.intersections + east.intersections,
        box(*shapely.total_bounds([west.boundary, east.boundary])),
        areas=west.areas + east.areas,
    )


def shaft() -> FloorPlan:
    """A corridor in which no robot finds a place."""
    walls = closed((0.0, 0.0), (4.0, 0.0), (4.0, 0.4), (0.0, 0.4))
    corridor = Region("shaft", box(0.0, 0.0, 4.0, 0.4))
    return FloorPlan("shaft", (walls,), (), (), (corridor,), (), box(0.0, 0.0, 4.0, 0.4))


def saved(plan: FloorPlan, folder: Path) -> Path:
    path = folder / f"{plan.name}.geojson"
    save_floor_plan(plan, path)
    return path


def test_episodes_begin_in_every_part_of_a_floor(tmp_path: Path, capsys: Any) -> None:
    floor = saved(in_two_parts(), tmp_path)
    code, out, err = run(
        capsys, "episodes", "import", floor, "--episodes", 8, "--out", tmp_path / "out"
    )
    assert code == 0, out + err
    closed_rooms = "west room_north, east room_north"
    assert out.splitlines()[1:] == [
        f"left out: what no robot gets into in two parts: {closed_rooms}"
    ]
    episodes = load_episodes(tmp_path / "out" / "test_real_floors.jsonl.gz")
    east = sum(episode.start[0] > AWAY / 2 for episode in episodes)
    assert 0 < east < len(episodes) == 8
    for episode in episodes:
        assert all((x > AWAY / 2) == (episode.start[0] > AWAY / 2) for x, _ in episode.route)


def test_a_floor_of_one_part_gives_the_same_episodes() -> None:
    name, split = "heidelberg_hallway", SPLITS["test_real"]
    sites = Site(HALL, name), Site(HALL, name, whole=True)
    usual, whole = ([generate_episode(site, split, k) for k in range(6)] for site in sites)
    assert usual == whole
    assert len(sites[1].parts) == 1


def test_a_floor_without_commands_does_not_stop_the_others(tmp_path: Path, capsys: Any) -> None:
    bare = replace(HALL, name="walls", doors=(), rooms=(), corridors=(), intersections=(), areas=())
    floors = [saved(plan, tmp_path) for plan in (shaft(), bare, HALL)]
    code, out, err = run(
        capsys, "episodes", "import", *floors, "--episodes", 3, "--out", tmp_path / "out"
    )
    assert code == 0, err
    written, *left_out = out.splitlines()
    assert written.endswith("3 episodes in 1 floor")
    assert left_out[0] == (
        "left out: 3 episodes in shaft, where too few commands can be carried out"
    )
    assert left_out[2].startswith("left out: walls has no corridor")
    assert len(load_episodes(tmp_path / "out" / "test_real_floors.jsonl.gz")) == 3


def test_a_vector_map_is_refused_by_what_would_be_right(tmp_path: Path, capsys: Any) -> None:
    path = tmp_path / "walls.vectormap.json"
    path.write_text('[{"p0": {"x": 0, "y": 0}, "p1": {"x": 9, "y": 0}}]')
    code, out, err = run(capsys, "episodes", "import", path, "--out", tmp_path / "out")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "walls has no corridor" in err
    assert "`semnav map import`" in err
    assert "pose" not in err


def test_what_no_robot_gets_into_is_named(tmp_path: Path, capsys: Any) -> None:
    slit = Region("slit", box(0.5, 19.9, 9.0, 20.1))
    walls = closed((0.5, 19.9), (9.0, 19.9), (9.0, 20.1), (0.5, 20.1))
    plan = replace(
        HALL,
        name="with a slit",
        surfaces=(*HALL.surfaces, walls),
        corridors=(*HALL.corridors, slit),
        boundary=HALL.boundary.union(slit.polygon.buffer(0.1)).envelope,
    )
    floor = saved(plan, tmp_path)
    code, out, err = run(
        capsys, "episodes", "import", floor, "--episodes", 3, "--out", tmp_path / "out"
    )
    assert code == 0, err
    assert "left out: what no robot gets into in with a slit: slit, room_north" in out


def test_a_floor_in_which_no_pose_is_free_is_bare() -> None:
    with pytest.raises(TooBareError):
        generate_episode(Site(shaft(), "shaft", whole=True), SPLITS["test_real"], 0)


def test_episodes_are_made_in_plans_of_the_projects_own_format(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    lab, out = tmp_path / "lab.geojson", tmp_path / "out"
    save_floor_plan(generate_office(3), lab)
    assert run(capsys, "episodes", "import", lab, "--out", out, "--episodes", 1)[0] == 0
    assert len(list(out.iterdir())) == 2


def test_a_refused_import_leaves_no_folder(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    lab, out = tmp_path / "lab.geojson", tmp_path / "out"
    lab.write_text("{}")
    assert run(capsys, "episodes", "import", lab, "--out", out)[0] == 2
    assert not out.exists()
