"""`semnav demo`: let one robot carry out one command, with a film or a picture of it."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from tyro.conf import Positional, arg

from semnav_env.agents.base import steps
from semnav_env.agents.registry import make_agent
from semnav_env.commands import parse
from semnav_env.dynamics import NO_DYNAMICS, Dynamics
from semnav_env.dynamics.social import for_json
from semnav_env.env import SemNavEnv
from semnav_env.scripts.arguments import parse_pose
from semnav_env.scripts.outputs import check_file
from semnav_env.scripts.progress import tracked

STEPS_PER_FRAME = 3
"""Steps of the environment for each frame of a film: 5 frames a second are enough to follow it."""


@dataclass(frozen=True)
class Arguments:
    """Let a robot carry out a command.

    The exit code is 0 if the robot got there, 1 if it did not, and 2 if the command cannot be
    carried out from its start.

    Attributes:
        command: what to say to the robot.
        map: a floor plan: a name (office_cross, or office:medium:17, generated) or a path.
        language: of the command: en or de (english, german).
        robot: wheelchair or spot.
        agent: scripted, oracle, quick, office (trained ones), the folder of a trained agent, or
            package.module:Class.
        pose: where the robot starts, x,y,heading in metres and radians; random if not given.
        seed: of everything that is random.
        dynamics: what else moves.
        save: film to write (.gif or .mp4).
        picture: picture of the end to write (.png).
        show: show the drive in a window.
        json: print the outcome as JSON.
    """

    command: Positional[str]
    map: str = "heidelberg_hallway"
    language: str = "en"
    robot: str = "wheelchair"
    agent: str = "scripted"
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
        agent = make_agent(self.agent)
        filmed = self.save is not None or self.picture is not None
        mode = "human" if self.show else "rgb_array" if filmed else None
        env = SemNavEnv(
            self.robot,
            self.map,
            observation=agent.observation,
            dynamics=self.dynamics,
            render_mode=mode,
        )
        command = parse(self.command, self.language, env.floor_plan.room_names)
        options: dict[str, Any] = {"command": command}
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
            if filmed and (number % STEPS_PER_FRAME == 0 or "is_success" in info):
                frames.append(env.render())  # type: ignore[arg-type]
        env.close()
        self._save(frames, env.metadata["render_fps"] / STEPS_PER_FRAME)
        self._report(start, info, env.seconds, for_json(env.world.social()))
        return 0 if info["is_success"] else 1

    def _check_files(self) -> None:
        """Refuse bad paths before the drive, which takes a while."""
        from semnav_env.rendering.video import check_suffix

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
        self, start: dict[str, Any], info: dict[str, Any], seconds: float, social: dict[str, Any]
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
            "files": [str(path) for path in (self.save, self.picture) if path is not None],
        }
        if self.json:
            print(json.dumps(outcome))
            return
        verdict = "done" if info["is_success"] else " / ".join(outcome["verdicts"])
        pose = ",".join(f"{value:.2f}" for value in start["pose"])
        print(f"from {pose} in {start['floor_plan']}")
        print(
            f'"{start["command"]}": {verdict} after {seconds:.1f} s and '
            f"{info['path_length']:.1f} m, {info['collisions']} collisions"
        )
        if outcome["impossible"]:
            print(f"the robot took it for impossible: {outcome['impossible']}")
        for path in outcome["files"]:
            print(f"wrote {path}")
