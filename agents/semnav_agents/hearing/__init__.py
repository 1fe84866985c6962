"""Policies that hear the command: a learned grounding, driven by the planner."""
