"""Running the command `semnav`, and what it wrote."""

import json

from semnav_scripts import main as cli


def run(capsys, *words, command=cli.main):
    """The exit code of a command with these words, and what it printed and complained of."""
    code = command([str(word) for word in words])
    captured = capsys.readouterr()
    return code, captured.out, captured.err


def scenes(path):
    """The objects of a file of JSON lines."""
    return [json.loads(line) for line in path.read_text().splitlines()]
