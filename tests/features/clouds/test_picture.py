"""Pictures of clouds."""

import numpy as np
import pytest
from PIL import Image

from semnav_features.clouds import PointCloud, find_door
from semnav_features.clouds.picture import save_cloud
from tests.support.door_clouds import DOOR, door_cloud

RED = (214, 39, 40)


def reds(path):
    with Image.open(path) as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    return int((np.abs(pixels - RED).max(axis=2) < 12).sum())


def test_the_jambs_that_were_found_are_red(tmp_path):
    cloud = door_cloud(np.random.default_rng(0))
    save_cloud(tmp_path / "found.png", cloud, DOOR, find_door(cloud, DOOR))
    save_cloud(tmp_path / "none.png", cloud, DOOR, None)
    assert reds(tmp_path / "found.png") > 300 > reds(tmp_path / "none.png")


def test_an_empty_cloud_is_drawn(tmp_path):
    save_cloud(tmp_path / "empty.svg", PointCloud(), DOOR, None)
    assert (tmp_path / "empty.svg").stat().st_size > 1000


def test_a_name_that_is_no_picture_is_refused(tmp_path):
    with pytest.raises(ValueError, match=r"must end in \.png"):
        save_cloud(tmp_path / "cloud.ply", PointCloud(), DOOR, None)
