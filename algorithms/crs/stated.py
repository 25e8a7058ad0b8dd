"""The CRS that a user states, in place of the CRS in the files."""

from __future__ import annotations

import functools
import re
from numbers import Integral

from ..core.errors import BareEarthError
from ..core.words import option
from .provider import library, wkt_of_epsg, wkt_of_text
from .wkt import read_wkt

_CODE = re.compile(r"(?:EPSG:{1,2})?([0-9]{1,9})", re.IGNORECASE)
# A library would fetch such a text from another computer.
_REMOTE = re.compile(r"[a-z][a-z0-9+.-]+://|/vsi", re.IGNORECASE)
_LONGEST_SHOWN = 60


def how_to_state() -> str:
    """Return how a user states the CRS, for the end of a sentence."""
    return f"with {option('crs')}, such as EPSG:25832"


def crs_text(given: object) -> str | None:
    """Return a CRS as text, given as text, as an EPSG code, or as an object of pyproj."""
    if given is None or isinstance(given, str):
        return given
    if hasattr(given, "to_wkt"):
        return str(given.to_wkt())
    if isinstance(given, Integral) and not isinstance(given, bool):
        return f"EPSG:{given}"
    raise BareEarthError(f"crs must be an EPSG code or well-known text (WKT), not {given!r}.")


def stated_wkt(text: str | None) -> str | None:
    """Return the well-known text of a CRS that a user states, such as "EPSG:2230+6360", or None;
    refuse a text that is not a horizontal CRS, or that no installed library knows.
    """
    # The text is an EPSG code, with or without a vertical one, well-known text, or another text
    # that pyproj or GDAL understand, such as a PROJ string.
    text = (text or "").strip()
    return _wkt_of(text, library()) if text else None


@functools.lru_cache(maxsize=16)
def _wkt_of(text: str, library: object) -> str:
    """Return the well-known text; the result also depends on the installed library."""
    if read_wkt(text) is not None:
        return text
    code = _CODE.fullmatch(text)
    known = None
    if code:
        known = wkt_of_epsg(int(code[1]))
    elif not _REMOTE.match(text):
        known = wkt_of_text(text)
    if known is None or read_wkt(known) is None:
        short = text if len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}..."
        if library is None:
            raise BareEarthError(
                f"The CRS {short} cannot be looked up without pyproj: pip install pyproj, or give"
                " the CRS as well-known text (WKT)."
            )
        raise BareEarthError(
            f"{short} is no known CRS of points on a map. Give an EPSG code, such as EPSG:25832, or"
            " well-known text (WKT)."
        )
    return known
