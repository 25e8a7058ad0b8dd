"""Writes the tables of README and docs/how-accurate.md from those of results/accuracy.md."""

from __future__ import annotations

from pathlib import Path

from . import marked, tables

_ROOT = Path(__file__).parents[1]
ACCURACY = _ROOT / "benchmarks" / "results" / "accuracy.md"
MANUAL = _ROOT / "docs" / "how-accurate.md"
README = _ROOT / "README.md"
PERFORMANCE = ACCURACY.with_name("performance.md")
# Filters as the manual calls them, and as the page does.
_FILTERS = {
    "**TIN densification**": "**TIN densification**",
    "**Grid minimum**": "**Grid minimum**",
    "**Slope filter**": "**Slope filter**",
    "pysmrf, windows of the SMRF paper": "pysmrf, windows=18",
    "PDAL SMRF (quoted, not measured here)": "PDAL SMRF (quoted)",
    "pysmrf, its defaults": "pysmrf",
    "CSF, cloth of 1 m": "CSF",
    "Whitebox slope filter, its defaults": "Whitebox slope filter",
}
# What the manual tells of speed: its label, that of results/performance.md, that of the README.
_SPEEDS = (
    ("**TIN densification**", "**TIN densification**", "**TIN densification**"),
    ("**Grid minimum**", "**Grid minimum**", "**Grid minimum**"),
    ("**Slope filter**", "**Slope filter**", "**Slope filter**"),
    (
        "**TIN densification with terrain model, 1 m**",
        "**TIN densification and DTM, 1 m**",
        "",
    ),
    (
        "**the same, hillshade and heights of all points**",
        "**TIN densification, DTM, hillshade and heights**",
        "",
    ),
    (
        "**Terrain model, surface model and canopy height of a classified file**",
        "**DTM, DSM and canopy height**",
        "",
    ),
    ("**Heights above ground of a classified file**", "**Heights above ground**", ""),
    ("pysmrf, its defaults", "pysmrf", "pysmrf, its defaults"),
    ("CSF, its defaults", "CSF", "CSF, cloth of 1 m"),
    (
        "Whitebox slope filter, radius 2 m",
        "Whitebox slope filter, 2 m",
        "Whitebox slope filter, its defaults",
    ),
)
_TIME = "Time, as a multiple of reading and writing"
# Land, points a square metre, and the tiles.
_LANDS = (
    ("Farmland with ditches and dikes", "3.6", ("nrw_rural",)),
    ("Dense town", "14.6", ("ahn3_urban",)),
    ("Coast and town, thinned", "0.26", ("ign_sparse_urban",)),
    ("Forest on a crater and lava", "19.2", ("hawaii_forest",)),
    ("Dense conifers on rough ground, two tiles", "12 to 14", ("conifer_1", "conifer_2")),
    ("Forest with shrubs on slopes of 30 to 45°", "2.3", ("mountain_forest",)),
    ("Sparse broadleaf wood", "0.28", ("broadleaf_sparse",)),
    ("Rain forest on steep ridges", "20, of which 0.2 on the ground", ("rainforest_ridge",)),
    (
        "Yards and roofs, points from drone images",
        "45 to 54",
        ("yard_photogrammetry", "roofs_photogrammetry"),
    ),
    ("Tall crops beside a wood", "20", ("tall_crops",)),
    ("Cliff and sea stack", "16", ("corse_cliff",)),
    ("Dry grass 0.3 to 1 m high, from a drone", "950", ("savanna_grass",)),
    ("Campus on a hillside, drone images thinned to 1 m", "1", ("hillside_images",)),
    ("Bare slope with outcrops of rock", "1.3", ("rock_mountain",)),
    ("Terraces and retaining walls beside a building", "5.2", ("campus_terraces",)),
)
_OURS, _CLOTH = "**TIN densification**", "CSF"

# By title of the table, then by row and column.
Found = dict[str, dict[str, dict[str, str]]]


def read(page: Path) -> Found:
    """Return the tables of a page by their first title; the first of those with the same."""
    found: Found = {}
    head: list[str] = []
    for line in page.read_text("utf-8").splitlines():
        cells = _cells(line)
        if not line.startswith("|"):
            head = []
        elif not head:
            head = [] if cells[0] in found else cells
            if head:
                found[head[0]] = {}
        elif not line.startswith(("| -", "|-")):
            found[head[0]][cells[0]] = dict(zip(head[1:], cells[1:]))
    return found


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip().strip("|").split(" | ")]


def _mean(found: Found, title: str, name: str, quoted: str = "") -> str:
    """Return a mean over the samples, with its range if it has one."""
    if name in found[title]:
        return found[title][name]["mean"]
    return next((rows[name][quoted] for rows in found.values() if quoted in rows.get(name, ())), "")


def samples(found: Found) -> list[str]:
    """Return the table of the manual on samples."""
    lines = []
    for label, name in _FILTERS.items():
        if name == "pysmrf":
            continue
        kappa = _mean(found, "Kappa, %", name, "kappa, %").split(" ")[0]
        types = (_mean(found, f"Type {n} error, %", name).split(" ")[0] for n in ("I", "II"))
        total = _mean(found, "Total error, %", name, "total error, %")
        short = label.replace(", not measured here", "")
        lines.append([short, total, *types, f"{float(kappa):.1f}"])
    return tables.table(("", "Total error, %", "Type I, %", "Type II, %", "Kappa, %"), lines)


def in_short(found: Found) -> list[str]:
    """Return the table of the README, with the times that the manual states."""
    rows = map(_cells, marked.held(MANUAL, "speed"))
    times = {cells[0]: cells[1] for cells in rows if len(cells) > 1}
    told = {short: times[label] for label, _, short in _SPEEDS if short and label in times}
    lines = []
    for label, name in _FILTERS.items():
        total = _mean(found, "Total error, %", name, "total error, %").split(" ")[0]
        kappa = _mean(found, "Kappa, %", name, "kappa, %").split(" ")[0]
        lines.append([label, f"{total} %", f"{float(kappa):.1f} %", told.get(label, "")])
    return tables.table(("", "total error", "kappa", "time"), lines)


def _figure(cell: str, digits: int) -> str:
    """Return a figure with fewer digits where it is 10 or more."""
    value = cell.split(" ")[0]
    if value in ("", tables.NONE, tables.FAILED):
        return ""
    number = float(value) + 1e-9  # a half is rounded up
    return f"{number:.{max(digits - (number >= 10.0), 0)}f}"


def lands(found: Found) -> list[str]:
    """Return the table of the manual on terrain models."""
    models, labels, lines = found["RMSE, m"], found["Total (I / II), %"], []
    for land, density, names in _LANDS:
        wanted = (models, _OURS, 2), (labels, _OURS, 1), (models, _CLOTH, 2), (labels, _CLOTH, 1)
        rmse, wrong, *others = (
            ", ".join(filter(None, (_figure(rows.get(name, {}).get(who, ""), n) for name in names)))
            for rows, who, n in wanted
        )
        cloth = "; ".join(filter(None, others))
        lines.append([land, density, rmse, wrong, cloth])
    return tables.table(
        ("Land", "Points/m²", "RMSE, m", "Labels, %", "CSF: RMSE, m; labels, %"), lines
    )


def speeds(page: Path = PERFORMANCE) -> list[str]:
    """Return the table of the manual on speed, of a page that was measured."""
    found = read(page)[_TIME]
    lines = [
        [label, *(found[name][tile].split(" ")[0] for tile in ("hawaii_forest", "nrw_rural"))]
        for label, name, _ in _SPEEDS
    ]
    return tables.table(("", "Forest", "Farmland"), lines)


def write(with_speeds: bool = False) -> None:
    """Write the tables; those of speed when it was measured, since the manual's may be newer than
    the page.
    """
    if with_speeds:
        marked.fill(MANUAL, "speed", speeds())
    found = read(ACCURACY)
    for page, name, lines in made(found):
        marked.fill(page, name, lines)


def made(found: Found) -> list[tuple[Path, str, list[str]]]:
    """Return the page, the mark and the lines of each table."""
    return [
        (MANUAL, "samples", samples(found)),
        (MANUAL, "lands", lands(found)),
        (README, "samples", in_short(found)),
    ]
