"""What newcomers said and the robot did not mean: it asks, or refuses and says why."""

import pytest

from semnav_env.judge.episodes import load_episodes
from semnav_env.judge.tasks.request import EpisodeRequest
from semnav_env.language import AmbiguousCommandError, CommandError, read, readings
from semnav_scripts.ground import understood

ROOMS = ("lab", "office", "kitchen")


@pytest.mark.parametrize(
    "text",
    [
        "reverse two metres",
        "reverse one metre, then turn left",
        "please reverse for 3 metres",
        "drive backwards one metre",
        "go two metres backwards",
        "back up 1 metre",
        "fahr rückwärts zwei Meter",
        "fahr zwei Meter rückwärts",
    ],
)
def test_driving_backwards_by_a_distance_is_never_done_forwards(text: str) -> None:
    assert str(read(text, None, ROOMS)).startswith("back up for ")


def test_to_reverse_alone_or_before_going_on_is_to_turn_around() -> None:
    assert str(read("reverse")) == "turn around"
    turned = "turn around and go down the hallway for 2 metres"
    assert str(read("reverse, then go two metres")) == turned
    assert str(read("reverse two metres")) == "back up for 2 metres"


def test_doors_that_are_passed_on_both_sides_may_be_counted_on_one() -> None:
    with pytest.raises(AmbiguousCommandError) as caught:
        read("pass two doors and then enter the third one on your left")
    assert [str(command) for command in caught.value.readings] == [
        "go down the hallway past the second door and go through the first door on the left",
        "go down the hallway past the second door on the left "
        "and go through the first door on the left",
    ]
    for plain in ("pass two doors and take the next on the left", "pass two doors, take the third"):
        read(plain)


@pytest.mark.parametrize(
    ("text", "room"),
    [("Fahr ins Büro", "office"), ("Geh ins Labor", "lab"), ("Fahr in die Küche", "kitchen")],
)
def test_a_room_is_known_by_its_kind_in_both_languages(text: str, room: str) -> None:
    assert str(read(text, None, ROOMS)) == f'go to room "{room}"'
    assert read(text, "de", ROOMS) == read(f"go to the {room}", "en", ROOMS)


@pytest.mark.parametrize("text", ["Fahr ins Büro", "go to the office"])
def test_a_kind_of_room_that_several_rooms_have_is_no_door(text: str) -> None:
    with pytest.raises(CommandError, match="there are: office 1, office 2"):
        read(text, None, ("office 1", "office 2"))
    assert str(read("fahr ins Büro 2", None, ("office 1", "office 2"))) == 'go to room "office 2"'
    counted = read("take the second office on the left", None, ROOMS)
    assert str(counted) == "go through the second door on the left"


@pytest.mark.parametrize(
    ("text", "rooms", "wrong"),
    [
        ("Fahr in die Bibliothek", ROOMS, "Bibliothek"),
        ("Kannst du bitte in die Toilette fahren?", ROOMS, "Toilette"),
        ("turn left and go to the library", ROOMS, "library"),
        ("go past the kitchen and turn left", (), "kitchen"),
        ("go to the toilet, it is the second door on the left", ROOMS, "toilet"),
    ],
)
def test_the_carets_are_under_a_room_that_there_is_not(
    text: str, rooms: tuple[str, ...], wrong: str
) -> None:
    with pytest.raises(CommandError) as caught:
        read(text, None, rooms)
    error = caught.value
    assert error.position == text.index(wrong)
    assert error.length == len(wrong)
    assert all(room in str(error) for room in rooms)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("go to the kitchn", 'Did you mean "kitchen"? (\'go to room "kitchen"\')'),
        ("go thruogh the second door on the rigth", 'Did you mean "through, right"?'),
        (
            "take a left, then a right, then turn 45 degrees",
            'Left, or right? ("turn left by 45 degrees" / "turn right by 45 degrees")',
        ),
        ("turn left in 5 metres", "in what distance? first say how far to go"),
        ("go down the hallway for 100 metres", "a distance is 0.5 to 50 metres"),
        ("explore everything", 'say "search the house"'),
    ],
)
def test_an_error_says_what_would_be_right(text: str, says: str) -> None:
    with pytest.raises(CommandError) as caught:
        read(text, None, ROOMS)
    assert says in str(caught.value)


@pytest.mark.parametrize(
    "text",
    [
        "go down the hallway for 100 metres",
        "explore everything",
        "follow the person",
        "dock at the charging station",
        "Hol mir einen Kaffee",
    ],
)
def test_rooms_are_listed_only_where_one_may_be_meant(text: str) -> None:
    with pytest.raises(CommandError) as caught:
        read(text, None, ROOMS)
    assert "rooms" not in str(caught.value)


@pytest.mark.parametrize(
    "text", ["Such das Haus ab", "Suche im ganzen Haus", "bitte das ganze Haus absuchen"]
)
def test_a_house_is_searched_in_german_words(text: str) -> None:
    assert str(read(text)) == "search the house"


def test_the_language_of_a_text_is_recognised_everywhere() -> None:
    around = read("turn around")
    assert EpisodeRequest("dreh dich um").checked_command(()) == around
    assert understood("dreh dich um") == around
    with pytest.raises(CommandError, match="this is German"):
        EpisodeRequest("nimm die Tür", language="en").checked_command(())


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("den Raum verlassen und danach durch die letzte Tür links", "Tür links"),
        ("den Raum verlassen und dann nach links", "leave the room and turn left"),
        ("go outside and then at the 1st intersection, turn right", "at the first intersection"),
        ("go outside and then when you reach the second crossing, turn right", "second"),
        ("continue and then left", "go down the hallway and turn left"),
        ("go and then left", "turn left"),
    ],
)
def test_and_then_parts_two_clauses_behind_a_verb_that_says_where_to(text: str, meant: str) -> None:
    """Behind a bare "go" it says nothing; "then" alone may stand inside a clause."""
    command = read(text)
    assert meant in f"{command.say('en')} {command.say('de')}"
    assert len(command.clauses) == 1 + (not text.startswith("go and"))


@pytest.mark.parametrize(
    "name", ["train-00844", "train-01181", "test_long-00791", "test_long-00941"]
)
def test_frozen_texts_with_and_then_are_read_as_their_programs(name: str) -> None:
    split, _, number = name.rpartition("-")
    episode = load_episodes(split)[int(number)]
    assert readings(episode.command, episode.language) == episode.programs


@pytest.mark.parametrize(
    "text",
    [
        "drive for 10 seconds",
        "go down the hallway for 5 minutes",
        "go straight for 3 seconds",
        "go to the second door in 5 seconds",
        "turn left after 5 seconds",
        "fahr 10 Sekunden geradeaus",
        "fahr den Flur 5 Minuten entlang",
    ],
)
def test_how_long_to_drive_is_never_taken_for_a_wait(text: str) -> None:
    with pytest.raises(CommandError) as caught:
        read(text)
    assert not isinstance(caught.value, AmbiguousCommandError)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("in 5 seconds turn left", "wait for 5 seconds and turn left"),
        ("halte 3 Sekunden an", "stop and wait for 3 seconds"),
        ("stop at the second door for 5 seconds", "go to the second door and wait for 5 seconds"),
        ("go to the second door, 5 seconds", "go to the second door and wait for 5 seconds"),
        ("give me five seconds", "wait for 5 seconds"),
    ],
)
def test_a_time_that_says_how_long_to_stand_is_a_wait(text: str, meant: str) -> None:
    assert str(read(text)) == meant
