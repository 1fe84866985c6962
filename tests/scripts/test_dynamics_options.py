"""Commands offer the settings of what moves, but not what only a program can use."""

import re
from dataclasses import fields

import pytest

from semnav_env.world.dynamics import Dynamics, Walking
from semnav_scripts import demo, evaluate, play
from semnav_scripts.arguments import parse
from tests.support.command_line import run

COMMANDS = {"demo": demo.Arguments, "evaluate": evaluate.Arguments, "play": play.Arguments}


@pytest.mark.parametrize("name", COMMANDS)
def test_all_that_moves_is_an_option_but_what_is_added_by_hand(capsys, name):
    code, said, _ = run(capsys, name, "--help")
    offered = set(re.findall(r"--([a-z-]+)", said))
    settings = {field.name.replace("_", "-") for field in fields(Dynamics)}
    assert code == 0
    assert settings - offered == {"by-hand"}
    refused, _, why = run(capsys, name, "--by-hand", "3")
    assert refused == 2
    assert "--by-hand" in why


@pytest.mark.parametrize("arguments", COMMANDS.values())
def test_the_options_are_the_settings_that_they_name(arguments):
    words = ["--pedestrians", "2", "--walking.speed", "1.5"]
    told = parse(arguments, words, "semnav").dynamics
    assert isinstance(told, Dynamics)
    assert vars(told) == vars(Dynamics(pedestrians=2, walking=Walking(speed=1.5)))
