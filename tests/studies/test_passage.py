"""What is called a corridor."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features import ExtractorSettings, Scene, Wall, extract
from studies.__main__ import STUDIES
from studies.places.passage import PassageLimits, is_corridor, passages
from studies.places.place_scans import called_corridor, place_sheets, read_place_labels
from tests.support.paths import DATA
from tests.support.raycaster import polyline, scan_of

DATA = DATA / "clutter_slices"

widths = st.floats(0.9, 2.9)
poses = st.tuples(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0), st.floats(-math.pi, math.pi))


def strip(width, length, shift=0.0):
    """Two walls that face each other, free sides inwards."""
    return Scene((Wall((0.0, 0.0), (length, 0.0)), Wall((shift + length, width), (shift, width))))


@given(widths, st.floats(2.1, 9.0), poses)
def test_two_long_facing_walls_are_a_corridor(width, times, pose):
    """The pose of the scene does not matter."""
    scene = strip(width, times * width).placed(pose)
    assert is_corridor(scene)
    assert max(p.elongation for p in passages(scene.walls)) == pytest.approx(times)


@given(widths, st.floats(0.3, 1.9))
def test_a_passage_shorter_than_twice_its_width_is_no_corridor(width, times):
    assert not is_corridor(strip(width, times * width))


@given(widths, st.floats(2.1, 9.0))
def test_walls_back_to_back_are_none(width, times):
    scene = strip(width, times * width)
    turned = [Wall(wall.end, wall.start) for wall in scene.walls]
    assert not is_corridor(Scene(tuple(turned)))


@given(widths, st.floats(3.0, 9.0), st.floats(0.0, 12.0))
def test_only_where_both_sides_are_seen_it_has_length(width, length, shift):
    found = passages(strip(width, length, shift).walls)
    assert all(p.length == pytest.approx(max(0.0, length - shift)) for p in found)


@pytest.mark.parametrize("gap", [1.0, 2.0])
def test_doors_do_not_end_a_side_but_wide_gaps_do(gap):
    walls = strip(2.0, 6.0).walls
    halves = [Wall((0.0, 0.0), (3.0 - gap / 2, 0.0)), Wall((3.0 + gap / 2, 0.0), (6.0, 0.0))]
    longest = max(p.length for p in passages((*halves, walls[1])))
    assert longest == pytest.approx(6.0 if gap < PassageLimits().gap else 6.0 - gap)


@pytest.mark.parametrize(("length", "called"), [(14.0, True), (3.0, False)])
def test_a_scan_in_a_corridor_says_so(length, called):
    half = length / 2
    box = polyline((-half, -1.0), (half, -1.0), (half, 1.0), (-half, 1.0), (-half, -1.0))
    assert is_corridor(extract(scan_of(box, (0.1, 0.2, 0.3)))) is called


def test_an_empty_scene_shows_none():
    assert passages(()) == ()
    assert not is_corridor(Scene())


def test_the_sheets_count_what_was_called_a_corridor(tmp_path, capsys):
    half = np.linspace(-2.3, 2.3, 400)
    hall = 1.0 / np.maximum(np.abs(np.sin(half)), 0.12)
    room = 1.5 / np.maximum(np.abs(np.sin(half)), np.abs(np.cos(half)))
    arrays = {
        "ranges": np.stack((hall, hall, room)),
        "place": np.array(["hall", "hall", "room"]),
        "position": np.array(["a", "b", "a"]),
        "angle_min": half[0],
        "angle_increment": half[1] - half[0],
    }
    np.savez(tmp_path / "scans.npz", **arrays)
    labels = read_place_labels(tmp_path / "scans.npz")
    whole, by_place, by_position = place_sheets(labels, [True, False, True], "hall")
    assert whole.rows == [("hall", 3, 2, 2, 0.5, 0.5, 0.5)]
    assert by_place.rows == [("hall", 2, 1), ("room", 1, 1)]
    assert by_position.rows == [("a", 1, 1), ("b", 1, 0)]
    with pytest.raises(ValueError, match=r"no scan was taken in 'attic'; there are: hall, room"):
        list(place_sheets(labels, [True] * 3, "attic"))
    words = ["places", "--data", str(tmp_path / "scans.npz"), "--corridor", "hall"]
    assert STUDIES.main(words) == 0
    assert "| hall | 3 | 2 | 2 | 1.000 | 1.000 | 1.000 |" in capsys.readouterr().out


def test_what_are_no_scans_of_places_is_refused(tmp_path):
    (tmp_path / "a.npz").write_text("text")
    np.savez(tmp_path / "b.npz", ranges=np.ones(3))
    for name in ("a.npz", "b.npz"):
        with pytest.raises(ValueError, match=rf"{name}: not scans of places"):
            read_place_labels(tmp_path / name)


def test_few_other_places_are_called_a_corridor_in_real_scans():
    path = DATA / "clutter_slices.npz"
    if not path.exists():
        pytest.skip("the scans of labelled places are not here")
    labels = read_place_labels(path)
    called = called_corridor(path, ExtractorSettings())
    (row,) = next(place_sheets(labels, called, "Corridor_main")).rows
    assert row[4] > 0.8
