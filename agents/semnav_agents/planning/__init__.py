"""Footprint-aware local planning, path following and the memory of near obstacles."""
