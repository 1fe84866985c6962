"""A first episode: the scripted agent goes through the second door on the right.

One sees the command, where the robot is every two seconds and what the reward was made of, and at
the end the verdict. Give the path of a .png or .gif to keep a picture or a film.

    python examples/first_episode.py film.gif
"""

import sys

import gymnasium as gym

from semnav_agents import make_agent
from semnav_env.rendering.video import save_video


def main(film: str | None = None) -> None:
    """Drive one episode; keep its pictures if there is a path to keep them at."""
    agent = make_agent("scripted")
    env = gym.make(
        "semnav_env:SemNav-v0",
        robot="wheelchair",
        floor_plan="heidelberg_hallway",
        observation=agent.observation,
        render_mode="rgb_array" if film else None,
    )
    start = {"command": "go through the second door on the right", "pose": (-2.5, -0.6, 0.25)}
    observation, info = env.reset(seed=0, options=start)
    agent.reset(info)
    print("told:", info["command"])
    frames, over, steps = [], False, 0
    while not over:
        observation, _, terminated, truncated, info = env.step(agent.act(observation))
        over, steps = terminated or truncated, steps + 1
        if steps % 30 == 0:
            x, y, _ = info["pose"]
            progress = info["reward_terms"]["progress"]
            print(f"{steps / 15:4.0f} s  at ({x:5.2f}, {y:5.2f})  progress {progress:+.2f} m")
        if film and (steps % 3 == 0 or over):
            frames.append(env.render())
    print("verdicts:", *info["verdicts"])
    print("success:", info["is_success"], " contacts:", info["collisions"])
    if film:
        print("wrote", save_video(film, frames, fps=5))


if __name__ == "__main__":
    main(*sys.argv[1:2])
