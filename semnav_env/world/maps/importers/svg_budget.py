"""Budgets of an SVG drawing, checked before svgelements reads it.

Parts of that reader take time that grows with the square or the cube of a length: of a number, of a
list of transforms, of a style sheet, of an outline that is closed again and again.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from xml.etree.ElementTree import Element

from semnav_env.world.maps.rules import FloorPlanError

MAX_ELEMENTS = 60_000
"""Number of elements beyond which a drawing is refused."""

MAX_NUMBERS = 200_000
"""Number of numbers in outlines beyond which a drawing is refused; a line takes one or two."""

MAX_ARCS = 10_000
"""Number of arcs beyond which a drawing is refused: one takes a third of a millisecond, and a
circle is four."""

MAX_DIGITS = 100
"""Length of the longest number, characters; a float has seventeen digits."""

MAX_TRANSFORM = 1000
"""Length of the longest list of transforms, characters."""

MAX_STYLE_SHEET = 10_000
"""Length of the longest style sheet, characters."""

MAX_CLOSINGS = 100
"""Largest number of closings of one subpath; each closing is looked up from the subpath's
beginning."""

_OUTLINES = ("d", "points")
_TRANSFORMS = ("transform", "gradientTransform", "patternTransform")
_NUMBER = re.compile(r"[0-9]+")
_LONG_NUMBER = re.compile(rf"[0-9.]{{{MAX_DIGITS}}}")
_ARC = re.compile(r"[Aa]([^a-df-zA-DF-Z]*)")
_ROUND = ("circle", "ellipse", "rect")
_SUBPATH = re.compile(r"[Mm]")


def check_budget(root: Element) -> None:
    """Refuse a drawing that would take too long to read.

    Raises:
        FloorPlanError: says which budget it exceeds.
    """
    if not expanded(root, lambda element: 1.0) <= MAX_ELEMENTS:
        raise FloorPlanError(
            f"more than {MAX_ELEMENTS:,} elements, those that <use> repeats included; export the "
            "walls alone"
        )
    for element in root.iter():
        for fault in _faults(element):
            raise FloorPlanError(f"<{element.tag.rpartition('}')[2][:20]}> has {fault}")
    for what, most, weigh in (("numbers", MAX_NUMBERS, _numbers), ("arcs", MAX_ARCS, _arcs)):
        if not expanded(root, weigh) <= most:
            raise FloorPlanError(
                f"more than {most:,} {what} in its outlines, those that <use> repeats included; "
                "export the walls alone"
            )


def expanded(root: Element, weigh: Callable[[Element], float]) -> float:
    """Weight of all elements once each <use> is replaced by what it refers to.

    Args:
        root: the outermost element.
        weigh: the weight of an element without those in it.

    Returns:
        Their sum; infinite if an element contains itself.
    """
    named = {each.get("id"): each for each in root.iter() if each.get("id")}
    weights: dict[Element, float] = {}

    def weight(element: Element) -> float:
        if element not in weights:
            weights[element] = math.inf  # until it is known: what contains itself has no end
            target = named.get(_reference(element)) if element.tag.endswith("use") else None
            inner = sum(map(weight, element)) + (0.0 if target is None else weight(target))
            weights[element] = weigh(element) + inner
        return weights[element]

    return weight(root)


def _reference(element: Element) -> str:
    """The id that a <use> refers to; empty if it says none."""
    links = (value for name, value in element.attrib.items() if name.endswith("href"))
    return next(links, "").removeprefix("#")


def _numbers(element: Element) -> float:
    """Least count of numbers in the outline of an element."""
    return float(sum(len(_NUMBER.findall(element.get(name, ""))) for name in _OUTLINES))


def _arcs(element: Element) -> float:
    """Number of arcs of an element; a command may draw several, of five numbers each."""
    commands = _ARC.findall(element.get("d", ""))
    drawn = sum(max(1, len(_NUMBER.findall(numbers)) // 5) for numbers in commands)
    return float(drawn + 4 * element.tag.endswith(_ROUND))


def _faults(element: Element) -> Iterator[str]:
    """The parts of an element that take too long to read."""
    if any(map(_LONG_NUMBER.search, element.attrib.values())):
        yield f"a number of {MAX_DIGITS} characters or more; save it with fewer decimals"
    if any(len(element.get(name, "")) > MAX_TRANSFORM for name in _TRANSFORMS):
        yield f"transforms of more than {MAX_TRANSFORM:,} characters; join them into one matrix"
    if element.tag.endswith("style") and len(element.text or "") > MAX_STYLE_SHEET:
        yield f"a style sheet of more than {MAX_STYLE_SHEET:,} characters; save it as plain SVG"
    for subpath in _SUBPATH.split(element.get("d", "").replace("Z", "z")):
        if subpath.count("z") > MAX_CLOSINGS:
            yield f"a line that is closed more than {MAX_CLOSINGS} times; begin each outline with M"
