"""Arcs: runs of straight pieces that one circle explains better (Yan et al.)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from semnav_features.elements import Arc
from semnav_features.frames import FloatArray
from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.circles import Circle, EdgeRay, algebraic_circle, refined
from tests.numpy_oracle.constants import ARC_RUNS, CIRCLE_FIT
from tests.numpy_oracle.sweep import Sweep
from tests.numpy_oracle.walls import Piece


def find_arcs(
    sweep: Sweep, pieces: list[Piece], settings: ExtractorSettings
) -> tuple[list[Arc], list[Piece]]:
    """The arcs, and the pieces again, those in an arc marked `is_round`."""
    if not settings.arcs:
        return [], pieces
    search = _Search(sweep, pieces, settings)
    arcs: list[Arc] = []
    first = 0
    while first < len(pieces):
        if first in search.in_arcs:
            first += 1
            continue
        last, turn = search.end_of_run(first)
        found = search.explained(first, last) if search.is_bowed(first, last, turn) else []
        arcs += found
        first = last if last > first and not found else last + 1
    return arcs, [replace(p, is_round=k in search.in_arcs) for k, p in enumerate(pieces)]


class _Search:
    """The points of a sweep by number, and its pieces as numbers of first and last points."""

    def __init__(self, sweep: Sweep, pieces: list[Piece], settings: ExtractorSettings) -> None:
        self.sweep, self.pieces, self.settings = sweep, pieces, settings
        once = sweep.returned[: sweep.turn or None]
        self.beams: NDArray[np.intp] = np.flatnonzero(once)
        self.points = sweep.points([int(beam) for beam in self.beams])
        number = {int(beam): i for i, beam in enumerate(self.beams)}
        self.spans = [(number[p.beams[0]], number[p.beams[-1]]) for p in pieces]
        groups = sweep.connected_groups(settings)
        self.group_starts = [*(number[group[0]] for group in groups), sum(map(len, groups))]
        self.in_arcs: set[int] = set()

    def end_of_run(self, first: int) -> tuple[int, float]:
        """The last piece that keeps turning the same way, and the sum of the turns' sines."""
        last, turn = first, 0.0
        for k in range(first + 1, len(self.pieces)):
            if not self._is_solid(first):
                break
            if not self._is_solid(k):
                continue
            sine = _turn_sine(self.pieces[last], self.pieces[k], self.settings)
            if sine == 0.0 or sine * turn < 0.0:
                break
            last, turn = k, turn + sine
        return last, turn

    def is_bowed(self, first: int, last: int, turn: float) -> bool:
        """Whether the middle half of the pieces lies off their lines as an arc's would."""
        if first == last:
            return self._is_lonely(first)
        run = range(first, last + 1)
        extent = turn * len(run) / (len(run) - 1)
        if abs(extent) < self.settings.arc_extent_min:
            return False
        halves = [len(self.pieces[k].beams) // 2 for k in run]
        starts = [self.spans[k][0] + len(self.pieces[k].beams) // 4 for k in run]
        bow = -sum(
            self.pieces[k].offset(point)
            for k, start, half in zip(run, starts, halves, strict=True)
            for point in self.points[start : start + half]
        )
        lengths = [self.pieces[k].length for k in run]
        expected = sum(c**2 * half for c, half in zip(lengths, halves, strict=True))
        least = ARC_RUNS.least_bow * expected * abs(extent) / sum(lengths)
        return (bow if extent > 0.0 else -bow) >= least

    def explained(self, first: int, last: int) -> list[Arc]:
        """The arcs of a run, which is split at its worst point as long as it is none."""
        while first <= last and first in self.in_arcs:
            first += 1
        if first > last or (first == last and not self._is_lonely(first)):
            return []
        arc, worst = self._best_arc(first, last)
        if arc is not None:
            return [arc]
        if first == last:
            return []
        cut = first
        while cut + 1 < last and self.spans[cut + 1][0] <= worst:
            cut += 1
        return self.explained(first, cut) + self.explained(cut + 1, last)

    def _best_arc(self, start: int, end: int) -> tuple[Arc | None, int]:
        """The arc through the pieces start to end if it beats them, and its farthest point."""
        first, last = self.spans[start][0], self.spans[end][1]
        circle = algebraic_circle(self.points[first : last + 1])
        on = np.abs(circle.beyond(self.points)) <= CIRCLE_FIT.near * self.settings.sigma
        start, first = self._grown(on, start, first, -1)
        end, last = self._grown(on, end, last, 1)
        points = self.points[first : last + 1]
        bulges = circle.bulges_at(points[(len(points) - 1) // 2])
        rays = [self._edge_ray(first, -1), self._edge_ray(last, 1)] if bulges else []
        found = [ray for ray in rays if ray is not None]
        circle = refined(points, circle, found)
        arc, straight = _arc(circle, points), self._straight_scatter(start, end, first, last)
        worst = first + int(np.abs(circle.beyond(points)).argmax())
        if not _is_arc(arc, straight, end - start + 1, self.settings):
            return None, worst
        self.in_arcs.update(range(start, end + 1))
        return arc, worst

    def _grown(self, on: NDArray[np.bool_], piece: int, point: int, step: int) -> tuple[int, int]:
        """The outermost piece and point that a run reaches: in its group, no two in a row off."""
        starts = np.array(self.group_starts)
        group = int(np.searchsorted(starts, point, side="right"))
        border = starts[group - 1] if step < 0 else starts[group] - 1
        reached, previous = point, True
        for i in range(point + step, border + step, step):
            if not on[i] and not previous:
                break
            previous = bool(on[i])
            beside = piece + step
            if 0 <= beside < len(self.pieces):
                span = self.spans[beside]
                if span[0] <= i <= span[1]:
                    if i != span[0 if step < 0 else 1]:
                        continue
                    if beside in self.in_arcs:
                        break
                    piece = beside
            if on[i]:
                reached = i
        return piece, reached

    def _edge_ray(self, point: int, step: int) -> EdgeRay | None:
        beam, following = int(self.beams[point]), point + step
        if not 0 <= beam + step < len(self.sweep.ranges):
            return None
        if 0 <= following < len(self.beams):
            border = point if step < 0 else following
            nearer = np.linalg.norm(self.points[following]) < np.linalg.norm(self.points[point])
            follows = int(self.beams[following]) == beam + step
            if border not in self.group_starts or (follows and nearer):
                return None
        hit, miss = self.sweep.directions[[beam, beam + step]]
        return EdgeRay.between(hit, miss, self.points[point], self.settings.sigma)

    def _straight_scatter(self, start: int, end: int, first: int, last: int) -> float:
        """Squared distances to the pieces' lines, loose points to the nearer one beside them."""
        total = sum(self.pieces[k].scatter for k in range(start, end + 1))
        borders = [first - 1, *[i for k in range(start, end + 1) for i in self.spans[k]], last + 1]
        for gap in range(end - start + 2):
            lines = {max(start + gap - 1, start), min(start + gap, end)}
            for point in self.points[borders[2 * gap] + 1 : borders[2 * gap + 1]]:
                total += min(self.pieces[k].offset(point) ** 2 for k in lines)
        return total

    def _is_solid(self, k: int) -> bool:
        return len(self.pieces[k].beams) >= ARC_RUNS.solid

    def _is_lonely(self, k: int) -> bool:
        piece = self.pieces[k]
        uneven = len(piece.beams) * (ARC_RUNS.uneven * self.settings.sigma) ** 2
        return bool(
            len(piece.beams) >= self.settings.arc_beams
            and piece.scatter >= uneven
            and (piece.start_rupture or piece.start_break)
            and (piece.end_rupture or piece.end_break)
        )


def _turn_sine(a: Piece, b: Piece, settings: ExtractorSettings) -> float:
    sine = float(a.along[0] * b.along[1] - a.along[1] * b.along[0])
    longer, mean = max(a.length, b.length), (a.length + b.length) / 2
    most = ARC_RUNS.chord_sagitta * settings.split_distance * mean
    meet = np.linalg.norm(b.start - a.end) <= settings.merge_gap
    fits = longer**2 * abs(sine) <= most and a.along @ b.along >= ARC_RUNS.most_turn
    return sine if fits and meet else 0.0


def _arc(circle: Circle, points: FloatArray) -> Arc:
    (x, y), start, end = circle.centre, circle.nearest(points[0]), circle.nearest(points[-1])
    return Arc(
        (float(x), float(y)),
        circle.radius,
        (float(start[0]), float(start[1])),
        (float(end[0]), float(end[1])),
        circle.bulges_at(points[(len(points) - 1) // 2]),
        len(points),
        float(np.sqrt(np.mean(circle.beyond(points) ** 2))),
    )


def _is_arc(arc: Arc, straight: float, lines: int, settings: ExtractorSettings) -> bool:
    """Round enough, and better than lines by Schwarz's criterion."""
    n, finest = arc.beams, (CIRCLE_FIT.finest * settings.sigma) ** 2
    with np.errstate(divide="ignore", invalid="ignore"):
        gain = n * np.log((straight / n + finest) / np.float64(arc.residual**2 + finest))
    return bool(
        n >= settings.arc_beams
        and settings.arc_radius_min <= arc.radius <= settings.arc_radius_max
        and arc.residual <= settings.arc_residual
        and arc.extent >= settings.arc_extent_min
        and (math.hypot(*arc.centre) < arc.radius or arc.extent <= math.pi)
        and arc.radius * (1.0 - math.cos(arc.extent / 2)) >= settings.arc_sagitta_min
        and gain + (3 * lines - 4) * math.log(n) > 0.0
    )
