"""`semnav doctor`: check the installation, repair its cache, and print facts for a bug report."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass

from semnav_scripts import checks
from semnav_scripts.bug_report import facts
from semnav_scripts.checks import InstallationCheck


@dataclass(frozen=True)
class Arguments:
    """Check the installation, and say how to repair it; include its output in a bug report.

    Files of the cache of compiled kernels that are damaged or were left behind are removed. The
    exit code is 0 if everything that is needed works, and 1 otherwise. Optional parts do not
    count.

    Attributes:
        warm: also compile the kernels of all commands, in parallel, so that no command waits for
            them later; this takes minutes.
        json: print JSON.
    """

    warm: bool = False
    json: bool = False

    def run(self) -> int:
        """Run every check and report."""
        done = [*_examine(), *(_warm() if self.warm else ())]
        if self.json:
            print(json.dumps([asdict(check) for check in done], indent=1))
        else:
            print("\n".join(_line(check) for check in done))
        return 0 if all(check.ok or not check.needed for check in done) else 1


def _examine() -> Iterator[InstallationCheck]:
    yield from facts()
    yield checks.python_version()
    yield from checks.requirements()
    yield from checks.extras()
    yield checks.single_pygame()
    for name, examine in _TRIALS.items():
        try:
            yield from examine()
        except Exception as error:
            yield InstallationCheck(name, False, f"{type(error).__name__}: {error}", _ADVICE)


def _warm() -> Iterator[InstallationCheck]:
    from semnav_scripts.progress import tracked
    from semnav_scripts.warming import GROUPS, warm

    done: list[str] = []
    begun = time.perf_counter()
    groups = tracked(warm(), lambda n: f"compiling: {n} groups", lambda: len(done) / len(GROUPS))
    for group in groups:
        done.append(group.name)
        name, said = f"kernels of {group.name}", f"ready after {group.seconds:.1f} s"
        yield InstallationCheck(name, not group.fault, group.fault or said, _ADVICE, needed=False)
    told = f"{time.perf_counter() - begun:.1f} s, {len(GROUPS)} processes on {os.cpu_count()} cores"
    yield InstallationCheck("kernels, in all", True, told, needed=False)


_ADVICE = "set SEMNAV_CACHE_DIR to a folder that you may write to, or reinstall semnav-env"

_TRIALS: dict[str, Callable[[], list[InstallationCheck]]] = {
    "editable install": lambda: [checks.editable_install()],
    "imported copy": lambda: [checks.imported_copy()],
    "drawing without a display": lambda: [checks.headless_drawing()],
    "compiled kernels": checks.kernels,
}
"""Checks that run other code, whose errors are reported as the outcome of the check."""


def _line(check: InstallationCheck) -> str:
    mark = "ok" if check.ok else "FAIL" if check.needed else "--"
    advice = "" if check.ok else f" ({check.fix})"
    return f"{mark:<5}{check.name:<28}{check.detail}{advice}"
