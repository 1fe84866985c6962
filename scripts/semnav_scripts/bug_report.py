"""Facts for a bug report beside the versions of packages: code and machine."""

from __future__ import annotations

import locale
import os
import platform
import sys
from collections.abc import Iterator
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path

from semnav_scripts.checks import InstallationCheck

VARIABLES = ("SEMNAV_", "NUMBA_", "OMP_", "MKL_", "SDL_", "MUJOCO_GL", "MPLBACKEND", "PYTHONPATH")
"""Beginnings of the names of environment variables that change what semnav-env does."""


def facts() -> Iterator[InstallationCheck]:
    """Facts about this machine, which are neither right nor wrong."""
    yield _fact("semnav-env", f"{metadata.version('semnav-env')} in {_place()}")
    yield _fact("interpreter", f"{platform.python_implementation()} in {sys.prefix}")
    yield _fact("system", f"{platform.platform()}, {_processors()}, {_memory()}")
    encodings = f"files {locale.getpreferredencoding(False)}, output {sys.stdout.encoding}"
    yield _fact("encodings", encodings)
    named = [f"{k}={v}" for k, v in sorted(os.environ.items()) if k.startswith(VARIABLES)]
    yield _fact("environment variables", " ".join(named) or "none that matter")


def _fact(name: str, detail: str) -> InstallationCheck:
    return InstallationCheck(name, True, detail, needed=False)


def _place() -> str:
    found = find_spec("semnav_env")
    return str(Path(found.origin).parent) if found and found.origin else "no folder"


def _processors() -> str:
    return f"{platform.machine()} with {os.cpu_count()} processors"


def _memory() -> str:
    try:
        size = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):  # not on this system
        return "unknown memory"
    return f"{size / 1e9:.0f} GB of memory"
