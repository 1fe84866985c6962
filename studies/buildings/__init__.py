"""Doors in simulated scans of real floors."""
