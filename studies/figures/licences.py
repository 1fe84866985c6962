"""Writes docs/licences.md: the licences of what an installation brings."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from semnav_features.writing import write_file
from studies.figures import IMAGES

PAGE = IMAGES.parent / "licences.md"
PYPROJECT = Path(__file__).resolve().parents[2] / "pyproject.toml"

NOT_FOR_USERS = ("all", "dev", "docs")
"""Extras that are no extras of users: the sum of the others, and tools to change the package."""

LEFT_OUT = ("nvidia", "cuda", "triton")
"""Beginnings of the names of what torch brings along only on some machines; the page names them."""

NOT_HERE = {"ray": "Apache-2.0"}
"""Licences of what this environment lacks, because it needs one of its own: as its site says."""

NAMES = {
    "3-Clause BSD License": "BSD-3-Clause",
    "Apache 2.0": "Apache-2.0",
    "Apache License 2.0": "Apache-2.0",
    "Apache Software License": "Apache-2.0",
    "BSD 3-Clause License": "BSD-3-Clause",
    "MIT License": "MIT",
    "new BSD": "BSD-3-Clause",
}
"""Other words for a licence, and its identifier of SPDX."""

TEMPLATE = """# Licences of dependencies

semnav-env has the MIT licence. An installation brings the packages below. The page is written by
`python -m studies.figures licences`, which reads what each installed package says of itself; it is
a help and no legal advice.

- The wheels of `av` (extra `render`) hold FFmpeg, whose libavcodec says "LGPL version 3 or later",
  and beside it the encoders x264 and x265, which are under the GPL. Only films in .mp4 use them.
- `pygame-ce` (extra `render`) is LGPL: it is imported, and can be replaced by another build.
- `torch` (extra `rl`) brings, by default on Linux, libraries of NVIDIA under NVIDIA's own licences;
  its build for processors does not.
- Other wheels may hold libraries with other licences, too; their folders `*.dist-info` say so.

## What semnav-env asks for

| package | version | licence | extra |
|---|---|---|---|
{direct}

## What these bring

| package | version | licence |
|---|---|---|
{brought}
"""


@dataclass(frozen=True)
class Licence:
    """The licence of a package.

    Attributes:
        version: that is installed; empty if none is.
        licence: identifier of SPDX, or what the package says.
    """

    version: str
    licence: str


def licence_of(name: str) -> Licence:
    """The licence of an installed package.

    Raises:
        ValueError: it is not installed, and no licence of it is known.
    """
    try:
        found = distribution(name)
    except PackageNotFoundError:
        if name not in NOT_HERE:
            raise ValueError(f"{name} is not installed: install all extras but ray") from None
        return Licence("", NOT_HERE[name])
    said = found.metadata.get("License-Expression") or ""
    classes = found.metadata.get_all("Classifier") or []
    if not said:
        last = [each.rpartition(" :: ")[2] for each in classes if each.startswith("License ::")]
        said = " and ".join(NAMES.get(each, each) for each in last if each != "OSI Approved")
    if not said:
        said = (found.metadata.get("License") or "").strip().partition("\n")[0]
    return Licence(found.version, NAMES.get(said, said) or "not said")


def asked_for() -> dict[str, str]:
    """The packages that pyproject.toml names for users, and the extras that need them."""
    project = tomllib.loads(PYPROJECT.read_text("utf-8"))["project"]
    found = dict.fromkeys(_names(project["dependencies"]), "")
    for extra, needs in project["optional-dependencies"].items():
        if extra in NOT_FOR_USERS:
            continue
        for name in _names(needs):
            if found.get(name) != "":
                found[name] = f"{found[name]}, {extra}" if name in found else extra
    return found


def brought_by(names: Iterable[str]) -> list[str]:
    """What packages need in turn, sorted, without themselves."""
    asked, waiting = set(names), list(names)
    found = set[str]()
    while waiting:
        try:
            needs = distribution(waiting.pop()).requires or []
        except PackageNotFoundError:
            continue
        new = {name for name in _names(needs) if not name.startswith(LEFT_OUT)} - found
        found |= new
        waiting += new
    return sorted(found - asked)


def _names(needs: Iterable[str]) -> list[str]:
    """The names of requirements that hold here, without those of extras."""
    parsed = (Requirement(need) for need in needs)
    return [
        canonicalize_name(each.name)
        for each in parsed
        if each.marker is None or each.marker.evaluate({"extra": ""})
    ]


def direct_rows(asked: Mapping[str, str]) -> list[str]:
    """A row of the first table for each package."""
    rows = []
    for name in sorted(asked):
        found = licence_of(name)
        rows.append(_row(name, found.version, found.licence, asked[name]))
    return rows


def _row(*cells: str) -> str:
    return "| " + " | ".join(re.sub(r"\s+", " ", cell) for cell in cells) + " |"


def page() -> str:
    """The text of the page."""
    asked = asked_for()
    brought = ((name, licence_of(name)) for name in brought_by(asked))
    rows = [_row(name, found.version, found.licence) for name, found in brought]
    return TEMPLATE.format(direct="\n".join(direct_rows(asked)), brought="\n".join(rows))


def main() -> None:
    """Write the page."""
    write_file(PAGE, page())
    print(f"wrote {PAGE}")
