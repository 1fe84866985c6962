"""What results say of what they were made by: version, commit, fingerprint of the rules."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from functools import partial
from importlib import metadata
from importlib.resources import files
from pathlib import Path

import pytest

from semnav_agents.evaluation import provenance as made_by

MODULE = '''"""Of a module."""

TOLERANCE = 0.5
"""Of the tolerance."""


def near(text: str = "# no comment") -> bool:
    """Whether it is near."""
    return len(text) < TOLERANCE
'''

REWORDED = '''"""Of the same
module."""

# A remark.
TOLERANCE = 0.5  # metres
"""Of the tolerance."""

def near(text: str = "# no comment") -> bool:
    """Whether it is not far."""
    # Another remark.
    return len(text) < TOLERANCE
'''


@pytest.fixture
def packages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with copies of the sources, of which the fingerprint is taken."""
    left_out = shutil.ignore_patterns("frozen", "pretrained", "bundled", "__pycache__")
    for name in ("semnav_features", "semnav_env", "semnav_agents"):
        shutil.copytree(str(files(name)), tmp_path / name, ignore=left_out)
    monkeypatch.setattr(made_by, "files", lambda name: tmp_path / name)
    return tmp_path


def fingerprint() -> str:
    return made_by.rules_fingerprint.__wrapped__()


def run_git(folder: Path, *words: str) -> str:
    """What git prints, in a checkout without settings of the user."""
    named = ("-c", "user.name=a", "-c", "user.email=a@b.c", "-c", "commit.gpgsign=false")
    command = ["git", "-C", str(folder), *named, *words]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


def edited(path: Path, change: Callable[[str], str]) -> None:
    before = path.read_text("utf-8")
    after = change(before)
    assert after != before
    path.write_text(after, "utf-8")


def test_rewording_a_module_changes_nothing_that_counts() -> None:
    assert made_by.bare(REWORDED) == made_by.bare(MODULE)
    assert made_by.bare(MODULE.replace("0.5", "0.6")) != made_by.bare(MODULE)
    assert made_by.bare(MODULE.replace("# no", "# a")) != made_by.bare(MODULE)


def test_a_copy_of_the_sources_has_their_fingerprint(packages: Path) -> None:
    assert fingerprint() == made_by.rules_fingerprint()


@pytest.mark.parametrize(
    ("file", "before", "after"),
    [
        ("semnav_env/rules.py", "stand_off: Length = 0.9", "stand_off: Length = 0.8"),
        (
            "semnav_env/mind/grounding/goals.py",
            "import annotations",
            "import annotations, division",
        ),
        (
            "semnav_env/judge/judge.py",
            "import annotations",
            "import annotations, division",
        ),
        ("semnav_features/extraction.py", "annotations", "annotations, division"),
        ("semnav_features/kernels/doors.py", "annotations", "annotations, division"),
        ("semnav_env/language/english.json", "door", "gate"),
    ],
)
def test_what_decides_changes_the_fingerprint(
    packages: Path, file: str, before: str, after: str
) -> None:
    edited(packages / file, lambda text: text.replace(before, after, 1))
    assert fingerprint() != made_by.rules_fingerprint()


def test_words_and_agents_do_not_change_the_fingerprint(packages: Path) -> None:
    edited(packages / "semnav_env" / "rules.py", lambda text: f"# A remark.\n{text}")
    edited(packages / "semnav_agents" / "scripted.py", lambda text: f"{text}\nMORE = 1\n")
    assert fingerprint() == made_by.rules_fingerprint()


def test_the_commit_is_that_of_the_checkout_of_the_package(packages: Path) -> None:
    """A package that lies in somebody's checkout, but is not kept there, has no commit."""
    git = partial(run_git, packages)
    git("init")
    git("commit", "--allow-empty", "-m", "another project")
    assert made_by.commit.__wrapped__() == ""
    git("add", "semnav_env")
    git("commit", "-m", "the package")
    assert made_by.commit.__wrapped__() == git("rev-parse", "HEAD")
    edited(packages / "semnav_env" / "rules.py", lambda text: f"{text}\n")
    assert made_by.commit.__wrapped__() == f"{git('rev-parse', 'HEAD')}-dirty"


def test_asking_for_the_commit_writes_nothing_into_the_checkout(packages: Path) -> None:
    """A process that is killed meanwhile would leave a lock, and git could not be used any more."""
    init = packages / "semnav_env" / "__init__.py"
    run_git(packages, "init")
    run_git(packages, "add", str(init))
    run_git(packages, "commit", "-m", "the package")
    index = packages / ".git" / "index"
    before = index.read_bytes()
    os.utime(init, ns=(1, 1))  # what git would note in its index
    assert made_by.commit.__wrapped__()
    assert index.read_bytes() == before


def test_without_git_there_is_no_commit(packages: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(packages))
    assert made_by.commit.__wrapped__() == ""


def test_results_of_now_are_of_this_version() -> None:
    row = made_by.provenance().row()
    assert row["version"] == metadata.version("semnav-env")
    assert row["rules"] == made_by.rules_fingerprint()
    assert len(made_by.rules_fingerprint()) == made_by.FINGERPRINT_DIGITS
