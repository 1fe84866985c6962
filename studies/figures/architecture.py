"""Writes docs/architecture.md: the folders, their lines and imports, and three walks."""

from __future__ import annotations

import ast
from collections import defaultdict
from pathlib import Path
from statistics import median

from studies.figures import IMAGES

PAGE = IMAGES.parent / "architecture.md"
ROOT = IMAGES.parents[1]
ROOTS = {
    "semnav_features": ROOT / "features",
    "semnav_env": ROOT,
    "semnav_agents": ROOT / "agents",
    "semnav_ros": ROOT / "scripts",
    "semnav_scripts": ROOT / "scripts",
}
LAYERS = tuple(ROOTS)

ABOUT = {
    "semnav_features": "from a scan to a scene, memory, drift; NumPy and Numba only",
    "semnav_features/clouds": "door jambs in point clouds",
    "semnav_features/explain": "why the extractor rejected a candidate",
    "semnav_features/kernels": "the compiled parts, over plain arrays",
    "semnav_features/mapping": "line maps, landmarks and scan matching",
    "semnav_features/readers": "logs of real robots",
    "semnav_env": "the environment, the rules, and parts that no folder below holds",
    "semnav_env/approach": "poses from which a door can be passed",
    "semnav_env/mind/belief": "from ranges, odometry and bumps to pose, scene and goal",
    "semnav_env/bench": "the measurement of speed: `semnav bench`",
    "semnav_env/language": "text to clauses and back",
    "semnav_env/language/corpora": "how much of people's words is understood",
    "semnav_env/language/vocabulary": "the words that people say, by their classes",
    "semnav_env/world/depth": "simulated depth cameras, and floor plans raised to their ceiling",
    "semnav_env/world/dynamics": "people, swinging doors, moved furniture",
    "semnav_env/judge/episodes": "frozen episodes and the splits",
    "semnav_env/mind/grounding": "what a clause refers to in a scene, and where it leads",
    "semnav_env/world/grid": "grids: reachable poses, distances, costs of paths, cells in view",
    "semnav_env/world/lidar": "the simulated lidar",
    "semnav_env/mind/localization": "the pose of a robot in a known plan, by its doors",
    "semnav_env/judge": "the judge: whether a command was carried out",
    "semnav_env/mind": "the part that runs on a robot: belief, grounding, observations",
    "semnav_env/world": "the simulated world: plans, physics, sensors, people",
    "semnav_env/world/maps": "floor plans: read, check, find ways",
    "semnav_env/world/maps/generator": "offices drawn from a seed",
    "semnav_env/world/maps/importers": "floor plans from other formats",
    "semnav_env/judge/metrics": "measures of a recorded episode",
    "semnav_env/mind/observations": "the declared layout of an observation, written and read",
    "semnav_env/rendering": "pictures, films, the window",
    "semnav_env/rescue": "searching houses: a person detector, its map of people, coverage",
    "semnav_env/robots": "bodies and their actions",
    "semnav_env/judge/routes": "routes in words, and the ways to named rooms",
    "semnav_env/world/simulator": "world, lidar and odometry behind `step(twist) -> Sensed`",
    "semnav_env/judge/tasks": "requests and missions of episodes, and rewards",
    "semnav_env/vector": "many robots in one environment",
    "semnav_env/world/physics": "the physics; the only folder that imports Pymunk",
    "semnav_agents": "scripted, oracle and learned agents, and floors, behind one protocol",
    "semnav_agents/assistance": "shared control: a person or an agent drives, the robot helps",
    "semnav_agents/evaluation": "suites of episodes, driven and judged",
    "semnav_agents/hearing": "agents that hear the command: a learned grounding for the planner",
    "semnav_agents/learning": "training and its files",
    "semnav_agents/learning/rllib": "training on more than one machine, with RLlib on Ray",
    "semnav_agents/networks": "where the networks of agents lie, and what their training shares",
    "semnav_env/networks": "the layers of learned networks in NumPy, and their files",
    "semnav_agents/planning": "the planner of the scripted agent and the oracle",
    "semnav_agents/searching": "searching a house: poses to look from, and people to approach",
    "semnav_env/language/translating": "the learned reader: values out, translated",
    "semnav_ros": "a robot's own node: its core without ROS, and what carries its messages",
    "semnav_scripts": "the `semnav` command",
    "semnav_scripts/launch": "launch files of ROS 1 and ROS 2",
    "semnav_scripts/page": "the page of `semnav serve`: requests, sessions, server, web files",
    "semnav_scripts/playing": "driving by hand: `semnav play`",
    "semnav_scripts/report": "the report of an evaluation: one HTML file, with its failures",
    "semnav_scripts/recording": "recordings of a followed command, for Rerun and Foxglove",
}

TEMPLATE = """# Architecture

The simulator and the robot meet only at the sensors: only data that a real robot has, too, go
from one to the other. The folder `features/` is the root of the package `semnav_features`,
`agents/` that of `semnav_agents`, and `scripts/` that of `semnav_ros` and `semnav_scripts`;
`semnav_env/` is a package itself. Paths below begin with the package.

                 SIMULATOR                     |                ROBOT'S SIDE
                                               |
    floor plan --> world (Pymunk) --> lidar ---+--> ranges, odometry, bumps --> BeliefTracker
        |             ^                        |                                     |
        |             +---- twist <------------+-- agent <-- observation <-- Belief <+
        |                                      |                    (pose, scene, clause, goal)
        +--> true scene --> JUDGE --> reward, end, info

`semnav_env` has four main packages: `language` (text to clauses and back), `world` (the simulated
world and its sensors), `mind` (the robot's belief, and the goals of clauses) and `judge` (the
contents of episodes, and whether they were carried out). `language` and `world` import none of the
others, `mind` imports `language`, and `judge` imports all three. The environment (`env.py`,
`vector`) connects them.

`tests/test_layers.py` checks the imports. `semnav_scripts` may import `semnav_ros`, which may
import `semnav_agents`, which may import `semnav_env`, which may import `semnav_features`, never
the other way round. There are no import cycles. `semnav_env/mind/belief` imports nothing of the
simulator or the judge.

[Where do I change what?](where.md) names the file for the most frequent
changes: a door, a reward term, a clause, a sensor, a format, an agent, an entry of the observation.

## Three walks through the code

**A scan.** `SemNavEnv.step` (`semnav_env/env.py`) is one control period, which is written in
`semnav_env/control_period.py` from top to bottom: drive, sense, understand, judge, reward, end,
info. The first four are one compiled call, `run_period`, which calls three others. `sense`
(`semnav_env/world/simulator/sensing.py`) drives the body (`semnav_env/world/physics/drive.py`),
updates the odometry (`semnav_env/world/simulator/odometry.py`) and makes the scan. `understand`
(`semnav_env/mind/belief/understand.py`) extracts the features
(`semnav_features/kernels/chain.py`), corrects the drift (`semnav_features/kernels/drift.py`),
remembers walls and doors (`semnav_features/kernels/memory.py`) and updates the progress of the
active clause (`semnav_env/mind/grounding/clause_progress.py`). `judge_motion`
(`semnav_env/judge/judge_record.py`) updates the judge's counters, and writes the `Period`: the
result of this control period. They return events, such as a completed clause. Only after an event
does `RobotLoop.think` call `BeliefTracker.think` (`semnav_env/mind/belief/tracker.py`), which
grounds again, and `Judge.think`, which completes the `Period`. Rewards, ends and infos are made
from the `Period` by functions that take numbers for one robot and arrays for many:
`SemNavVectorEnv` (`semnav_env/vector/vector_env.py`) is the same control period, with `run_period`
in threads (`semnav_env/vector/tick.py`) and the functions called once. On a real robot
`BeliefTracker.update` calls `understand` with the sensor data. `EntryObservation.observe`
(`semnav_env/mind/observations/observer.py`) makes the arrays that an agent gets.

**A command.** `parse` (`semnav_env/language/translating/interpreter.py`) turns text into a
`Command`, a tuple of clauses. `MissionMaker` (`semnav_env/judge/tasks/mission_maker.py`) checks
on the floor plan that it can be carried out. The robot's `Follower`
(`semnav_env/mind/grounding/follower.py`) holds the active clause and grounds it on the memory
(`semnav_env/mind/grounding/ground.py`); the result is a goal: seek, reach, pass or stop. The
`Judge` (`semnav_env/judge/judge.py`) runs the same follower on the true scene, once for each right
answer (`semnav_env/judge/readings.py`), and gives each clause a `Verdict`.

**An action.** `Actions.twist` (`semnav_env/robots/actions.py`) turns the action into a velocity.
`drive` (`semnav_env/world/physics/drive.py`) bounds its acceleration and lets Chipmunk, the
engine in Pymunk, move the body (`semnav_env/world/physics/chipmunk.py`). The true motion goes to
the `JudgeRecord` (`semnav_env/judge/judge_record.py`): crossed doors, reached places, progress.
`weigh` (`semnav_env/judge/tasks/rewards.py`) computes the reward of the step.

## Folders

{total} lines of Python in {files} files; the median file has {median:g}, the longest {longest}.
Lines include comments and docstrings.

| folder | lines | what it holds | imports from |
|---|---|---|---|
{rows}
"""


def page() -> str:
    """The page, made of the code as it is."""
    sources = {path: path.read_text(encoding="utf-8") for path in _files()}
    lines = {path: len(source.splitlines()) for path, source in sources.items()}
    folders: dict[str, list[Path]] = defaultdict(list)
    for path in sources:
        folders[_folder(path)].append(path)
    rows = []
    for name in sorted(folders, key=lambda name: (LAYERS.index(name.split("/")[0]), name)):
        needs = sorted({n for p in folders[name] for n in _needs(sources[p])} - {name})
        count = sum(lines[path] for path in folders[name])
        imports = ", ".join(need.removeprefix("semnav_env/") for need in needs)
        rows.append(f"| `{name}` | {count} | {ABOUT[name]} | {imports} |")
    return TEMPLATE.format(
        total=sum(lines.values()),
        files=len(lines),
        median=median(lines.values()),
        longest=max(lines.values()),
        rows="\n".join(rows),
    )


def _files() -> list[Path]:
    return [path for layer in LAYERS for path in sorted((ROOTS[layer] / layer).rglob("*.py"))]


def _folder(path: Path) -> str:
    """The folder of a file, from its package on."""
    root = next(root for layer, root in ROOTS.items() if path.is_relative_to(root / layer))
    return path.parent.relative_to(root).as_posix()


def _needs(source: str) -> set[str]:
    """The folders that a module imports from."""
    names = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(LAYERS):
            names |= {_home(f"{node.module}.{alias.name}") for alias in node.names}
    return names


def _home(dotted: str) -> str:
    """The folder of a module or of a name in it."""
    parts = dotted.split(".")
    while not ROOTS[parts[0]].joinpath(*parts).is_dir():
        parts = parts[:-1]
    return "/".join(parts)


def main() -> None:
    """Write the page."""
    PAGE.write_text(page(), encoding="utf-8")
