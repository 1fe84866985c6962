"""Measures the speed of the environment on this machine: `semnav bench`."""
