"""Tasks of one's own: what episodes are asked to be, harder with success, on varying robots.

One sees which commands, plans and lidars the episodes of each task get.
"""

from dataclasses import replace

import numpy as np

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import CommandTask, Curriculum, EpisodeRequest, RandomisedRobot
from semnav_env.world.lidar import TIM561
from semnav_env.world.simulator import EXACT, OdometrySettings


class SomeDoor:
    """Asks for the nth door on a side, in an office that is new each time."""

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        """Draw from `rng` alone, so that a seed gives the same episodes."""
        nth, side = rng.choice(["first", "second"]), rng.choice(["left", "right"])
        office = f"office:small:{rng.integers(100)}"
        return EpisodeRequest(f"go through the {nth} door on the {side}", floor_plan=office)


NOISY = replace(TIM561, name="noisy", sigma=0.04, dropout=0.02)
RANDOMISED = RandomisedRobot(
    CommandTask(floor_plans=("office_cross", "heidelberg_hallway")),
    lidars=("tim561", NOISY),
    odometry=(EXACT, OdometrySettings(turn_bias=0.03)),
)
EASY_FIRST = Curriculum(
    ["go through the first door on the right", SomeDoor()], promotion=1.0, window=2
)


def main() -> None:
    """Begin a few episodes of each task."""
    commands = ["turn around", "go through the second door on the right"]
    for name, task in (("list", commands), ("own", SomeDoor()), ("randomised", RANDOMISED)):
        env = SemNavEnv(task=task)
        env.reset(seed=0)
        for _ in range(3):
            _, info = env.reset()
            plan, lidar = info["floor_plan"], info["lidar"]["name"]
            print(f'{name}: "{info["command"]}" in {plan} with lidar {lidar}')
    for success in (True, False, True, True):
        EASY_FIRST.note(success)  # the environment tells it so at the end of each episode
        print(f"curriculum: success {success}, now at stage {EASY_FIRST.stage}")


if __name__ == "__main__":
    main()
