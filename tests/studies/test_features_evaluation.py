"""Measuring the extractor: the study, its tables, the command and the real logs."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from semnav_env.world.maps import bundled_names, load_floor_plan
from semnav_features import Door, ExtractorSettings, Scene, extract
from semnav_features.frames import to_parent
from studies.__main__ import STUDIES
from studies.doors.door_sightings import Gate
from studies.doors.openings import read_openings
from studies.doors.real_doors import (
    FREIBURG,
    FREIBURG_LABELS,
    Glimpse,
    count,
    look_through,
    passes,
    targets,
)
from studies.features.cases import draw_cases
from studies.features.metrics import score, segmentation_rates
from studies.features.real_logs import find_logs, is_finite, log_row
from studies.features.records import FeatureKind
from studies.features.study import DEFAULT_STRATEGY, Study, all_strategies
from studies.sheets import ResultSheet
from tests.support.command_line import run
from tests.support.evaluation_cases import WALL
from tests.support.paths import DATA

needs_data = pytest.mark.skipif(not (DATA / FREIBURG).exists(), reason="the real logs are not here")


def test_strategies_differ_from_the_default_in_one_choice_each():
    strategies = all_strategies()
    assert strategies[DEFAULT_STRATEGY] == ExtractorSettings()
    assert len(strategies) > 6
    assert len(set(strategies.values())) == len(strategies)


@pytest.mark.parametrize("seed", [0, 1])
def test_of_six_hundred_scans_of_the_villa_one_at_most_shows_a_door_that_is_none(seed):
    """Its hall is 1.10 m wide, so that its mouth has the width of a door."""
    plan, false = load_floor_plan("villa_hall"), 0
    for case in draw_cases(plan, 600, (0.02,), False, np.random.default_rng(seed)):
        [(_, scan)] = case.scans
        places = [to_parent(case.pose, door.midpoint) for door in extract(scan).doors]
        false += sum(min(math.dist(p, d.midpoint) for d in plan.doors) > 0.3 for p in places)
    assert false <= 1


def test_the_extractor_keeps_its_level_on_a_small_sample():
    """Far below what docs/lab/features_evaluation.md reports, so that only a break shows."""
    study = Study({DEFAULT_STRATEGY: extract})
    plans = [load_floor_plan(name) for name in bundled_names()]
    for _ in study.run(plans, 12, (0.02,), (False, True), seed=7):
        pass
    assert study.cases == 2 * 12 * len(plans)
    outcome = study.pooled()
    level = {
        FeatureKind.WALL: 0.95,
        FeatureKind.DOOR: 0.85,
        FeatureKind.FULL_CORNER: 0.9,
        FeatureKind.CORRIDOR: 0.75,
    }
    for kind, least in level.items():
        each = score(outcome.sightings, outcome.detections, kind)
        assert min(each.recall, each.precision) > least, kind
    assert segmentation_rates(outcome.sightings)[1] > 0.9


def test_a_table_is_the_same_for_people_and_programs():
    sheet = ResultSheet("Title", ("what", "share"), [("doors", 0.5), ("arcs", math.nan)])
    assert sheet.markdown().splitlines() == [
        *("## Title", "", "| what | share |", "| --- | --- |"),
        *("| doors | 0.500 |", "| arcs | - |"),
    ]
    assert sheet.records() == [{"what": "doors", "share": 0.5}, {"what": "arcs", "share": None}]


def test_the_command_writes_tables_and_figures(capsys, tmp_path):
    out = tmp_path / "new" / "study"
    words = ("--plans", "villa_hall", "--poses", 3, "--sigma", 0.02, "--out", out, "--json")
    code, text, _ = run(capsys, "features", *words, command=STUDIES.main)
    assert code == 0
    document = json.loads(text)
    assert document == json.loads((out / "features.json").read_text())
    assert document["asked"]["poses"] == 3
    assert document["tables"]["Strategies"][0]["strategy"] == DEFAULT_STRATEGY
    assert "## Found and missed" in (out / "features.md").read_text()
    pictures = sorted(out.glob("*.png"))
    assert len(pictures) == 5
    for picture in pictures:
        with Image.open(picture) as image:
            assert min(image.size) > 200


def test_the_command_prints_all_tables_only_on_request(capsys):
    words = ("features", "--plans", "villa_hall", "--poses", 2, "--sigma", 0.02)
    short, full = (
        run(capsys, *words, *more, command=STUDIES.main)[1] for more in ((), ("--full",))
    )
    assert len(short.splitlines()) < 15
    assert short.startswith("## Over all poses, sigma 20 mm\n")
    assert short.endswith("--full, or --out for a page with figures\n")
    assert full.count("\n## ") == 6


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (("--poses", "-1"), "poses is -1"),
        (("--poses", "0"), "nothing to measure"),
        (("--sigma", "20"), "give metres"),
        (("--strategies", "magic"), "no strategy 'magic'; there are: all, default"),
        (("--plans", "nowhere"), "no floor plan named 'nowhere'"),
        (("--every", "0"), "every is 0"),
        (("--poses", "0", "--data", "nowhere"), "no carmen"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_two(capsys, words, complaint):
    code, out, err = run(capsys, "features", *words, command=STUDIES.main)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert complaint in err


def test_a_scene_with_nan_is_noticed():
    assert is_finite(Scene(walls=(WALL,), doors=(Door((1.0, 0.0), (2.0, 0.0)),)))
    assert not is_finite(Scene(doors=(Door((math.nan, 0.0), (2.0, 0.0)),)))
    assert not is_finite(Scene(walls=(replace(WALL, residual=math.inf),)))


@needs_data
def test_the_real_log_shows_the_noted_doors():
    """Every eighth scan is compared with notes that were made by hand."""
    target = targets(read_openings(FREIBURG_LABELS))[1]
    glimpses = list(look_through(DATA / FREIBURG, ExtractorSettings(), every=8))
    counts = count(glimpses, target, Gate(), memory=False)
    assert (counts.seen, counts.gated) == (93, 79)
    assert counts.gated_found <= counts.gated
    all_passes, found = passes(glimpses, target, Gate())
    assert 0 < found <= all_passes


@needs_data
def test_a_short_memory_keeps_what_two_scans_saw():
    glimpses = [
        g
        for g, _ in zip(look_through(DATA / FREIBURG, ExtractorSettings()), range(40), strict=False)
    ]
    assert all(isinstance(glimpse, Glimpse) for glimpse in glimpses)
    assert any(glimpse.remembered for glimpse in glimpses)


@needs_data
@pytest.mark.parametrize("log", ["aces", "csail", "fhw", "freiburg-101"])
def test_real_logs_give_finite_scenes(log):
    (path,) = (p for p in find_logs(DATA) if p.name.startswith(log))
    _, scans, _, broken, *_ = log_row(path, ExtractorSettings())
    assert scans > 0
    assert broken == 0
