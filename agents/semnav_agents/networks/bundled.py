"""The networks that come with the package, each in a folder of its own."""

from __future__ import annotations

from pathlib import Path

from semnav_env.networks.card import CARD_FILE, NetworkSettings, card_fields

BUNDLED_FOLDER = Path(__file__).parents[1] / "pretrained"
"""Folder of the networks of the bundled agents, one folder each."""


def network_folder(source: str | Path) -> Path:
    """The folder of a network: one that comes with the package, by its name, or the folder."""
    bundled = BUNDLED_FOLDER / source
    return bundled if (bundled / CARD_FILE).is_file() else Path(source)


def network_kind(source: str | Path) -> str:
    """The kind of the network of a name or a folder; empty if there is no card.

    Raises:
        ValueError: the card is damaged.
        OSError: it cannot be read.
    """
    folder = network_folder(source)
    return str(card_fields(folder)["network"]) if (folder / CARD_FILE).is_file() else ""


def bundled_names(kind: type[NetworkSettings]) -> tuple[str, ...]:
    """Names of the networks of a kind that come with the package, sorted."""
    names = sorted(path.parent.name for path in BUNDLED_FOLDER.glob(f"*/{CARD_FILE}"))
    return tuple(name for name in names if network_kind(name) == kind.KIND)
