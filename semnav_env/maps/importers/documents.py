"""Reads small text files of foreign maps safely."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import yaml

from semnav_env.maps.rules import FloorPlanError

MAX_YAML_BYTES = 200_000
"""Size of the largest YAML file that is read, bytes."""

MAX_BYTES = 20_000_000
"""Size of the largest other document that is read, bytes."""


def read_text(path: Path, most: int = MAX_BYTES) -> str:
    """Read a text file of limited size.

    Raises:
        FloorPlanError: no such file, too large, or not UTF-8.
    """
    try:
        size = path.stat().st_size
        if size > most:
            raise FloorPlanError(f"{path}: {size:,} bytes; at most {most:,} are read")
        return path.read_text("utf-8-sig")
    except OSError as error:
        raise FloorPlanError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise FloorPlanError(f"{path}: not UTF-8 text; is it the right file?") from None


def read_yaml(path: Path) -> Any:
    """Read a YAML document of limited size.

    Raises:
        FloorPlanError: no such file, too large, or no YAML.
    """
    try:
        return yaml.safe_load(read_text(path, MAX_YAML_BYTES))
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        if isinstance(error, FloorPlanError):
            raise
        said = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise FloorPlanError(f"{path}: not YAML: {said}") from None


def finite(value: Any) -> float:
    """A finite number; also one that YAML 1.1 reads as text, such as 1e-3.

    Raises:
        TypeError: not a number at all.
        ValueError: not a finite one.
    """
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"{value} is not finite")
    return number
