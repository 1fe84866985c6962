"""Somebody found by voice: how exactly, and how often the robot then sees who it is."""
