"""Files with some wrong bytes end in a right output or in a sentence: no abort, no hang, no trace.

`python tests/core/campaign.py FOLDER SEED COUNT` tries as many as wanted.
"""

import faulthandler
import itertools
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("resource")
import campaign

SCRIPT = Path(campaign.__file__)
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="its limits are those of Linux")


@pytest.mark.parametrize(
    ("seed", "count"),
    [(2, 40), *(pytest.param(seed, 3000, marks=pytest.mark.long) for seed in (2, 3))],
)
def test_files_with_wrong_bytes_end_in_a_sentence(tmp_path, seed, count):
    words = map(str, (SCRIPT, tmp_path, seed, count))
    done = subprocess.run(
        [sys.executable, *words], capture_output=True, text=True, timeout=600, check=False
    )
    assert not [line for line in done.stdout.splitlines() if line.startswith("mutant")]
    assert (done.returncode, done.stderr) == (0, "")
    assert f"tried {count}:" in done.stdout


ENDS = {
    "done": lambda: 1,
    "refused": lambda: 0,
    "ValueError at test_mutants.py": lambda: int("no number"),
    "SystemExit": lambda: sys.exit(1),
    "ended by SIGABRT": lambda: (faulthandler.disable(), os.abort()),
    "ended by SIGALRM": lambda: time.sleep(60),
    "ended by SIGPROF": lambda: sum(0 for _ in itertools.count()),
    "MemoryError": lambda: np.ones(1 << 30),
    "MB used": lambda: len(np.ones(80_000_000)),
    "stderr: a word": lambda: os.write(2, b"a word"),
}


def found(monkeypatch, folder, names, seconds=60, waited=300):
    """Return what the campaign says of mutants that come to these ends, by the name of each."""
    monkeypatch.setattr(campaign, "SECONDS", seconds)
    monkeypatch.setattr(campaign, "USED", 500 << 20)
    monkeypatch.setattr(campaign, "WAITED", waited)
    monkeypatch.setattr(campaign, "work_on", lambda source, random: ENDS[source]())
    numbers = range(len(names))
    answers = dict(campaign.answers_of(numbers, lambda number: (names[number], None), folder))
    assert list(answers) == list(numbers)
    return {names[number]: answer for number, answer in answers.items()}


def test_the_campaign_sees_each_bad_end_and_goes_on_behind_it(tmp_path, monkeypatch):
    busy, waiting = "ended by SIGPROF", "ended by SIGALRM"
    answers = found(monkeypatch, tmp_path, [end for end in ENDS if end not in (busy, waiting)])
    answers.update(found(monkeypatch, tmp_path, ["done", busy, "refused"], seconds=0.5))
    answers.update(found(monkeypatch, tmp_path, ["done", waiting, "refused"], waited=1))
    for expected, answer in answers.items():
        assert expected in answer
