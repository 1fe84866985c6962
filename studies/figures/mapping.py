"""Draw docs/images/mapping.png: the map of a drive through the office, poses found by matching."""

import math
from itertools import pairwise

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_env.world.maps.draw import draw_floor_plan
from semnav_env.world.maps.line_map_plan import plan_of_scene
from semnav_features import extract
from semnav_features.frames import compose
from semnav_features.mapping import LineMap, ScanOdometry
from studies.figures import IMAGES

WAY = ((2.5, 9.1), (27.0, 9.1), (15.0, 9.1), (15.0, 17.0), (15.0, 2.5))
STEP, TURN = 0.15, math.radians(10.0)


def drive() -> list[tuple[float, float, float]]:
    """Poses along the way, turning on the spot at its corners."""
    poses: list[tuple[float, float, float]] = []
    heading = 0.0
    for (x1, y1), (x2, y2) in pairwise(WAY):
        turn = math.remainder(math.atan2(y2 - y1, x2 - x1) - heading, math.tau)
        turns = math.ceil(abs(turn) / TURN)
        poses += [(x1, y1, heading + turn * k / turns) for k in range(turns)]
        heading += turn
        steps = round(math.dist((x1, y1), (x2, y2)) / STEP)
        shares = (k / steps for k in range(steps + 1))
        poses += [(x1 + s * (x2 - x1), y1 + s * (y2 - y1), heading) for s in shares]
    return poses


def mapped(plan: FloorPlan) -> FloorPlan:
    """The plan as a lidar without wheels finds it."""
    lidar, line_map, odometry = Lidar(plan), LineMap(), ScanOdometry()
    poses = drive()
    for step, pose in enumerate(poses):
        scan = lidar.scan(pose, key=(0, 0, step))
        line_map.add(extract(scan), scan, compose(poses[0], odometry.update(scan)))
    x, y, turn = compose(poses[0], odometry.pose)
    off = math.dist((x, y), poses[-1][:2])
    print(f"{len(poses)} scans; at the end {off:.3f} m and {turn - poses[-1][2]:.4f} rad off")
    return plan_of_scene(line_map.scene, "map")


def main() -> None:
    """Draw mapping.png: the map of a drive through the office, poses found by matching."""
    plan = load_floor_plan("office_cross")
    found = mapped(plan)
    figure = Figure(figsize=(11, 15), layout="constrained")
    FigureCanvasAgg(figure)
    above: Axes
    below: Axes
    above, below = figure.subplots(2, 1, sharex=True, sharey=True)
    draw_floor_plan(plan, above, names=False)
    draw_floor_plan(found, below, names=False)
    above.set_title("the floor plan")
    below.set_title(f"its map: {len(found.surfaces)} walls and {len(found.doors)} open doors")
    figure.savefig(IMAGES / "mapping.png", dpi=60)
