"""The extraction chain once more in plain NumPy, to read and to test the kernels against."""

from tests.numpy_oracle.chain import extract_reference

__all__ = ["extract_reference"]
