"""The report of an assessment: one HTML page that needs no other file."""

from __future__ import annotations

import base64
import struct
import zlib
from dataclasses import dataclass
from html import escape
from pathlib import Path

import numpy as np

from ..core.errors import printable
from ..core.files import replacing
from ..core.points import Points
from ..grids.hillshade import hillshade
from ..grids.inpaint import inpaint
from .comparison import Assessment, AssessmentOptions, Comparison

# Told apart by colour-blind eyes, and in print.
_TYPE_1, _TYPE_2 = "#d1157f", "#f07f09"
_LONGEST_SIDE = 900
# Side of a pixel, in mean distances between points: most pixels are to have one.
_SPACINGS = 1.2
# Cells without a point, but next to one, are shaded.
_GAP = 3
# A cell with one wrong point of many is coloured faintly, but not too faintly to be seen.
_FAINTEST = 0.55
_DARKEST = 120

# ASPRS (2019): LAS specification 1.4, table 17.
_CLASSES = {
    0: "never classified", 1: "unclassified", 2: "ground", 3: "low vegetation",
    4: "medium vegetation", 5: "high vegetation", 6: "building", 7: "low noise",
    8: "model key point", 9: "water", 10: "rail", 11: "road surface", 12: "overlap",
    13: "wire guard", 14: "wire conductor", 15: "transmission tower", 16: "wire connector",
    17: "bridge deck", 18: "high noise",
}  # fmt: skip

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 920px;
       margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; } h2 { font-size: 1.2em; margin-top: 2em; }
table { border-collapse: collapse; } caption { text-align: left; color: #555; }
th, td { border: 1px solid #bbb; padding: .25em .7em; text-align: right; }
th { background: #f2f2f2; font-weight: 600; } td.text, th.text { text-align: left; }
td.right { background: #e6f2e6; } td.wrong { background: #fbe6ee; }
dl { display: flex; flex-wrap: wrap; gap: 1em; padding: 0; }
dl div { border: 1px solid #bbb; border-radius: 6px; padding: .4em 1em; }
dt { color: #555; } dd { margin: 0; font-size: 1.5em; }
figure { margin: 0; }
img { width: 100%; image-rendering: pixelated; border: 1px solid #bbb; box-sizing: border-box; }
.bar { border: 2px solid #222; border-top: 0; height: 6px; }
.key { display: inline-block; width: 1em; height: 1em; vertical-align: -.15em; margin: 0 .3em 0 1em;
       border: 1px solid #555; }
.files { word-break: break-all; }
"""


@dataclass(frozen=True)
class Picture:
    """A map of the errors.

    Attributes
    ----------
    pixels : numpy.ndarray of uint8, shape (rows, columns, 3)
        Red, green and blue, from north to south.
    cell_size : float
        Side of a pixel in metres.
    """

    pixels: np.ndarray
    cell_size: float


def write_report(
    target: Path,
    assessment: Assessment,
    comparison: Comparison,
    points: Points,
    options: AssessmentOptions,
    files: tuple[Path, Path],
) -> None:
    """Write the report of an assessment.

    Parameters
    ----------
    target : Path
        The .html file to make.
    assessment : Assessment
        The figures.
    comparison : Comparison
        What they are about, point by point.
    points : Points
        Where the points lie.
    options : AssessmentOptions
        How the figures were made.
    files : tuple of Path
        The classified cloud and the reference.

    Raises
    ------
    BareEarthError
        If the file cannot be written.
    """
    text = report_html(assessment, draw_errors(points, comparison), options, files)
    with replacing(target) as temporary:
        temporary.write_text(text, encoding="utf-8")


def draw_errors(points: Points, comparison: Comparison) -> Picture:
    """Return a map of the errors on the relief of the highest points.

    Parameters
    ----------
    points : Points
        Where the points lie; one at least.
    comparison : Comparison
        Which of them are wrong.
    """
    width, height = np.ptp(points.x), np.ptp(points.y)
    spacing = _SPACINGS * np.sqrt(width * height / points.count)
    cell = max(spacing, max(width, height) / _LONGEST_SIDE) or 1.0
    columns, rows = int(width / cell) + 1, int(height / cell) + 1
    column = ((points.x - points.x.min()) / cell).astype(np.int64)
    row = ((points.y.max() - points.y) / cell).astype(np.int64)
    place = row * columns + column

    def counts(which: np.ndarray) -> np.ndarray:
        return np.bincount(place[which], minlength=rows * columns).reshape(rows, columns)

    shade = _relief(place, points.z, (rows, columns), cell)
    rejected, accepted = counts(comparison.rejected), counts(comparison.accepted)
    share = (rejected + accepted) / np.maximum(counts(comparison.counted), 1)
    weight = np.where(share > 0, _FAINTEST + (1 - _FAINTEST) * share, 0)[..., None]
    colour = np.where((rejected >= accepted)[..., None], _rgb(_TYPE_1), _rgb(_TYPE_2))
    pixels = weight * colour + (1 - weight) * shade[..., None]
    return Picture(np.rint(pixels).astype(np.uint8), float(cell))


def png(pixels: np.ndarray) -> bytes:
    """Return a picture as PNG.

    Parameters
    ----------
    pixels : numpy.ndarray of uint8, shape (rows, columns, 3)
        Red, green and blue.

    References
    ----------
    ISO/IEC 15948:2004: Portable Network Graphics, sections 5.3, 11.2.2 and 12.8.
    """
    rows, columns, _ = pixels.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    # Every row begins with the number of its filter, 0 for none.
    lines = np.zeros((rows, 1 + 3 * columns), np.uint8)
    lines[:, 1:] = pixels.reshape(rows, -1)
    # Eight bits of each of three colours; the zeros are the only compression, filter and order.
    header = struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)
    data = zlib.compress(lines.tobytes(), 9)
    signature = b"\x89PNG\r\n\x1a\n"
    return signature + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def report_html(
    assessment: Assessment, picture: Picture, options: AssessmentOptions, files: tuple[Path, Path]
) -> str:
    """Return the page of the report; see `write_report`."""
    from ..core.version import __version__

    title = escape(printable(f"Assessment of {files[0].name}"))
    classified, reference = (escape(printable(str(file))) for file in files)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>{_STYLE}</style>
</head>
<body>
<h1>{title}</h1>
<p class="files">Classified: {classified}<br>Reference: {reference}</p>
<dl>{_figures(assessment)}</dl>
<p>Type I error: the share of the reference's ground that was rejected. Type II error: the share of
all other points that was accepted as ground. Kappa: the agreement beyond what chance alone gives.
Ground of the reference: {_list(options.ground_classes)}.
Left out: {_list(options.ignored_classes or ())}.</p>
<h2>Where the errors are</h2>
{_map(picture)}
<h2>Confusion</h2>
{_confusion(assessment)}
<h2>Classes of the reference</h2>
{_classes(assessment, options)}
<p>Made by Bare Earth {escape(__version__)}.</p>
</body>
</html>
"""


def _relief(place: np.ndarray, z: np.ndarray, shape: tuple[int, int], cell: float) -> np.ndarray:
    """Return the grey of each cell: the shaded relief of the highest points, white beyond."""
    from scipy import ndimage

    order = np.lexsort((z, place))
    last = np.append(np.diff(place[order]) != 0, True)
    heights = np.full(shape, np.nan)
    heights.ravel()[place[order[last]]] = z[order[last]]
    near = ndimage.binary_dilation(np.isfinite(heights), np.ones((3, 3)), _GAP)
    lit = hillshade(inpaint(heights), cell)
    return np.where(near, _DARKEST + (255 - _DARKEST) * (lit / 255.0), 255.0)


def _rgb(colour: str) -> tuple[int, ...]:
    return tuple(bytes.fromhex(colour[1:]))


def _figures(assessment: Assessment) -> str:
    figures = {
        "Type I error": _percent(assessment.type_1_error),
        "Type II error": _percent(assessment.type_2_error),
        "Total error": _percent(assessment.total_error),
        "Kappa": _percent(assessment.kappa),
        "Points": f"{assessment.point_count:,}",
    }
    return "".join(f"<div><dt>{name}</dt><dd>{value}</dd></div>" for name, value in figures.items())


def _map(picture: Picture) -> str:
    data = base64.b64encode(png(picture.pixels)).decode("ascii")
    rows, columns, _ = picture.pixels.shape
    length = _round_length(columns * picture.cell_size / 4)
    share = length / (columns * picture.cell_size)
    return f"""<figure style="max-width: {_LONGEST_SIDE * min(columns / rows, 1):.0f}px">
<img src="data:image/png;base64,{data}" alt="Map of the errors">
<div class="bar" style="width: {100 * share:.2f}%"></div>
</figure>
<p>{length:g} m
<span class="key" style="background: {_TYPE_1}"></span>type I: ground that was rejected
<span class="key" style="background: {_TYPE_2}"></span>type II: other points that were accepted</p>
<p>North is up. Grey is the relief of the highest points. A pixel is {picture.cell_size:.3g} m wide;
it takes the colour of its more frequent error, the stronger the more of its points are
wrong.</p>"""


def _round_length(most: float) -> float:
    """Return the largest of 1, 2, 5, 10, 20 ... that is not larger than `most`."""
    power = 10.0 ** np.floor(np.log10(most))
    return float(next(each * power for each in (5, 2, 1) if each * power <= most * (1 + 1e-9)))


def _confusion(a: Assessment) -> str:
    ground, other = a.ground_as_ground + a.ground_as_other, a.other_as_ground + a.other_as_other
    return f"""<table>
<tr><th></th><th>Classified as ground</th><th>Classified as other</th><th>All</th>
<th>Wrong</th></tr>
<tr><th class="text">Reference: ground</th><td class="right">{a.ground_as_ground:,}</td>
<td class="wrong">{a.ground_as_other:,}</td><td>{ground:,}</td>
<td>{_percent(a.type_1_error)} (type I)</td></tr>
<tr><th class="text">Reference: other</th><td class="wrong">{a.other_as_ground:,}</td>
<td class="right">{a.other_as_other:,}</td><td>{other:,}</td>
<td>{_percent(a.type_2_error)} (type II)</td></tr>
<tr><th class="text">All</th><td>{a.ground_as_ground + a.other_as_ground:,}</td>
<td>{a.ground_as_other + a.other_as_other:,}</td><td>{a.point_count:,}</td>
<td>{_percent(a.total_error)} (total)</td></tr>
</table>"""


def _classes(assessment: Assessment, options: AssessmentOptions) -> str:
    rows = []
    for value, counts in assessment.classes.items():
        is_ground, points, ground = value in options.ground_classes, *counts.values()
        wrong = points - ground if is_ground else ground
        rows.append(
            f'<tr><td>{value}</td><td class="text">{_CLASSES.get(value, "")}</td>'
            f'<td class="text">{"ground" if is_ground else "other"}</td><td>{points:,}</td>'
            f"<td>{ground:,}</td><td>{points - ground:,}</td>"
            f"<td>{_percent(100 * wrong / points)}</td></tr>"
        )
    return f"""<table>
<tr><th>Class</th><th class="text">Name</th><th class="text">Counts as</th><th>Points</th>
<th>Classified as ground</th><th>Classified as other</th><th>Wrong</th></tr>
{chr(10).join(rows)}
</table>"""


def _percent(value: float) -> str:
    return "none" if np.isnan(value) else f"{value:.2f} %"


def _list(classes: tuple[int, ...]) -> str:
    return "class " + ", ".join(str(each) for each in classes) if classes else "nothing"
