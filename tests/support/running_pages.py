"""Runs a page of the documentation as somebody would who types it off, block by block."""

from __future__ import annotations

import contextlib
import io
import re
import shlex
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from semnav_scripts import main as cli
from tests.support.paths import ROOT

BLOCK = re.compile(r"^( *)```(python|sh)\n(.*?)^ *```\n(?:^ *```text\n(.*?)^ *```)?", re.S | re.M)


@dataclass(frozen=True)
class Shown:
    """A block of a page after it ran.

    Attributes:
        code: what is typed.
        promised: what the page shows below it; None if it shows nothing.
        printed: what it printed.
    """

    code: str
    promised: str | None
    printed: str


def run_page(page: str, replacing: dict[str, str] | None = None) -> Iterator[Shown]:
    """Run the blocks of a page in the current folder, one after the other.

    Blocks of Python share their names; lines of a shell are commands of `semnav`, or `cp` from the
    checkout.

    Args:
        page: its path in the checkout.
        replacing: what is run in the place of what the page says, where that takes long.
    """
    names: dict[str, Any] = {"__name__": "page"}
    for indent, kind, block, promised in BLOCK.findall((ROOT / page).read_text("utf-8")):
        code = re.sub(rf"(?m)^{indent}", "", block)
        for said, run in (replacing or {}).items():
            code = code.replace(said, run)
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            if kind == "python":
                exec(compile(code, page, "exec"), names)
            else:
                for line in code.replace("\\\n", " ").splitlines():
                    type_in(line)
        yield Shown(code, promised or None, printed.getvalue())


def type_in(line: str) -> None:
    """Run a line of a shell."""
    program, *words = shlex.split(line, comments=True) or ["cp"]
    if program == "semnav":
        code = cli.main(words)
        if code not in (0, 1):
            raise RuntimeError(f"{line}: exit code {code}")
    elif program == "cp" and words:
        shutil.copy(ROOT / words[0], Path(words[1]))
    elif words:
        raise ValueError(f"a page may type semnav and cp, not {program}")
