"""The `semnav` command: finds the sub-command and turns its outcome into an exit code.

Exit codes: 0 done; 1 not achieved; 2 bad input, with one line on stderr that names what is wrong
and what would be right; 130 interrupted.
"""

from __future__ import annotations

import difflib
import os
import sys
from collections.abc import Sequence
from importlib import import_module, metadata

COMMANDS = {
    "extract": ("extract", "turn a log of lidar scans into walls, doors, corners and corridors"),
    "map": ("map", "list, show, check, generate, build, import and export floor plans"),
    "demo": ("demo", "let a robot carry out a command"),
    "ground": ("ground", "say what a command refers to in a floor plan"),
    "describe": ("describe", "say the command that leads to a door or a room"),
    "demonstrate": ("demonstrate", "write what an agent sees and does as a dataset"),
    "episodes": ("episodes", "list, check and generate the frozen episodes, import others"),
    "evaluate": ("evaluate", "measure an agent on a suite of commands"),
    "evaluate features": ("evaluate_features", "measure the feature extractor against truth"),
    "evaluate lines": ("evaluate_lines", "measure lines on real scans, walls on simulated ones"),
    "evaluate segmentation": ("evaluate_segmentation", "measure how walls are cut into pieces"),
    "evaluate buildings": ("evaluate_buildings", "measure doors in scans of real floors"),
    "evaluate places": ("evaluate_places", "measure corridors told from other places"),
    "evaluate matching": ("evaluate_matching", "measure how exactly scans are matched"),
    "evaluate unsaid": ("evaluate_unsaid", "measure what implicit steps are good for"),
    "evaluate offices": ("evaluate_offices", "check generated offices, and time them"),
    "train": ("train", "teach an agent, and keep what it learned"),
    "bench": ("bench", "time a step of the environment and its parts"),
    "doctor": ("doctor", "check the installation, and say how to mend it"),
}
"""Sub-command of one or two words: (module in this package, help).

The module's `Arguments` have `run() -> int`.
"""

BAD_INPUT, INTERRUPTED, BROKEN_PIPE = 2, 130, 141


def main(argv: Sequence[str] | None = None) -> int:
    """Run `semnav` with these arguments, by default those of the process.

    `--debug` anywhere, or SEMNAV_DEBUG=1 in the environment, shows where an error comes from.

    Returns:
        The exit code.
    """
    words = list(sys.argv[1:] if argv is None else argv)
    debug = "--debug" in words or os.environ.get("SEMNAV_DEBUG", "0") not in ("", "0")
    words = [word for word in words if word != "--debug"]
    try:
        return _run(words)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return BROKEN_PIPE
    except (KeyboardInterrupt, SystemError) as stop:
        if isinstance(stop, SystemError) and not isinstance(stop.__cause__, KeyboardInterrupt):
            raise  # otherwise Ctrl-C came while a compiled kernel ran
        print(_with_notes("semnav: interrupted", stop), file=sys.stderr)
        return INTERRUPTED
    except (ValueError, OSError, ImportError) as error:
        if debug:
            raise
        print(_with_notes(f"semnav: {in_one_line(error)}", error), file=sys.stderr)
        return BAD_INPUT


def in_one_line(error: Exception) -> str:
    """What an error says, in one line that a user understands."""
    if isinstance(error, FileExistsError):
        return f"{os.fspath(error.filename)!r} is a file, not a folder"
    if isinstance(error, OSError) and error.strerror:
        where = f" {os.fspath(error.filename)!r}" if error.filename else ""
        return f"cannot open{where}: {error.strerror}"
    if isinstance(error, ModuleNotFoundError) and not str(error.name).startswith("semnav_env"):
        return f"{error.name} is not installed; `semnav doctor` says what to install"
    lines = str(error).strip().splitlines()
    return lines[0] if lines else type(error).__name__


def _with_notes(said: str, error: BaseException) -> str:
    """With what an error was told on its way up, such as where the work so far is."""
    return "; ".join([said, *getattr(error, "__notes__", ())])


def _run(words: list[str]) -> int:
    if not words:
        raise ValueError(f"no command given; there are: {', '.join(COMMANDS)} (semnav --help)")
    name, *rest = words
    if name in ("-h", "--help"):
        print(_help())
        return 0
    if name == "--version":
        print(f"semnav {metadata.version('semnav-env')}")
        return 0
    if rest and f"{name} {rest[0]}" in COMMANDS:
        name, rest = f"{name} {rest[0]}", rest[1:]
    elif rest and rest[0].strip() and not rest[0].startswith("-"):
        near = difflib.get_close_matches(f"{name} {rest[0]}", COMMANDS, n=1, cutoff=0.9)
        if near:
            raise ValueError(f"no command '{name} {rest[0]}'; did you mean '{near[0]}'?")
    if name not in COMMANDS:
        near = difflib.get_close_matches(name, COMMANDS, n=1)
        hint = f"did you mean {near[0]!r}? " if near else ""
        raise ValueError(f"no command {name!r}; {hint}there are: {', '.join(COMMANDS)}")
    from semnav_env.scripts.arguments import Help, parse

    module = import_module(f"semnav_env.scripts.{COMMANDS[name][0]}")
    try:
        command = parse(module.Arguments, rest, prog=f"semnav {name}")
    except Help:
        return 0
    return command.run()


def _help() -> str:
    width = max(map(len, COMMANDS)) + 2
    commands = "\n".join(f"  {name:<{width}}{help}" for name, (_, help) in COMMANDS.items())
    return (
        "usage: semnav COMMAND ...\n\nSemantic indoor navigation: see, understand, drive.\n\n"
        f"commands:\n{commands}\n\n"
        "`semnav COMMAND --help` tells a command's options; `--debug` shows where an error\n"
        "comes from; `--version` prints the version.\n"
        "exit codes: 0 done, 1 not achieved, 2 bad input"
    )


if __name__ == "__main__":
    raise SystemExit(main())
