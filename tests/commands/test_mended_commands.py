"""What newcomers said and the robot did not mean: it asks, or refuses and says why."""

import pytest

from semnav_env.commands import AmbiguousCommandError, CommandError, parse

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
    with pytest.raises(CommandError) as caught:
        parse(text, None, ROOMS)
    assert not isinstance(caught.value, AmbiguousCommandError)


def test_to_reverse_alone_or_before_going_on_is_to_turn_around() -> None:
    assert str(parse("reverse")) == "turn around"
    turned = "turn around and go down the hallway for 2 metres"
    assert str(parse("reverse, then go two metres")) == turned
    with pytest.raises(CommandError, match="driving backwards is not understood: turn around"):
        parse("reverse two metres")


def test_doors_that_are_passed_on_both_sides_may_be_counted_on_one() -> None:
    with pytest.raises(AmbiguousCommandError) as caught:
        parse("pass two doors and then enter the third one on your left")
    assert [str(command) for command in caught.value.readings] == [
        "go down the hallway past the second door and go through the first door on the left",
        "go down the hallway past the second door on the left "
        "and go through the first door on the left",
    ]
    for plain in ("pass two doors and take the next on the left", "pass two doors, take the third"):
        parse(plain)
