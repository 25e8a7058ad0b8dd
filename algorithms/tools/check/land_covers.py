"""Which checkpoints lie on vegetated land, by their land covers in several languages.

ASPRS (2023): Positional Accuracy Standards for Digital Geospatial Data, edition 2, version 1.0:
land without vegetation (NVA) is bare earth, sand, rock, short grass and urban land; vegetated land
(VVA) is tall weeds and crops, brush and forest.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import NamedTuple, Sequence

from ...core.progress import Progress
from ...core.words import option
from .checkpoints import Checkpoints
from .columns import VOCABULARY, parts_of

NVA = "NVA"
VVA = "VVA"
CONTROL = "control"
UNKNOWN = ""
# What the name or the use of a point says, beside `CONTROL`.
_CHECK = "check"
_EITHER = "either"

# Abbreviations for the accuracy on both kinds of land in the standard and its predecessor.
_STATED = {"nva": NVA, "fva": NVA, "vva": VVA}
_MOST_NAMES = 10
_UMLAUTS = re.compile("([aou])e")


def _key(word: str) -> str:
    """Return a word in lower case, with a, o and u for ae, oe and ue, as for ä, ö and ü."""
    return _UMLAUTS.sub(r"\1", word.lower())


def _words(text: str) -> list[str]:
    """Return the words of a text in lower case."""
    return [_key(part) for part in parts_of(text) if part.isalpha()]


_LISTS = {
    name: frozenset(map(_key, words.split())) for name, words in VOCABULARY["land covers"].items()
}
# Endings of compound words of each kind: Nadelwald, Waldweg.
_ENDS = tuple(
    (kind, tuple(VOCABULARY["land covers"][name].split()))
    for kind, name in ((VVA, "ends of vegetated"), (NVA, "ends of open"))
)
# With these endings the word before them decides: Maisfeld, Waldboden, cornfield.
_NEUTRAL_ENDS = re.compile(
    "(.{3,})(?:felder|feld|fields|field|flachen|flache|gebiet|bestand|boden|rand|veld|velden|zone"
    "|acker|akker|reihe|streifen|saum)"
)
_WITHOUT = re.compile("(.{3,})(?:less|los|lose|loses|losen|frei|freie|freies)|(?:un|non|on)(.+)")
_BETWEEN = re.compile(r"[,;/+&()|:]|\s[-\u2013]\s")


class LandCovers(NamedTuple):
    """Decides whether checkpoints lie on vegetated land, by their use and land cover."""

    # Words of vegetated land covers, and of no others; empty for the known words.
    words: tuple[str, ...] = ()

    def kind(self, use: str, cover: str) -> str | None:
        """Return `NVA`, `VVA`, `CONTROL`, `UNKNOWN` for an unknown land cover, or None without any,
        from the use of a checkpoint, such as Check or NVA, and its land cover.
        """
        used, named = _words(use), _words(cover)
        says_more = not {*named} <= _LISTS["control"] | _LISTS["point"]
        if _is_control(used) or (_is_control(named) and not says_more):
            return CONTROL
        return (self._land(use) if used else None) or self._land(cover)

    def _land(self, text: str) -> str | None:
        """Return the kind of land that a text names."""
        words = _words(text)
        explicit = _stated(text)
        if len(explicit) == 1:
            return explicit.pop()
        if not text.strip() or (words and {*words} <= _LISTS["check"] | _LISTS["point"]):
            return None
        if not self.words and _has("tall", words) and _has("low plants", words):
            return VVA
        if not self.words and len(words) == 1 and _has("vegetated alone", words):
            return VVA
        kinds = set(map(self._of_part, _parts(text)))
        if VVA in kinds:
            return VVA
        return NVA if NVA in kinds or self.words else UNKNOWN

    def _of_part(self, words: list[str]) -> str:
        """Return the kind of land that a few words name together."""
        kinds = [self._of_word(word) for word in words]
        for place, word in enumerate(words):
            if word in _LISTS["not"] and VVA in kinds[place + 1 :]:
                kinds[kinds.index(VVA, place + 1)] = NVA
            if word in _LISTS["free"] and place and kinds[place - 1] == VVA:
                kinds[place - 1] = NVA
        marked = [place for place, kind in enumerate(kinds) if kind]
        if not marked:
            return UNKNOWN
        first = marked[0]
        between = words[first + 1 : marked[1]] if marked[1:] else []
        is_first = words[first] in _LISTS["first decides"] or _has("of", between)
        last = marked[-1]
        if VVA in kinds and words[last] in _LISTS["low plants"]:  # marsh grass
            return VVA
        return kinds[first if is_first else last]

    def _of_word(self, word: str) -> str:
        """Return the kind of land that a word names."""
        if self.words:
            return VVA if any(_is_same(word, _key(given)) for given in self.words) else UNKNOWN
        for kind, known in ((VVA, "vegetated"), (NVA, "open")):
            if _has(known, _singular(word)):
                return kind
        without = _WITHOUT.fullmatch(word)
        if without and self._of_word(without[1] or without[2]) == VVA:
            return NVA
        for kind, ends in _ENDS:
            if word.endswith(ends):
                return kind
        neutral = _NEUTRAL_ENDS.fullmatch(word)
        return self._of_word(neutral[1]) if neutral else UNKNOWN


def kinds_of(
    checkpoints: Checkpoints, covers: LandCovers, progress: Progress
) -> tuple[list[str], dict[str, int]]:
    """Return `NVA`, `VVA` or `CONTROL` for each checkpoint, if need be by the names of checkpoints,
    and the unknown land covers, which a warning names.
    """
    uses = checkpoints.types or [""] * checkpoints.count
    found = list(map(covers.kind, uses, checkpoints.covers))
    if not any(found) and not any(checkpoints.covers):
        stated = (map(_STATED.get, map(_key, parts_of(name))) for name in checkpoints.names)
        found = [next(filter(None, kinds), None) for kinds in stated]
        if any(found):
            progress.info("The names of the checkpoints say which of them are NVA or VVA.")
    found = _with_named_control(checkpoints, found, progress)
    unknown = Counter(
        cover or use for use, cover, kind in zip(uses, checkpoints.covers, found) if kind == UNKNOWN
    )
    bare = found.count(None)
    if bare == len(found):
        progress.info("The checkpoints have no land cover: all count as without vegetation.")
    elif bare:
        progress.info(f"Checkpoints without a land cover, which count as not vegetated: {bare:,}.")
    if unknown:
        names = [f"{name} ({count:,})" for name, count in unknown.most_common(_MOST_NAMES)]
        more = len(unknown) - len(names)
        progress.warning(
            f"Unknown land covers count as not vegetated: {', '.join(names)}"
            f"{f' and {more:,} more' if more else ''}. If some are vegetated, name"
            f" their words with {option('vegetated')}."
        )
    return [kind or NVA for kind in found], dict(unknown.most_common())


def _with_named_control(
    checkpoints: Checkpoints, kinds: list[str | None], progress: Progress
) -> list[str | None]:
    """Return the kinds with `CONTROL` for points whose name or use says so beside check points."""
    uses = checkpoints.types or [""] * checkpoints.count
    sides = [
        _side(use) or (_CHECK if _stated(cover) else _side(name))
        for use, cover, name in zip(uses, checkpoints.covers, checkpoints.names)
    ]
    is_split = {CONTROL, _CHECK} <= {*sides} or {CONTROL, _EITHER} <= {*sides}
    fitted = CONTROL if is_split else _EITHER if {_CHECK, _EITHER} <= {*sides} else None
    is_new = [
        fitted is not None and side == fitted and kind != CONTROL
        for side, kind in zip(sides, kinds)
    ]
    if any(is_new):
        progress.info(
            f"The names of {is_new.count(True):,} checkpoints say that they are control points,"
            " since check points stand beside them."
        )
    return [CONTROL if new else kind for new, kind in zip(is_new, kinds)]


def _side(text: str) -> str | None:
    """Return what a name or a use says that a point is for; None if it says nothing."""
    words = _words(text)
    checks = _LISTS["check"].intersection(words)
    if _stated(text) or checks - _LISTS["either"]:
        return _CHECK
    if checks:
        return _CHECK if _has("control", words) else _EITHER
    return CONTROL if _has("control", words) or _has("control beside check", words) else None


def _stated(text: str) -> set[str]:
    """Return the kinds of land that a text states by their abbreviations."""
    return {_STATED[word] for word in _words(text) if word in _STATED}


def _has(name: str, words: Sequence[str]) -> bool:
    """Return whether one of the words is in a list."""
    return not _LISTS[name].isdisjoint(words)


def _parts(text: str) -> list[list[str]]:
    """Return the words of each part of a text that separators or a word for "and" divide."""
    found: list[list[str]] = []
    for part in _BETWEEN.split(text):
        found.append([])
        for word in _words(part):
            if word in _LISTS["and"]:
                found.append([])
            else:
                found[-1].append(word)
    return list(filter(None, found))


def _singular(word: str) -> tuple[str, ...]:
    """Return a word, and the words whose plural it may be."""
    return tuple(word[: len(word) - len(end)] for end in ("", "s", "x", "es") if word.endswith(end))


def _is_same(word: str, wanted: str) -> bool:
    """Return whether a word is one that the user gave, or a compound that ends with it."""
    return (len(wanted) > 3 and word.endswith(wanted)) or wanted in _singular(word)


def _is_control(words: Sequence[str]) -> bool:
    """Return whether words name a control point, to which a survey was fitted."""
    return _has("control", words) and not _has("check", words)
