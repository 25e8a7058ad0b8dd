"""Rebuilds a labelled point cloud from its sources, by the steps of the manifest.

The steps of an entry, in order:

- ``copy``: the only source, as it is; ``to_laz``: the only source, read and written as LAZ.
- ``read``: ``las`` (all sources, joined in their order), ``ply`` (binary), or ``text`` with the
  names of its columns.
- ``crop``: keeps xmin <= x < xmax and ymin <= y < ymax; no point lies on a bound.
- ``remap``: makes classes from the numbers of a dimension.
- ``grid``: makes integer coordinates with a scale and the entry's ``offsets``.
- ``unique``: drops points at the place of an earlier one.
- ``sort``: by a dimension, and before it by strips of some metres in y.
- ``write``: point format, dimensions that stay, constants, records of the first source to keep.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any, Callable, Mapping, Sequence

import laspy
import numpy as np

from .manifest import Entry, sha256

_PLY_TYPES = {
    "float": "<f4", "double": "<f8", "uchar": "u1", "char": "i1", "short": "<i2", "ushort": "<u2",
    "int": "<i4", "uint": "<u4",
}  # fmt: skip
_RETURNS = ("classification", "return_number", "number_of_returns")


class Rebuilding:
    """The points of an entry between two steps: an array for each dimension."""

    def __init__(self, entry: Entry, paths: Sequence[Path], target: Path) -> None:
        self._entry, self._paths, self._target = entry, paths, target
        self._points: dict[str, np.ndarray] = {}
        self._records: list[Any] = []  # variable length records of the first source
        self._scale = 1.0

    def run(self) -> None:
        """Do all steps; the last one writes the file."""
        for name, *arguments in self._entry.steps:
            getattr(self, f"_{name}")(*arguments)

    def _copy(self) -> None:
        shutil.copyfile(self._paths[0], self._target)

    def _to_laz(self) -> None:
        laspy.read(self._paths[0]).write(str(self._target))

    def _read(self, how: str | Mapping[str, Any]) -> None:
        if isinstance(how, str):
            readers: dict[str, Callable[[], dict[str, np.ndarray]]]
            readers = {"las": self._of_las, "ply": self._of_ply}
            self._points = readers[how]()
        else:
            columns = np.loadtxt(self._paths[0], unpack=True)
            self._points = dict(zip(how["columns"], columns))

    def _of_las(self) -> dict[str, np.ndarray]:
        clouds = [laspy.read(path) for path in self._paths]
        self._records = list(clouds[0].header.vlrs)
        names = [name for name in clouds[0].point_format.dimension_names if name not in "XYZ"]
        return {
            name: np.concatenate([np.asarray(cloud[name]) for cloud in clouds])
            for name in ("x", "y", "z", *names)
        }

    def _of_ply(self) -> dict[str, np.ndarray]:
        data = self._paths[0].read_bytes()
        start = data.index(b"end_header\n") + len(b"end_header\n")
        words = [line.split() for line in data[:start].decode("ascii").splitlines()]
        if ["format", "binary_little_endian", "1.0"] not in words:
            raise ValueError(f"{self._paths[0].name} is not a binary little-endian PLY file")
        count = next(int(line[2]) for line in words if line[:2] == ["element", "vertex"])
        layout = [(line[2], _PLY_TYPES[line[1]]) for line in words if line[0] == "property"]
        vertices = np.frombuffer(data, np.dtype(layout), count, start)
        return {name: vertices[name] for name, _ in layout}

    def _take(self, chosen: np.ndarray) -> None:
        self._points = {name: values[chosen] for name, values in self._points.items()}

    def _crop(self, box: Mapping[str, float]) -> None:
        inside = np.ones(len(self._points["x"]), dtype=bool)
        for axis in "xy":
            inside &= self._points[axis] >= box.get(f"{axis}min", -np.inf)
            inside &= self._points[axis] < box.get(f"{axis}max", np.inf)
        self._take(inside)

    def _remap(self, how: Mapping[str, Any]) -> None:
        values, index = np.unique(self._points[how["from"]], return_inverse=True)
        classes = np.array([how["to"][str(int(value))] for value in values], np.uint8)
        self._points["classification"] = classes[index.reshape(-1)]

    def _grid(self, scale: float) -> None:
        self._scale = scale
        for axis, offset in zip("xyz", self._entry.offsets):
            steps = np.rint((self._points[axis] - offset) / scale)
            self._points[axis.upper()] = steps.astype(np.int32)

    def _unique(self) -> None:
        places = np.column_stack([self._points[axis] for axis in "XYZ"])
        self._take(np.sort(np.unique(places, axis=0, return_index=True)[1]))

    def _sort(self, how: Mapping[str, Any]) -> None:
        keys = [self._points[how["by"]]]
        if "strip" in how:
            keys.append(self._points["Y"] // round(how["strip"] / self._scale))
        self._take(np.lexsort(keys))  # stable; the last key counts first

    def _write(self, how: Mapping[str, Any]) -> None:
        header = laspy.LasHeader(point_format=how["point_format"], version="1.2")
        header.scales, header.offsets = np.full(3, self._scale), np.array(self._entry.offsets)
        header.generating_software = "Bare Earth, from public sources"
        header.vlrs.extend(one for one in self._records if one.user_id == how.get("vlrs"))
        cloud = laspy.LasData(header)
        cloud.X, cloud.Y, cloud.Z = (self._points[axis] for axis in "XYZ")
        names = list(header.point_format.dimension_names) if "keep" in how else list(_RETURNS)
        if isinstance(how.get("keep"), list):
            names = how["keep"]
        for name in names:
            if name in self._points and name not in "XYZ":
                cloud[name] = self._points[name]
        for name, value in how.get("set", {}).items():
            cloud[name] = np.full(len(self._points["X"]), value, np.uint8)
        cloud.write(str(self._target))


def digests(path: Path) -> dict[str, int | str]:
    """Return what the manifest states of a cloud: its number of points, and the digests of places
    and classes (13 bytes a point) and of returns (2 bytes a point).
    """
    cloud = laspy.read(path)
    layout = [("x", "<i4"), ("y", "<i4"), ("z", "<i4"), ("class", "u1")]
    records = np.empty(len(cloud.points), layout)
    records["x"], records["y"], records["z"] = cloud.X, cloud.Y, cloud.Z
    records["class"] = np.asarray(cloud.classification)
    returns = [np.asarray(cloud[name]) for name in ("return_number", "number_of_returns")]
    return {
        "points": len(records),
        "points_sha256": sha256(records.tobytes()),
        "returns_sha256": sha256(np.column_stack(returns).astype(np.uint8).tobytes()),
    }


def is_as_measured(path: Path, entry: Entry) -> bool:
    """Return whether a file holds the points that the figures of the project were measured on."""
    return all(getattr(entry, name) == value for name, value in digests(path).items())
