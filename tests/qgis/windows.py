"""The window of a QGIS with a profile of its own, which tests drive by scripts."""

import json
import os
import shutil
import subprocess
import textwrap

from support import ALGORITHM

PRELUDE = """
import json, os, sys, time, traceback
from qgis.core import QgsApplication, QgsSettings
from qgis.PyQt.QtCore import QCoreApplication
from qgis.utils import iface, plugins
answer, given = {}, json.loads(os.environ["GIVEN"])

def wait(until, seconds=60):
    end = time.monotonic() + seconds
    while not until() and time.monotonic() < end:
        QCoreApplication.processEvents()
        time.sleep(0.02)

def dialog():
    plugins["bare_earth"].show_laz_support()
    children = iface.mainWindow().children()
    return [child for child in children if type(child).__name__ == "LazDialog"][0]

def result(found):
    wait(lambda: found.result.text())
    return found.result.text()

def messages():
    return [item.text() for item in iface.messageBar().items()]

def run(algorithm, **parameters):
    import processing
    try:
        return processing.run(algorithm, parameters)
    except Exception as error:
        return str(error)

try:
    exec(os.environ["STEPS"])
except Exception:
    answer["error"] = traceback.format_exc()
QgsSettings().sync()
with open(os.environ["ANSWER"], "w") as file:
    json.dump(answer, file, default=str)
os._exit(0)
"""


class Qgis:
    """A QGIS with a profile of its own, and without the packages of these tests."""

    def __init__(self, folder):
        self.folder = folder
        self.profile = folder / "profiles" / "default"
        for name in ("home", "runtime"):
            (folder / name).mkdir(mode=0o700, exist_ok=True)
        foreign = ("PYTHONPATH", "QGIS_PLUGINPATH", "QT_QPA_PLATFORM", "DISPLAY")
        self._environment = {
            **{key: value for key, value in os.environ.items() if key not in foreign},
            "HOME": str(folder / "home"),
            "XDG_RUNTIME_DIR": str(folder / "runtime"),
            "QGIS_CUSTOM_CONFIG_PATH": str(folder),
        }

    def window(self, steps, environment=None, **given):
        """Run steps in the window; return what they put into `answer`."""
        script, file = self.folder / "steps.py", self.folder / "answer.json"
        script.write_text(PRELUDE, encoding="utf-8")
        file.unlink(missing_ok=True)
        given = {key: str(value) for key, value in given.items()}
        settings = {
            "STEPS": textwrap.dedent(steps), "GIVEN": json.dumps(given), "ANSWER": str(file),
            **(environment or {}),
        }  # fmt: skip
        done = subprocess.run(
            ["xvfb-run", "-a", "qgis", "--nologo", "--noversioncheck", "--code", str(script)],
            env={**self._environment, **settings},
            capture_output=True,
            text=True,
            timeout=300,
        )
        assert file.exists(), done.stdout[-2000:] + done.stderr[-2000:]
        answer = json.loads(file.read_text(encoding="utf-8"))
        assert "error" not in answer, answer["error"]
        return answer

    def process(self, source, target):
        """Classify by qgis_process."""
        # In Debian 12 the wrapper of this name adds an option that it then does not know.
        program = shutil.which("qgis_process.bin") or shutil.which("qgis_process")
        return subprocess.run(
            [program, "run", ALGORITHM, "--", f"INPUT={source}", f"OUTPUT={target}"],
            env={**self._environment, "QT_QPA_PLATFORM": "offscreen"},
            capture_output=True,
            text=True,
            timeout=300,
        )
