"""Routes through a floor plan, and the commands that describe them."""

from semnav_env.routes.describe import UndescribableError, describe
from semnav_env.routes.follow import follows
from semnav_env.routes.route import Route, RouteError
from semnav_env.routes.route_to import comfortable, route_to

__all__ = [
    "Route",
    "RouteError",
    "UndescribableError",
    "comfortable",
    "describe",
    "follows",
    "route_to",
]
