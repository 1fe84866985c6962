"""Small files in which one place is filled with a token that is repeated without end.

Parsers that look back, or try again from each character, take time that grows with the square or
the cube of such a run.
"""

from __future__ import annotations

import gzip
import json
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from semnav_env.judge.episodes import load_episodes
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.importers import import_map
from tests.reliability.children import PROCESSOR_SECONDS, Outcome, in_child, outcome_of
from tests.reliability.readers import HOUSE, RANGES, READERS, SVG, read_drawing, read_log
from tests.support.drawn_maps import two_rooms, write_map

RUN_BYTES = 100_000
"""Length of a run, bytes."""

SHORT_RUN_BYTES = 30_000
"""Length of a run in the tests of every day: what is cubic or quadratic shows, too."""

HOLE = "@"
"""What stands in a text for the run."""

COMMON_TOKENS = ("1", "(", "[", "z ", "rotate(", "\u0663")
"""Tokens that are tried in every run of the tests."""

TOKENS = (
    *COMMON_TOKENS,
    *("-", '{"a":', "1.", "0 ", "M0 0", "1,"),
    *("0", "9", "+", ".", ",", ";", ":", "#", '"', "'", ")", "]", "{", "}", "<", ">", "/", "\\"),
    *("&", "*", "!", "|", "%", "=", "_", "e", "M", "z", "a", "\u00fc", "~", "?", "@", "^", " "),
    *("\t", "\n", "\r", "\0", "1e", "-1", "L1 1", "z L1 1", "a1,", "a1 1 0 0 0 1 1", "rotate(1)"),
    *("<g>", "<!--", "&amp;", "[1,", "- ", "? ", ": ", "\\u0041", "''", "x,", "r1", "1_", "a{"),
)
"""All of them: characters, and short texts that some format gives a meaning."""

NUMBERS = ",".join(map(str, RANGES))
WORDS = " ".join(map(str, RANGES))
ROUND_MAP = "image: floor.pgm\nresolution: 0.1\norigin: [0, 0, 0]\n"
SHAPE = '<path d="M0 0 L4 4"/>'


class Hole(NamedTuple):
    """A place in a file that a run fills.

    Attributes:
        format: of the file.
        name: of the file.
        text: of the file, with `HOLE` where the run goes.
        read: reads it.
    """

    format: str
    name: str
    text: str
    read: Callable[[Path], Any]


def _holes(
    kind: str, name: str, read: Callable[[Path], Any], texts: Iterable[str]
) -> tuple[Hole, ...]:
    return tuple(Hole(kind, name, text, read) for text in (HOLE, *texts))


def _json_holes(document: Any) -> list[str]:
    """A document with a hole for each of its values, with quotation marks and without."""
    texts: list[str] = []

    def visit(parent: Any, keys: Iterable[Any]) -> None:
        for key in keys:
            value, parent[key] = parent[key], HOLE
            texts.append(json.dumps(document))
            texts.append(texts[-1].replace(f'"{HOLE}"', HOLE))
            parent[key] = value
            if isinstance(value, dict):
                visit(value, list(value))
            elif isinstance(value, list) and value:
                visit(value, [0])

    visit(document, list(document) if isinstance(document, dict) else [0])
    return texts


def _sound_text(reader: str, folder: Path) -> str:
    """The text of the small sound file of a reader."""
    data = next(each for each in READERS if each.name == reader).make(folder).read_bytes()
    return (gzip.decompress(data) if data.startswith(b"\x1f\x8b") else data).decode()


def _attributes() -> list[str]:
    """Drawings with a hole in each kind of attribute that is read."""
    shapes = (
        *('<path d="@"/>', '<path d="M0 0 H40 V30 @"/>', '<path d="M0 0 L@ 4"/>'),
        *('<path d="M0 0 A@ 4 0 1 1 3 3"/>', '<polyline points="@"/>', f"<style>@</style>{SHAPE}"),
        *('<circle cx="@" cy="9" r="@"/>', '<rect x="@" y="0" width="@" height="2" rx="1"/>'),
        *(f'<g transform="@">{SHAPE}</g>', f'<g transform="rotate(@)">{SHAPE}</g>'),
        *(f'<g id="@" class="@" style="@" display="@">{SHAPE}</g>', f"@{SHAPE}"),
        *(f'<use href="@"/>{SHAPE}', '<path fill="@" stroke="@" stroke-width="@" d="M0 0 L4 4"/>'),
        *(f'<text font-size="@" font="@" x="@">@</text>{SHAPE}', f'<image href="@"/>{SHAPE}'),
    )
    box = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="@" width="@" height="9">'
    return [*map(SVG.format, shapes), f"{box}{SHAPE}</svg>"]


def holes(folder: Path) -> tuple[Hole, ...]:
    """Every hole of every format; sound files are made in a folder."""
    plan = json.loads(_sound_text("floor plan", folder))
    plan["features"] = plan["features"][:2]
    episode = json.loads(_sound_text("episodes", folder).splitlines()[0])
    drawing = _sound_text("DXF", folder)
    write_map(folder, two_rooms())
    segment = [{"p0": {"x": 0, "y": 0}, "p1": {"x": 3, "y": 1}}]
    return (
        *_holes("SVG", "drawing.svg", read_drawing, _attributes()),
        *_holes("CSV", "log.csv", read_log, CSV_LOGS),
        *_holes("CARMEN", "robot.log", read_log, CARMEN_LOGS),
        *_holes("BreezySLAM", "exp.dat", read_log, (f"@ {'1 ' * 706}\n", f"1 @ {'1 ' * 705}\n")),
        *_holes("ROS bag", "run.bag", read_log, ["#ROSBAG V2.0\n@"]),
        *_holes("vector map", "map.json", import_map, _json_holes(segment)),
        *_holes("HouseExpo", "house.json", import_map, _json_holes(HOUSE)),
        *_holes("walls", "walls.csv", import_map, ("0,0,@,1\n", "#@\n0,0,1,1\n", '"@,0,1,1\n')),
        *_holes("floor plan", "plan.geojson", load_floor_plan, _json_holes(plan)),
        *_holes("YAML", "floor.yaml", import_map, YAML_MAPS),
        *_holes("episodes", "some.jsonl", load_episodes, _json_holes(episode)),
        *_holes("DXF", "drawing.dxf", import_map, _lines_of(drawing)),
        *_holes("PGM", "floor.pgm", _read_image, ("P5\n@ 9\n255\n", "P2\n9 9\n@", "P1 9 9 @")),
    )


CSV_LOGS = (
    *("r0,r1,@\n1,2,3\n", "@,r1,r2\n1,2,3\n", "r0,r1@\n1,2\n", "@.r0,@.r1\n1,2\n"),
    *("x@,r1,r2\n0,1,2\n", f"{NUMBERS}\n@,{NUMBERS}\n", f"# angle_min=@\n{NUMBERS}\n"),
    *(f"# @\n{NUMBERS}\n", "t,r0,r1\n@,1,2\n", "sep=@\n1,2,3\n", "%time,r0,r1\n@,1,2\n"),
)
CARMEN_LOGS = (
    *(f"FLASER @ {WORDS} 0 0 0 0 0 0 1.0 r 1.0\n", f"FLASER 60 @ {WORDS} 0 0 0 0 0 0 1.0 r 1.0\n"),
    *(f"ODOM 1 2 3\n@ 60 {WORDS}\n", "ODOM @ 2 3 0 0 0\n", "ROBOTLASER1 1 @ 3 4 0 0 0 2 1 1 0\n"),
)
YAML_MAPS = (
    *(ROUND_MAP.replace("floor.pgm", "@"), ROUND_MAP.replace("floor.pgm", '"@"')),
    *(ROUND_MAP.replace("0.1", "@"), ROUND_MAP.replace("[0,", "[@,"), f"{ROUND_MAP}negate: @\n"),
    *(f"@: 1\n{ROUND_MAP}", f"{ROUND_MAP}@", ROUND_MAP.replace("floor.pgm", "|\n  @")),
)


def _lines_of(drawing: str) -> tuple[str, ...]:
    return (
        drawing.replace("1.5\n", "@\n"),
        drawing.replace("ENTITIES\n", "ENTITIES\n@", 1),
        drawing.replace("CIRCLE\n", "CIRCLE@\n", 1),
    )


def _read_image(path: Path) -> Any:
    return import_map(path, 0.1)


def tried(hole: Hole, tokens: Sequence[str], size: int, folder: Path) -> Outcome:
    """How the worst of some runs of that many bytes ends, all of them in one child process."""
    path = folder / hole.name

    def fill() -> None:
        for token in tokens:
            run = token * (size // len(token.encode()))
            path.write_text(hole.text.replace(HOLE, run), encoding="utf-8")
            begun = time.process_time()
            outcome = outcome_of(lambda: hole.read(path), path.name)
            used = time.process_time() - begun
            assert not outcome.fault, f"{token!r}: {outcome}"
            assert used < PROCESSOR_SECONDS, f"{token!r} takes {used:.1f} s"

    return in_child(fill, seconds=PROCESSOR_SECONDS * len(tokens))
