"""Lists of point clouds: virtual point clouds (VPC), and items and collections of STAC.

A list can name any address. Those on servers that the user did not name are followed only if the
user says so, and no list on a server leads to files of this computer.

References
----------
https://github.com/PDAL/wrench/blob/main/vpc-spec.md
STAC 1.0 and 1.1 with the extension "projection"
"""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path
from typing import Any, Iterator, NamedTuple

from ..core.errors import BareEarthError
from ..core.points import Box
from ..crs.provider import library
from ..crs.stated import stated_wkt
from ..crs.system import Crs, crs_of_wkt
from ..las.sources import open_source
from ..survey.area import Area
from ..survey.shapes import Place, Shapes
from .addresses import checked, ends_with, host_of, is_address, name_of, referred, shown
from .copc import area_of
from .ept import DESCRIPTION
from .transfers import Transfers

# Endings and media types of clouds of which parts can be read.
_ENDINGS, _MEDIA = (".copc.laz", DESCRIPTION), ("application/vnd.laszip+copc",)
_MOST_BYTES, _MOST_ITEMS, _MOST_PAGES = 1 << 26, 5_000, 100


class Cloud(NamedTuple):
    """A point cloud in a list."""

    address: str  # or a path of this computer
    crs: str | None = None  # as code or well-known text, if the list says it
    box: Box | None = None  # in this CRS

    def may_touch(self, area: Area | None) -> bool:
        """Return whether an area can have points of the cloud, as far as the list says."""
        if area is None or self.box is None:
            return True
        crs = None
        if isinstance(area.polygons, Shapes):
            if self.crs is None or library() is None:
                return True
            crs = crs_of_wkt(stated_wkt(self.crs) or "")
        west, south, east, north = self.box
        # Lists round.
        box = west - 1, south - 1, east + 1, north + 1
        located = area_of(area, Place(name_of(self.address), crs or Crs(), box))
        return located is None or located.may_touch(box)


def clouds_of(
    address: str, transfers: Transfers, follows: bool, how: str = "run it again with --follow"
) -> list[Cloud]:
    """Return the point clouds at an address, or at the path of a file: itself, or those of a list;
    refuse a list that leads to servers that the user did not name, and say `how` it may.
    """
    if ends_with(address, ".laz", ".las") or name_of(address).lower() == DESCRIPTION:
        return [Cloud(address)]
    reader = _Reader(address, transfers, follows)
    clouds = list(dict.fromkeys(cloud for item in reader.items() for cloud in reader.clouds(item)))
    if reader.strange_hosts:
        hosts = ", ".join(sorted(reader.strange_hosts))
        raise BareEarthError(
            f"{shown(address)} names files on other servers: {hosts}. If you trust them, {how}."
        )
    if not clouds:
        raise BareEarthError(
            f"{shown(address)} lists no COPC and no EPT point cloud. Give the address of one, or of"
            " a virtual point cloud, a STAC item or collection with such files."
        )
    return clouds


class _Reader:
    """Reads a list."""

    def __init__(self, address: str, transfers: Transfers, follows: bool) -> None:
        self._address, self._transfers, self._follows = address, transfers, follows
        self.strange_hosts: set[str] = set()

    def items(self) -> list[tuple[str, dict[str, Any]]]:
        """Return the items, each with the address of the document in which it stands."""
        found: list[tuple[str, dict[str, Any]]] = []
        pages, seen = [self._address], set()
        while pages:
            address = pages.pop(0)
            if address in seen:
                continue
            seen.add(address)
            content = self._read(address)
            if content.get("type") == "Feature":
                found.append((address, content))
            elif content.get("type") == "FeatureCollection":
                found += [(address, item) for item in _list_of(content, "features")]
                pages += self._links(address, content, "next")
            elif content.get("type") in ("Collection", "Catalog"):
                pages += self._links(address, content, "items")
                items = self._links(address, content, "item")
                self._check(len(found) + len(items), 0)
                read = self._transfers.run([partial(self._read, item) for item in items])
                found += zip(items, read)
                if isinstance(content.get("assets"), dict):
                    found.append((address, content))
            else:
                raise self._no_list(address)
            self._check(len(found), len(seen))
        return found

    def _check(self, items: int, pages: int) -> None:
        if items > _MOST_ITEMS or pages > _MOST_PAGES:
            raise BareEarthError(
                f"{shown(self._address)} lists more than {_MOST_ITEMS:,} point clouds. Give a part"
                " of the list, such as the answer to a search for the area."
            )

    def clouds(self, item: tuple[str, dict[str, Any]]) -> Iterator[Cloud]:
        """Yield the point clouds of an item."""
        base, content = item
        assets = content.get("assets") if isinstance(content, dict) else None
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
        # Some name COPC without its ending; what is none is refused when it is opened.
        for asset in right or [asset for asset in known if ends_with(asset["href"], ".laz")]:
            properties = content.get("properties")
            about = {**(properties if isinstance(properties, dict) else {}), **asset}
            for place in self._followed(base, asset["href"]):
                yield Cloud(place, _crs_of(about), _box_of(about.get("proj:bbox")))

    def _links(self, base: str, content: dict[str, Any], relation: str) -> list[str]:
        return [
            place
            for link in _list_of(content, "links")
            if isinstance(link, dict) and link.get("rel") == relation
            if isinstance(link.get("href"), str)
            for place in self._followed(base, link["href"])
        ]

    def _followed(self, base: str, reference: str) -> Iterator[str]:
        """Yield the address or path to which a document refers, unless its server is strange."""
        if not is_address(base) and not is_address(reference):
            yield str(Path(base).parent / reference)
            return
        place = checked(referred(base, reference) if is_address(base) else reference)
        named = host_of(self._address) if is_address(self._address) else None
        if self._follows or host_of(place) == named:
            yield place
        else:
            self.strange_hosts.add(host_of(place))

    def _read(self, address: str) -> dict[str, Any]:
        """Return a document."""
        try:
            if is_address(address):
                text = self._transfers.read_whole(address, _MOST_BYTES)
            else:
                with open_source(Path(address)) as file:
                    text = file.read()
            content = json.loads(text.decode("utf-8-sig"))
        except (ValueError, RecursionError) as error:
            raise self._no_list(address) from error
        if not isinstance(content, dict):
            raise self._no_list(address)
        return content

    def _no_list(self, address: str) -> BareEarthError:
        return BareEarthError(
            f"{shown(address)} is neither a point cloud nor a list of some. Give the address of a"
            " .copc.laz file, an ept.json, a .vpc, or a STAC item or collection."
        )


def _list_of(content: dict[str, Any], name: str) -> list[Any]:
    found = content.get(name)
    return found if isinstance(found, list) else []


def _crs_of(about: dict[str, Any]) -> str | None:
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
