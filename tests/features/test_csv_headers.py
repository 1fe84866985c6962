"""Logs as CSV whose columns other programs named."""

from __future__ import annotations

from semnav_env.features.readers import Geometry
from tests.features.test_tables import read, written

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
