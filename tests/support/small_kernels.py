"""Kernels that compile in no time."""

import numpy as np

from semnav_env.features.kernels.compiling import kernel


@kernel
def twice(x):
    return x + x


@kernel
def sum_of_twice(values):
    total = 0.0
    for i in range(len(values)):
        total += twice(values[i])
    return total + twice(1.0) + twice(1) + twice(len(values))


@kernel(counts_references=True)
def counting(n):
    if n < 0:
        raise ValueError("a negative number of values")
    return np.arange(n)


@kernel(counts_references=True)
def sum_of_counting(n):
    return counting(n).sum()


@kernel(inline=True)
def increased(x):
    return x + 1


@kernel
def increased_twice(x):
    return increased(increased(x))
