"""Measurements, training of the door scorer and pictures of the documentation; not installed.

Everything here imports the package, and the package imports nothing of it.
"""
