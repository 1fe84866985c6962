"""Build the packages and try each in an empty environment: `make packages`.

Everything is made from a copy of the tracked files, as in a zip: without `.git`, and outside the
checkout. The wheel and the source package are installed without extras; in the copy `make demo`
has to work, for which it adds its extra to one of these environments.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.support.paths import ROOT, ROOTS

SMOKE = Path(__file__).with_name("smoke.py")
REPORT = ("evaluate", "heidelberg", "--agent", "blind", "--seeds", "1")
DEMO = ("go through the second door on the right", "--map=heidelberg_hallway", "--seed=3")


def run(*command: str | Path, cwd: Path) -> None:
    """Run a command that does not know of this checkout.

    Raises:
        CalledProcessError: it failed.
    """
    print("+", *command, flush=True)
    hidden = {"PYTHONPATH", "VIRTUAL_ENV", "MAKEFLAGS", "MAKELEVEL"}
    environment = {name: value for name, value in os.environ.items() if name not in hidden}
    subprocess.run(command, cwd=cwd, env=environment, check=True)


def tracked() -> list[Path]:
    """The files of the checkout that git knows, from the checkout on."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True)
    return [Path(name) for name in listed.stdout.decode().split("\0") if (ROOT / name).is_file()]


def copy_to(folder: Path) -> None:
    """Copy the tracked files as they are now."""
    for file in tracked():
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / file, folder / file)


def package_files() -> set[Path]:
    """What an installation holds, from `site-packages` on."""
    places = [(ROOTS[name] / name, ROOTS[name]) for name in ROOTS]
    return {
        (ROOT / file).relative_to(root)
        for file in tracked()
        for package, root in places
        if (ROOT / file).is_relative_to(package)
    }


def try_package(package: Path, folder: Path) -> None:
    """Install a package into an empty environment, and use it from an empty folder.

    Raises:
        AssertionError: it lacks files.
        CalledProcessError: it cannot be installed, or does not work.
    """
    run(sys.executable, "-m", "venv", folder, cwd=folder.parent)
    install = (folder / "bin/pip", "install", "-q", "--no-compile")
    run(*install, "-c", ROOT / "constraints.txt", package, cwd=folder)
    (installed,) = folder.glob("lib/python*/site-packages")
    missing = sorted(str(file) for file in package_files() if not (installed / file).exists())
    assert not missing, f"{package.name} lacks {', '.join(missing)}"
    for file in package_files():
        assert os.access(installed / file, os.X_OK) or file.name != "run", f"roslaunch: {file}"
    semnav = folder / "bin/semnav"
    run(semnav, "demo", *DEMO, cwd=folder)
    run(semnav, *REPORT, "--html", "report.html", cwd=folder)
    assert "<article" in (folder / "report.html").read_text("utf-8")
    run(semnav, "completion", "bash", cwd=folder)
    run(folder / "bin/python", "-I", SMOKE, cwd=folder)


def main() -> None:
    """Try all three: the wheel, the source package, and the copy."""
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        print("packages are not tried: git, which tells their files, is not here")
        return
    with TemporaryDirectory(prefix="semnav-packages-") as temporary:
        folder = Path(temporary)
        copy, packages = folder / "copy", folder / "packages"
        copy_to(copy)
        run(sys.executable, "-m", "build", "--outdir", packages, copy, cwd=folder)
        for package in sorted(packages.iterdir()):
            environment = folder / f"with{package.suffix}"
            try_package(package, environment)
        run("make", "demo", f"VENV={environment}", cwd=copy)
        assert (copy / "out" / "demo.gif").stat().st_size > 0
        viewed = ("view", "test_real-00000", "--agent", "blind", "--out", "out/run.mp4")
        run(environment / "bin/semnav", *viewed, cwd=copy)
        assert (copy / "out" / "run.mp4").stat().st_size > 0


if __name__ == "__main__":
    main()
