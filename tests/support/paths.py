"""Where things lie: the checkout, and beside it the data that not every machine has."""

from pathlib import Path

TESTS = Path(__file__).resolve().parents[1]
ROOT = TESTS.parent
SHARED = ROOT.parent / "shared"
DATA = SHARED / "data"
GOLDEN = TESTS / "golden"

ROOTS = {
    "semnav_features": ROOT / "features",
    "semnav_env": ROOT,
    "semnav_agents": ROOT / "agents",
    "semnav_ros": ROOT / "scripts",
    "semnav_scripts": ROOT / "scripts",
}
"""The installed packages, each with the folder that holds it."""


def source(name: str) -> Path:
    """A file or folder that the documentation names, from its package or from the checkout on."""
    return ROOTS.get(name.split("/")[0], ROOT) / name
