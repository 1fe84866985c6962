import json

import pytest
from PIL import Image

from semnav_env.judge.routes.describe import describe
from semnav_env.judge.routes.route import RouteError
from semnav_env.judge.routes.route_to import route_to
from semnav_env.world.maps import load_floor_plan
from semnav_scripts import main as cli
from semnav_scripts.outputs import check_file, check_folder, counted
from tests.support.drawn_maps import DOORS, two_rooms, write_map


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "afile").write_text("kept")
    (tmp_path / "folder").mkdir()
    return tmp_path


def refusal(capsys, *words):
    code = cli.main([str(word) for word in words])
    out, err = capsys.readouterr()
    assert (code, out, err.count("\n")) == (2, "", 1)
    return err.removeprefix("semnav: ").strip()


DEMO = ("demo", "turn around")
EVALUATE = ("evaluate", "heidelberg", "--seeds", "1")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((*DEMO, "--save", "afile/x.gif"), "--save: 'afile' is a file, not a folder"),
        ((*DEMO, "--picture", "afile/x.png"), "--picture: 'afile' is a file, not a folder"),
        ((*EVALUATE, "--out", "folder"), "--out: 'folder' is a folder; give a file"),
        ((*EVALUATE, "--out", "afile/a/b.jsonl"), "--out: 'afile' is a file, not a folder"),
        ((*EVALUATE, "--pictures", "afile"), "--pictures: 'afile' is a file, not a folder"),
        (("extract", "a.log", "--out", "folder"), "--out: 'folder' is a folder; give a file"),
        (("extract", "a.log", "--plot", "afile/x.png"), "--plot: 'afile' is a file"),
        (("map", "build", "a.log", "--out", "folder"), "--out: 'folder' is a folder; give a file"),
        (("map", "show", "villa_hall", "--out", "afile/x.png"), "'afile' is a file, not a folder"),
    ],
)
def test_unwritable_paths_are_refused_before_the_work(capsys, monkeypatch, here, words, message):
    for name in ("evaluate.run_suite", "demo.SemNavEnv", "extract.open_log", "map_build.open_log"):
        monkeypatch.delattr(f"semnav_scripts.{name}")
    assert message in refusal(capsys, *words)
    assert (here / "afile").read_text() == "kept"


def test_folders_that_are_missing_can_be_made(here):
    check_file(None, "--out")
    check_file(here / "new" / "and" / "newer.jsonl", "--out")
    check_file(here / "afile", "--out")
    check_folder(here / "new" / "one", "--pictures")
    check_folder(here / "folder", "--pictures")
    assert sorted(path.name for path in here.iterdir()) == ["afile", "folder"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (
            ("extract", "a.log", "--out", "a.png", "--plot", "a.png"),
            "--plot: 'a.png' is --out, too",
        ),
        (("extract", "a.png", "--plot", "a.png"), "--plot: 'a.png' is the log, too"),
        (
            ("map", "build", "a.log", "--out", "a.svg", "--picture", "folder/../a.svg"),
            "--picture: 'folder/../a.svg' is --out, too; give another file",
        ),
        (
            ("map", "import", "floor.yaml", "--out", "a.svg", "--picture", "a.svg"),
            "--picture: 'a.svg' is --out, too",
        ),
        (
            ("map", "import", "floor.yaml", "--out", "a.geojson", "--picture", "floor.png"),
            "--picture: 'floor.png' is the map, too",
        ),
        (
            ("map", "import", "floor.yaml", "--out", "doors.yaml"),
            "--out: 'doors.yaml' is the map, too",
        ),
    ],
)
def test_no_file_is_written_that_is_read_or_written_already(capsys, here, words, message):
    """The picture replaced the scenes of a log, and the image of an occupancy map."""
    path = write_map(here, two_rooms())
    path.write_text(path.read_text().replace("floor.pgm", "floor.png"))
    (here / "doors.yaml").write_text(DOORS)
    Image.open(here / "floor.pgm").save(here / "floor.png")
    before = {file: file.read_bytes() for file in here.iterdir() if file.is_file()}
    assert message in refusal(capsys, *words)
    assert before == {file: file.read_bytes() for file in here.iterdir() if file.is_file()}


def test_one_thing_is_singular():
    assert [counted(n, "door") for n in (0, 1, 2)] == ["0 doors", "1 door", "2 doors"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("ground", "", "--pose", "0,0,0"), "the command is empty"),
        (("evaluate", ""), "no suite ''"),
        (("describe", "--from=-2.5,-0.3,0.24", "--to", "south_1", "--seed=-1"), "--seed is -1"),
        (
            ("describe", "--from=-2.5,-0.3,0.24", "--to", "south_1", "--paraphrases=-1"),
            "--paraphrases is -1; it must be 0 or more",
        ),
        (
            ("describe", "--from=-2.5,-0.3,0.24", "--to", "100,100"),
            "(100, 100) is outside heidelberg_hallway, which spans x",
        ),
    ],
)
def test_a_refusal_names_what_is_wrong(capsys, words, message):
    assert message in refusal(capsys, *words)


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        (("evaluate", "val_unsen"), "val_unseen"),
        (("evaluate", "heidleberg"), "heidelberg"),
        (("demonstrate", "trian", "--out", "x"), "train"),
        (("episodes", "check", "test_lng"), "test_long"),
        (("episodes", "generate", "val_sen"), "val_seen"),
        (("describe", "--from=-2.5,-0.3,0.24", "--to", "suoth_1"), "south_1"),
    ],
)
def test_an_unknown_split_suite_or_place_names_the_nearest_one(capsys, words, meant):
    assert refusal(capsys, *words).endswith(f"; did you mean {meant!r}?")


def test_an_unlike_word_has_no_nearest_one(capsys):
    assert "did you mean" not in refusal(capsys, "evaluate", "moon")


def test_a_place_that_is_not_there_lists_each_name_once(capsys):
    plan = "office:medium:17"
    said = refusal(capsys, "describe", "--from=-9,7.7,0", "--to", "nowhere", "--map", plan)
    names = said.split("there are: ")[1].split(", ")
    assert len(set(names)) == len(names) > 10


@pytest.mark.parametrize("command", ["demo", "evaluate"])
def test_the_help_names_the_trained_agents(capsys, command):
    assert cli.main([command, "--help"]) == 0
    assert "drive, listener, listener_drives (trained)" in " ".join(
        capsys.readouterr().out.replace("│", " ").split()
    )


def test_describe_takes_a_language_by_its_code(capsys):
    words = ["describe", "--from=-2.5,-0.3,0.24", "--to", "south_1", "--language", "de", "--json"]
    assert cli.main(words) == 0
    assert "Tür" in json.loads(capsys.readouterr().out)["command"]


def test_routes_and_descriptions_refuse_things_of_another_kind():
    plan = load_floor_plan("heidelberg_hallway")
    with pytest.raises(TypeError, match="needs a Route, as route_to makes it"):
        describe(plan, None)
    with pytest.raises(RouteError, match="give x, y and heading"):
        route_to(plan, (-2.5, -0.3), "south_1")
    with pytest.raises(RouteError, match=r"\(500, 500\) is outside"):
        route_to(plan, (-2.5, -0.3, 0.24), (500, 500))
