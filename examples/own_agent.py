"""An agent of one's own: it curves towards its goal and slows down before walls.

One sees how it fares on four commands. The command line measures it as well, from the folder of the
checkout:

    semnav evaluate heidelberg --agent examples.own_agent:HeadForGoal --seeds 10
"""

import math
from typing import Any

import numpy as np

from semnav_agents.evaluation import run_suite, suite
from semnav_env.mind.observations import SeenGoal
from semnav_env.robots import RobotSpec
from semnav_features.lidar_spec import LidarSpec


class HeadForGoal:
    """Curves towards the goal so that it arrives there in the goal's direction."""

    observation = "all"

    def reset(self, info: dict[str, Any]) -> None:
        """An episode begins; `info` is what `env.reset` returned."""
        self.action_size = RobotSpec(**info["robot"]).action_size
        self.ahead = np.abs(LidarSpec(**info["lidar"]).angles) < 0.3

    def act(self, observation: dict[str, np.ndarray]) -> np.ndarray:
        """Shares of the largest speeds, in [-1, 1]."""
        x, y, heading = SeenGoal.read(observation["goal"]).pose
        before = 0.6 * math.hypot(x, y)  # aim at a place before the goal, nearer as one comes near
        x, y = x - before * math.cos(heading), y - before * math.sin(heading)
        bearing, free = math.atan2(y, x), float(observation["scan"][self.ahead].min())
        action = np.zeros(self.action_size, np.float32)
        action[0] = min(0.5, 0.3 * free) * max(0.0, math.cos(bearing))
        action[-1] = np.clip(1.5 * bearing, -1.0, 1.0)
        return action


def main() -> None:
    """Drive one episode of each command of the suite `heidelberg`."""
    for result in run_suite(suite("heidelberg"), HeadForGoal, "spot", seeds=range(1)):
        verdicts, contacts = ", ".join(result.verdicts), result.metrics.collisions
        print(f'"{result.command}": {verdicts}; contacts: {contacts}')


if __name__ == "__main__":
    main()
