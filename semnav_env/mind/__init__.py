"""The part that runs on a robot: its belief, the grounding of clauses, and the observations."""
