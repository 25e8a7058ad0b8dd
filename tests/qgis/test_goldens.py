"""No output of any algorithm and no dialog changes by accident."""

from qgis.core import QgsApplication

from benchmarks.goldens.agreed import AGREED_IN_QGIS, differences, read
from benchmarks.goldens.dialogs import RUNS, of_dialogs


def test_no_output_changes_by_accident(tmp_path):
    wrong = [*differences(read(AGREED_IN_QGIS), of_dialogs(tmp_path))]
    assert not wrong, (
        "Outputs are not as agreed. If they changed on purpose, write their digests anew by"
        " 'python -m benchmarks.goldens --write', and say why in the message of the commit:\n"
        + "\n".join(wrong)
    )


def test_all_algorithms_are_run():
    algorithms = QgsApplication.processingRegistry().providerById("bareearth").algorithms()
    assert {algorithm for algorithm, _ in RUNS.values()} == {one.name() for one in algorithms}
