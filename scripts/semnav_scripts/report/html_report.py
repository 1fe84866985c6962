"""Writes the report of an evaluation as one HTML file that loads nothing from elsewhere."""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

from semnav_agents.evaluation import Result, Summary, common_causes
from semnav_env.judge import FAILURES, Verdict
from semnav_features.writing import write_file
from semnav_scripts.evaluation_tables import command_cells, headings, measure_cells
from semnav_scripts.outputs import counted
from semnav_scripts.report.gallery import chosen, drives_message

WORDS = ("command", "all episodes")
"""Headings of columns that hold words; the others hold numbers."""


def save_report(
    path: Path,
    who: Mapping[str, Any],
    summaries: Sequence[Summary],
    everything: Summary,
    results: Sequence[Result],
) -> None:
    """Write the report: the tables, and a gallery of failures.

    Args:
        path: the file.
        who: what every row of the results has: agent, split, robot, version and so on.
        summaries: one for each command or number of clauses.
        everything: summary of all episodes.
        results: all results; failures are shown whose drives were kept.
    """
    title, *further = headings(who, everything)
    shown = chosen(results)
    drives = [result.kept for result in shown if result.kept is not None]
    parts = {
        "title": escape(title),
        "icon": _data_address("image/svg+xml", _web("page", "icon.svg")),
        "style": _web("page", "look.css") + _web("report", "report.css"),
        "modules": _modules("camera.js", "drawing.js"),
        "headings": "\n".join(f"<p>{escape(line)}</p>" for line in further),
        "commands": _table(command_cells([*summaries, everything])),
        "measures": _table(measure_cells(everything)),
        "failures": _failures(results, shown),
        "data": _json(drives_message(drives)),
        "script": _web("report", "report.js"),
    }
    write_file(path, Template(_web("report", "report.html")).substitute(parts))


def _failures(results: Sequence[Result], shown: Sequence[Result]) -> str:
    """The section of what failed and why."""
    failed = sum(not result.success for result in results)
    if not failed:
        return '<section><h2>Failures</h2><p class="note">Nothing failed.</p></section>'
    causes = [("n", "cause"), *((str(n), cause) for cause, n in common_causes(results))]
    cards = "\n".join(_card(number, result) for number, result in enumerate(shown, start=1))
    few = "" if len(shown) == failed else f" {len(shown)} of them are shown, of each cause some."
    return _SECTION.substitute(
        failed=counted(failed, "failure"), few=few, causes=_table(causes), cards=cards
    )


_SECTION = Template("""<section aria-labelledby="failures">
<h2 id="failures">$failed</h2>
<p class="note">$few</p>
<div class="wide" tabindex="0" role="group" aria-label="Causes">
$causes
</div>
<ul id="legend" aria-label="Legend">
<li class="true" data-mark="┄">true route, numbered goals</li>
<li class="driven" data-mark="━">driven</li>
<li class="touched" data-mark="×">something was touched</li>
<li class="door" data-mark="━">doors that the robot remembered at the end</li>
<li class="aim" data-mark="★">where its agent was driving to</li>
</ul>
<div class="row"><label for="speed">Speed</label>
<select id="speed">
<option value="1">1 ×</option>
<option value="4" selected>4 ×</option>
<option value="16">16 ×</option>
</select></div>
<div id="gallery">
$cards
</div>
</section>""")


def _card(number: int, result: Result) -> str:
    """A failure: what was said, which clause failed, why, and its drive."""
    assert result.kept is not None
    name = escape(result.episode or f"{result.floor_plan}, seed {result.seed}")
    clauses = "\n".join(map(_clause, result.kept.clauses, result.verdicts))
    return f"""<article aria-labelledby="failure-{number}">
<h3 id="failure-{number}">{name}</h3>
<p class="said">“{escape(result.command)}”</p>
<ol class="clauses">
{clauses}
</ol>
<p class="cause">{escape(result.cause)}</p>
<canvas role="img" aria-label="Floor plan with the drive of {name}"></canvas>
<div class="row">
<button type="button" aria-describedby="failure-{number}">Play</button>
<input type="range" min="0" value="0" aria-label="Moment of {name}">
<output></output>
</div>
</article>"""


def _clause(words: str, verdict: str) -> str:
    """A clause with the mark of its verdict."""
    kind, mark = ("done", "✓") if verdict == Verdict.DONE else ("", "·")
    if verdict in FAILURES:
        kind, mark = "failed", "✗"
    said = f'<span>{escape(words)} <span class="verdict">{escape(verdict)}</span></span>'
    return f'<li class="{kind}" data-mark="{mark}">{said}</li>'


def _table(cells: Sequence[tuple[str, ...]]) -> str:
    """A table whose first row is its headings; a row that is named "all" stands out."""
    names, *rows = cells
    wordy = [name in (*WORDS, "cause") for name in names]
    head = _row("th", names, wordy, ' scope="col"')
    kinds = (' class="all"' if "all" in row else "" for row in rows)
    body = "\n".join(
        f"<tr{kind}>{_row('td', row, wordy)}</tr>" for kind, row in zip(kinds, rows, strict=True)
    )
    return f"<table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody>\n</table>"


def _row(tag: str, cells: Sequence[str], wordy: Sequence[bool], more: str = "") -> str:
    kinds = (' class="words"' if words else "" for words in wordy)
    return "".join(
        f"<{tag}{kind}{more}>{escape(cell)}</{tag}>"
        for cell, kind in zip(cells, kinds, strict=True)
    )


def _modules(*names: str) -> str:
    """An import map that holds modules of the page of `semnav serve` themselves."""
    addresses = {
        f"./{name}": _data_address("text/javascript", _web("page", name)) for name in names
    }
    return _json({"imports": addresses})


def _data_address(kind: str, text: str) -> str:
    """An address that holds a text itself."""
    return f"data:{kind};base64,{base64.b64encode(text.encode()).decode()}"


def _json(document: Any) -> str:
    """JSON that ends no element of a page, whatever it holds."""
    return json.dumps(document, separators=(",", ":")).replace("<", "\\u003c")


def _web(package: str, name: str) -> str:
    """A file that a browser reads, from the folder `web` of a package beside this module."""
    return (files("semnav_scripts") / package / "web" / name).read_text("utf-8")
