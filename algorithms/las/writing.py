"""Writes files with changed points: with other classes, heights or extra bytes.

laspy gives the positions of the fields of a point, but does not write: it would make new headers
and records, and drop what it does not know. Instead the bytes of the input are copied, and only
the necessary ones are changed.
"""

from __future__ import annotations

import shutil
import struct
from pathlib import Path
from typing import BinaryIO, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import replacing
from ..core.progress import SILENT, Progress
from ..core.temporary import shown
from .backends import require
from .class_layers import ClassLayers, class_layers
from .cloud import PointCloud
from .copc import write_copc
from .copc_index import CopcIndex
from .copc_nodes import OctreeError
from .edits import EditedFile, Edits
from .header import EVLR_COUNT
from .header_edits import with_statistics
from .lasfile import COPC_HIERARCHY, COPC_INFO, LASZIP, LasFile
from .opening import open_las
from .records import HeaderCounts, LasRecordWriter, LazRecordWriter, copy_range, laszip_vlr, named
from .sources import open_source

_COPC_SUFFIX = ".copc.laz"
_EXTERNAL_WAVEFORMS = 0x04
_EXTENDED_WITH_WAVEFORMS = (9, 10)


def check_writable(target: Path) -> None:
    """Refuse, before any work is done, a file name that is not .las, .laz or .copc.laz, or a format
    whose package is missing.
    """
    target = Path(target)
    if target.suffix.lower() not in (".las", ".laz"):
        raise BareEarthError(f"Cannot write {target}: name it .las, .laz or .copc.laz.")
    if target.suffix.lower() == ".laz":
        require("lazrs")


def write_changed(
    source: Path | LasFile,
    target: Path,
    changes: Edits,
    progress: Progress = SILENT,
    cloud: PointCloud | None = None,
    memory: int | None = None,
) -> None:
    """Write `source` with changes of its points and nothing else changed, or write no file; records
    that `cloud` has are changed in place.
    """
    # The order of the points, integers, extra bytes, header and records stay, except for what
    # compression needs. If the changes leave out points, header and counts describe the others. For
    # .copc.laz, the order of the points changes, and point formats 0 to 5 become 6 to 8, as its
    # specification requires; `memory` is as for `write_copc`.
    # A source that has changed meanwhile is refused if it was opened before its points were read,
    # or if `cloud` is given. If `cloud` holds all points, less is read again.
    target = Path(target)
    check_writable(target)
    layout = open_las(source)
    layout.check_unchanged()
    if cloud is not None and cloud.file is not None:
        cloud.file.check_unchanged()
    rewriting = EditedFile(layout, changes, None if cloud is None else cloud.records)
    if layout.is_compressed:
        require("lazrs")
    classes = rewriting.only_classes
    kept = None if classes is None else layers_kept(layout, target)
    with replacing(target) as temporary:
        if classes is not None and kept is not None:
            _replace_classes(rewriting, classes, kept, temporary, progress, cloud)
        elif is_copc(target):
            write_copc(rewriting, temporary, progress, memory)
        else:
            _write(rewriting, temporary, progress)
        layout.check_unchanged()
    if not is_copc(target):
        _report_waveforms(layout, target, progress)


def write_without_points(layout: LasFile, target: Path) -> None:
    """Write a file without points unchanged, or compressed or uncompressed as its name asks."""
    check_writable(target)
    wants = target.suffix.lower() == ".laz"
    with replacing(target) as temporary:
        if wants == layout.is_compressed:
            shutil.copyfile(layout.path, temporary)
        else:
            _write(EditedFile(layout, Edits()), temporary, SILENT)
        layout.check_unchanged()


def is_copc(target: Path) -> bool:
    """Return whether a file of this name is written as COPC."""
    return target.name.lower().endswith(_COPC_SUFFIX)


class CopiedLayers(NamedTuple):
    """Positions in a compressed file, with which everything but the classes can be copied."""

    layers: ClassLayers
    octree: CopcIndex | None = None  # if the output is COPC as well


def layers_kept(source: LasFile, target: Path) -> CopiedLayers | None:
    """Return the layers of a compressed file whose classes are replaced in the output; None if the
    output has another format, or the source has no layers.
    """
    if target.suffix.lower() != ".laz" or is_copc(target) > source.is_copc:
        return None
    layers = class_layers(source)
    if layers is None:
        return None
    if not is_copc(target):
        return CopiedLayers(layers)
    try:
        octree = CopcIndex(source)
    except OctreeError:
        return None
    return CopiedLayers(layers, octree) if octree.fits(layers.chunks) else None


def _replace_classes(
    rewriting: EditedFile,
    classes: np.ndarray,
    kept: CopiedLayers,
    target: Path,
    progress: Progress,
    cloud: PointCloud | None,
) -> None:
    """Write a compressed file in which only the classes change."""
    layout = rewriting.target
    dropped = (COPC_INFO, COPC_HIERARCHY) if kept.octree is None else ()
    if kept.octree is None:
        _report_index(layout, progress)
    with open(target, "w+b") as file:
        vlrs = tuple(vlr for vlr in layout.vlrs if vlr.key not in dropped)
        file.write(layout.prefix(vlrs, compressed=True))
        for done in kept.layers.write(file, classes, cloud):
            progress(done)
        shift = file.seek(0, 2) - layout.tail_start
        _copy_tail(rewriting, file, *dropped)
        if kept.octree is not None:
            kept.octree.write(file, kept.layers.moved, shift)


def _report_index(layout: LasFile, progress: Progress) -> None:
    if layout.is_copc:
        progress.info(
            "The points stay in the order of the COPC file, but its index is left out. To keep the"
            " index, name the output .copc.laz."
        )


def _write(rewriting: EditedFile, target: Path, progress: Progress) -> None:
    rewriting.check_classes()
    layout = rewriting.target
    _report_index(layout, progress)
    compressed = target.suffix.lower() == ".laz"
    vlrs = [vlr for vlr in layout.vlrs if vlr.key not in (LASZIP, COPC_INFO)]
    laszip = laszip_vlr(layout.point_format, layout.extra_bytes) if compressed else None
    if laszip is not None:
        # The record stays in its place, so that a file that is compressed again differs only in its
        # points.
        before = [vlr.key for vlr in layout.vlrs if vlr.key != COPC_INFO]
        vlrs.insert(before.index(LASZIP) if LASZIP in before else len(vlrs), laszip)
    with open(target, "w+b") as file:
        file.write(layout.prefix(tuple(vlrs), compressed))
        writer = LazRecordWriter(file, laszip) if laszip else LasRecordWriter(file)
        channels, counts = set(), HeaderCounts(layout)
        for records, classes, done in rewriting.points() if layout.count else ():
            if len(records):
                points = named(layout, records)
                # The flags in the same byte stay.
                points["classification"][:] = classes
                if laszip is not None and layout.point_format in _EXTENDED_WITH_WAVEFORMS:
                    channels |= set(np.unique(points["scanner_channel"]).tolist())
                    _check_channels(layout, channels)
            writer.write(records)
            if rewriting.leaves_out:
                counts.add(records)
            progress(done)
        writer.finish()
        if rewriting.leaves_out:
            # The header of the source describes all points, and not only the written ones.
            layout = with_statistics(
                layout, counts.lowest.tolist(), counts.highest.tolist(), counts.returns.tolist()
            )
            file.seek(0)
            file.write(layout.prefix(tuple(vlrs), compressed)[: len(layout.header)])
        _copy_tail(rewriting, file, COPC_HIERARCHY)


def _check_channels(layout: LasFile, channels: set[int]) -> None:
    """Refuse points that lazrs compresses wrongly."""
    # It mixes up the waveform packets of several scanner channels (seen with 0.6.0 and 0.8.2).
    if len(channels) > 1:
        raise BareEarthError(
            f"The points of {layout.path} have waveforms and several scanner channels, which cannot"
            " be compressed here without damage. Name the output .las."
        )


def _copy_tail(rewriting: EditedFile, file: BinaryIO, *dropped: tuple[str, int]) -> None:
    """Copy what follows the points, except for some records, and update the header."""
    layout = rewriting.source
    kept = {evlr.key for evlr in rewriting.target.evlrs}
    tail = layout.kept_tail(*dropped, *(e.key for e in layout.evlrs if e.key not in kept))
    pointers = layout.pointers(tail, file.seek(0, 2))
    with open_source(layout.path) as source:
        for start, end in tail:
            copy_range(source, file, start, end)
    for place, pointer in pointers.items():
        file.seek(place)
        file.write(struct.pack("<Q", pointer))
    if len(tail) > 1:
        file.seek(EVLR_COUNT.start)
        file.write(struct.pack("<I", len(layout.evlrs) - len(tail) + 1))


def _report_waveforms(layout: LasFile, target: Path, progress: Progress) -> None:
    if layout.global_encoding & _EXTERNAL_WAVEFORMS:
        named = Path(shown(target))  # not that of a temporary file
        progress.warning(
            f"The waveforms are in a file beside the input: copy"
            f" {layout.path.with_suffix('.wdp').name} to {named.with_suffix('.wdp').name}."
        )
