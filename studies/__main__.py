"""`python -m studies`: measures, and trains the scorer of doors."""

from __future__ import annotations

from semnav_scripts.dispatch import CommandTable

STUDIES = CommandTable(
    "python -m studies",
    "Measurements of the package; `python -m studies.figures --help` lists the pictures.",
    {
        "answers": ("studies.answers.command", "what right answers on real floors depend on"),
        "assistance": ("studies.assistance.command", "drivers with shared control and without it"),
        "buildings": ("studies.buildings.command", "doors in scans of real floors"),
        "clouds": ("studies.clouds.command", "door jambs in point clouds, after Mes 2021"),
        "drift": ("studies.drift.command", "success against drift of odometry"),
        "exits": ("studies.exits.command", "how often robots get out through a named door"),
        "features": ("studies.features.command", "the feature extractor against truth"),
        "finding": (
            "studies.finding.command",
            "ways of finding somebody: look, or call",
        ),
        "frames": ("studies.theses.frames_command", "doors of Barbret's hallway in his frame 536"),
        "grids": ("studies.grids", "kernels on grids beside those of SciPy"),
        "landmarks": (
            "studies.landmarks.command",
            "corners and columns fused over scans, and drift corrected by them",
        ),
        "latency": ("studies.latency.command", "how soon the node of a robot answers a scan"),
        "learning": (
            "studies.learning.command",
            "five ways of learning from words and memory, by steps",
        ),
        "lines": ("studies.lines.command", "lines on real scans, walls on simulated ones"),
        "manner": ("studies.manner.command", "success at each pace and along each wall"),
        "matching": ("studies.matching.command", "how exactly scans are matched"),
        "offices": ("studies.offices", "check generated offices, and time them"),
        "page": ("studies.page.command", "how soon the page of `semnav serve` moves its robot"),
        "page_memory": ("studies.page.memory", "memory of `semnav serve` over an hour"),
        "places": ("studies.places.command", "corridors told from other places"),
        "ray_cost": ("studies.ray_cost", "what a training on Ray costs"),
        "limits": ("studies.translating.limits", "show when it is best to act, to ask, to refuse"),
        "refine": ("studies.translating.refining", "let the translator learn from new authors"),
        "said": ("studies.said.command", "commands to find people in people's words"),
        "search": ("studies.search.command", "houses searched with their plan and without"),
        "segmentation": ("studies.segmentation.command", "how walls are cut into pieces"),
        "speech": ("studies.speech.command", "the speech parser, with fillers and without commas"),
        "theses": ("studies.theses.command", "the table of every item of the four documents"),
        "tour": ("studies.tour.command", "ten rooms with drift, with each correction"),
        "train_doors": ("studies.door_scorer.train_doors", "train the scorer of doors"),
        "translator": ("studies.translating.command", "train the translator"),
        "unsaid": ("studies.unsaid.command", "what implicit steps are good for"),
        "voices": ("studies.voices.command", "somebody in another room found by voice"),
        "wordless": ("studies.wordless.command", "the listener without its words: a learned floor"),
    },
)

if __name__ == "__main__":
    raise SystemExit(STUDIES.main())
