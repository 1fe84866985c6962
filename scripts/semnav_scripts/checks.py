"""The checks of `semnav doctor`, one for each part of the installation."""

from __future__ import annotations

import json
import os
import platform
import re
import subprocess
import sys
import time
import tomllib
from dataclasses import dataclass
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urlsplit
from urllib.request import url2pathname

from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

if TYPE_CHECKING:  # the doctor must start without the compiled kernels
    from semnav_features.kernels.cache_repair import CacheRepair

_PACKAGE = "semnav-env"
"""Name of the installed distribution."""


@dataclass(frozen=True)
class InstallationCheck:
    """The outcome of one check.

    Attributes:
        name: of the part that was checked.
        ok: whether the part is as it should be.
        detail: what was found.
        fix: what to do if it is not ok.
        needed: whether semnav-env does not work without the part.
    """

    name: str
    ok: bool
    detail: str
    fix: str = ""
    needed: bool = True


def python_version() -> InstallationCheck:
    """Check that this Python is new enough."""
    wanted = metadata.metadata(_PACKAGE)["Requires-Python"]
    found = platform.python_version()
    return InstallationCheck(
        "Python", SpecifierSet(wanted).contains(found), found, f"use Python {wanted}"
    )


def requirements() -> list[InstallationCheck]:
    """Check that the packages which semnav-env needs are installed, in supported versions."""
    return [_requirement(r) for r in _requirements() if r.marker is None]


def extras() -> list[InstallationCheck]:
    """Check which optional parts are installed."""
    names = metadata.metadata(_PACKAGE).get_all("Provides-Extra") or []
    return [_extra(name) for name in names if name != "all"]


def single_pygame() -> InstallationCheck:
    """Check that only one of the two packages which install the module pygame is there."""
    there = [name for name in ("pygame", "pygame-ce") if _version(name)]
    return InstallationCheck(
        "one pygame",
        len(there) < 2,
        " and ".join(there) or "none installed",
        "they overwrite each other: pip uninstall pygame pygame-ce, then pip install pygame-ce",
    )


def editable_install() -> InstallationCheck:
    """Check that an editable install knows all packages of its checkout.

    It remembers those that there were when it was installed: a package that a later `git pull`
    brings cannot be imported.
    """
    installed = metadata.distribution(_PACKAGE)
    told = json.loads(installed.read_text("direct_url.json") or "{}")
    if not told.get("dir_info", {}).get("editable"):
        return InstallationCheck("editable install", True, "this is none", needed=False)
    checkout = Path(url2pathname(urlsplit(told["url"]).path))
    texts = [
        Path(str(installed.locate_file(file))).read_text("utf-8")
        for file in installed.files or ()
        if file.name.startswith("__editable__") and file.suffix in (".pth", ".py")
    ]
    missing = missing_packages(checkout, "\n".join(texts))
    return InstallationCheck(
        "editable install",
        not missing,
        f"does not know {', '.join(missing)}" if missing else f"knows all packages of {checkout}",
        f"the checkout has changed since: pip install -e {checkout}",
    )


def imported_copy() -> InstallationCheck:
    """Check that in a checkout its own packages are imported, and not another copy of them."""
    here = Path.cwd()
    checkout = next(filter(_is_checkout, (here, *here.parents)), None)
    found = find_spec("semnav_env")
    imported = Path(found.origin).parents[1] if found and found.origin else None
    ok = checkout is None or (imported is not None and imported.samefile(checkout))
    return InstallationCheck(
        "imported copy",
        ok,
        f"{imported}" if ok else f"{imported}, and not this checkout",
        f"to use the code of {checkout}: pip install -e {checkout}",
        needed=False,
    )


def _is_checkout(folder: Path) -> bool:
    project = folder / "pyproject.toml"
    if not (folder / "semnav_env").is_dir() or not project.is_file():
        return False
    return bool(tomllib.loads(project.read_text("utf-8"))["project"]["name"] == _PACKAGE)


def missing_packages(checkout: Path, known: str) -> list[str]:
    """Names of the packages of a checkout that an editable install does not know.

    Args:
        checkout: its folder.
        known: text of the files in which pip keeps where the packages are: the folder of each, or
            in lines of their own the folders in which they lie.
    """
    project = tomllib.loads((checkout / "pyproject.toml").read_text("utf-8"))
    find = project["tool"]["setuptools"]["packages"]["find"]
    folders = [
        start.parent
        for root in find["where"]
        for pattern in find["include"]
        for start in sorted((checkout / root).glob(f"{pattern}/__init__.py"))
    ]
    lines = known.splitlines()
    return [
        folder.name
        for folder in folders
        if repr(str(folder)) not in known and str(folder.parent) not in lines
    ]


def headless_drawing() -> InstallationCheck:
    """Check that pictures can be drawn without a display.

    The check runs in a process of its own, because a broken SDL may end its process.
    """
    program = (
        "from semnav_env.rendering.backend import load_pygame\n"
        "surface = load_pygame().Surface((8, 8), 0, 32)\n"
        "surface.fill((255, 0, 0))\n"
        "assert surface.get_at((4, 4))[:3] == (255, 0, 0)\n"
    )
    hidden = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    run = subprocess.run(
        [sys.executable, "-c", program],
        env={**hidden, "SDL_VIDEODRIVER": "dummy"},
        capture_output=True,
        text=True,
        timeout=120,
    )
    detail = "works" if run.returncode == 0 else (run.stderr.splitlines() or ["crashed"])[-1]
    fix = f'pip install "{_PACKAGE}[render]"'
    return InstallationCheck(
        "drawing without a display", run.returncode == 0, detail, fix, needed=False
    )


def kernels() -> list[InstallationCheck]:
    """Repair the cache of compiled kernels, and check that they work and stay between runs."""
    from semnav_env.world.lidar import Lidar
    from semnav_env.world.maps import load_floor_plan
    from semnav_features import extract
    from semnav_features.kernels.cache_folder import cache_folder
    from semnav_features.kernels.cache_repair import repair

    mended = repair(cache_folder())
    start = time.perf_counter()
    pose = (-2.5, -0.3, 0.24)
    scan = Lidar(load_floor_plan("heidelberg_hallway")).scan(pose, key=(0, 0, 0))
    walls = len(extract(scan).walls)
    seconds = time.perf_counter() - start
    works = InstallationCheck(
        "compiled kernels",
        walls > 0,
        f"a simulated scan shows {walls} walls; ready after {seconds:.1f} s",
        "reinstall numba and semnav-env",
    )
    return [works, _cache(cache_folder(), mended)]


def _cache(folder: Path, mended: CacheRepair) -> InstallationCheck:
    fix = "set SEMNAV_CACHE_DIR to a folder that you may write to, or every start compiles anew"
    ok = os.access(folder, os.W_OK)
    sizes = [file.stat().st_size for file in folder.glob("*.bin")]
    held = f"{len(sizes)} kernels, {sum(sizes) / 1e6:.0f} MB"
    detail = f"{folder} is {'' if ok else 'not '}writable; {held}{mended}"
    return InstallationCheck("kernel cache", ok, detail, fix, needed=False)


def _requirements() -> list[Requirement]:
    return [Requirement(text) for text in metadata.requires(_PACKAGE) or []]


def _requirement(wanted: Requirement) -> InstallationCheck:
    found = _version(wanted.name)
    ok = found is not None and wanted.specifier.contains(found, prereleases=True)
    plain = f"{wanted.name}{wanted.specifier}"
    return InstallationCheck(wanted.name, ok, found or "not installed", f'pip install "{plain}"')


def _extra(name: str) -> InstallationCheck:
    pattern = re.compile(rf"""extra == ['"]{re.escape(name)}['"]""")
    checks = [_requirement(r) for r in _requirements() if pattern.search(str(r.marker))]
    missing = [check.name for check in checks if not check.ok]
    detail = f"missing: {', '.join(missing)}" if missing else "installed"
    fix = f'pip install "{_PACKAGE}[{name}]"'
    return InstallationCheck(f"extra {name}", not missing, detail, fix, needed=False)


def _version(package: str) -> str | None:
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return None
