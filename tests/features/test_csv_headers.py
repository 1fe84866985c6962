"""Logs as CSV whose columns other programs named."""

from __future__ import annotations

import math

import numpy as np
import pytest

from semnav_env.features.readers import Geometry
from tests.features.test_tables import FORWARD, read, written

ROSTOPIC = """\
%time,field.header.seq,field.header.stamp,field.header.frame_id,field.angle_min,\
field.angle_increment,field.range_min,field.range_max,field.ranges0,field.ranges1,\
field.intensities0,field.intensities1
1500000000,1,1500000000,laser,-0.5,0.25,0.2,9.0,2.5,2.6,0,0
2500000000,2,2500000000,laser,-0.5,0.25,0.2,9.0,far,2.6,0,0
"""


def test_words_in_columns_that_are_passed_over_cost_no_row(tmp_path):
    """What `rostopic echo -p` prints names the frame; a word among the ranges is a bad row."""
    records, log = read(written(tmp_path, ROSTOPIC), Geometry())
    assert [record.scan.ranges.tolist() for record in records] == [[2.5, 2.6]]
    assert records[0].stamp == 1.5
    assert log.bad == {"a cell that is not a number": 1}


@pytest.mark.parametrize("index", ["", "7"])
def test_the_numbers_that_pandas_writes_over_its_columns_are_a_header(tmp_path, index):
    """`DataFrame(ranges).to_csv()`, with its index and without."""
    comma = "," if index else ""
    text = f"{comma}0,1,2,3\n" + 2 * f"{index}{comma}2.5,,2.7,2.8\n"
    records, log = read(written(tmp_path, text), FORWARD)
    assert not log.bad
    assert [record.line for record in records] == [2, 3]
    for record in records:
        np.testing.assert_array_equal(record.scan.ranges, [2.5, math.nan, 2.7, 2.8])


@pytest.mark.parametrize("first", ["0.0,1.0,2.0", "0,1,3", "1,2,3", ",1,2"])
def test_a_first_row_that_does_not_count_from_nought_is_a_scan(tmp_path, first):
    records, _ = read(written(tmp_path, f"{first}\n2,2,2\n"), FORWARD)
    assert [record.line for record in records] == [1, 2]
