"""A body of one's own: a small delivery robot that can move sideways.

One sees the size of its actions and that it drives through a door; so does a slower one.
"""

from dataclasses import replace

from semnav_agents import make_agent
from semnav_agents.base import steps
from semnav_env.env import SemNavEnv
from semnav_env.robots import RobotSpec

COURIER = RobotSpec(
    name="courier",
    length=0.70,
    width=0.50,
    mass=40.0,
    max_speed=1.2,
    max_sideways_speed=0.4,
    max_turn_rate=1.8,
    max_acceleration=1.0,
    max_turn_acceleration=3.0,
    axle=0.0,
    lidar_mount=(0.25, 0.0, 0.0),
    source="an example",
)
START = {"command": "go through the first door on the right", "pose": (-2.5, -0.3, 0.24)}


def main() -> None:
    """Drive it, and another one that is slow and cannot move sideways."""
    for robot in (COURIER, replace(COURIER, name="walker", max_speed=0.6, max_sideways_speed=0.0)):
        agent = make_agent("scripted")
        env = SemNavEnv(robot, "heidelberg_hallway", observation=agent.observation)
        *_, last = steps(env, agent, *env.reset(seed=0, options=START))
        length, speeds = robot.length, env.action_space.shape[0]
        print(f"{robot.name}: {length} m long, {speeds} numbers an action", end="; ")
        print(f"success {last.info['is_success']} after {env.seconds:.0f} s")


if __name__ == "__main__":
    main()
