"""Writes results/accuracy.md and results/scenes.md: the figures, with pictures."""

from __future__ import annotations

from pathlib import Path
from string import Template
from typing import Iterable, NamedTuple, Sequence

from bare_earth.algorithms.filters import DEFAULT_METHOD, METHODS

from . import data, maps, peers, tables
from .generated import remembered_scene, worst_kinds
from .measure import Filter, GroundFilter, ReferenceModel, Scores, best
from .phases import Phased
from .scenes import KINDS
from .sensitivity import Moved, Sensitivity

RESULTS = Path(__file__).parent / "results"
PAGE = RESULTS / "accuracy.md"
IMAGES = RESULTS / "images"
WORST_NAME, RELIEF_NAME = "accuracy-worst-", "accuracy-relief-"
SCENE_NAME = "accuracy-scene-"
WORST, WORST_SCENES = 3, 5
RELIEF_TILES = ("hawaii_forest", "ahn3_urban")

_SITES = {
    "samp11": "a steep slope with houses and low vegetation",
    "samp21": "a bridge, and narrow strips of ground",
    "samp23": "a town with plazas, terraces and large blocks",
    "samp24": "ramps",
    "samp31": "dense buildings",
    "samp42": "a railway station with very long roofs",
    "samp52": "a steep slope and terraces, 0.18 points/m²",
    "samp54": "a dense village, 0.18 points/m²",
    "samp61": "road embankments and large gaps, 0.18 points/m²",
}
_TILES = {
    "ahn3_urban": "dense Dutch town, AHN3, 14.6 points/m²",
    "ign_sparse_urban": "coast and town, IGN LiDAR HD thinned to 0.26 points/m²",
    "nrw_rural": "farmland with ditches and dikes, NRW, 3.6 points/m²",
    "corse_cliff": "cliff and sea stack, 40 m of relief on 48 x 40 m, 16 points/m²",
    "ign_bridge": "road bridges, wood and village, IGN, 0.3 points/m²",
    "megaplot": "dense canopy with few ground points, 1.7 points/m²",
    "forest_topography": "forested hill with a lake, 0.9 points/m²",
    "mixed_conifer": "conifer plot, 4.7 points/m²",
    "oregon_conifer": "conifer stand, 5.4 points/m²",
    "ign_pf8": "IGN LiDAR HD, 11.5 points/m²",
    "hawaii_forest": "forest on a crater and lava, steep, 19.2 points/m²",
    "wires_single_return": "power lines and forest, 2.1 points/m²",
    "conifer_1": "dense conifers on rough ground, 12 points/m²",
    "conifer_2": "the tile beside it, 14 points/m²",
    "mountain_forest": "forest with shrubs on slopes of 30 to 45°, 2.3 points/m²",
    "rainforest_ridge": "rain forest on steep ridges, 20 points/m² of which 0.2 reach the ground",
    "yard_photogrammetry": "trees and yards in points from drone images, 54 points/m²",
    "roofs_photogrammetry": "roofs and yards in points from drone images, 45 points/m²",
    "broadleaf_sparse": "dense broadleaf wood, IGN LiDAR HD thinned to 0.28 points/m²",
    "house_slope": "a house and trees on a slope, 29 points/m²",
    "tall_crops": "a field of tall crops beside a wood, IGN, 20 points/m²",
    "pond_powerline": "a power line and a pond, AHN4, 17 points/m²",
    "savanna_grass": "dry grass 0.3 to 1 m high, from a drone, 950 points/m² on four plots",
    "hillside_images": "a campus on a hillside in points from drone images, thinned to 1 point/m²",
    "city_court": "a city block with a court, 2.2 points/m², of which a ninth have labels",
    "rock_mountain": "a bare slope with outcrops of rock, 1.3 points/m²",
    "campus_terraces": "a building with terraces and a retaining wall, 5.2 points/m²",
}


class Picture(NamedTuple):
    """A file below results/images, and what stands below it."""

    name: str
    caption: str


def worst(assessments: dict[str, Phased], count: int = WORST) -> list[str]:
    """Return the names of the samples with the largest total error, the worst first."""
    return sorted(assessments, key=lambda name: -assessments[name].total_error)[:count]


def draw(chosen: GroundFilter, assessments: dict[str, Phased]) -> list[Picture]:
    """Draw the error maps of the worst samples and the relief of the real tiles."""
    pictures, title = [], METHODS[chosen.name].label
    paths = {path.stem: path for path in data.isprs()}
    for rank, sample in enumerate(worst(assessments), 1):
        cloud, reference = data.load(paths[sample])
        name, one = f"{WORST_NAME}{rank}.png", assessments[sample].assessments[0]
        ground = chosen.ground(cloud)
        target = IMAGES / name
        maps.error_map(cloud, ground, reference, one, f"{title}, {sample}", target)
        pictures.append(Picture(name, f"{sample}: {_SITES.get(sample, '')}"))
    for tile in data.REAL:
        if tile.title not in RELIEF_TILES or not data.real(tile.name).exists():
            continue
        cloud, reference = data.load(data.real(tile.name))
        name = f"{RELIEF_NAME}{tile.title.replace('_', '-')}.png"
        model = ReferenceModel(cloud, reference)
        titles = title, "reference"
        maps.relief_pair(model, chosen.ground(cloud), titles, IMAGES / name)
        pictures.append(Picture(name, f"{tile.title}: {_TILES.get(tile.title, '')}"))
    return pictures


def draw_scenes(chosen: GroundFilter, scores: tables.SceneScores, seeds: Sequence[int]) -> list:
    """Draw terrain model and errors of the worst kinds of scenes, each on its worst seed."""
    pictures, own = [], scores[chosen.name]
    for rank, kind in enumerate(worst_kinds(own)[: -WORST_SCENES - 1 : -1], 1):
        errors = [score.type_1 + score.type_2 for score in own[kind]]
        seed = seeds[errors.index(max(errors))]
        scene, model = remembered_scene(kind, seed)
        name = f"{SCENE_NAME}{rank}.png"
        score = own[kind][seeds.index(seed)]
        title = METHODS[chosen.name].label
        maps.scene_map(scene, model, chosen.ground(scene.cloud()), score, title, IMAGES / name)
        pictures.append(Picture(name, f"{kind}, seed {seed}: {KINDS[kind].description}"))
    return pictures


def write(isprs: Scores, real: tables.TileScores) -> None:
    """Write the page about samples and tiles."""
    chosen = Filter(best({name: isprs[name] for name in METHODS}))
    pictures = draw(chosen, isprs[chosen.name])
    _fill(
        PAGE,
        {
            "peers": _peers(),
            "isprs": _blocks(
                [*(tables.isprs(isprs, title) for title in tables.FIGURES), tables.quoted()]
            ),
            "worst": _pictures(pictures, WORST_NAME),
            "tiles": [f"- **{tile}**: {_TILES.get(tile, '')}." for tile in real],
            "labels": tables.labels(real),
            "doubtful": tables.doubtful(real),
            "dtm": _blocks(
                [*(tables.dtm(real, *figure) for figure in tables.DTM_FIGURES), tables.spikes(real)]
            ),
            "relief": _pictures(pictures, RELIEF_NAME),
            "problems": [f"- **What failed**: {problem}." for problem in tables.problems(real)],
        },
    )


def write_scenes(scenes: dict[str, tables.SceneScores], seeds: Sequence[int], moved: Moved) -> None:
    """Write the page about generated scenes and changed defaults; `seeds` are those reported."""
    chosen = Filter(DEFAULT_METHOD)
    pictures = draw_scenes(chosen, scenes["reporting"], seeds)
    _fill(
        PAGE.with_name("scenes.md"),
        {
            "scenes": _scenes(scenes),
            "scenes_worst": _pictures(pictures, SCENE_NAME),
            "sensitivity": _moved(moved),
        },
    )


def _fill(target: Path, parts: dict[str, list[str]]) -> None:
    """Fill the template that is called as the page, and write the page."""
    template = Template((Path(__file__).parent / target.name).read_text(encoding="utf-8"))
    text = template.substitute({name: "\n".join(lines) for name, lines in parts.items()})
    target.write_text(text.rstrip() + "\n", encoding="utf-8")


def _peers() -> list[str]:
    lines = [
        f"- {peer.name} ({peer.package.split('==')[0]} {peer.version}): {peer.note}."
        for peer in peers.installed()
    ]
    missing = [f"`pip install {package}`" for package in peers.missing()]
    if missing:
        lines.append(f"- Not installed when this page was made: {', '.join(missing)}.")
    return lines


def _scenes(scenes: dict[str, tables.SceneScores]) -> list[str]:
    reporting, tuning = scenes["reporting"], scenes["tuning"]
    described = [
        f"- **{name}**: {KINDS[name].description}." for name in next(iter(reporting.values()))
    ]
    blocks = [[f"### {METHODS[name].label}", "", *lines] for name, lines in
              tables.scenes(reporting, tuning).items()]  # fmt: skip
    return _blocks([described, tables.scene_totals(reporting), *blocks])


def _moved(moved: Moved) -> list[str]:
    lines: list[str] = []
    for method, places in moved.items():
        lines += [f"### {METHODS[method].label}", ""]
        for where, rows in places.items():
            lines += [f"On {where}. {_spread(rows)}", "", *tables.sensitivity(rows), ""]
    return lines[:-1]


def _spread(rows: Sequence[Sensitivity]) -> str:
    """Return the sentence on the smallest and the largest move."""
    moves = [
        (change.total_error, row.declaration.label, way)
        for row in rows
        for change, way in zip(row.changes, ("halved", "doubled"))
        if not change.problem
    ]
    if not moves:
        return "Every change is refused."
    most, label, way = max(moves)
    return (
        f"Total error {min(moves)[0]:.2f} to {most:.2f} % with one default changed; the worst is"
        f" *{label}* {way}:"
    )


def _pictures(pictures: Sequence[Picture], start: str) -> list[str]:
    lines = []
    for picture in pictures:
        if picture.name.startswith(start):
            image = f"![{picture.caption}](images/{picture.name})"
            lines += [image, "", f"*{picture.caption}*", ""]
    return lines[:-1]


def _blocks(blocks: Iterable[Sequence[str]]) -> list[str]:
    """Return tables one after the other, an empty line between two."""
    return [
        line
        for number, block in enumerate(blocks)
        for line in (("",) if number else ()) + tuple(block)
    ]
