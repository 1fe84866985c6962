"""Pictures of an episode: turns frames into pixels, windows or films.

It imports nothing by itself, because most environments are never drawn.
"""
