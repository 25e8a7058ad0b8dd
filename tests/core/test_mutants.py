"""Files with some wrong bytes end in a right output or in a sentence: no abort, no hang, no trace.

`python tests/core/mutants.py FOLDER SEED COUNT` tries as many as wanted.
"""

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("resource")
SCRIPT = Path(__file__).with_name("mutants.py")


@pytest.mark.parametrize(
    ("seed", "count"),
    [(2, 30), *(pytest.param(seed, 120, marks=pytest.mark.long) for seed in (2, 3))],
)
def test_files_with_wrong_bytes_end_in_a_sentence(tmp_path, seed, count):
    words = map(str, (SCRIPT, tmp_path, seed, count))
    command = [sys.executable, "-W", "error", *words]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    lines = done.stdout.splitlines()
    assert not [line for line in lines if line.startswith("mutant")]
    assert (done.returncode, done.stderr) == (0, ""), f"mutant {lines[-1]} ended the process"
    assert lines[-1] == str(count - 1)
