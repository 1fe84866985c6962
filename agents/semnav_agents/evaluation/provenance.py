"""What results were made by: the version, the commit, and a fingerprint of the rules."""

from __future__ import annotations

import ast
import io
import subprocess
import tokenize
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from functools import lru_cache
from hashlib import sha256
from importlib import metadata
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

PACKAGE = "semnav_env"
"""Name of the package whose commit is asked for."""

UNKNOWN = "unknown, before 0.2"
"""Version and rules of results that were kept before results said theirs."""

DECIDING = (
    *("semnav_env/rules.py", "semnav_env/env.py", "semnav_env/control_period.py"),
    *("semnav_env/robots", "semnav_env/world/physics", "semnav_env/world/simulator"),
    "semnav_env/world/lidar",
    *("semnav_features", "semnav_features/kernels"),
    *("semnav_env/mind/belief", "semnav_env/mind/grounding", "semnav_env/mind/observations"),
    *("semnav_env/language", "semnav_env/language/vocabulary"),
    *("semnav_env/judge/routes", "semnav_env/judge/tasks", "semnav_env/judge"),
    *(f"semnav_env/judge/metrics/{name}.py" for name in ("measure", "motion", "paths")),
)
"""Modules, and folders without their subfolders, that decide how episodes go.

What is not among them is named otherwise: agents by the commit, floor plans by their fingerprint
in each episode, people and other things that move by `dynamics` in each row.
"""

SUFFIXES = (".py", ".json")
"""Endings of the names of the files that are read: code, and words of the languages."""

FINGERPRINT_DIGITS = 16
"""Length of a fingerprint in hexadecimal digits."""


@dataclass(frozen=True)
class Provenance:
    """By what a result was made.

    Attributes:
        version: of the installed package.
        commit: of the git checkout that the package lies in, with "-dirty" at its end where files
            differ from it; empty if it lies in none.
        rules: fingerprint of the rules, see `rules_fingerprint`.
    """

    version: str
    commit: str
    rules: str

    def row(self) -> dict[str, object]:
        """As fields of a row of results."""
        return asdict(self)


def provenance() -> Provenance:
    """Of results that are made now."""
    return Provenance(metadata.version("semnav-env"), commit(), rules_fingerprint())


@lru_cache(maxsize=1)
def rules_fingerprint() -> str:
    """The first `FINGERPRINT_DIGITS` of a SHA-256 of the sources that decide how episodes go.

    Comments, docstrings, and empty lines do not count, so that rewording changes nothing.
    """
    total = sha256()
    for place, source in sorted(_deciding_sources()):
        text = bare(source) if place.endswith(".py") else source
        total.update(f"{place}\n{text}\n".encode())
    return total.hexdigest()[:FINGERPRINT_DIGITS]


def bare(source: str) -> str:
    """The lines of a module without comments, docstrings and what is empty then.

    They are cut out of the text by their places, because texts that Python makes of a syntax tree
    differ from version to version.
    """
    lines = source.split("\n")
    for row, column in _comments(source):
        lines[row] = lines[row][:column]
    for row in _documented(source):
        lines[row] = ""
    return "\n".join(line.rstrip() for line in lines if line.strip())


def _comments(source: str) -> Iterator[tuple[int, int]]:
    """Row and column of each comment, from 0."""
    if "#" in source:  # most modules have none, and reading tokens takes long
        for token in tokenize.generate_tokens(io.StringIO(source).readline):
            if token.type == tokenize.COMMENT:
                yield token.start[0] - 1, token.start[1]


def _documented(source: str) -> Iterator[int]:
    """Rows of the texts that stand by themselves: docstrings, also those of constants."""
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.Expr(value=ast.Constant(value=str()), lineno=first, end_lineno=int(last)):
                yield from range(first - 1, last)


@lru_cache(maxsize=1)
def commit() -> str:
    """The commit of the checkout that this package lies in; empty if it lies in none.

    A package that is merely installed somewhere below another project's checkout is not of that
    checkout, so git is asked whether it keeps the file.
    """
    folder = Path(str(files(PACKAGE)))
    if not _git(folder, "ls-files", "--error-unmatch", "__init__.py"):
        return ""
    head = _git(folder, "rev-parse", "--verify", "HEAD")
    changed = _git(folder, "status", "--porcelain", "--untracked-files=no")
    return f"{head}-dirty" if head and changed else head


def _git(folder: Path, *words: str) -> str:
    """The output of git, which writes nothing; empty if git fails or is not installed."""
    command = ["git", "--no-optional-locks", "-C", str(folder), *words]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=60.0, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return "" if done.returncode else done.stdout.strip()


def _deciding_sources() -> Iterator[tuple[str, str]]:
    """Place, from its package on, and text of each file that decides."""
    for name in DECIDING:
        package, *rest = name.split("/")
        place = files(package).joinpath(*rest)
        if place.is_file():
            yield name, place.read_text("utf-8")
        else:
            yield from (
                (f"{name}/{each.name}", each.read_text("utf-8")) for each in _sources(place)
            )


def _sources(folder: Traversable) -> Iterator[Traversable]:
    """The files of a folder that are read."""
    return (each for each in folder.iterdir() if each.name.endswith(SUFFIXES) and each.is_file())
