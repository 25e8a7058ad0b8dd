"""The zip of `make package` in the window of a fresh QGIS, installed there by QGIS itself."""

import os
import shutil
import subprocess
from pathlib import Path

import laspy
import pytest
from qgis.core import QgsProviderRegistry
from remote_server import serving
from support import ALGORITHM, ROOT
from windows import Qgis

SENTENCE = "Plugins > Bare Earth > LAZ support"
# The wheel of lazrs that tools/environment got.
WHEELS = next((Path(laspy.__file__).parents[1] / "wheels").glob("lazrs-*.whl")).parent


@pytest.fixture(scope="session")
def package(tmp_path_factory):
    if not (ROOT / ".git").exists():
        pytest.skip("this is no git checkout")
    folder = tmp_path_factory.mktemp("package")
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    subprocess.run([ROOT / "tools" / "environment", "package", folder], env=environment, check=True)
    (file,) = folder.iterdir()
    return file


@pytest.fixture(scope="session")
def fresh(package, tmp_path_factory):
    """A QGIS in which nothing was done but to install the zip, and what its window said."""
    qgis = Qgis(tmp_path_factory.mktemp("fresh"))
    answer = qgis.window(
        """
        import pyplugin_installer
        pyplugin_installer.instance().installFromZipFile(given["zip"])
        menus = [action for action in iface.pluginMenu().actions() if action.text() == "Bare Earth"]
        answer["menu"] = [action.text() for action in menus[0].menu().actions()]
        answer["messages"] = messages()
        registry = QgsApplication.processingRegistry()
        answer["algorithms"] = len(registry.providerById("bareearth").algorithms())
        answer["model"] = registry.createAlgorithmById("bareearth:terraincontours").canExecute()
        import laspy
        answer["laspy"] = laspy.__file__
        """,
        zip=package,
    )
    return qgis, answer


@pytest.fixture
def qgis(fresh, tmp_path):
    """A copy of that QGIS, to be changed."""
    shutil.copytree(fresh[0].folder, tmp_path / "qgis", dirs_exist_ok=True)
    return Qgis(tmp_path / "qgis")


@pytest.fixture
def clouds(tmp_path):
    from support import Scene

    return Scene(tmp_path, ".las"), Scene(tmp_path, ".laz")


def ground_of(path):
    return int((laspy.read(path).classification == 2).sum())


def test_qgis_installs_the_zip(fresh):
    qgis, answer = fresh
    assert answer["menu"] == [
        "Point cloud to terrain…", "Review", "LAZ support…", "Remove downloaded point clouds",
        "Documentation",
    ]  # fmt: skip
    assert answer["algorithms"] >= 14
    assert answer["model"] == [True, ""]
    assert Path(answer["laspy"]) == (
        qgis.profile / "python" / "plugins" / "bare_earth" / "packages" / "laspy" / "__init__.py"
    )
    assert len([message for message in answer["messages"] if ".laz" in message]) == 1


def test_of_laz_support_is_told_once(qgis):
    assert not qgis.window("answer['messages'] = messages()")["messages"]


def test_the_help_button_opens_the_page_in_the_plugin(qgis):
    answer = qgis.window(
        """
        from processing.gui.AlgorithmDialog import AlgorithmDialog
        from qgis.PyQt.QtCore import QObject, pyqtSlot, QUrl
        from qgis.PyQt.QtGui import QDesktopServices
        from qgis.PyQt.QtWidgets import QDialogButtonBox

        class Browser(QObject):
            @pyqtSlot(QUrl)
            def open(self, url):
                answer["opened"] = url.toLocalFile()

        browser = Browser()
        QDesktopServices.setUrlHandler("file", browser, "open")
        registry = QgsApplication.processingRegistry()
        dialog = AlgorithmDialog(registry.createAlgorithmById(given["algorithm"]))
        dialog.show()
        box = dialog.findChild(QDialogButtonBox)
        box.button(QDialogButtonBox.StandardButton.Help).click()
        provider = registry.providerById("bareearth")
        answer["all"] = [QUrl(tool.helpUrl()).toLocalFile() for tool in provider.algorithms()]
        """,
        algorithm=ALGORITHM,
    )
    help_folder = qgis.profile / "python" / "plugins" / "bare_earth" / "help"
    assert Path(answer["opened"]) == help_folder / "tin-densification.html"
    assert "<h1" in Path(answer["opened"]).read_text(encoding="utf-8")
    assert all(Path(page).is_file() for page in answer["all"])


def test_the_menu_opens_the_dialog_with_which_users_begin(qgis):
    answer = qgis.window(
        """
        from qgis.PyQt.QtWidgets import QApplication
        (menu,) = [one for one in iface.pluginMenu().actions() if one.text() == "Bare Earth"]
        menu.menu().actions()[0].trigger()
        QApplication.processEvents()
        shown = [widget for widget in QApplication.topLevelWidgets() if widget.isVisible()]
        answer["titles"] = [widget.windowTitle() for widget in shown]
        """
    )
    # Newer QGIS writes titles in its own case.
    assert any("point cloud to terrain" in title.lower() for title in answer["titles"]), answer


def test_the_menu_opens_the_documentation_in_the_plugin(qgis):
    answer = qgis.window(
        """
        from qgis.PyQt.QtCore import QObject, pyqtSlot, QUrl
        from qgis.PyQt.QtGui import QDesktopServices

        class Browser(QObject):
            @pyqtSlot(QUrl)
            def open(self, url):
                answer["opened"] = url.toLocalFile()

        browser = Browser()
        QDesktopServices.setUrlHandler("file", browser, "open")
        menus = [action for action in iface.pluginMenu().actions() if action.text() == "Bare Earth"]
        entries = {action.text(): action for action in menus[0].menu().actions()}
        entries["Documentation"].trigger()
        """
    )
    page = qgis.profile / "python" / "plugins" / "bare_earth" / "help" / "index.html"
    assert Path(answer["opened"]) == page and page.is_file()


def test_the_message_on_laz_goes_when_lazrs_is_there(qgis):
    answer = qgis.window(
        """
        from qgis.utils import reloadPlugin
        QgsSettings().remove("bare_earth/laz_support_told")
        reloadPlugin("bare_earth")
        answer["before"] = messages()
        found = dialog()
        found.get_from_wheel(given["wheel"])
        answer["result"] = result(found)
        wait(lambda: not messages(), 5)
        answer["after"] = messages()
        """,
        wheel=next(WHEELS.glob("lazrs-*.whl")),
    )
    assert any(".laz" in message for message in answer["before"])
    assert answer["result"].startswith("Done")
    assert not any(".laz" in message for message in answer["after"])


@pytest.mark.parametrize(
    ("locale", "title", "menu"),
    [
        ("de", "Boden klassifizieren (TIN-Verdichtung)", "LAZ-Unterstützung…"),
        ("fr", "Classer le sol (densification de TIN)", "Prise en charge LAZ…"),
    ],
)
def test_the_window_speaks_the_language_of_qgis(qgis, clouds, tmp_path, locale, title, menu):
    qgis.window(
        """
        QgsSettings().setValue("locale/overrideFlag", True)
        QgsSettings().setValue("locale/userLocale", given["locale"])
        """,
        locale=locale,
    )
    answer = qgis.window(
        """
        menus = [action for action in iface.pluginMenu().actions() if action.text() == "Bare Earth"]
        answer["menu"] = [action.text() for action in menus[0].menu().actions()]
        algorithm = QgsApplication.processingRegistry().createAlgorithmById(given["algorithm"])
        answer["title"] = algorithm.displayName()
        found = dialog()
        answer["state"] = found.state.text()
        """,
        algorithm=ALGORITHM,
    )
    assert answer["title"] == title and menu in answer["menu"]
    assert not answer["state"].startswith("Not installed")
    # Ids and values are the same in every language.
    done = qgis.process(clouds[0].path, tmp_path / "out.las")
    assert done.returncode == 0 and ground_of(tmp_path / "out.las") > 0


def test_las_works_from_the_zip_alone_and_laz_is_told(qgis, clouds, tmp_path):
    plain, packed = clouds
    done = qgis.process(plain.path, tmp_path / "out.las")
    assert done.returncode == 0, done.stdout + done.stderr
    assert ground_of(tmp_path / "out.las") == pytest.approx(plain.ground_count, rel=0.01)
    done = qgis.process(packed.path, tmp_path / "out2.las")
    assert done.returncode != 0 and SENTENCE in done.stdout + done.stderr
    assert not (tmp_path / "out2.las").exists()


def test_a_wheel_file_gives_laz_support_without_a_restart(qgis, clouds, tmp_path):
    _, packed = clouds
    answer = qgis.window(
        """
        target = given["folder"] + "/window.laz"
        answer["before"] = run(given["algorithm"], INPUT=given["cloud"], OUTPUT=target)
        found = dialog()
        answer["enabled"] = [found.get.isEnabled(), found.remove.isEnabled()]
        found.get_from_wheel(given["wheel"])
        answer["busy"] = found.busy.isVisible()
        answer["result"] = result(found)
        answer["state"] = found.state.text()
        answer["after"] = run(given["algorithm"], INPUT=given["cloud"], OUTPUT=target)
        """,
        wheel=next(WHEELS.iterdir()), cloud=packed.path, folder=tmp_path, algorithm=ALGORITHM,
    )  # fmt: skip
    assert SENTENCE in answer["before"]
    assert answer["enabled"] == [True, False] and answer["busy"]
    assert answer["result"] == "Done; no restart is needed."
    assert answer["state"].startswith("Ready") and str(qgis.profile) in answer["state"]
    assert answer["after"]["GROUND_COUNT"] == ground_of(tmp_path / "window.laz") > 0
    # The next start, and qgis_process, have it as well.
    done = qgis.process(packed.path, tmp_path / "process.laz")
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "process.laz").read_bytes() == (tmp_path / "window.laz").read_bytes()


def test_laz_support_is_removed_and_got_again(qgis, clouds, tmp_path):
    answer = qgis.window(
        """
        found = dialog()
        found.get_from_wheel(given["wheel"])
        result(found)
        import lazrs
        answer["file"] = lazrs.__file__
        found.remove.click()
        answer["removed"] = [found.result.text(), found.state.text()]
        target = given["folder"] + "/out.las"
        answer["without"] = run(given["algorithm"], INPUT=given["cloud"], OUTPUT=target)
        found.get_from_wheel(given["wheel"])
        answer["again"] = [found.result.text(), result(found)]
        answer["with"] = run(given["algorithm"], INPUT=given["cloud"], OUTPUT=target)
        found.remove.click()
        """,
        wheel=next(WHEELS.iterdir()), cloud=clouds[1].path, folder=tmp_path, algorithm=ALGORITHM,
    )  # fmt: skip
    assert qgis.profile / "bare_earth" in Path(answer["file"]).parents
    assert answer["removed"][0] == "Removed." and answer["removed"][1].startswith("Not installed")
    assert SENTENCE in answer["without"]
    assert answer["again"] == ["", "Done; no restart is needed."]
    assert answer["with"]["GROUND_COUNT"] > 0
    assert not list((qgis.profile / "bare_earth" / "packages").iterdir())


def test_a_wheel_for_another_python_is_refused(qgis, tmp_path):
    wheel = tmp_path / "lazrs.whl"
    wheel.write_bytes(b"no wheel")
    answer = qgis.window(
        """
        found = dialog()
        found.get_from_wheel(given["wheel"])
        answer["result"] = result(found)
        """,
        wheel=wheel,
    )
    assert answer["result"] == "lazrs.whl is not a wheel, or is damaged. Download it again."


def test_pip_gets_it_or_the_reason_is_told(qgis, tmp_path):
    steps = """
        found = dialog()
        found.get.click()
        answer["result"] = result(found)
        answer["state"] = found.state.text()
        """
    has_pip = subprocess.run(["/usr/bin/python3", "-m", "pip", "--version"]).returncode == 0
    nothing = {"PIP_NO_INDEX": "1", "PIP_FIND_LINKS": str(tmp_path), "PIP_CONFIG_FILE": os.devnull}
    answer = qgis.window(steps, nothing)
    expected = (
        "the package index has none for cp3" if has_pip else "sudo apt-get install python3-pip"
    )
    assert expected in answer["result"] and answer["state"].startswith("Not installed")
    if has_pip:
        answer = qgis.window(steps, {**nothing, "PIP_FIND_LINKS": str(WHEELS)})
        assert answer["result"] == "Done; no restart is needed."
        assert answer["state"].startswith("Ready")


def test_the_proxy_of_qgis_is_that_of_pip(qgis):
    answer = qgis.window(
        """
        from bare_earth.plugin.laz_dialog import proxy_address
        from qgis.core import QgsNetworkAccessManager
        answer["none"] = proxy_address()
        for key, value in given.items():
            QgsSettings().setValue(f"proxy/{key}", value)
        QgsSettings().setValue("proxy/proxyEnabled", True)
        QgsNetworkAccessManager.instance().setupDefaultProxyAndCache()
        answer["proxy"] = proxy_address()
        """,
        proxyType="HttpProxy", proxyHost="proxy.invalid", proxyPort=3128, proxyUser="me",
        proxyPassword="a@b",
    )  # fmt: skip
    assert answer == {"none": "", "proxy": "http://me:a%40b@proxy.invalid:3128"}


def test_layers_are_in_order_in_a_window_whatever_layer_is_current(qgis, clouds, tmp_path):
    answer = qgis.window(
        """
        import processing
        for _ in range(2):
            processing.runAndLoadResults(given["algorithm"], {
                "INPUT": given["cloud"], "EXPECTED_ERROR": "TEMPORARY_OUTPUT",
                **dict.fromkeys(("DTM", "DSM", "CHM", "HILLSHADE"), "TEMPORARY_OUTPUT"),
            })
            wait(lambda: False, 0.5)
        root = iface.layerTreeView().layerTreeModel().rootGroup()
        answer["groups"] = [
            [group.name(), [one.name() for one in group.children()]] for group in root.children()
        ]
        """,
        cloud=clouds[0].path, algorithm="bareearth:pointcloudtoterrain",
    )  # fmt: skip
    titles = ["Expected error", "Canopy height", "Surface model", "Terrain model", "Hillshade"]
    groups = {
        "scene: terrain": [f"scene: {title}" for title in titles],
        "scene: terrain (2)": [f"scene (2): {title}" for title in titles],
    }
    assert dict(answer["groups"]) == groups and len(answer["groups"]) == 2


@pytest.mark.skipif(
    "copc" not in QgsProviderRegistry.instance().providerList(), reason="shows no point clouds"
)
def test_the_map_of_a_remote_layer_becomes_terrain_in_three_clicks(qgis, tmp_path, scene):
    import processing

    source = tmp_path / "far.copc.laz"
    processing.run(ALGORITHM, {"INPUT": str(scene.path), "OUTPUT": str(source)})
    with serving() as server:
        address = server.add(source.name, source.read_bytes())
        answer = qgis.window(
            """
            from qgis.core import QgsPointCloudLayer, QgsProject, QgsRectangle
            import processing
            project = QgsProject.instance()
            layer, another = (
                project.addMapLayer(QgsPointCloudLayer(given["address"], name, "copc"))
                for name in ("far", "another")
            )
            canvas = iface.mapCanvas()
            canvas.setDestinationCrs(layer.crs())
            canvas.setExtent(QgsRectangle(500010, 5700010, 500050, 5700040))

            iface.setActiveLayer(layer)  # the first click
            dialog = processing.createAlgorithmDialog("bareearth:pointcloudtoterrain")  # the second
            dialog.show()
            wait(lambda: False, 1)
            answer["values"] = dialog.createProcessingParameters()
            answer["layer"] = layer.id()
            dialog.runButton().click()  # the third
            def terrain():
                return project.mapLayersByName("far: Terrain model")

            wait(terrain, 120)
            answer["terrain"] = [one.width() for one in terrain()]
            answer["log"] = dialog.logText() if hasattr(dialog, "logText") else ""
            """,
            {"PYTHONPATH": str(Path(laspy.__file__).parents[1]),
             "BARE_EARTH_CACHE": str(tmp_path / "cache")},
            address=address,
        )  # fmt: skip
    assert answer["values"]["INPUT"] == answer["layer"]
    assert answer["values"]["EXTENT"].endswith("[EPSG:25832]")
    assert answer["terrain"] and answer["terrain"][0] >= 40, answer["log"]


@pytest.mark.parametrize("package_name", ["scipy", "numpy"])
def test_where_numpy_or_scipy_is_missing_the_window_says_how_to_add_it(qgis, package_name):
    answer = qgis.window(
        """
        from qgis.utils import startPlugin, unloadPlugin, loadPlugin
        unloadPlugin("bare_earth")
        sys.modules[given["name"]] = None
        answer["started"] = loadPlugin("bare_earth") and startPlugin("bare_earth")
        answer["messages"] = messages()
        """,
        name=package_name,
    )
    (message,) = answer["messages"]
    assert answer["started"]
    assert f"no {package_name}" in message and f"install python3-{package_name}" in message
