"""Measuring the extractor: comparison with truth, scores, tables and the command."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image
from shapely import LineString, Point

from semnav_env.evaluation.cases import draw_cases
from semnav_env.evaluation.clutter import cluttered
from semnav_env.evaluation.comparison import compare, compare_doors
from semnav_env.evaluation.door_sightings import Gate
from semnav_env.evaluation.metrics import calibration, calibration_error, score, segmentation_rates
from semnav_env.evaluation.openings import read_openings
from semnav_env.evaluation.overlap import Overlap, segmentation_rate
from semnav_env.evaluation.real_doors import (
    FREIBURG,
    FREIBURG_LABELS,
    Glimpse,
    count,
    look_through,
    passes,
    targets,
)
from semnav_env.evaluation.real_logs import find_logs, is_finite, log_row
from semnav_env.evaluation.records import Detection, Kind, Limits, Sighting, as_table
from semnav_env.evaluation.sheets import Sheet
from semnav_env.evaluation.study import DEFAULT, Study, all_strategies
from semnav_env.features import (
    Arc,
    Corner,
    CornerKind,
    Corridor,
    Door,
    ExtractorSettings,
    Scene,
    Wall,
)
from semnav_env.maps import Material, bundled_names, load_floor_plan
from semnav_env.scripts import main as cli
from semnav_env.truth import TrueView
from semnav_env.truth.shapes import fit_circle
from tests.small_plans import empty_hall

DATA = Path(__file__).resolve().parents[2] / "shared" / "data"
needs_data = pytest.mark.skipif(not (DATA / FREIBURG).exists(), reason="the real logs are not here")
OFFICE = load_floor_plan("office_cross")


def cases(plan=OFFICE, poses=6, sigmas=(0.0, 0.02), clutter=True, seed=1):
    return list(draw_cases(plan, poses, sigmas, clutter, np.random.default_rng(seed)))


def tables(scan, truth, found):
    sightings, detections = compare(scan, truth, found, Limits())
    return as_table(sightings, Sighting), as_table(detections, Detection)


def test_a_case_is_drawn_the_same_from_the_same_seed():
    first, second = cases(), cases()
    assert [case.pose for case in first] == [case.pose for case in second]
    assert all(
        np.array_equal(a[1].ranges, b[1].ranges)
        for one, other in zip(first, second, strict=True)
        for a, b in zip(one.scans, other.scans, strict=True)
    )


def test_noise_is_of_the_stated_size_and_a_clean_scan_is_the_truth():
    for case in cases(clutter=False):
        (_, clean), (_, noisy) = case.scans
        both = clean.valid & noisy.valid & (clean.ranges < 9.5)
        exact = TrueView(OFFICE).scan(case.pose)
        assert np.array_equal(clean.ranges[both], exact.ranges[both])
        assert np.std(noisy.ranges[both] - clean.ranges[both]) == pytest.approx(0.02, rel=0.25)


@pytest.mark.parametrize("name", bundled_names())
def test_half_of_the_poses_are_in_corridors(name):
    plan = load_floor_plan(name)
    inside = [
        any(r.polygon.covers(Point(case.pose[:2])) for r in (*plan.corridors, *plan.intersections))
        for case in cases(plan, 6, (0.0,), clutter=False)
        if case.situation.place == "corridor"
    ]
    assert inside == [True] * 3


def test_a_plan_that_names_no_rooms_is_floor_all_over():
    for case in cases(empty_hall(), 4, (0.0,), clutter=False):
        assert 0.35 <= case.pose[0] <= 9.65
        assert 0.35 <= case.pose[1] <= 5.65


def test_clutter_stands_free_and_is_partly_round():
    filled = cluttered(OFFICE, np.random.default_rng(0))
    added = filled.surfaces[len(OFFICE.surfaces) :]
    assert len(added) > 10
    assert {surface.material for surface in added} == {Material.FURNITURE}
    assert 0 < sum(fit_circle(surface) is not None for surface in added) < len(added)
    for surface in added:
        assert not len(OFFICE.solids.query(LineString(surface.points), "intersects"))


@given(st.integers(0, 1000))
@settings(max_examples=10, deadline=None)
def test_the_truth_itself_scores_one(seed):
    (case,) = cases(poses=1, sigmas=(0.0,), seed=seed)
    sightings, detections = tables(case.scans[0][1], case.truth, case.truth)
    assert sightings["found"].all()
    assert detections["right"].all()
    errors = np.stack([sightings[name] for name in ("angle", "place", "size")])
    assert np.nanmax(errors, initial=0.0) < 1e-9
    walls = len(sightings[sightings["kind"] == Kind.WALL])
    assert walls == 0 or segmentation_rates(sightings) == pytest.approx((1.0, 1.0))


def test_nothing_found_is_recall_zero_and_no_precision():
    case = cases(poses=1)[0]
    sightings, detections = tables(case.scans[0][1], case.truth, Scene())
    each = score(sightings, detections, Kind.WALL)
    assert each.recall == 0.0
    assert math.isnan(each.precision)
    assert segmentation_rates(sightings) == (0.0, 0.0)


WALL = Wall((0.0, -1.0), (4.0, -1.0), beams=100)


def test_pieces_cover_a_wall_together_and_the_longest_alone():
    parts = [Wall((0.0, -1.0), (1.5, -1.0)), Wall((1.0, -1.02), (3.0, -1.02))]
    overlap = Overlap([WALL], parts)
    assert overlap.covered == pytest.approx([3.0])
    assert overlap.longest == pytest.approx([2.0])
    assert overlap.best(0) == 1
    assert segmentation_rate(overlap.lengths, overlap.longest) == pytest.approx(0.5)


@pytest.mark.parametrize(
    "other",
    [
        Wall((0.0, -1.2), (4.0, -1.2)),
        Wall((4.0, -1.0), (0.0, -1.0)),
        Wall((0.0, -1.0), (3.0, -0.3)),
        Wall((4.5, -1.0), (6.0, -1.0)),
    ],
    ids=["aside", "from behind", "askew", "farther on"],
)
def test_another_wall_covers_nothing(other):
    assert Overlap([WALL], [other]).covered == pytest.approx([0.0])


def test_a_corner_is_found_once_and_its_type_is_told_apart():
    corner = Corner((2.0, 0.0), CornerKind.INNER)
    truth = Scene(corners=(corner,))
    found = Scene(
        corners=(Corner((2.1, 0.0), CornerKind.OUTER), Corner((2.0, 0.05), CornerKind.INNER))
    )
    sightings, detections = tables(cases(poses=1)[0].scans[0][1], truth, found)
    each = score(sightings, detections, Kind.FULL_CORNER)
    assert (each.recall, each.precision, each.type_right) == (1.0, 0.5, 1.0)
    assert each.place[0] == pytest.approx(0.05)
    assert each.place_share[0] == pytest.approx(0.025)
    potential = Scene(corners=(Corner((2.0, 0.0), CornerKind.POTENTIAL),))
    sightings, detections = tables(cases(poses=1)[0].scans[0][1], truth, potential)
    assert not sightings["found"].any()
    assert not detections["right"].any()


def test_an_arc_is_found_by_its_centre():
    arc = Arc((2.0, 0.0), 0.4, (2.0, 0.4), (2.0, -0.4), beams=30)
    near = replace(arc, centre=(2.0, 0.1), radius=0.42)
    sightings, detections = tables(
        cases(poses=1)[0].scans[0][1], Scene(arcs=(arc,)), Scene(arcs=(near,))
    )
    each = score(sightings, detections, Kind.ARC)
    assert (each.gated, each.recall, each.precision) == (1, 1.0, 1.0)
    assert each.size[0] == pytest.approx(0.05)
    assert each.place[0] == pytest.approx(0.1)


def test_corridors_are_found_by_their_midpoints():
    corridor = Corridor((2.0, -1.0), (2.0, 1.0))
    found = (Corridor((2.1, 1.0), (2.1, -1.0)), Corridor((3.0, 1.0), (3.0, -1.0)))
    sightings, detections = tables(
        cases(poses=1)[0].scans[0][1], Scene(corridors=(corridor,)), Scene(corridors=found)
    )
    each = score(sightings, detections, Kind.CORRIDOR)
    assert (each.recall, each.precision) == (1.0, 0.5)


def test_a_door_in_poor_view_is_no_demand_but_right_if_found():
    for case in cases(poses=40, clutter=False):
        scan = case.scans[0][1]
        sightings, detections = compare_doors(scan, case.truth.doors, case.truth.doors, Limits())
        poor = [s for s in sightings if not s.gated]
        if poor:
            assert all(s.found for s in poor)
            assert all(d.right for d in detections)
            return
    pytest.fail("no door was in poor view")


def test_confidences_that_hold_have_no_calibration_error():
    rows = [Detection(Kind.DOOR, 1.0, 0.0, k < 7, 0.7) for k in range(10)]
    bins = calibration(as_table(rows, Detection))
    assert [(b.detections, b.confidence, b.precision) for b in bins] == [
        (10, pytest.approx(0.7), pytest.approx(0.7))
    ]
    assert calibration_error(bins) == pytest.approx(0.0)
    assert math.isnan(calibration_error([]))


def test_strategies_differ_from_the_default_in_one_choice_each():
    strategies = all_strategies()
    assert strategies[DEFAULT] == ExtractorSettings()
    assert len(strategies) > 6
    assert len(set(strategies.values())) == len(strategies)


def test_the_extractor_keeps_its_level_on_a_small_sample():
    """Far below what docs/features_evaluation.md reports, so that only a break shows."""
    study = Study({DEFAULT: ExtractorSettings()})
    plans = [load_floor_plan(name) for name in bundled_names()]
    for _ in study.run(plans, 12, (0.02,), (False, True), seed=7):
        pass
    assert study.cases == 2 * 12 * len(plans)
    outcome = study.pooled()
    level = {Kind.WALL: 0.95, Kind.DOOR: 0.85, Kind.FULL_CORNER: 0.9, Kind.CORRIDOR: 0.75}
    for kind, least in level.items():
        each = score(outcome.sightings, outcome.detections, kind)
        assert min(each.recall, each.precision) > least, kind
    assert segmentation_rates(outcome.sightings)[1] > 0.9


def test_a_table_is_the_same_for_people_and_programs():
    sheet = Sheet("Title", ("what", "share"), [("doors", 0.5), ("arcs", math.nan)])
    assert sheet.markdown().splitlines() == [
        *("## Title", "", "| what | share |", "| --- | --- |"),
        *("| doors | 0.500 |", "| arcs | - |"),
    ]
    assert sheet.records() == [{"what": "doors", "share": 0.5}, {"what": "arcs", "share": None}]


def run(capsys, *words):
    code = cli.main([str(word) for word in words])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def test_the_command_writes_tables_and_figures(capsys, tmp_path):
    out = tmp_path / "new" / "study"
    words = ("--plans", "villa_hall", "--poses", 3, "--sigma", 0.02, "--out", out, "--json")
    code, text, _ = run(capsys, "evaluate", "features", *words)
    assert code == 0
    document = json.loads(text)
    assert document == json.loads((out / "features.json").read_text())
    assert document["asked"]["poses"] == 3
    assert document["tables"]["Strategies"][0]["strategy"] == DEFAULT
    assert "## Found and missed" in (out / "features.md").read_text()
    pictures = sorted(out.glob("*.png"))
    assert len(pictures) == 5
    for picture in pictures:
        with Image.open(picture) as image:
            assert min(image.size) > 200


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
    code, out, err = run(capsys, "evaluate", "features", *words)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert complaint in err


def test_other_suites_are_still_reached(capsys):
    code, _, err = run(capsys, "evaluate", "nonsense")
    assert code == 2
    assert "nonsense" in err


def test_a_scene_with_a_number_that_is_none_is_noticed():
    assert is_finite(Scene(walls=(WALL,), doors=(Door((1.0, 0.0), (2.0, 0.0)),)))
    assert not is_finite(Scene(doors=(Door((math.nan, 0.0), (2.0, 0.0)),)))
    assert not is_finite(Scene(walls=(replace(WALL, residual=math.inf),)))


@needs_data
def test_every_eighth_scan_of_the_real_log_shows_the_doors_that_the_notes_count():
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
