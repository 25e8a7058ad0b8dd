"""The translations of the plugin: complete, and as good for the machine as the English texts."""

import re

import pytest
import qm
import translations

from bare_earth.algorithms.core.parameters import ParameterSet
from bare_earth.algorithms.filters import METHODS

TEXTS = {name.stem.rpartition("_")[2]: qm.read_ts(name.read_bytes()) for name in translations.FILES}


@pytest.fixture(params=sorted(TEXTS))
def language(request):
    return request.param


def test_there_are_german_and_french():
    assert {"de", "fr"} <= set(TEXTS)


def test_no_text_is_without_translation(language):
    assert [text.source for text in TEXTS[language] if not text.translation.strip()] == []


def test_each_language_has_the_same_texts(language):
    sources = [text.source for text in TEXTS[language]]
    assert len(sources) == len(set(sources)) > 300
    assert sources == [text.source for text in TEXTS["de"]]


def test_what_the_plugin_says_has_a_translation(language):
    assert translations.written_texts() <= {text.source for text in TEXTS[language]}


def test_labels_and_help_of_the_ground_filters_have_a_translation(language):
    sources = {text.source for text in TEXTS[language]}
    for method in METHODS.values():
        assert issubclass(method.parameters, ParameterSet)
        for declaration in method.parameters.declarations():
            assert {declaration.label, declaration.help, *declaration.choices.values()} <= sources
        told = method.toolbox
        assert {method.label, told.title, told.summary, told.about, *told.words} <= sources


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
