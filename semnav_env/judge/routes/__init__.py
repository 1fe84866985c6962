"""Routes through a floor plan: made, described by commands, and pointed out to named rooms.

Import from the modules: the judge needs `room_guide` here, while `describe` and `follow` need
the judge.
"""
