"""`semnav demo`: let one robot carry out one command, with a film or a picture of it."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from tyro.conf import Positional, arg

from semnav_env.agents.base import Agent, steps
from semnav_env.agents.registry import make_agent
from semnav_env.agents.translating.interpreter import understand
from semnav_env.commands import SearchHouse
from semnav_env.commands.speech.recognition import language_of_text
from semnav_env.dynamics import NO_DYNAMICS, Dynamics
from semnav_env.dynamics.social import for_json
from semnav_env.env import SemNavEnv
from semnav_env.maps import FloorPlan, load_floor_plan
from semnav_env.scripts.arguments import parse_pose
from semnav_env.scripts.outputs import check_file
from semnav_env.scripts.progress import tracked

DEFAULT_MAP = "heidelberg_hallway"
"""The floor plan where none is named."""

STEPS_PER_FRAME = 3
"""Steps of the environment for each frame of a film: 5 frames a second are enough to follow it."""

STEPS_PER_SEARCH_FRAME = 60
"""The same for a search, which takes minutes: the film is twenty times as fast."""

KNOWS_THE_PLAN = "agent searcher, which knows the floor plan; --agent explorer does without"
"""What is said of the agent of a search where none is named."""


@dataclass(frozen=True)
class Arguments:
    """Let a robot carry out a command.

    The exit code is 0 if the robot got there, 1 if it did not, and 2 if the command cannot be
    carried out from its start.

    Attributes:
        command: what to say to the robot.
        map: a floor plan: a name (office_cross, or office:medium:17, generated) or a path;
            heidelberg_hallway if not given, for a search a generated house.
        language: of the command: en or de (english, german); recognised if not given.
        robot: wheelchair or spot.
        agent: scripted, oracle, blind, random, drive, listener, listener_drives (trained), the
            folder of a trained agent, or package.module:Class; searcher (knows the plan) or
            explorer for a search. If not given: scripted, for a search searcher.
        pose: where the robot starts, x,y,heading in metres and radians; random if not given.
        seed: of everything that is random.
        dynamics: what else moves.
        save: film to write (.gif or .mp4).
        picture: picture of the end to write (.png).
        show: show the drive in a window, without --save and --picture.
        json: print the outcome as JSON.
    """

    command: Positional[str]
    map: str | None = None
    language: str | None = None
    robot: str = "wheelchair"
    agent: str | None = None
    pose: str | None = None
    seed: int = 0
    dynamics: Annotated[Dynamics, arg(name="")] = NO_DYNAMICS
    save: Path | None = None
    picture: Path | None = None
    show: bool = False
    json: bool = False

    def run(self) -> int:
        """Drive, film and report."""
        if self.seed < 0:
            raise ValueError(f"seed is {self.seed}; it must be 0 or more")
        self._check_files()
        plan = load_floor_plan(self.map or DEFAULT_MAP)
        command = understand(self.command, self.language, plan.room_names)
        searches = SearchHouse() in command.clauses
        agent = make_agent(self.agent or ("searcher" if searches else "scripted"))
        filmed = self.save is not None or self.picture is not None
        env = self._environment(plan, agent, searches, filmed)
        frames_apart = STEPS_PER_SEARCH_FRAME if searches else STEPS_PER_FRAME
        spoken = language_of_text(self.command, self.language)
        options: dict[str, Any] = {"command": command, "language": spoken.code}
        if self.pose is not None:
            options["pose"] = parse_pose(self.pose)
        observation, start = env.reset(seed=self.seed, options=options)
        frames: list[NDArray[np.uint8]] = []
        info: dict[str, Any] = {}
        driven = tracked(
            steps(env, agent, observation, start), lambda _: f"{env.seconds:.0f} s", lambda: None
        )
        for number, step in enumerate(driven):
            info = step.info
            if filmed and (number % frames_apart == 0 or "is_success" in info):
                frames.append(env.render())  # type: ignore[arg-type]
        echo = env.judge.verifier.mission.command.say(spoken)
        env.close()
        self._save(frames, env.metadata["render_fps"] / STEPS_PER_FRAME)
        self._report(start, echo, info, env.seconds, for_json(env.world.social()))
        return 0 if info["is_success"] else 1

    def _environment(
        self, plan: FloorPlan, agent: Agent, searches: bool, filmed: bool
    ) -> SemNavEnv:
        """The environment for a command: that of a search has a person detector and victims."""
        mode = "human" if self.show else "rgb_array" if filmed else None
        if not searches:
            return SemNavEnv(
                self.robot,
                plan,
                observation=agent.observation,
                dynamics=self.dynamics,
                render_mode=mode,
            )
        from semnav_env.rescue.environment import VICTIMS, search_and_rescue

        return search_and_rescue(
            observation=agent.observation,
            robot=self.robot,
            floor_plan=plan if self.map else f"office:house:{self.seed}",
            dynamics=replace(self.dynamics, victims=self.dynamics.victims or VICTIMS),
            render_mode=mode,
        )

    def _check_files(self) -> None:
        """Refuse bad paths before the drive, which takes a while."""
        from semnav_env.rendering.video import check_suffix

        if self.show and (self.save or self.picture):
            raise ValueError("--show opens a window; give it without --save and --picture")
        check_file(self.save, "--save")
        check_file(self.picture, "--picture")
        if self.save is not None:
            check_suffix(self.save)
        if self.picture is not None:
            check_suffix(self.picture, (".png",))

    def _save(self, frames: list[NDArray[np.uint8]], rate: float) -> None:
        from semnav_env.rendering.video import save_png, save_video

        if self.save is not None:
            save_video(self.save, frames, rate)
        if self.picture is not None:
            save_png(self.picture, frames[-1])

    def _report(
        self,
        start: dict[str, Any],
        echo: str,
        info: dict[str, Any],
        seconds: float,
        social: dict[str, Any],
    ) -> None:
        outcome = {
            "command": start["command"],
            "floor_plan": start["floor_plan"],
            "pose": start["pose"],
            "success": info["is_success"],
            "verdicts": [str(verdict) for verdict in info["verdicts"]],
            "crossed_doors": list(info["crossed_doors"]),
            "collisions": info["collisions"],
            "impossible": info["impossible"],
            "seconds": round(seconds, 2),
            "path_length": round(info["path_length"], 3),
            "route_length": round(info["route_length"], 3),
            **social,
            **({"search": info["search"]} if "search" in info else {}),
            "files": [str(path) for path in (self.save, self.picture) if path is not None],
        }
        if self.json:
            print(json.dumps(outcome))
            return
        verdict = "done" if info["is_success"] else " / ".join(outcome["verdicts"])
        pose = ",".join(f"{value:.2f}" for value in start["pose"])
        print(f"from {pose} in {start['floor_plan']}")
        if "search" in outcome and self.agent is None:
            print(KNOWS_THE_PLAN)
        print(
            f'"{echo}": {verdict} after {seconds:.1f} s and '
            f"{info['path_length']:.1f} m, {info['collisions']} collisions"
        )
        if "search" in outcome:
            print(_found(outcome["search"]))
        if outcome["impossible"]:
            print(f"the robot took it for impossible: {outcome['impossible']}")
        for path in outcome["files"]:
            print(f"wrote {path}")


def _found(search: dict[str, Any]) -> str:
    """What became of a search, in one line."""
    return (
        f"{search['found']} of {search['victims']} people found, "
        f"{search['false_reports']} false reports, "
        f"least covered room {100 * search['least_coverage']:.0f} %"
    )
