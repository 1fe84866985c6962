"""How exactly scans are matched, and how far a chain of matches drifts."""
