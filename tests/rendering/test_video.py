"""Films and pictures in files."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from semnav_env.rendering.video import save_gif, save_mp4, save_png, save_video
from semnav_env.rendering.viewer import Viewer
from tests.support.small_office import PLAIN, PLAN

pytest.importorskip("pygame", reason="pictures need the extra `render`")


@pytest.fixture(scope="module")
def viewer() -> Viewer:
    return Viewer(PLAN)


@pytest.fixture(scope="module")
def film(viewer: Viewer) -> list[NDArray[np.uint8]]:
    return [viewer.draw(replace(PLAIN, pose=(2.0 + 0.2 * k, 3.0, 0.1))) for k in range(7)]


def test_a_gif_has_the_frames_and_the_duration_it_was_given(
    tmp_path: Path, film: list[NDArray[np.uint8]]
) -> None:
    path = save_gif(tmp_path / "new" / "folder" / "run.gif", film, fps=15)
    with Image.open(path) as gif:
        assert gif.n_frames == len(film)
        durations = []
        for index, frame in enumerate(film):
            gif.seek(index)
            durations.append(gif.info["duration"])
            error = np.abs(np.asarray(gif.convert("RGB"), dtype=float) - frame)
            assert error.mean() < 0.5
            assert error.max() < 40.0
    assert sum(durations) == pytest.approx(1000 * len(film) / 15, abs=10)


@pytest.mark.parametrize("shades", [1, 255, 100_000])
def test_a_gif_of_any_number_of_colours_stays_close(tmp_path: Path, shades: int) -> None:
    noise = np.random.default_rng(0).integers(0, shades, (100, 100))
    frame = np.stack((noise % 251, noise // 251 % 251, noise % 7), axis=-1).astype(np.uint8)
    with Image.open(save_gif(tmp_path / "noise.gif", [frame], fps=10)) as gif:
        error = np.abs(np.asarray(gif.convert("RGB"), dtype=float) - frame)
    assert error.mean() < (0.5 if shades < 256 else 20.0)


def test_equal_frames_of_a_gif_last_as_long_as_they_should(
    tmp_path: Path, film: list[NDArray[np.uint8]]
) -> None:
    path = save_gif(tmp_path / "still.gif", [film[0], film[0], film[1]], fps=10)
    with Image.open(path) as gif:
        assert gif.n_frames == 2
        assert gif.info["duration"] == 200


def test_a_film_can_be_saved_smaller(tmp_path: Path, film: list[NDArray[np.uint8]]) -> None:
    with Image.open(save_video(tmp_path / "run.gif", film, fps=10, scale=0.5)) as gif:
        assert gif.size == (480, 360)


def test_an_mp4_has_the_frames_it_was_given(tmp_path: Path, film: list[NDArray[np.uint8]]) -> None:
    imageio = pytest.importorskip("imageio.v3", reason="mp4 needs the extra `render`")
    pytest.importorskip("av", reason="mp4 needs the extra `render`")
    path = save_mp4(tmp_path / "run.mp4", [frame[:, :-1] for frame in film], fps=10)
    frames = imageio.imread(path, plugin="pyav")
    assert frames.shape == (len(film), 720, 958, 3)
    assert np.abs(frames[3].astype(float) - film[3][:, :958]).mean() < 5.0


def test_a_png_holds_the_last_frame_exactly(tmp_path: Path, film: list[NDArray[np.uint8]]) -> None:
    with Image.open(save_video(tmp_path / "end.png", film, fps=10)) as image:
        np.testing.assert_array_equal(np.asarray(image), film[-1])
    assert save_png(tmp_path / "one.png", film[0]).exists()


def test_an_unknown_suffix_is_refused_with_those_there_are(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"\.gif, \.mp4 or \.png"):
        save_video(tmp_path / "run.avi", [np.zeros((4, 4, 3), np.uint8)], fps=10)


@pytest.mark.parametrize("name", ["run.gif", "run.mp4", "run.png"])
def test_no_frames_are_refused_and_leave_no_file(tmp_path: Path, name: str) -> None:
    with pytest.raises(ValueError, match="no frames"):
        save_video(tmp_path / name, [], fps=10)
    assert not (tmp_path / name).exists()


@pytest.mark.parametrize(("fps", "scale"), [(0.0, 1.0), (math.nan, 1.0), (10.0, 0.0), (10.0, 2.0)])
def test_bad_rates_and_scales_are_refused(tmp_path: Path, fps: float, scale: float) -> None:
    with pytest.raises(ValueError, match="it must be"):
        save_gif(tmp_path / "run.gif", [np.zeros((4, 4, 3), np.uint8)], fps, scale)
