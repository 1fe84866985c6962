"""A route in words: the shortest command that leads from a pose to a door, in two languages.

One sees the command, other ways to say it, and its clauses. Give the path of a .png, .pdf or .svg
to draw the route.

    python examples/describe_route.py route.png
"""

import sys
from pathlib import Path

import numpy as np

from semnav_env.judge.routes.describe import describe
from semnav_env.judge.routes.route_to import route_to
from semnav_env.language import paraphrases
from semnav_env.world.maps import load_floor_plan


def main(picture: str | None = None) -> None:
    """Describe one route."""
    plan = load_floor_plan("office_cross")
    route = route_to(plan, (1.3, 9.1, 0.0), "bend_north_3")
    command = describe(plan, route)
    print(f"{route.length:.1f} m: {command}")
    print("auf Deutsch:", command.say("de"))
    for other in paraphrases(command, np.random.default_rng(0), 3):
        print("or:", other)
    for clause in command.clauses:
        print(" ", repr(clause))
    if picture:
        from semnav_env.judge.routes.draw import save_routes

        save_routes(plan, [(route, str(command))], Path(picture))
        print("wrote", picture)


if __name__ == "__main__":
    main(*sys.argv[1:2])
