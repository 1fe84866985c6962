"""Draw docs/images/routes.png: three routes, and what is said for each."""

from semnav_env.judge.routes.describe import describe
from semnav_env.judge.routes.draw import save_routes
from semnav_env.judge.routes.route_to import route_to
from semnav_env.world.maps import load_floor_plan
from studies.figures import IMAGES

START = (1.3, 9.1, 0.0)
GOALS = ("west_south_2", "south_east", "room_bend_south_2")


def main() -> None:
    """Draw routes.png: three routes, and what is said for each."""
    plan = load_floor_plan("office_cross")
    routes = [route_to(plan, START, goal) for goal in GOALS]
    told = [(route, str(describe(plan, route))) for route in routes]
    save_routes(plan, told, IMAGES / "routes.png", names=False)
