"""A command followed on a log: what a robot would have believed at each scan, and where it led.

The class that does it, `BeliefTracker`, needs scans and odometry only, so the same lines run on a
robot. One sees each change of the goal and of the clause. Give the path of a log and a command;
without them, a drive of the scripted agent is recorded first.

    python examples/command_on_log.py robot.log.gz "go through the first door on the left"
"""

import sys
from collections.abc import Iterable, Iterator

from semnav_env.belief import BeliefTracker
from semnav_env.commands import parse
from semnav_env.features import Scan
from semnav_env.features.frames import Pose
from semnav_env.features.readers import open_log
from semnav_env.lidar import LidarSpec

COMMAND = "go through the second door on the right, then stop"
Sensed = tuple[Scan, Pose]
"""A scan and the odometry at which it was taken."""


def from_log(path: str) -> Iterator[Sensed]:
    """The scans of a log that have odometry, or a pose in its place."""
    with open_log(path) as log:
        for record in log:
            pose = record.odometry or record.pose
            if pose is not None:
                yield record.scan, pose


def recorded() -> Iterator[Sensed]:
    """The scans and the odometry of a drive in the simulator."""
    from semnav_env.agents.base import steps
    from semnav_env.agents.registry import make_agent
    from semnav_env.env import SemNavEnv
    from semnav_env.observations import read_odometry

    agent = make_agent("scripted")
    env = SemNavEnv("spot", observation=agent.observation)
    start = env.reset(seed=0, options={"command": COMMAND, "pose": (-2.5, -0.6, 0.25)})
    lidar = env.lidar_spec
    for step in steps(env, agent, *start):
        ranges, pose = step.observation["scan"], read_odometry(step.observation)[0]
        yield Scan(ranges, lidar.angle_min, lidar.angle_increment, range_max=lidar.range_max), pose


def follow(sensed: Iterable[Sensed], command: str) -> None:
    """Print what changes in the belief."""
    tracker, told = None, None
    for number, (scan, odometry) in enumerate(sensed):
        if tracker is None:
            beams, first, apart = len(scan.ranges), scan.angle_min, scan.angle_increment
            tracker = BeliefTracker(LidarSpec("log", beams, first, apart, range_max=scan.range_max))
            tracker.begin(parse(command))
        belief = tracker.update(scan.ranges, odometry)
        new = belief.clause, type(belief.goal).__name__, belief.reasons
        if new != told:
            print(f"scan {number}: clause {new[0]}, {new[1]}: {'; '.join(new[2])}")
        told = new


if __name__ == "__main__":
    path, command = (*sys.argv[1:3], COMMAND)[:2] if len(sys.argv) > 1 else (None, COMMAND)
    follow(from_log(path) if path else recorded(), command)
