"""Constructions that people whom nobody knew used, each as a rule and not as a sentence."""

import pytest

from semnav_env.language import AmbiguousCommandError, CommandError, read, readings

ROOMS = ("kitchen", "library", "lab", "office", "Küche", "Archiv")

MEANT = """
Position yourself so that the wall is on your left-hand side. = turn so that the wall is on the left
Turn on the spot till the wall's on your right. = turn so that the wall is on the right
turn yourself until the kitchen is straight ahead of you = face room "kitchen"
Richten Sie sich so aus, dass die Wand rechts von Ihnen liegt. = turn so that the wall is on the right
dreh dich so, dass du die Küche direkt vor dir hast = face room "kueche"
forward one point five meters = go down the hallway for 1.5 metres
turn a hundred and twenty degrees left = turn left by 120 degrees
three metres on, turn about, three metres back = go down the hallway for 3 metres, turn around and go down the hallway for 3 metres
leave the room, then it's a right = leave the room and turn right
leave the room and take the corridor to the right = leave the room and turn right
take the corridor on the right = turn right at the first turning
turn left in front of the office = go down the hallway until room "office" and turn left
bring me to the door of the office = stop in front of room "office"
do not enter the kitchen, only go up to its door = stop in front of room "kitchen"
of the doors on the right-hand side, enter the fifth = go through the fifth door on the right
von den Türen links nimm die dritte = go through the third door on the left
geh durch die rechte der beiden Türen = go through the first door on the right
enter the door immediately before the T-junction = go through the last door
counting from the end, enter the second door = go through the second-to-last door
Gibt es keine Kreuzung, dreh dich um. = if you do not see the first intersection, turn around
Is there a door on the left? Then go through it. = if you see the first door on the left, go through the first door on the left
if there is no door on the left, go to the end of the hallway and turn right = if you do not see the first door on the left, turn right at the end of the hallway
you pass one door, another door, and then you take the third one = go down the hallway past the first door, go down the hallway past the first door and go through the first door
in between the two intersections there's a door on the left, go in = go down the hallway past the first intersection and go through the first door on the left
don't stop at the kitchen, go on into the lab = go down the hallway past room "kitchen" and go to room "lab"
am Archiv nicht anhalten, weiter bis zur Ecke = go down the hallway past room "archiv" and go down the hallway until the first corner
not the kitchen, the library, go to the library = go to room "library"
past the lab, yes, past the lab, then turn left = go down the hallway past room "lab" and turn left
you are in the kitchen. leave it and turn right = leave the room and turn right
go to the library and take the door just after it = go to room "library", go down the hallway past room "library" and go through the first door
next intersection left, the one after that right = turn left at the first intersection and turn right at the first intersection
rechts ist eine Tür, die nimm = go through the first door on the right
rechts in den Gang hinein = turn right
biegste an der Ecke links ab = turn left at the first corner
"""  # noqa: E501

CASES = [tuple(line.split(" = ")) for line in MEANT.strip().splitlines()]


@pytest.mark.parametrize(("text", "meant"), CASES)
def test_what_strangers_said_is_taken_as_meant(text: str, meant: str) -> None:
    """Each line is a construction of docs/language.md."""
    assert {str(found) for found in readings(text, None, ROOMS)} == {meant}


@pytest.mark.parametrize("turn", ["turn around", "turn left"])
def test_a_turn_in_any_case_depends_on_nothing(turn: str) -> None:
    text = (
        f"if you see the first door, go down the hallway until the first corner, in any case {turn}"
    )
    assert str(read(text)) == text


@pytest.mark.parametrize(
    "text",
    [
        "wait ten seconds straight ahead",
        "stop in the door of the kitchen, don't go inside",
        "stop at the door next to the kitchen",
        "is there a door on the left?",
    ],
)
def test_a_clause_of_which_a_part_would_be_dropped_is_refused(text: str) -> None:
    with pytest.raises(CommandError) as caught:
        read(text, None, ROOMS)
    assert not isinstance(caught.value, AmbiguousCommandError)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("the patient will arrive soon, turn left", "turn left"),
        ("bring me to the glorbulum, no, to the kitchen", 'go to room "kitchen"'),
    ],
)
def test_a_remark_is_left_out_with_a_question(text: str, meant: str) -> None:
    with pytest.raises(AmbiguousCommandError) as caught:
        read(text, None, ROOMS)
    assert [str(command) for command in caught.value.readings] == [meant]
    assert caught.value.question.unread


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("turn 180 degrees to the right", "turn right by 180 degrees"),
        ("rotate one hundred and eighty degrees to the left", "turn left by 180 degrees"),
        ("turn 180 degrees", "turn around"),
        ("do a 180", "turn around"),
    ],
)
def test_half_a_turn_may_have_a_side(text: str, meant: str) -> None:
    assert str(read(text)) == meant
