"""Numba kernels over plain arrays, and their NumPy reference."""
