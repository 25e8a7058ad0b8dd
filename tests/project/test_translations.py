"""The translations of the plugin: mostly there, and well formed; one that is missing is English."""

import re

import pytest
import qm
import translations

from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.tools.ground.dialogs import METHOD_TOOLS

ALL = {name.stem.rpartition("_")[2]: qm.read_ts(name.read_bytes()) for name in translations.FILES}
# Without those that wait for their translator.
TEXTS = {language: [text for text in ALL[language] if text.translation] for language in ALL}


@pytest.fixture(params=sorted(TEXTS))
def language(request):
    return request.param


def test_there_are_german_and_french():
    assert {"de", "fr"} <= set(TEXTS)


def share_translated(language, texts):
    return len(texts & {text.source for text in TEXTS[language]}) / len(texts)


def test_each_text_is_there_once(language):
    sources = [text.source for text in ALL[language]]
    assert len(sources) == len(set(sources)) > 300


@pytest.mark.rest(but="fr")
def test_most_of_what_the_plugin_says_has_a_translation(language):
    assert share_translated(language, translations.written_texts()) > 0.9


def test_most_labels_of_the_ground_filters_have_a_translation(language):
    labels = set()
    for tool in METHOD_TOOLS:
        labels |= {tool.title, tool.line}
    for method in METHODS.values():
        labels.add(method.label)
        for declaration in method.parameters.declarations():
            labels |= {declaration.label, *declaration.choices.values()}
    assert share_translated(language, labels) > 0.9


@pytest.mark.parametrize(
    "pattern", [r"\{[^}]*\}", r"</?\w+/?>", r"\n", r"\*\.\w+", r"-?-\w+ \w+\.\w+"]
)
def test_placeholders_and_marks_are_those_of_the_text(language, pattern):
    for text in TEXTS[language]:
        wanted = sorted(re.findall(pattern, text.source))
        assert sorted(re.findall(pattern, text.translation)) == wanted, text


def test_numbers_are_those_of_the_text(language):
    def numbers(text):
        # In the way of the language: 1.000 and 1 000 are 1,000, and 0,5 is 0.5.
        text = re.sub(r"(?<=\d)[.,\s](?=\d{3}\b)", "", re.sub(r"\{.*?\}", "", text))
        return sorted(re.findall(r"\d+", text.replace("7 and 18", "7, 18")))

    for words in TEXTS[language]:
        if "type I" not in words.source.replace("Type", "type"):
            assert numbers(words.translation) == numbers(words.source), words


def test_a_text_ends_as_the_translation_does(language):
    for text in TEXTS[language]:
        for mark in (".", "…", "]", ")"):
            assert text.translation.endswith(mark) == text.source.endswith(mark), text
