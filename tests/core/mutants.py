"""Sound files of all kinds, and files of which some bytes are wrong.

A mutant is known by its seed and its number: `mutant(originals, seed, number)` gives the same bytes
each time. `campaign.py` works on them.
"""

import json
import pickle
import struct
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from conftest import las_bytes, vlr
from copcs import many_nodes

WKT = b'PROJCS["p",GEOGCS["g",UNIT["degree",0.01745]],UNIT["metre",1],AUTHORITY["EPSG","25832"]]'
KEYS = struct.pack("<12H", 1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 25832)
EXTRA = struct.pack("<2xBB32s156x", 3, 0, b"amount")
RING = [[4e5 - 5, 5e6 - 5], [4e5 + 20, 5e6 - 5], [4e5 + 20, 5e6 + 20], [4e5 - 5, 5e6 - 5]]
# What a counter, a length, a place or a coordinate may be at its worst.
NUMBERS = {
    "<B": (0, 1, 0x7F, 0x80, 0xFF),
    "<H": (0, 1, 0x7FFF, 0xFFFF),
    "<I": (0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 10**6, 10**9),
    "<Q": (0, 1, 1 << 31, 1 << 40, (1 << 63) - 1, 1 << 63, (1 << 64) - 1),
    "<d": (0.0, -1.0, 1e-300, 1e300, float("inf"), float("nan"), 1e6, 1e12, -1e12),
}
# How often each kind of file is taken.
SHARES = {
    ".las": 0.2,
    ".laz": 0.35,
    ".copc.laz": 0.25,
    ".vpc": 0.08,
    ".geojson": 0.12,
}
WORDS = (
    b"null", b"-1", b"1e999", b"1e-400", b"NaN", b"Infinity", b"9" * 400, b"{}", b"[]", b"[[[[",
    b"]]", b"}", b'"', b"\\ud800", b"\\u0000", b"\0", b"\xff\xfe", b"..", b"/", b"http://a.b/",
    b"/vsicurl/http://a.b/c.laz", b"file:///", b"%2e%2e%2f", b"%00", b"\n", b"((((", b"))", b",",
    b"MULTI", b"UNIT[", b"AUTHORITY[", b"[" * 3000, b"(" * 3000, b"true", b"x" * 5000,
)  # fmt: skip


class Original(NamedTuple):
    """A sound file: what its name ends with, its bytes, and where its parts are."""

    suffix: str
    content: bytes
    parts: dict


def originals(folder):
    """Return sound files of all kinds; it uses threads, so let a process of its own call it."""
    records = [vlr(b"LASF_Projection", 2112, WKT), vlr(b"LASF_Projection", 34735, KEYS)]
    extra = vlr(b"LASF_Spec", 4, EXTRA)
    found = []
    for point_format in (0, 1, 3, 4, 6, 7, 8, 10):
        for compressed in (False, True):
            is_new = point_format > 5
            content = las_bytes(
                version=4 if is_new else 3,
                point_format=point_format,
                compressed=compressed,
                extra=2,
                vlrs=[*records, extra],
                evlrs=_evlrs() if is_new else (),
                encoding=0x10 if is_new else 0,
                chunk_size=17,
            )
            found.append(_las(".laz" if compressed else ".las", content))
    for pages in (False, True):
        content = many_nodes(folder, 7, pages, vlrs=records, encoding=0x10)
        found.append(_las(".copc.laz", content))
    found += [_text(suffix, content) for suffix, content in _texts()]
    return found


def _evlrs():
    head = "<H16sHQ32s"
    wkt = struct.pack(head, 0, b"LASF_Projection", 2112, len(WKT), b"") + WKT
    return [wkt, struct.pack(head, 0, b"other", 7, 30, b"") + bytes(30)]


def _las(suffix, content):
    """Return a file of points, and where its parts are."""
    (header, start), size = struct.unpack_from("<HI", content, 94), len(content)
    parts = {"header": (0, min(header, 375)), "records": (header, start)}
    points_end = size
    if content[25] == 4 and struct.unpack_from("<I", content, 243)[0]:
        points_end = struct.unpack_from("<Q", content, 235)[0]
        parts["EVLRs"] = points_end, size
    if suffix != ".las":
        table = struct.unpack_from("<q", content, start)[0]
        parts["chunk table"] = table, points_end
        parts["chunk pointer"] = start, start + 8
        laszip = content.index(b"laszip encoded") + 52
        parts["LASzip record"] = laszip, laszip + 34 + 12
        points_end = table
    if suffix == ".copc.laz":
        parts["COPC info"] = 375 + 54, 375 + 54 + 160
        parts["hierarchy"] = struct.unpack_from("<QQ", content, 375 + 54 + 40)
        start_of, length = parts["hierarchy"]
        parts["hierarchy"] = start_of, start_of + length
    parts["points"] = start, points_end
    if WKT in content[:start]:
        at = content.index(WKT)
        parts["WKT"] = at, at + len(WKT)
    return Original(suffix, content, parts)


def _text(suffix, content):
    return Original(suffix, content, {"text": (0, len(content))})


def _texts():
    """Yield a virtual point cloud, polygons and lines, as text."""
    features = []
    for name in ("a.las", "b.laz"):
        asset = {"href": f"./{name}", "type": "application/vnd.laszip", "roles": ["data"]}
        box = [4e5 - 10, 5e6, 4e5, 5e6 + 8]
        properties = {"datetime": "2021-02-11T00:00:00Z", "pc:count": 60, "pc:type": "lidar",
                      "proj:epsg": 25832, "proj:wkt2": WKT.decode(), "proj:bbox": box}  # fmt: skip
        features.append(
            {"type": "Feature", "stac_version": "1.0.0", "id": name, "bbox": box,
             "properties": properties, "assets": {"data": asset}}
        )  # fmt: skip
    collection = {"type": "FeatureCollection", "features": features}
    yield ".vpc", json.dumps(collection).encode()
    polygon = {"type": "Polygon", "coordinates": [RING]}
    line = {"type": "LineString", "coordinates": [[*corner, 100.0] for corner in RING]}
    shapes = [{"type": "Feature", "geometry": value, "properties": {}} for value in (polygon, line)]
    yield ".geojson", json.dumps({"type": "FeatureCollection", "features": shapes}).encode()


def mutant(originals, seed, number):
    """Return the suffix and the bytes of a file of which some are wrong, and what was done."""
    random = np.random.default_rng([seed, number])
    suffix = random.choice(list(SHARES), p=list(SHARES.values()))
    of_kind = [source for source in originals if source.suffix == suffix]
    original = of_kind[random.integers(len(of_kind))]
    data, done = bytearray(original.content), []
    for _ in range(random.integers(1, 5)):
        name = list(original.parts)[random.integers(len(original.parts))]
        change = _change_text if name in ("text", "WKT") else _change_bytes
        place = original.parts[name]
        change(data, *place, random, keep_length=name == "WKT")
        done.append(name)
    if random.random() < 0.08 and len(data) > 1:
        del data[int(random.integers(len(data))) :]
        done.append("cut off")
    return original.suffix, bytes(data), done


def _change_bytes(data, low, high, random, keep_length):
    """Put a wrong number, other bits, or bytes from elsewhere into a part of a file."""
    high = min(high, len(data))
    if high - low < 8:
        return
    at, kind = int(random.integers(low, high - 7)), random.random()
    if kind < 0.55:
        layout = list(NUMBERS)[random.integers(len(NUMBERS))]
        value = NUMBERS[layout][random.integers(len(NUMBERS[layout]))]
        struct.pack_into(layout, data, at, value)
    elif kind < 0.75:
        data[at] ^= 1 << int(random.integers(8))
    elif kind < 0.9:
        number = struct.unpack_from("<I", data, at)[0] + int(random.integers(-3, 4))
        struct.pack_into("<I", data, at, number & 0xFFFFFFFF)
    elif kind < 0.93:  # as broken disks have it
        end = min(at + int(random.integers(16, 4096)), high)
        data[at:end] = (b"\0", b"\xff")[random.integers(2)] * (end - at)
    else:
        length = int(random.integers(1, 64))
        start = int(random.integers(len(data)))
        piece = data[start : start + length]
        end = at + (len(piece) if random.random() < 0.7 else 0)
        data[at : min(end, len(data))] = piece


def _change_text(data, low, high, random, keep_length):
    """Put what a text must not hold into it, leave a piece out, or repeat one."""
    high = min(high, len(data))
    if high <= low:
        return
    at, length = int(random.integers(low, high)), int(random.integers(0, 24))
    end, kind = min(at + length, high), random.random()
    if kind < 0.6:
        new = WORDS[random.integers(len(WORDS))]
    elif kind < 0.8:
        new = b""
    else:
        new = bytes(data[low:high] if kind > 0.95 else data[at:end] * 2)
    if keep_length:
        new = new[: end - at].ljust(end - at)
    data[at:end] = new


if __name__ == "__main__":
    place = Path(sys.argv[1])
    (place / "originals").write_bytes(pickle.dumps([tuple(fields) for fields in originals(place)]))
