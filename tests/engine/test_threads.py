import itertools
import threading
import time

import numpy as np
import pytest
from runs import CancelAt

from bare_earth import Cancelled, Progress
from bare_earth.algorithms.core import progress as progress_module
from bare_earth.algorithms.core.progress import paced
from bare_earth.algorithms.core.threads import (
    SharedThreads,
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
    begun = threading.Barrier(4)

    def late(item):
        begun.wait(10.0)
        time.sleep(0.02 * (4 - item))
        return item, threading.get_ident()

    with may_use(4):
        results = in_threads(late, range(4))
    assert [item for item, _ in results] == [0, 1, 2, 3]
    assert len({ident for _, ident in results}) == 4


def test_nested_calls_share_the_threads():
    working, most, lock = 0, 0, threading.Lock()
    numbers, together = itertools.count(), threading.Barrier(3)

    def work(_):
        nonlocal working, most
        with lock:
            working += 1
            most = max(most, working)
        if next(numbers) < together.parties:
            together.wait(20.0)
        time.sleep(0.002)
        with lock:
            working -= 1

    with may_use(3):
        in_threads(lambda _: in_threads(work, range(5)), range(4))
    # A caller that waited for its threads goes on at once: beside it ends the call of a thread that
    # had taken its place meanwhile. One call of four is left for one such caller.
    assert 3 <= most <= 4
    assert workers() == 1


def test_threads_that_have_nothing_left_to_do_help_with_a_call_that_goes_on():
    ended = threading.Event()

    def unequal(item):
        if item == 0:
            return ended.set()
        if not ended.wait(10.0):
            return None
        end = time.monotonic() + 10.0
        while workers() < 2 and time.monotonic() < end:
            time.sleep(0.001)
        both = threading.Barrier(2)
        return in_threads(lambda _: both.wait(10.0), range(2))

    with may_use(2):
        assert sorted(in_threads(unequal, range(2))[1]) == [0, 1]


def test_a_helping_thread_ends_where_another_computation_needs_its_place():
    shared, helped, since = SharedThreads(2), [], []
    both, begun, ended = threading.Barrier(2), threading.Event(), threading.Event()

    def work(item):
        (since if begun.is_set() else helped).append(threading.get_ident())
        if item < 2:
            both.wait(20.0)
        if item == 2:
            other.start()
        if item >= 2:
            begun.wait(20.0)

    def compute():
        with shared.used():
            begun.set()
            ended.wait(20.0)

    other = threading.Thread(target=compute)
    with shared.used():
        in_threads(work, range(100))
        # It may have begun one more.
        others = [count for count in since if count != threading.get_ident()]
        assert len(set(helped)) == 2 and len(others) <= 1 < len(since)
        ended.set()
        other.join()
    assert shared.free == 2


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
        over_parts(see, len(seen), 10, Progress())
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
    assert not [thread for thread in threading.enumerate() if thread.name == "strip"]


def test_pieces_are_as_long_as_the_pace_lets_them_be(monkeypatch):
    now, seen = [0.0], []
    monkeypatch.setattr(progress_module.time, "perf_counter", lambda: now[0])
    for piece in paced(5_000_000, 2_000_000):
        seen.append(piece)
        # A tenth of a second each, until the machine has other things to do.
        now[0] += 0.1 if piece.stop <= 3_000_000 else (piece.stop - piece.start) / 500_000
    assert [count.start for count in seen[1:]] == [count.stop for count in seen[:-1]]
    lengths = [count.stop - count.start for count in seen]
    assert lengths[:3] == [500_000, 1_000_000, 2_000_000]
    assert sum(lengths) == 5_000_000 and abs(lengths[-2] - 200_000) < 10


def test_there_is_a_cpu():
    assert available_cpus() >= 1
