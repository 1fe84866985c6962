"""Routes through a floor plan: making them, describing them by commands, and ways to named rooms.

Import from the modules: the judge needs `room_guide` here, while `describe` and `follow` need
the judge.
"""
