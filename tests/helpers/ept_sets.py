"""EPT data sets of a few thousand points, on a server of `remote_server`."""

import functools
import io
import json

import laspy
import numpy as np

WKT = (
    'PROJCS["ETRS89 / UTM zone 32N",GEOGCS["ETRS89",DATUM["ETRS89",SPHEROID["GRS 1980",6378137,'
    '298.257222101]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION['
    '"Transverse_Mercator"],PARAMETER["central_meridian",9],UNIT["metre",1],'
    'AUTHORITY["EPSG","25832"]]'
)
MERCATOR = WKT.replace("ETRS89 / UTM zone 32N", "WGS 84 / Pseudo-Mercator").replace(
    "Transverse_Mercator", "Mercator_1SP"
)
CUBE = (500_000, 5_600_000, 0, 500_100, 5_600_100, 100)


def tile_of(points, point_format, offset):
    header = laspy.LasHeader(
        version="1.4" if point_format > 5 else "1.2", point_format=point_format
    )
    header.scales, header.offsets = [0.01] * 3, offset
    header.add_extra_dim(laspy.ExtraBytesParams("OriginId", "u4"))
    tile = laspy.LasData(header)
    tile.x, tile.y, tile.z = points[:, :3].T
    tile.classification, tile.OriginId = points[:, 3].astype(np.uint8), points[:, 4].astype("u4")
    tile.gps_time, tile.return_number = points[:, 4] * 0.5, np.full(len(points), 1)
    tile.number_of_returns = np.full(len(points), 1)
    file = io.BytesIO()
    tile.write(file, do_compress=True)
    return file.getvalue()


SCHEMA = [
    *({"name": axis, "type": "signed", "size": 4, "scale": 0.01, "offset": offset}
      for axis, offset in zip("XYZ", (500_010, 5_600_000, 0))),
    {"name": "Classification", "type": "unsigned", "size": 1},
    {"name": "ReturnNumber", "type": "unsigned", "size": 1},
    {"name": "ScanAngleRank", "type": "float", "size": 4},
    {"name": "ClassFlags", "type": "unsigned", "size": 1},
    {"name": "GpsTime", "type": "float", "size": 8},
    {"name": "OriginId", "type": "unsigned", "size": 4},
    {"name": "Red", "type": "unsigned", "size": 2},
]  # fmt: skip


def kinds_of(schema):
    kinds = {"signed": "i", "unsigned": "u", "float": "f"}
    return np.dtype([(row["name"], f"<{kinds[row['type']]}{row['size']}") for row in schema])


def rows_of(points):
    """Return points as rows of the schema."""
    rows = np.zeros(len(points), dtype=kinds_of(SCHEMA))
    for axis, name in enumerate("XYZ"):
        rows[name] = np.rint((points[:, axis] - SCHEMA[axis]["offset"]) / 0.01)
    rows["Classification"], rows["OriginId"] = points[:, 3], points[:, 4]
    rows["GpsTime"], rows["ReturnNumber"] = points[:, 4] * 0.5, 1
    rows["ScanAngleRank"], rows["ClassFlags"], rows["Red"] = -12, 4, 300
    return rows.tobytes()


def add_ept(server, name="set", point_format=1, srs=None, pages=True, kind="laszip"):
    """Put a data set of 3,000 points in 1 + 4 + 16 tiles on the server; return all points."""
    points, files = parts_of_ept(point_format, pages, kind)
    for path, content in files.items():
        server.add(f"{name}/{path}", content)
    srs = {"wkt": WKT} if srs is None else srs
    about = {"bounds": CUBE, "boundsConforming": CUBE, "dataType": kind, "span": 16, "srs": srs}
    about["schema"] = SCHEMA
    return points, server.add(f"{name}/ept.json", json.dumps(about).encode())


@functools.cache
def parts_of_ept(point_format, pages, kind):
    """Return the points of a data set, and the contents of tiles and hierarchy by their paths."""
    random, files = np.random.default_rng(3), {}
    points = np.column_stack((random.random((3000, 3)) * 100, random.integers(1, 7, 3000)))
    corner = np.array([500_000, 5_600_000, 0, 0])
    points = np.column_stack((np.round(points, 2) + corner, np.arange(3000)))
    points.flags.writeable = False
    depths, hierarchy, branches = np.arange(3000) % 3, {}, {}
    for depth in range(3):
        side = 100 / 2**depth
        cells = np.minimum((points[:, :3] - CUBE[:3]) // side, 2**depth - 1).astype(int)
        cells[:, 2] = 0
        some = points[depths == depth]
        for cell in np.unique(cells[depths == depth], axis=0):
            inside = some[(cells[depths == depth] == cell).all(axis=1)]
            key = "-".join(map(str, (depth, *cell)))
            # Offsets of tiles are theirs, not those of the description.
            offset = [500_000 + depth, 5_600_000, 0]
            if kind == "laszip":
                files[f"ept-data/{key}.laz"] = tile_of(inside, point_format, offset)
            else:
                files[f"ept-data/{key}.bin"] = rows_of(inside)
            if depth == 2 and pages:
                above = "-".join(map(str, (1, *(cell // 2))))
                branches.setdefault(above, {})[key] = len(inside)
            else:
                hierarchy[key] = len(inside)
    for key, below in branches.items():
        below[key], hierarchy[key] = hierarchy[key], -1
        files[f"ept-hierarchy/{key}.json"] = json.dumps(below).encode()
    files["ept-hierarchy/0-0-0-0.json"] = json.dumps(hierarchy).encode()
    return points, files
