"""Draw docs/images/logs.png: three simulated scans with what the extractor finds in them."""

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import load_floor_plan
from semnav_features import extract
from semnav_features.plot import save_page
from studies.figures import IMAGES

PLACES = (
    ("heidelberg_hallway", (-2.5, -0.3, 0.24)),
    ("office_cross", (8.5, 9.1, 0.0)),
    ("office_cross", (15.0, 16.5, 0.7)),
)


def main() -> None:
    """Draw logs.png: scans with what is extracted from them."""
    panels = []
    for step, (name, pose) in enumerate(PLACES):
        scan = Lidar(load_floor_plan(name)).scan(pose, key=(0, 0, step))
        panels.append((name, scan, extract(scan)))
    save_page(IMAGES / "logs.png", panels)
