"""Lists of point clouds: virtual point clouds (VPC), and items and collections of STAC.

A list can name any address. Those on servers that the user did not name are followed only if the
user allows it. Lists on servers cannot name files of this computer.

References
----------
https://github.com/PDAL/wrench/blob/main/vpc-spec.md
STAC 1.0 and 1.1 with the extension "projection"
"""

from __future__ import annotations

import contextlib
from functools import partial
from pathlib import Path
from typing import Iterator, NamedTuple

from ..core.errors import BareEarthError
from ..core.points import Box
from ..core.words import counted
from ..crs.provider import library
from ..crs.stated import stated_wkt
from ..crs.system import Crs, crs_of_wkt
from ..survey.area import Area
from ..survey.shapes import Place, Shapes
from .addresses import checked, ends_with, is_address, name_of, origin_of, referred, shown
from .answers import Document, parsed
from .copc import area_of
from .ept import DESCRIPTION
from .files import read_local
from .transfers import Transfers

# Endings and media types of point clouds that can be read in parts.
_ENDINGS = (".copc.laz", DESCRIPTION)
_MEDIA = ("application/vnd.laszip+copc",)
_MOST_ITEMS = 5_000  # most items of a list
_MOST_PAGES = 100  # most documents of a list
# Most bytes of a list, and of a document with a single item; six are in memory at a time.
_MOST_LIST = 1 << 25
_MOST_ITEM = 1 << 22
# Lists may round extents by so much, in units of the CRS or in degrees.
_ROUNDED = 1.0
_ROUNDED_DEGREES = 1e-5
_MOST_DEGREES = 361.0  # coordinates up to this value may be degrees
# Most point clouds whose headers are read if none is near the area by the list.
_MOST_ASKED = 100


class Cloud(NamedTuple):
    """A point cloud in a list."""

    address: str  # or a path on this computer
    crs: str | None = None  # code or well-known text, if the list states it
    box: Box | None = None  # extent in this CRS

    def may_touch(self, area: Area | None) -> bool:
        """Return whether the cloud may have points in an area, as far as the list states this."""
        if area is None or self.box is None:
            return True
        crs = None
        if self.crs is not None and library() is not None:
            with contextlib.suppress(BareEarthError):  # the CRS is not known here
                crs = crs_of_wkt(stated_wkt(self.crs) or "")
        west, south, east, north = self.box
        more = _ROUNDED_DEGREES if crs is not None and crs.is_geographic else _ROUNDED
        box = west - more, south - more, east + more, north + more
        has_crs = isinstance(area.polygons, Shapes)
        if has_crs and crs is None:
            return True
        # An area without a CRS is in that of the points. If the list is in degrees, they cannot be
        # compared.
        stated = area.box or (box if has_crs else area.bounds)
        is_in_degrees = crs.is_geographic if crs else max(map(abs, box)) <= _MOST_DEGREES
        if is_in_degrees and max(map(abs, stated)) > _MOST_DEGREES:
            return True
        located = area_of(area, Place(name_of(self.address), crs or Crs(), box))
        return located is None or located.may_touch(box)


def clouds_of(address: str, transfers: Transfers) -> list[Cloud]:
    """Return the point cloud at an address or path, or those of a list; refuse a list that names
    servers that the user did not name, unless that is allowed.
    """
    if ends_with(address, ".laz", ".las") or name_of(address).lower() == DESCRIPTION:
        return [Cloud(address)]
    reader = _ListReader(address, transfers)
    clouds = reader.clouds()
    if reader.strange:
        raise BareEarthError(
            f"{shown(address)} names files on other servers: {', '.join(sorted(reader.strange))}."
            f" If you trust them, {transfers.refusal}."
        )
    if not clouds:
        raise BareEarthError(
            f"{shown(address)} lists no COPC and no EPT point cloud. Give the address of one, or of"
            " a virtual point cloud, a STAC item or collection with such files."
        )
    if reader.twice_count:
        transfers.progress.warning(
            f"{shown(address)} has {counted(reader.twice_count, 'item')} both as COPC and as EPT:"
            " COPC is taken."
        )
    return clouds


def near(clouds: list[Cloud], area: Area | None) -> list[Cloud]:
    """Return the point clouds that may have points in an area; all, if there are not too many, if
    none has by the list, which may state extents in another CRS.
    """
    found = [cloud for cloud in clouds if cloud.may_touch(area)]
    return found or (clouds if len(clouds) <= _MOST_ASKED else [])


class _ListReader:
    """Reads a list."""

    def __init__(self, address: str, transfers: Transfers) -> None:
        self._address, self._transfers = address, transfers
        self.strange: set[str] = set()  # servers that the user did not name
        self.twice_count = 0  # items with several files; one is used

    def clouds(self) -> list[Cloud]:
        """Return the point clouds of all items, each once."""
        found: dict[Cloud, None] = {}
        pages, seen = [self._address], set()
        while pages:
            address = pages.pop(0)
            if address in seen:
                continue
            seen.add(address)
            content, items = self._read(address), []
            if content.get("type") == "Feature":
                found.update(dict.fromkeys(self._clouds(address, content)))
            elif content.get("type") == "FeatureCollection":
                features = _list_of(content, "features")
                self._check(len(features), len(seen))
                for item in features:
                    found.update(dict.fromkeys(self._clouds(address, item)))
                pages += self._links(address, content, "next")
            elif content.get("type") in ("Collection", "Catalog"):
                pages += self._links(address, content, "items")
                items = self._links(address, content, "item")
                self._check(len(items), 0)
                for clouds in self._transfers.run([partial(self._item, item) for item in items]):
                    found.update(dict.fromkeys(clouds))
                if isinstance(content.get("assets"), dict):
                    found.update(dict.fromkeys(self._clouds(address, content)))
            else:
                raise self._no_list(address)
            self._check(len(found), len(seen))
        return [*found]

    def _item(self, address: str) -> list[Cloud]:
        """Return the point clouds of an item that is a document of its own."""
        return [*self._clouds(address, self._parsed(address, _MOST_ITEM))]

    def _check(self, items: int, pages: int) -> None:
        if items > _MOST_ITEMS or pages > _MOST_PAGES:
            raise BareEarthError(
                f"{shown(self._address)} lists more than {_MOST_ITEMS:,} point clouds. Give a part"
                " of the list, such as the answer to a search for the area."
            )

    def _clouds(self, base: str, content: object) -> Iterator[Cloud]:
        """Yield the point clouds of an item in a document."""
        if not isinstance(content, dict):
            return
        assets = content.get("assets")
        known = [
            asset
            for asset in (assets.values() if isinstance(assets, dict) else ())
            if isinstance(asset, dict) and isinstance(asset.get("href"), str)
            if "overview" not in (asset.get("roles") or ())
        ]
        right = [
            asset
            for asset in known
            if ends_with(asset["href"], *_ENDINGS) or asset.get("type") in _MEDIA
        ]
        without_ept = [asset for asset in right if not ends_with(asset["href"], DESCRIPTION)]
        if without_ept and len(without_ept) < len(right):
            self.twice_count += 1
            right = without_ept
        # The ending may be missing in names of COPC files. Other files are refused when opened.
        for asset in right or [asset for asset in known if ends_with(asset["href"], ".laz")]:
            properties = content.get("properties")
            about = {**(properties if isinstance(properties, dict) else {}), **asset}
            for place in self._followed(base, asset["href"]):
                yield Cloud(place, _crs_of(about), _box_of(about.get("proj:bbox")))

    def _links(self, base: str, content: Document, relation: str) -> list[str]:
        return [
            place
            for link in _list_of(content, "links")
            if isinstance(link, dict) and link.get("rel") == relation
            if isinstance(link.get("href"), str)
            for place in self._followed(base, link["href"])
        ]

    def _followed(self, base: str, reference: str) -> Iterator[str]:
        """Yield the address or path that a document names, unless its server is not allowed."""
        if not is_address(base) and not is_address(reference):
            yield str(Path(base).parent / reference)
            return
        place = checked(referred(base, reference) if is_address(base) else reference)
        named = origin_of(self._address) if is_address(self._address) else None
        if self._transfers.refusal is None or origin_of(place) == named:
            yield place
        else:
            self.strange.add(origin_of(place))

    def _read(self, address: str) -> Document:
        """Return a document, while the caller can cancel."""
        return self._transfers.one(lambda: self._parsed(address, _MOST_LIST))

    def _parsed(self, address: str, most: int) -> Document:
        if is_address(address):
            text = self._transfers.read_whole(address, most)
        else:
            text = read_local(Path(address), most)
        try:
            return parsed(text)
        except ValueError as error:
            raise self._no_list(address) from error

    def _no_list(self, address: str) -> BareEarthError:
        return BareEarthError(
            f"{shown(address)} is neither a point cloud nor a list of some. Give the address of a"
            " .copc.laz file, an ept.json, a .vpc, or a STAC item or collection."
        )


def _list_of(content: Document, name: str) -> list[object]:
    found = content.get(name)
    return found if isinstance(found, list) else []


def _crs_of(about: Document) -> str | None:
    """Return the CRS that an item states."""
    for name in ("proj:wkt2", "proj:code"):
        if isinstance(about.get(name), str) and about[name]:
            return str(about[name])
    return f"EPSG:{about['proj:epsg']}" if isinstance(about.get("proj:epsg"), int) else None


def _box_of(bounds: object) -> Box | None:
    """Return smallest x and y, largest x and y, of a box with or without heights."""
    if not isinstance(bounds, list) or len(bounds) not in (4, 6):
        return None
    if not all(isinstance(number, (int, float)) for number in bounds):
        return None
    half = len(bounds) // 2
    west, south, east, north = map(float, (*bounds[:2], *bounds[half : half + 2]))
    return west, south, east, north
