"""Door jambs in point clouds: from any (n, 3) array of points to a detected door.

    cloud = PointCloud(points)                      # robot frame, z up from the floor
    expected, sigma = expect_door(door, pose, covariance)
    found = find_door(cloud, expected, sigma)       # a DetectedDoor, or None

It needs no simulator: the points may come from a real robot.
"""

from semnav_features.clouds.clusters import euclidean_clusters
from semnav_features.clouds.crop import CropBox, crop
from semnav_features.clouds.detected_door import DetectedDoor, expect_door
from semnav_features.clouds.finder import DoorFinder, find_door, find_shut_door
from semnav_features.clouds.joined import joined
from semnav_features.clouds.lidar_doors import door_in_scene
from semnav_features.clouds.mes import MesDetector, MesStep
from semnav_features.clouds.outliers import remove_outliers
from semnav_features.clouds.plane import plane_inliers
from semnav_features.clouds.point_cloud import PointCloud, fused
from semnav_features.clouds.upright_line import UprightLine, pair_apart, upright_line
from semnav_features.clouds.voxels import voxel_grid

__all__ = [
    "CropBox",
    "DetectedDoor",
    "DoorFinder",
    "MesDetector",
    "MesStep",
    "PointCloud",
    "UprightLine",
    "crop",
    "door_in_scene",
    "euclidean_clusters",
    "expect_door",
    "find_door",
    "find_shut_door",
    "fused",
    "joined",
    "pair_apart",
    "plane_inliers",
    "remove_outliers",
    "upright_line",
    "voxel_grid",
]
