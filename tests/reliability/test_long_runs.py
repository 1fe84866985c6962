"""A run of one character or token, wherever it stands in a small file, never hangs a reader."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.reliability.long_runs import (
    COMMON_TOKENS,
    RUN_BYTES,
    SHORT_RUN_BYTES,
    TOKENS,
    holes,
    tried,
)

FORMATS = (
    *("SVG", "CSV", "CARMEN", "BreezySLAM", "ROS bag", "vector map", "HouseExpo", "walls"),
    *("floor plan", "YAML", "episodes", "DXF", "PGM"),
)
EACH_FORMAT = pytest.mark.parametrize("kind", FORMATS)


def check(kind: str, tokens: tuple[str, ...], size: int, folder: Path) -> None:
    chosen = [hole for hole in holes(folder) if hole.format == kind]
    assert chosen
    for hole in chosen:
        outcome = tried(hole, tokens, size, folder)
        assert not outcome.fault, (hole.text[:300], outcome)


def test_every_format_has_holes(tmp_path: Path) -> None:
    assert {hole.format for hole in holes(tmp_path)} == set(FORMATS)


@EACH_FORMAT
def test_a_run_of_a_common_token_never_hangs(kind: str, tmp_path: Path) -> None:
    check(kind, COMMON_TOKENS[:3], SHORT_RUN_BYTES, tmp_path)


@pytest.mark.slow
@EACH_FORMAT
def test_a_run_of_any_token_never_hangs(kind: str, tmp_path: Path) -> None:
    check(kind, TOKENS, RUN_BYTES, tmp_path)
