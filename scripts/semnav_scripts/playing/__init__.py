"""Driving by hand: `semnav play`."""
