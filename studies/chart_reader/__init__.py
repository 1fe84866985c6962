"""Trains and measures the chart reader, each author left out in turn."""
