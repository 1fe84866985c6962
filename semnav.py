"""The `semnav` command, which minds Ctrl-C and SIGTERM before it loads anything else."""

import os
import signal
import sys
from types import FrameType


def main() -> int:
    """Load the sub-commands, and run the one that the arguments of the process name."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, leave_at_once)
    if signal.getsignal(signal.SIGTERM) is signal.SIG_DFL:
        signal.signal(signal.SIGTERM, leave_at_once)
    from semnav_env.scripts.main import main as run

    return run()


def leave_at_once(number: int, frame: FrameType | None) -> None:
    """End the process: while modules are loaded an exception may be lost, and nothing is begun."""
    sys.stderr.write("semnav: interrupted\n")
    sys.stderr.flush()
    os._exit(128 + number)  # as a shell says it


if __name__ == "__main__":
    raise SystemExit(main())
