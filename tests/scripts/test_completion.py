"""`semnav completion`: what shells complete."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from semnav_scripts.main import SEMNAV
from semnav_scripts.map import COMMANDS as MAP
from tests.support.command_line import run

ASK_BASH = """
source "$1"
complete -p semnav
shift
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_tyro_semnav
printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.fixture(scope="module")
def scripts(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The script of each shell, in a file."""
    folder = tmp_path_factory.mktemp("completion")
    return {shell: folder / shell for shell in ("bash", "zsh", "fish")}


def written(path: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    if not path.exists():
        code, text, _ = run(capsys, "completion", path.name)
        assert code == 0
        path.write_text(text)
    return path


def bash_completes(script: Path, *words: str) -> list[str]:
    done = subprocess.run(
        ["bash", "-c", ASK_BASH, "bash", script, *words], capture_output=True, text=True, check=True
    )
    registered, *found = done.stdout.split("\n")[:-1]
    assert registered == "complete -o default -F _tyro_semnav semnav"
    return found


def test_bash_completes_commands_and_options(
    scripts: dict[str, Path], capsys: pytest.CaptureFixture[str]
) -> None:
    script = written(scripts["bash"], capsys)
    single = {name for name in SEMNAV.commands if " " not in name}
    assert single <= set(bash_completes(script, "semnav", ""))
    assert set(MAP.commands) <= set(bash_completes(script, "semnav", "map", ""))
    assert bash_completes(script, "semnav", "evaluate", "--html")[0] == "--html"


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_shell_can_read_its_script(
    scripts: dict[str, Path], capsys: pytest.CaptureFixture[str], shell: str
) -> None:
    script = written(scripts[shell], capsys)
    assert "semnav" in script.read_text()
    if shutil.which(shell) is None:
        pytest.skip(f"there is no {shell} here")
    subprocess.run([shell, "-n", script], check=True)


def test_another_shell_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    code, _, said = run(capsys, "completion", "tcsh")
    assert code == 2
    assert "'bash', 'zsh', 'fish'" in said
