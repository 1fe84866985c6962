"""The `semnav` command, which minds Ctrl-C and SIGTERM from its first moment to its last."""

import contextlib
import os
import signal
import sys
from types import FrameType

INTERRUPTED = 130
"""Exit code of a command that was interrupted, as a shell has it for SIGINT."""

WORDS = {signal.SIGINT: "interrupted", signal.SIGTERM: "terminated"}
"""What a command says when it is ended by a signal."""


def main() -> int:
    """Load the sub-commands, and run the one that the arguments of the process name."""
    for number in WORDS:
        if signal.getsignal(number) in (signal.default_int_handler, signal.SIG_DFL):
            signal.signal(number, leave_at_once)
    try:
        from semnav_scripts.main import main as run

        try:
            return run()
        finally:
            _leave()
    except KeyboardInterrupt:  # between two lines of these functions
        leave_at_once(signal.SIGINT, None)
        raise


def _leave() -> None:
    """From here on there is nothing to put away."""
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError):  # a closed pipe: Python tells of it
            stream.flush()
    for number in WORDS:
        if getattr(signal.getsignal(number), "__name__", "") == "interrupt":
            signal.signal(number, leave_at_once)


def leave_at_once(number: int, frame: FrameType | None) -> None:
    """End the process: while modules are loaded an exception may be lost, and nothing is begun."""
    os.write(2, f"semnav: {WORDS[signal.Signals(number)]}\n".encode())
    os._exit(128 + number)


if __name__ == "__main__":
    raise SystemExit(main())
