"""The extraction chain once more in plain NumPy, to read and to test the kernels against."""

from semnav_env.features.reference.chain import extract_reference

__all__ = ["extract_reference"]
