"""The list of all tools, with a sentence on each, which imports none of them."""

from __future__ import annotations

from typing import NamedTuple


class Listed(NamedTuple):
    """A tool in the list."""

    file: str  # in this folder; for tools for points also the name of the function in the library
    line: str = ""  # a sentence: in the list, the tooltip, and the first line of the help
    tool: str = "TOOL"  # the name of the declaration in the file


# The tools that write classified files anew, by their commands.
POINT_TOOLS = {
    "height": Listed(
        "heights", "Adds the height of every point above the ground points of a point cloud."
    ),
    "above-ground": Listed(
        "above_ground",
        "Finds vegetation, buildings and bridges in a point cloud whose ground is known.",
    ),
    "key-points": Listed(
        "key_points",
        "Finds the few ground points that make as good a terrain model as all of them.",
    ),
    "clip": Listed("clip", "Writes the points of an area as they are, and nothing else."),
    "water-classes": Listed(
        "water_classes",
        "Gives class 9 to ground points in water, and class 20 to those beside its shore.",
    ),
}
# The tools that make rasters and contour lines of points.
MAP_TOOLS = {
    "classify": Listed(
        "ground.tool", "Classifies the ground points of a file, or of many files as one survey."
    ),
    "classify-tiles": Listed("ground.dialogs", tool="TILES_TOOL"),
    "terrain": Listed(
        "rasters.tool",
        "Makes terrain model, surface model, canopy height and hillshade of a point cloud.",
    ),
}
# The tools that read files and write others.
FILE_TOOLS = {
    "info": Listed("info", "Describes point cloud files, and checks them."),
    "fetch": Listed("fetch", "Downloads the points of a remote point cloud that lie in an area."),
    "remove-off-terrain-objects": Listed(
        "off_terrain",
        "Removes buildings, trees and other steep-sided objects from an elevation raster.",
    ),
    "contours": Listed("contours", "Draws contour lines of an elevation raster."),
    "canopy": Listed(
        "canopy", "Makes the canopy height of a surface model and a terrain model, two rasters."
    ),
    "check": Listed(
        "check.checking",
        "Compares ground points and a terrain model with points surveyed on the ground.",
    ),
    "compare-settings": Listed(
        "compare_settings",
        "Tries methods and presets on a part of a point cloud, and shows them side by side.",
    ),
    "quality": Listed(
        "quality", "Measures densities, voids and strips, and compares them with a specification."
    ),
    "assess": Listed(
        "assess", "Compares a classified point cloud with a reference: type I and II error, kappa."
    ),
    "review": Listed(
        "review", "Finds where a terrain model may be wrong: what to look at first, and why."
    ),
    "change": Listed(
        "change", "Finds where the ground changed between two surveys, how much, and how surely."
    ),
    "canopy-change": Listed(
        "canopy_change",
        "Finds where canopy was lost and gained between two surveys, and how it grew.",
    ),
    "relief": Listed(
        "relief",
        "Shows mounds, walls, ditches and old paths: sky view, openness, local relief, VAT.",
    ),
    "water": Listed(
        "water.tool", "Finds lakes and rivers as polygons with their levels, and as breaklines."
    ),
}
# Tools that work one after another, declared above this room.
COMPOSITIONS = {
    "deliver": Listed(
        ".delivery.tool",
        "Classifies a raw point cloud, and makes everything that a job hands over.",
    ),
}


def listed(command: str) -> Listed:
    """Return the entry of a tool of any kind, given its command."""
    return {**POINT_TOOLS, **FILE_TOOLS, **MAP_TOOLS, **COMPOSITIONS}[command]
