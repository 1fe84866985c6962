"""Searching a house: a map of inspected floor, poses to look from, and people to approach."""
