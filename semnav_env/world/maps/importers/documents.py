"""Reads small text files of foreign maps safely."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element, ParseError, fromstring

import yaml

from semnav_env.world.maps.rules import FloorPlanError
from semnav_features import reading
from semnav_features.validation import clipped, shown

MAX_YAML_BYTES = 200_000
"""Size of the largest YAML file that is read, bytes."""


def read_text(path: Path, most: int = reading.WHOLE_FILE) -> str:
    """Read a text file of limited size.

    Raises:
        FloorPlanError: no such file, too large, or not UTF-8.
    """
    try:
        return reading.read_text(path, most, FloorPlanError)
    except OSError as error:
        raise FloorPlanError(f"{path}: cannot be read: {error.strerror}") from None


class PlainLoader(yaml.SafeLoader):  # type: ignore[misc]
    """YAML without aliases: a few hundred bytes of them can stand for gigabytes of text."""

    def compose_node(self, parent: Any, index: Any) -> Any:
        """The next node, which may not refer to another one."""
        if self.check_event(yaml.AliasEvent):
            raise yaml.YAMLError("it has aliases (*name); write out what they stand for")
        return super().compose_node(parent, index)


def read_yaml(path: Path) -> Any:
    """Read a YAML document of limited size.

    Raises:
        FloorPlanError: no such file, too large, or no YAML.
    """
    text = read_text(path, MAX_YAML_BYTES)
    try:
        return yaml.load(text, PlainLoader)
    except (yaml.YAMLError, RecursionError, ValueError) as error:
        said = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise FloorPlanError(f"{path}: not YAML: {clipped(said)}") from None


def read_xml(path: Path, what_it_is: str) -> Element:
    """Read an XML document of limited size, without a document type: entities can grow endlessly.

    Args:
        path: the file.
        what_it_is: what the file should hold, for the error.

    Raises:
        FloorPlanError: no such file, too large, or no XML.
    """
    text = read_text(path)
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise FloorPlanError(f"{path}: declares a document type, which is not read; {what_it_is}")
    try:
        return fromstring(text.encode())
    except ParseError as error:
        raise FloorPlanError(f"{path}: no XML ({error}); {what_it_is}") from None


def finite(value: Any) -> float:
    """A finite number; also one that YAML 1.1 reads as text, such as 1e-3.

    Raises:
        TypeError: not a number at all.
        ValueError: not a finite one.
    """
    try:
        number = float(value)
    except ValueError:
        raise ValueError(f"{shown(value)} is no number") from None
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ValueError(f"{shown(value)} is not finite")
    return number
