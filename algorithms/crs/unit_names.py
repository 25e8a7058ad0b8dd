"""The names of units of length in texts, such as descriptions of bands and names of columns."""

from __future__ import annotations

import re

from .wkt import is_unit

# Metres.
FOOT = 0.3048
US_FOOT = 1200.0 / 3937.0
# Metres in a unit, by the letters of its name; a foot of unknown kind is the international one.
UNITS = {
    **dict.fromkeys(
        ("m", "metre", "metres", "meter", "meters", "metro", "metros", "metri", "mètre",
         "mètres", "mtr"),
        1.0,
    ),
    **dict.fromkeys(("cm", "centimetre", "centimetres", "centimeter", "centimeters"), 0.01),
    **dict.fromkeys(("mm", "millimetre", "millimetres", "millimeter", "millimeters"), 0.001),
    **dict.fromkeys(
        ("ft", "foot", "feet", "ift", "intlft", "intlfoot", "intlfeet", "internationalft",
         "internationalfoot", "internationalfeet", "fuss", "fuß", "pied", "pieds", "pies"),
        FOOT,
    ),
    **dict.fromkeys(
        ("ftus", "usft", "sft", "ussft", "footus", "usfoot", "feetus", "usfeet", "sfeet",
         "surveyft", "surveyfoot", "surveyfeet", "ussurveyft", "ussurveyfoot", "ussurveyfeet"),
        US_FOOT,
    ),
}  # fmt: skip
# As `unit_symbol` writes units without a name.
_SIZE = re.compile(r"units of ([0-9.eE+-]+) m$")
_AFTER = re.compile(r"[(\[]([^)\]]*)[)\]]|,\s*(.*)$|\bin\s+(.*)$", re.IGNORECASE)
_LETTERS = re.compile(r"[^\W_]+")


def unit_in(text: str) -> float | None:
    """Return the metres in the unit that a text states, such as "Elevation [US survey feet]" or
    "ft"; None if it states none, such as "DTM of 1 m".
    """
    # The unit is the whole text, or stands in brackets, after a comma or "in", or at the end.
    text = text.strip()
    size = _SIZE.search(text)
    if size:
        metres = float(size[1])
        return metres if is_unit(metres) else None
    parts = [_words(part) for match in _AFTER.findall(text) for part in match if part]
    words = _words(text)
    # Words such as "above sea level" can follow the unit.
    starts = ["".join(part[:count]) for part in parts for count in (3, 2, 1)]
    ends = [
        "".join(words[-count:])
        for count in (3, 2, 1)
        if len(words) == count or (len(words) > count and not words[-count - 1][0].isdigit())
    ]
    return next((UNITS[word] for word in (*starts, *ends) if word in UNITS), None)


def _words(text: str) -> list[str]:
    """Return the words of a text in lower case; "U.S." is one word."""
    return [word.lower() for word in _LETTERS.findall(text.replace(".S.", "S"))]
