"""Learned networks as they run: their layers in NumPy alone, and the files that hold them."""
