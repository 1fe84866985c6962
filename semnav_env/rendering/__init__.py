"""Pictures of an episode: a frame goes in, pixels, a window or a film come out.

It imports nothing by itself, because most environments are never drawn.
"""
