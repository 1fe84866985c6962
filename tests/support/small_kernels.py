"""Kernels that compile in no time."""

import numpy as np
from numba.experimental import structref

from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.structures import ArraysType


@kernel
def twice(x):
    return x + x


@kernel
def sum_of_twice(values):
    total = 0.0
    for i in range(len(values)):
        total += twice(values[i])
    return total + twice(1.0) + twice(1) + twice(len(values))


@kernel
def counting(n):
    if n < 0:
        raise ValueError("a negative number of values")
    return np.arange(n)


@kernel
def sum_of_counting(n):
    return counting(n).sum()


@kernel(shared=True)
def total(values):
    if len(values) == 0:
        raise ValueError("no values")
    return sum_of_twice(values) / 2.0


@kernel
def mean(values):
    return total(values) / len(values)


@structref.register
class PairOfArraysType(ArraysType):
    pass


class PairOfArrays(structref.StructRefProxy):
    pass


structref.define_proxy(PairOfArrays, PairOfArraysType, ["first", "both"])


@kernel
def paired(first, second):
    return PairOfArrays(first, (first, second))


@kernel
def sum_of_pair(pair):
    _, second = pair.both
    return sum_of_twice(pair.first[1:]) + second[0]


@kernel(inline=True)
def increased(x):
    return x + 1


@kernel
def increased_twice(x):
    return increased(increased(x))
