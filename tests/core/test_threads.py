import threading
import time

import numpy as np
import pytest
from runs import CancelAt

from bare_earth.algorithms.core import progress as progress_module
from bare_earth.algorithms.core.errors import Cancelled
from bare_earth.algorithms.core.progress import SILENT, paced
from bare_earth.algorithms.core.threads import (
    available_cpus,
    in_threads,
    may_use,
    over_parts,
    workers,
)


def test_a_computation_may_use_one_thread_unless_told_otherwise():
    assert workers() == 1
    with may_use(3):
        assert workers() == 3
        with may_use(0):
            assert workers() == 1
        assert workers() == 3
    assert workers() == 1


def test_calls_run_in_the_calling_thread_where_one_may_be_used():
    assert set(in_threads(lambda _: threading.get_ident(), range(4))) == {threading.get_ident()}


def test_results_come_in_the_order_of_the_items():
    def late(item):
        time.sleep(0.02 * (4 - item))
        return item, workers(), threading.get_ident()

    with may_use(4):
        results = in_threads(late, range(4))
    assert [item for item, _, _ in results] == [0, 1, 2, 3]
    assert {count for _, count, _ in results} == {1}
    assert len({ident for _, _, ident in results}) == 4


@pytest.mark.parametrize("count", [1, 3])
def test_the_first_failure_passes_on(count):
    def fail(item):
        if item in (2, 5):
            raise ValueError(item)
        return item

    with may_use(count), pytest.raises(ValueError, match="2"):
        in_threads(fail, range(8))


@pytest.mark.parametrize("count", [1, 3])
def test_parts_cover_a_range_once(count):
    seen = np.zeros(1001, dtype=int)

    def see(part):
        seen[part] += 1

    with may_use(count):
        over_parts(see, len(seen), 10, SILENT)
    assert (seen == 1).all()


@pytest.mark.parametrize("count", [1, 3])
def test_a_cancel_between_parts_ends_the_threads(count):
    begun = []

    def late(part):
        begun.append(part)
        time.sleep(0.01)

    with may_use(count), pytest.raises(Cancelled):
        over_parts(late, 1000, 1, CancelAt())
    # One each, and some more where the calling thread has to wait for a processor.
    assert len(begun) <= (1 if count == 1 else 100)
    assert not [each for each in threading.enumerate() if each.name == "strip"]


def test_pieces_are_as_long_as_the_pace_lets_them_be(monkeypatch):
    now, seen = [0.0], []
    monkeypatch.setattr(progress_module.time, "perf_counter", lambda: now[0])
    for piece in paced(5_000_000, 2_000_000):
        seen.append(piece)
        # A tenth of a second each, until the machine has other things to do.
        now[0] += 0.1 if piece.stop <= 3_000_000 else (piece.stop - piece.start) / 500_000
    assert [each.start for each in seen[1:]] == [each.stop for each in seen[:-1]]
    lengths = [each.stop - each.start for each in seen]
    assert lengths[:3] == [500_000, 1_000_000, 2_000_000]
    assert sum(lengths) == 5_000_000 and abs(lengths[-2] - 200_000) < 10


def test_there_is_a_cpu():
    assert available_cpus() >= 1
