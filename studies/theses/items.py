"""Every item of the four documents that can be compared, with what is measured here."""

from __future__ import annotations

from dataclasses import dataclass

from studies.theses.lab_tables import Figure

BARBRET, WEERAKOON, YAN, MES = "Barbret 2021", "Weerakoon et al.", "Yan et al.", "Mes 2021"

BY_EYE = "by eye, no figure"
"""What a document says of something that it judged by looking at pictures."""


@dataclass(frozen=True)
class ThesisItem:
    """A row of the table.

    Attributes:
        document: where it stands.
        section: section, table, figure or formula there.
        what: is compared.
        theirs: their figure.
        ours: this project's, in words with a place for each of `figures`, as "{} of doors".
        figures: cells of the documentation's tables.
        command: prints them, or shows the thing.
    """

    document: str
    section: str
    what: str
    theirs: str
    ours: str
    command: str
    figures: tuple[Figure, ...] = ()

    def row(self) -> tuple[str, str, str, str, str]:
        """Section, what, theirs, ours and command, as a line of the table has them."""
        ours = self.ours.format(*[figure.read() for figure in self.figures])
        return self.section, self.what, self.theirs, ours, f"`{self.command}`"


def _barbret(feature: str, section: str) -> ThesisItem:
    cells = [
        Figure("lab/features.md", (chain, feature), column)
        for chain in ("thesis", "here")
        for column in ("recall", "precision")
    ]
    return ThesisItem(
        BARBRET,
        section,
        f"{feature}: recall, precision",
        f"{BY_EYE}; its chain measured here: {cells[0].read()}, {cells[1].read()}",
        "{}, {}",
        "python -m studies features --poses 100 --sigma 0.02 --strategies barbret",
        (cells[2], cells[3]),
    )


def _frames(depth: str) -> ThesisItem:
    return ThesisItem(
        BARBRET,
        "figure 5.4",
        f"three open doors in frame 536, simulated, jambs {depth} deep: all three found",
        "2 of 3 in the real frame",
        "{} of the scans from there, {} from around",
        "python -m studies frames",
        tuple(
            [
                Figure("lab/features.md", (depth, place), "all three")
                for place in ("there", "around")
            ]
        ),
    )


def _clouds(category: str, theirs: str) -> ThesisItem:
    return ThesisItem(
        MES,
        "table 8.2",
        f"doors found in clouds of category {category}",
        theirs,
        "{}, with the 2D lidar {}; her pipeline on the same clouds, cropped by hand: {}, and "
        "thinned to 1 cm: {}",
        "python -m studies clouds",
        tuple(
            [
                Figure("lab/point_clouds.md", (name,), category)
                for name in (
                    "DoorFinder",
                    "DoorFinder and 2D lidar",
                    "Mes 2021, crop by hand",
                    "Mes 2021, crop by hand, cloud thinned to 1 cm",
                )
            ]
        ),
    )


def _segmentation(rule: str, theirs: str) -> ThesisItem:
    return ThesisItem(
        WEERAKOON,
        "formula (11)",
        f"segmentation rate with {rule}, percent",
        theirs,
        "{} at 10 mm, {} at 20 mm of noise",
        "python -m studies segmentation",
        tuple([Figure("lab/lines.md", (rule,), noise) for noise in ("10 mm", "20 mm")]),
    )


def _columns(diameter: str, distance: str) -> ThesisItem:
    cell = "found", "radius error, median"
    return ThesisItem(
        YAN,
        "section 2",
        f"round columns of {diameter} at {distance}: found, error of the radius",
        BY_EYE,
        "{}, {}",
        "python -m studies.figures arcs",
        tuple([Figure("lab/features.md", (diameter, distance), column) for column in cell]),
    )


ITEMS = (
    _barbret("walls", "4.4, 4.5"),
    _barbret("doors", "4.6"),
    _barbret("full corners", "3.2, 4.7"),
    _barbret("potential corners", "3.2.1"),
    _barbret("corridors", "3.3, 4.8"),
    _frames("0.10 m"),
    _frames("0.16 m"),
    _frames("0.25 m"),
    ThesisItem(
        BARBRET,
        "6.2.1",
        "walls are extended to a common corner",
        "wished for",
        "`corner_gap`; median error {} m at 20 mm of noise",
        "python -m studies features --full",
        (Figure("lab/features_evaluation.md", ("20", "full corners"), "place, m: median"),),
    ),
    ThesisItem(
        BARBRET,
        "6.2.2",
        "features are remembered from scan to scan: doors of the last five scans, real log",
        "wished for",
        "recall {}, precision {}",
        "python -m studies features --poses 0 --data DATA --every 2",
        tuple(
            [
                Figure("lab/features.md", ("all certain", "last 5 scans"), column)
                for column in ("recall", "precision")
            ]
        ),
    ),
    ThesisItem(
        BARBRET,
        "6.2.3",
        "a labelled reference: doors of freiburg-079 in single scans",
        "wished for",
        "recall {}, precision {}",
        "python -m studies features --poses 0 --data DATA --every 2",
        tuple(
            [
                Figure("lab/features.md", ("all certain", "single scans"), column)
                for column in ("recall", "precision")
            ]
        ),
    ),
    ThesisItem(
        BARBRET,
        "6.2.3",
        "features are added to a map: certain doors of freiburg-079 in it",
        "wished for",
        "{} of {}",
        "python -m studies features --poses 0 --data DATA",
        tuple(
            [
                Figure("lab/mapping.md", ("all certain",), column)
                for column in ("in the map (both jambs within 25 cm)", "number")
            ]
        ),
    ),
    ThesisItem(
        BARBRET,
        "1.1, 6.3",
        "commands are carried out: success / without contact, unknown offices",
        "wished for",
        "{}",
        "semnav evaluate val_unseen --agent scripted --episodes 600",
        (Figure("guides/agents.md", ("`scripted`",), "`val_unseen`"),),
    ),
    ThesisItem(
        BARBRET,
        "6.3",
        "driving habits at open doors: median angle in a real log, degrees",
        "wished for",
        "{} in {} passages",
        "semnav habits freiburg-079-corrected.log.gz",
        tuple(
            [Figure("guides/habits.md", ("log freiburg-079",), c) for c in ("angle", "passages")]
        ),
    ),
    ThesisItem(
        BARBRET,
        "6.3",
        "inputs that lead into a door's parts are overridden: contacts of a clumsy hand a command",
        "wished for",
        "{}; {} without",
        "python -m studies assistance",
        tuple(
            [
                Figure("guides/play.md", ("wheelchair, scripted, clumsy", assistance), "contacts")
                for assistance in ("and doors", "none")
            ]
        ),
    ),
    _segmentation("(12) Weerakoon et al., 4 degrees", "92.4"),
    _segmentation("(6) Certad et al., 4 degrees: the default", "82.7"),
    ThesisItem(
        WEERAKOON,
        "table I",
        "corners of one scan: error in percent of the range",
        "0.22 to 1.57 (their points; their column has other units)",
        "median {}, 90th percentile {}",
        "python -m studies features --full",
        tuple(
            [
                Figure("lab/features_evaluation.md", ("20", "full corners"), column)
                for column in ("place, % of range: median", "place, % of range: 90 %")
            ]
        ),
    ),
    ThesisItem(
        WEERAKOON,
        "table II",
        "ten corner landmarks fused over three scans, 20 mm of noise: error, claimed, mm",
        "no error given; two scans of one corner are 42 to 260 mm apart",
        "{}, {}; mean NEES {} of 2; {} by the paper's own equations",
        "python -m studies landmarks --tables corners",
        tuple(
            [
                Figure("lab/landmarks.md", ("all, 20 mm",), column)
                for column in (
                    "error, mm",
                    "claimed, mm",
                    "NEES of 2",
                    "the paper's way: error, mm",
                )
            ]
        ),
    ),
    ThesisItem(
        WEERAKOON,
        "IV",
        "landmarks enhance the localization: real scans, drift over 10 m by walls, and with them",
        "wished for",
        "{}, {}",
        "python -m studies landmarks --tables drift --data DATA",
        tuple(
            [
                Figure(
                    "lab/landmarks.md",
                    ("freiburg-079", "simulated", correction),
                    "drift per 10 m, median",
                )
                for correction in ("walls", "walls and landmarks")
            ]
        ),
    ),
    ThesisItem(
        WEERAKOON,
        "figure 11",
        "segments before and after merging of three scans",
        "15, then 9",
        "{}, then {} in a corridor of that kind, mean of 100 trials",
        "python -m studies landmarks --tables corners",
        tuple([Figure("lab/landmarks.md", ("20 mm, figure 11",), c) for c in ("before", "after")]),
    ),
    _columns("0.3 m", "1 to 2 m"),
    _columns("0.4 m", "3 to 4 m"),
    _columns("1.0 m", "3 to 4 m"),
    ThesisItem(
        YAN,
        "section 3",
        "arcs of a column of 0.6 m merged over six scans, 20 mm: error of centre, of radius, mm",
        BY_EYE,
        "{}, {}; {}, {} by a new fit to all points",
        "python -m studies landmarks --tables columns",
        tuple(
            [
                Figure("lab/landmarks.md", ("0.6 m", "20 mm", "6"), column)
                for column in (
                    "fused: centre",
                    "fused: radius",
                    "refitted: centre",
                    "its radius",
                )
            ]
        ),
    ),
    *[
        ThesisItem(
            MES,
            "table 7.1",
            f"poses at the door {door}: evaluated, clear of walls, safe",
            theirs,
            "{}, {}, {}",
            "python -m studies.figures approach",
            tuple(
                [
                    Figure("lab/approach.md", (door,), column)
                    for column in ("evaluated", "clear of walls", "safe")
                ]
            ),
        )
        for door, theirs in (
            ("parents", "25, 5, 3"),
            ("living", "25, 15, 8"),
            ("kitchen", "25, 15, 9"),
            ("daughter", "25, 25, 14"),
        )
    ],
    ThesisItem(
        MES,
        "table 7.2",
        "top ten poses of each door: area errors and order",
        "35 poses",
        "the same up to ties and two misprints",
        "python -m studies.figures approach",
    ),
    _clouds("A", "3 of 3"),
    _clouds("B", "3 of 4"),
    _clouds("C", "1 of 2"),
    _clouds("D", "0 of 3"),
    ThesisItem(
        MES,
        "8.5",
        "single jambs found in all clouds",
        "0.708 (17 of 24)",
        "{}, with the 2D lidar {}",
        "python -m studies clouds",
        tuple(
            [
                Figure("lab/point_clouds.md", (name,), "found")
                for name in ("DoorFinder", "DoorFinder and 2D lidar")
            ]
        ),
    ),
    ThesisItem(
        MES,
        "2.2, 9.3",
        "drift corrected by doors: ten rooms visited, error at the end (mean, largest)",
        "not measured",
        "{} of the tours, {}; with her detector {}, {}",
        "python -m studies tour",
        tuple(
            [
                Figure("lab/drift.md", ("1", correction), column)
                for correction in (
                    "doors of the 2D lidar, and walls",
                    "doors in SPOT's clouds (`MesDetector`)",
                )
                for column in ("all ten rooms", "error at the end")
            ]
        ),
    ),
    ThesisItem(
        MES,
        "chapter 1",
        "a room is left by a door: SPOT passes, of 2,000 cases",
        "no figure",
        "{}",
        "python -m studies exits",
        (Figure("lab/approach.md", ("`ExitViaDoor`", "all 2,000"), "SPOT passes"),),
    ),
    ThesisItem(
        MES,
        "chapter 1",
        "houses are searched: victims found, rooms covered",
        "no figure",
        "{}; {}; by a wheelchair {}; {}",
        "python -m studies search --agents searcher",
        tuple(
            [
                Figure("lab/search_and_rescue.md", (body,), column)
                for body in ("SPOT", "wheelchair")
                for column in ("victims", "rooms covered by 95 %")
            ]
        ),
    ),
    *[
        ThesisItem(
            MES,
            "chapter 1",
            f"{what}: people found, median error of the place in m, time in s",
            "no figure",
            "{}, {}, {}",
            "python -m studies finding --houses 100",
            tuple(
                [
                    Figure("lab/search_and_rescue.md", (way,), column)
                    for column in (
                        "people found within 1 m",
                        "error of the place, m: median",
                        "time, s: median",
                    )
                ]
            ),
        )
        for what, way in (
            ("a room is scanned from one place", "turn on the spot and look"),
            ("a room is scanned from several places", "look from several places"),
            ("calling, as with SPOT's one microphone", "call, one microphone"),
            ("calling, with a microphone array", "call and listen"),
            ("a person who was heard is approached", "call, listen and approach"),
        )
    ],
    *[
        ThesisItem(
            MES,
            "7.1",
            f"doors, turns, rooms and exits of her hall, {robot}: success / without contact",
            "no figure",
            "{}",
            f"semnav evaluate villa --robot {robot.lower()} --seeds 10",
            (Figure("guides/evaluation.md", (f"scripted, {robot}", "400 episodes"), "all four"),),
        )
        for robot in ("wheelchair", "SPOT")
    ],
    ThesisItem(
        MES,
        "chapter 1",
        "somebody in another room who answers: heard, met, error of the place by voice alone in m",
        "no figure",
        "{}, {} met; {} (median)",
        "python -m studies voices --houses 12",
        tuple(
            [
                Figure("lab/search_and_rescue.md", (eyes,), column)
                for eyes, column in (
                    ("with the camera", "heard"),
                    ("with the camera", "met"),
                    ("by voice alone", "error, m, median"),
                )
            ]
        ),
    ),
    ThesisItem(
        MES,
        "chapter 6",
        "six actions as told, asking for the name among them: commands in people's words, "
        "understood, asked about rightly, misread",
        "no figure",
        "{}, {}, {} of {} in English; {}, {}, {} of {} in German",
        "python -m studies said",
        tuple(
            [
                Figure("lab/search_and_rescue.md", (language,), column)
                for language in ("English", "German")
                for column in ("understood", "asked", "misread", "n")
            ]
        ),
    ),
    *[
        ThesisItem(
            MES,
            "chapter 8",
            f"shut doors of {kind} in clouds, from the poses of A and B: both jambs found",
            "no figure",
            "{}, with the 2D lidar {}",
            "python -m studies clouds --shut --scenes 20",
            tuple(
                [
                    Figure("lab/point_clouds.md", (name,), kind)
                    for name in ("DoorFinder", "DoorFinder and 2D lidar")
                ]
            ),
        )
        for kind in ("glass", "wood")
    ],
)
"""All of them, in the order of the documents."""
