import math

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from PIL import Image

from semnav_features import Arc, Corner, CornerKind, CorridorProbe, Door, Scan, Scene, Wall
from semnav_features.plot import draw_scene, save_page

SCAN = Scan(np.full(90, 3.0), -math.pi / 4, math.pi / 180)
SCENE = Scene(
    walls=(Wall((1.0, -1.0), (4.0, -1.0)), Wall((4.0, 1.0), (1.0, 1.0))),
    doors=(Door((4.0, -0.5), (4.0, 0.5)),),
    corners=tuple(Corner((4.0, float(kind)), kind) for kind in CornerKind),
    corridors=(CorridorProbe((1.0, -1.0), (1.0, 1.0)),),
)


def pixels(path):
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB")) / 255


def share(image, colour):
    return np.mean(np.abs(image - to_rgb(colour)).max(axis=2) < 0.1)


def lines(scene):
    ax = Figure().add_subplot()
    draw_scene(ax, SCAN, scene)
    return {line.get_label(): line.get_xydata() for line in ax.lines}, ax


def test_every_feature_is_drawn_where_it_is():
    drawn, _ = lines(SCENE)
    np.testing.assert_allclose(np.hypot(*drawn["beams"].T), 3.0)
    np.testing.assert_array_equal(drawn["scanner"], [[0, 0]])
    np.testing.assert_array_equal(drawn["door (width, m)"][:2], [[4, -0.5], [4, 0.5]])
    np.testing.assert_array_equal(drawn["corridor midpoint"], [[1, 0]])
    for kind in CornerKind:
        np.testing.assert_array_equal(drawn[f"{kind.name.lower()} corner"], [[4, kind]])


def test_an_arc_is_drawn_along_its_circle_from_start_to_end():
    arc = Arc((3.0, 0.0), 1.0, (3.0, -1.0), (3.0, 1.0))
    drawn, _ = lines(Scene(arcs=(arc,)))
    curve = drawn["arc (+ centre)"][1:-1]
    np.testing.assert_allclose(np.hypot(*(curve - arc.centre).T), 1.0)
    np.testing.assert_allclose(curve[[0, len(curve) // 2, -1], 0], [3.0, 2.0, 3.0], atol=0.01)
    np.testing.assert_allclose(curve[[0, -1]], [arc.start, arc.end], atol=1e-12)


def test_a_walls_tick_points_to_its_free_side():
    _, ax = lines(SCENE)
    ticks = ax.lines[2].get_xydata().reshape(-1, 3, 2)[:, :2]
    np.testing.assert_allclose(ticks[0], [[2.5, -1.0], [2.5, -0.8]], atol=1e-12)
    np.testing.assert_allclose(ticks[1], [[2.5, 1.0], [2.5, 0.8]], atol=1e-12)


def test_the_whole_scene_is_in_view_at_one_scale():
    _, ax = lines(SCENE)
    (west, east), (south, north) = ax.get_xlim(), ax.get_ylim()
    assert west < 0
    assert east > 4
    assert south < -1
    assert north > 1
    assert east - west == pytest.approx(north - south)


@pytest.mark.parametrize("count", [1, 7])
def test_a_page_shows_as_many_panels_as_scans(tmp_path, count):
    path = tmp_path / "page.png"
    save_page(path, [(f"scan {i}", SCAN, SCENE) for i in range(count)])
    image = pixels(path)
    columns = min(3, count)
    for i in range(math.ceil(count / columns) * columns):
        height, width = image.shape[0] / math.ceil(count / columns), image.shape[1] / columns
        y, x = int(i // columns * height), int(i % columns * width)
        panel = image[y : y + int(height * 0.9), x : x + int(width)]
        assert (share(panel, "#1a9e3f") > 0) == (i < count)


def test_a_door_is_seen_only_where_there_is_one(tmp_path):
    for name, scene in {"door": SCENE, "none": Scene(walls=SCENE.walls)}.items():
        ax = Figure().add_subplot()
        draw_scene(ax, SCAN, scene)
        ax.figure.savefig(tmp_path / f"{name}.png")
    assert share(pixels(tmp_path / "door.png"), "#1a9e3f") > 0
    assert share(pixels(tmp_path / "none.png"), "#1a9e3f") == 0


@pytest.mark.parametrize("ranges", [np.full(5, np.nan), np.full(5, np.inf), np.zeros(1)])
def test_a_scan_without_returns_is_drawn_too(tmp_path, ranges):
    save_page(tmp_path / "page.png", [("nothing", Scan(ranges, 0.0, 0.1), Scene())])
    assert share(pixels(tmp_path / "page.png"), "#d62728") > 0


@pytest.mark.parametrize("name", ["page.pdf", "page.SVG"])
def test_the_suffix_chooses_the_format(tmp_path, name):
    save_page(tmp_path / name, [("one", SCAN, SCENE)])
    head = (tmp_path / name).read_bytes()[:300]
    assert head.startswith(b"%PDF") or b"<svg" in head or b"<?xml" in head


def test_what_cannot_be_written_says_what_can(tmp_path):
    with pytest.raises(ValueError, match=r"\.png, \.pdf or \.svg"):
        save_page(tmp_path / "page.txt", [("one", SCAN, SCENE)])
    with pytest.raises(ValueError, match="at least one"):
        save_page(tmp_path / "page.png", [])
