"""Searching a house: a map of what was looked at, places to look from, and people to go to."""
