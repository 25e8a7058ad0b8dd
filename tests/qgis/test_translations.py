"""The plugin in German and French, and no label that could not be translated."""

import re

import pytest
import qm
import translations
from qgis.core import QgsApplication
from qgis.PyQt.QtCore import QCoreApplication, QTranslator
from support import ALGORITHM, Log, Scene, remove

from bare_earth.plugin import i18n

_OPEN, _CLOSE = "⟦", "⟧"


class Marker(QTranslator):
    """Translates each text of the plugin into itself, in brackets."""

    def translate(self, context, text, disambiguation=None, n=-1):
        return f"{_OPEN}{text}{_CLOSE}" if context == i18n.CONTEXT else None


@pytest.fixture
def marked():
    marker = Marker()
    QCoreApplication.installTranslator(marker)
    yield
    QCoreApplication.removeTranslator(marker)


def algorithms(registry):
    return [algorithm.create() for algorithm in registry.providerById("bareearth").algorithms()]


def test_most_of_what_algorithms_show_has_a_translation(registry):
    shown = translations.asked_texts()
    for path in translations.FILES:
        there = {text.source for text in qm.read_ts(path.read_bytes()) if text.translation}
        assert len(shown & there) > 0.9 * len(shown), "make translations, then translate"


def test_no_label_is_shown_past_the_translator(registry, marked):
    for algorithm in algorithms(registry):
        for text in translations.visible_texts(algorithm):
            if text in algorithm.tags():
                continue
            left = re.sub(f"{_OPEN}[^{_CLOSE}]*{_CLOSE}", " ", text)
            assert not re.findall(r"[a-z]{2,}", left.lower()), text


@pytest.mark.parametrize(
    ("locale", "title", "label", "tag"),
    [
        ("de", "Boden klassifizieren (TIN-Verdichtung)", "Größte Gebäudebreite [m]", "Bodenfilter"),
        ("de_AT", "Boden klassifizieren (TIN-Verdichtung)", "Größte Gebäudebreite [m]", "dgm"),
        ("fr", "Classer le sol (densification de TIN)", "Taille maximale des bâtiments [m]", "mnt"),
    ],
)
def test_qgis_speaks_german_and_french(registry, speak, locale, title, label, tag):
    english = {tool.id(): translations.visible_texts(tool) for tool in algorithms(registry)}
    ids = {tool.id(): tool.groupId() for tool in algorithms(registry)}
    assert speak(locale)
    found = {tool.id(): tool for tool in algorithms(registry)}
    algorithm = found[ALGORITHM]
    size = algorithm.parameterDefinition("MAX_BUILDING_SIZE")
    assert algorithm.displayName() == title
    assert size.description() == label and f"<b>{label}</b>" in algorithm.shortHelpString()
    assert tag in algorithm.tags() and "lasground" in algorithm.tags()
    # Scripts and models know no language.
    assert {layer.id(): layer.groupId() for layer in found.values()} == ids
    assert algorithm.parameterDefinition("PRESET").options()[0] == "automatic"
    groups = {layer.group(): layer.groupId() for layer in found.values()}
    assert groups[min(groups)] == "allinone"  # first in the toolbox
    for name, text in found.items():
        assert text.displayName() != english[name][0]


@pytest.mark.parametrize("locale", ["en_US", "es", "C"])
def test_other_languages_see_english(algorithm, speak, locale):
    assert speak(locale) is None
    assert algorithm.create().displayName() == "Classify ground (TIN densification)"


def test_the_option_lang_of_qgis_counts_more_than_the_settings(algorithm, speak):
    speak("fr")
    QgsApplication.setTranslation("de")
    try:
        assert speak("fr")
        assert algorithm.create().displayName() == "Boden klassifizieren (TIN-Verdichtung)"
    finally:
        QgsApplication.setTranslation("")


@pytest.mark.parametrize("path", translations.FILES, ids=lambda path: path.stem)
def test_qt_finds_every_translation(path, speak):
    translator = speak(path.stem.rpartition("_")[2])
    for text in qm.read_ts(path.read_bytes()):
        assert i18n.tr(text.source) == (text.translation or text.source)
    assert not translator.translate(i18n.CONTEXT, "never said")


def test_a_run_speaks_and_takes_the_same_values(registry, speak, tmp_path, context):
    speak("de")
    scene, log = Scene(tmp_path, ".las"), Log()
    algorithm = registry.createAlgorithmById(ALGORITHM)
    values = {"INPUT": str(scene.path), "PRESET": "town", "OUTPUT": str(tmp_path / "out.las")}
    assert algorithm.checkParameterValues(values, context)[0]
    _, done = algorithm.run(values, context, log)
    assert done and f"of {scene.count:,} points" in log.text
    possible, text = algorithm.checkParameterValues({**values, "INPUT": "no.las"}, context)
    assert not possible and text == "no.las gibt es nicht. Prüfen Sie den Pfad."


def test_the_log_of_a_run_is_in_one_language(registry, marked, tmp_path, context):
    scene = Scene(tmp_path, ".las")
    ground, out = str(tmp_path / "ground.las"), str(tmp_path / "out.las")
    terrain = str(tmp_path / "dtm.tif")
    runs = {
        ALGORITHM: {"INPUT": str(scene.path), "OUTPUT": ground, "NOSUCH": 1},
        "bareearth:classifytiles": {
            "INPUT": [str(scene.path)], "OUTPUT_FOLDER": str(tmp_path / "tiles"),
        },
        "bareearth:pointcloudtoterrain": {"INPUT": str(scene.path), "DTM": terrain},
        "bareearth:terrainmodel": {"INPUT": ground, "DTM": terrain},
        "bareearth:heightaboveground": {"INPUT": ground, "OUTPUT": out},
        "bareearth:classifyaboveground": {"INPUT": ground, "OUTPUT": out},
        "bareearth:waterclasses": {"INPUT": ground, "OUTPUT": out},
        "bareearth:modelkeypoints": {"INPUT": ground, "OUTPUT": out},
        "bareearth:assess": {"CLASSIFIED": ground, "REFERENCE": ground},
        "bareearth:comparesettings": {
            "INPUT": str(scene.path), "OUTPUT": str(tmp_path / "page.html"),
            "SETTINGS": ["slope:town"],
        },
        "bareearth:relief": {"INPUT": terrain, "OUTPUT_FOLDER": str(tmp_path / "relief")},
        "bareearth:removeoffterrainobjects": {"INPUT": terrain, "OUTPUT": out + ".tif"},
        "bareearth:contours": {"INPUT": terrain, "OUTPUT": out + ".gpkg"},
        "bareearth:canopyheight": {
            "SURFACE": terrain, "TERRAIN": terrain, "OUTPUT": out + "c.tif",
        },
    }  # fmt: skip
    for name, values in runs.items():
        log = Log()
        registry.createAlgorithmById(name).run(values, context, log)
        assert "Time: " in log.text and _OPEN not in log.text, f"{name}: {log.text}"
    log = Log(cancel_at=0)
    registry.createAlgorithmById(ALGORITHM).run(runs[ALGORITHM], context, log)
    assert "Cancelled" in log.text and _OPEN not in log.text
    # What a dialog refuses is in its language; the same in a log is English.
    wrong = {**runs[ALGORITHM], "INPUT": "no.las"}
    algorithm, log = registry.createAlgorithmById(ALGORITHM), Log()
    assert algorithm.checkParameterValues(wrong, context)[1].startswith(_OPEN)
    assert algorithm.run(wrong, context, log)[1] is False
    assert any(text.startswith("no.las does not exist") for text in log.said)


def test_choices_of_a_dialog_are_in_german_and_give_the_same_values(registry, speak):
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    speak("de")
    dialog = AlgorithmDialog(registry.createAlgorithmById(ALGORITHM))
    wrapper = dialog.mainWidget().wrappers["PRESET"]
    box = wrapper.wrappedWidget()
    texts = [box.itemText(row) for row in range(box.count())]
    assert "Stadt" in texts
    box.setCurrentIndex(texts.index("Stadt"))
    assert wrapper.parameterValue() == "town"
    remove(dialog)


def test_a_new_text_waits_for_its_translator_and_one_that_is_gone_goes(tmp_path):
    for path in translations.FILES:
        copy = tmp_path / path.name
        copy.write_bytes(path.read_bytes())
        assert translations.update(copy, {"Preset", "Something new"}) == 1
        kept = {text.source: text.translation for text in qm.read_ts(copy.read_bytes())}
        assert kept["Preset"] and kept == {"Preset": kept["Preset"], "Something new": ""}


def test_a_text_without_translation_is_english(speak):
    speak("de")
    assert i18n.tr("Something new") == "Something new"
