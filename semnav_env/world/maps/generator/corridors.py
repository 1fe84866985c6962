"""The corridors of a generated office: a connected part of a grid of lines along and across it."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import TypeAlias

from numpy.random import Generator

from semnav_env.world.maps.generator.boxes import Box, box_of
from semnav_env.world.maps.generator.chance import centimetres, chance
from semnav_env.world.maps.generator.settings import OfficeSettings

Node: TypeAlias = tuple[int, int]
"""A crossing of two lines of the grid: numbers of the line along x and of the line across."""

Edge: TypeAlias = tuple[Node, Node]
"""The two ends of a stretch of corridor."""


MAX_STUB_LENGTH = 300
"""Largest length of a corridor behind the last place for a junction, cm."""

MAX_PRUNED_SHARE = 0.5
"""Largest share of the edges that is cut back to make dead ends and missing wings."""

JUNCTION_KINDS = {2: "corner", 3: "T-junction", 4: "crossing"}
"""What a junction is called, by its number of arms."""


@dataclass(frozen=True)
class OfficeCorridor:
    """A straight corridor.

    Attributes:
        box: the floor from end to end, through its junctions.
        along_x: whether it runs along x, else along y.
        depths: depths of the rooms below (left of) and above (right of) it, cm; 0 for none.
        blind: whether its low end and its high end are dead ends.
    """

    box: Box
    along_x: bool
    depths: tuple[int, int]
    blind: tuple[bool, bool]

    def transposed(self) -> OfficeCorridor:
        """The corridor with x and y exchanged."""
        return replace(self, box=self.box.transposed(), along_x=not self.along_x)


@dataclass(frozen=True)
class OfficeJunction:
    """A place where corridors meet.

    Attributes:
        box: shared by them.
        arms: number of ways that lead away, 2 to 4.
    """

    box: Box
    arms: int


@dataclass(frozen=True)
class Lines:
    """Parallel lines on which corridors may lie.

    The first and the last are no lines: wings of the building end there.

    Attributes:
        at: coordinates of their middles, cm.
        widths: widths of the corridors, cm, even.
        depths: depths of the rooms to both sides, cm.
    """

    at: tuple[int, ...]
    widths: tuple[int, ...]
    depths: tuple[tuple[int, int], ...]


def draw_corridors(
    rng: Generator, settings: OfficeSettings
) -> tuple[tuple[OfficeCorridor, ...], tuple[OfficeJunction, ...]]:
    """Corridors and their junctions: along x first, then across."""
    (fewest, most), (fewest_rows, most_rows) = settings.crossings
    columns = int(rng.integers(fewest, most + 1))
    rows = int(rng.integers(fewest_rows, most_rows + 1))
    lines = _rows(rng, settings, rows), _columns(rng, settings, columns)
    edges = _network(rng, columns, rows, settings.loops)
    edges |= _wings(rng, columns, rows, settings.wings, edges)
    corridors = [*_runs(rng, edges, lines, True), *_runs(rng, edges, lines, False)]
    return tuple(corridors), tuple(_junctions(edges, lines))


def _rows(rng: Generator, settings: OfficeSettings, count: int) -> Lines:
    """Draw lines along x, at distances at which the rooms between two lines stand back to back."""
    widths, depths = _sizes(rng, settings, count)
    at = [0]
    for i in range(1, count):
        if depths[i - 1][1] + depths[i][0] == 0:
            depths[i] = (centimetres(rng, settings.room_depth), depths[i][1])
        apart = depths[i - 1][1] + depths[i][0]
        at.append(at[-1] + (widths[i - 1] + widths[i]) // 2 + apart)
    return _with_wings(rng, settings, at, widths, depths)


def _columns(rng: Generator, settings: OfficeSettings, count: int) -> Lines:
    """Draw lines along y, a bay apart."""
    widths, depths = _sizes(rng, settings, count)
    at = [0]
    for i in range(1, count):
        between = (widths[i - 1] + widths[i]) // 2
        at.append(at[-1] + between + centimetres(rng, settings.bay))
    return _with_wings(rng, settings, at, widths, depths)


def _with_wings(
    rng: Generator,
    settings: OfficeSettings,
    at: list[int],
    widths: list[int],
    depths: list[tuple[int, int]],
) -> Lines:
    low, high = (centimetres(rng, settings.wing) for _ in range(2))
    places = (at[0] - low, *at, at[-1] + high)
    return Lines(places, (0, *widths, 0), ((0, 0), *depths, (0, 0)))


def _sizes(
    rng: Generator, settings: OfficeSettings, count: int
) -> tuple[list[int], list[tuple[int, int]]]:
    """Draw widths of corridors, and depths of the rooms on both sides, not both 0."""
    widths = [centimetres(rng, settings.corridor_width, 10) for _ in range(count)]
    depths = []
    for _ in range(count):
        sides = [centimetres(rng, settings.room_depth) for _ in range(2)]
        if chance(rng, settings.single_loaded):
            sides[int(rng.integers(2))] = 0
        depths.append((sides[0], sides[1]))
    return widths, depths


def _network(rng: Generator, columns: int, rows: int, loops: float) -> set[Edge]:
    """A spanning tree of the grid with edges that close loops, some of its leaves cut back."""
    nodes = [(i, j) for j in range(1, rows + 1) for i in range(1, columns + 1)]
    beside = [((i, j), (i + 1, j)) for i, j in nodes if i < columns]
    above = [((i, j), (i, j + 1)) for i, j in nodes if j < rows]
    candidates = beside + above
    group = {node: node for node in nodes}
    edges: set[Edge] = set()
    for index in rng.permutation(len(candidates)).tolist():
        a, b = candidates[index]
        first, second = group[a], group[b]
        if first != second:
            group = {node: second if g == first else g for node, g in group.items()}
        if first != second or chance(rng, loops):
            edges.add((a, b))
    for _ in range(int(rng.integers(0, int(MAX_PRUNED_SHARE * len(edges)) + 1))):
        leaves = sorted(edge for edge in edges if _is_leaf(edge, edges))
        if leaves and len(edges) > 2:
            edges.remove(leaves[int(rng.integers(len(leaves)))])
    return edges


def _wings(rng: Generator, columns: int, rows: int, share: float, edges: set[Edge]) -> set[Edge]:
    """Edges that lead from the outermost nodes of the network out of the grid."""
    nodes = {node for edge in edges for node in edge} or {(1, 1)}
    wings = set()
    for i, j in sorted(nodes):
        outward = (
            (i == 1, ((0, j), (1, j))),
            (i == columns, ((i, j), (i + 1, j))),
            (j == 1, ((i, 0), (i, 1))),
            (j == rows, ((i, j), (i, j + 1))),
        )
        wings |= {edge for is_outer, edge in outward if is_outer and chance(rng, share)}
    return wings


def _is_leaf(edge: Edge, edges: set[Edge]) -> bool:
    degrees = Counter(node for other in edges for node in other)
    return degrees[edge[0]] == 1 or degrees[edge[1]] == 1


def _runs(
    rng: Generator, edges: set[Edge], lines: tuple[Lines, Lines], along_x: bool
) -> list[OfficeCorridor]:
    """The longest straight stretches in one direction."""
    step = (1, 0) if along_x else (0, 1)
    corridors = []
    for first in sorted(a for a, b in edges if b == _moved(a, step)):
        if (_moved(first, step, -1), first) not in edges:
            last = first
            while (last, _moved(last, step)) in edges:
                last = _moved(last, step)
            blind = tuple(not _crosses(node, edges, along_x) for node in (first, last))
            corridors.append(_corridor(rng, (first, last), blind, lines, along_x))
    return corridors


def _corridor(
    rng: Generator,
    ends: tuple[Node, Node],
    blind: tuple[bool, ...],
    lines: tuple[Lines, Lines],
    along_x: bool,
) -> OfficeCorridor:
    """The corridor between two nodes, to the far side of what it meets or a stub beyond."""
    own, other = lines if along_x else lines[::-1]
    first, last = (node[not along_x] for node in ends)
    i = ends[0][along_x]
    low, high = (
        other.widths[index] // 2
        + (centimetres(rng, (0.0, MAX_STUB_LENGTH / 100)) if is_blind else 0)
        for index, is_blind in zip((first, last), blind, strict=True)
    )
    half = own.widths[i] // 2
    span = other.at[first] - low, other.at[last] + high
    box = box_of(along_x, span, (own.at[i] - half, own.at[i] + half))
    return OfficeCorridor(box, along_x, own.depths[i], (blind[0], blind[1]))


def _moved(node: Node, step: Node, times: int = 1) -> Node:
    return node[0] + times * step[0], node[1] + times * step[1]


def _crosses(node: Node, edges: set[Edge], along_x: bool) -> bool:
    """Whether a corridor in the other direction leads away from a node."""
    step = (0, 1) if along_x else (1, 0)
    return (node, _moved(node, step)) in edges or (_moved(node, step, -1), node) in edges


def _junctions(edges: set[Edge], lines: tuple[Lines, Lines]) -> list[OfficeJunction]:
    rows, columns = lines
    degrees = Counter(node for edge in edges for node in edge)
    junctions = []
    for node in sorted(degrees):
        if _crosses(node, edges, True) and _crosses(node, edges, False):
            (x, half_x), (y, half_y) = (
                (line.at[i], line.widths[i] // 2)
                for line, i in zip((columns, rows), node, strict=True)
            )
            box = Box(x - half_x, y - half_y, x + half_x, y + half_y)
            junctions.append(OfficeJunction(box, degrees[node]))
    return junctions
