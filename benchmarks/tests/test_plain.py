"""Plain things that come out right stay so: some of the matrix each day, all of it is long."""

import numpy as np
import pytest
from matrices import quick

from benchmarks import plain
from benchmarks.scenes.plain import KINDS, rows

ROWS = {row.name: row for row in rows()}


def test_names_tell_rows_apart_and_scenes_do_not_change():
    assert len(ROWS) == len(rows()) == 2 * sum(len(kind.rows) for kind in KINDS)
    row = ROWS["bowl-3x0.5-slope0-8pm2-a"]
    one, again = row.make(), row.make()
    for first, second in zip((*one.scene.points, one.thing), (*again.scene.points, again.thing)):
        np.testing.assert_array_equal(first, second)
    assert row.sizes == (3.0, 0.5)


@pytest.mark.parametrize("name", quick([kind.name for kind in KINDS], "bowl", "low-clumps"))
def test_the_truth_of_a_kind_is_held_and_its_opposite_is_not(name):
    row = next(row for row in rows() if row.kind.name == name)
    judge, stays = plain.Judge(row), row.kind.stays
    truth, thing = judge.plain.scene.ground, judge.plain.thing
    assert thing.sum() >= 16 and (truth[thing] == stays).all()
    assert judge.judged(truth) == (True, 100.0 * stays, 0.0, 100.0)
    assert not judge.judged(truth ^ thing).held
    assert not judge.judged(np.zeros(len(truth), dtype=bool)).held
