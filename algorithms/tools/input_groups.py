"""The inputs that have several options and fields: constraints, corrections, checkpoints, grid."""

from __future__ import annotations

from .declaration import Input

# What the terrain must respect; the fields of `Constraints`.
_CONSTRAINTS = (
    Input(
        "breaklines",
        "lines",
        help="Lines that no triangle of the terrain crosses: edges of walls, dykes and terraces. A"
        " line with z has this height, in the unit of heights of the points. Without z, each side"
        " of the line has the height of the nearest ground point on that side.",
        label="Breaklines",
        advanced=True,
    ),
    Input(
        "water",
        "polygons",
        help="Polygons of water. Each is flattened to one level, that of the ground along its"
        " border.",
        label="Water",
        advanced=True,
    ),
    Input(
        "rivers",
        "lines",
        help="Lines along which the level of the water polygons falls. They may be drawn in either"
        " direction.",
        label="Rivers",
        advanced=True,
    ),
    Input(
        "no_ground",
        "polygons",
        help="Polygons in which the terrain uses no ground points, such as bridges and roofs. The"
        " classes of the points do not change.",
        label="No ground here",
        advanced=True,
    ),
)
_CORRECTIONS = (
    Input(
        "corrections",
        "polygons",
        help="Polygons in which you know the class, which is their attribute 'class', or places to"
        " review with their attribute 'answer', which counts before the class. A class replaces"
        " the result of the filter. If it is the class of the ground, points of the chosen returns"
        " are ground. Any other class is given to all points, and the filter does not use them."
        " Where polygons overlap, the last one counts.",
        label="Corrections",
        advanced=True,
    ),
    Input(
        "corrections_field",
        "attribute",
        help="The attribute of these polygons that holds their class: 2 for ground, 1 for"
        " unclassified.",
        label="Class of the corrections",
        advanced=True,
    ),
)
_CHECKPOINTS = (
    Input(
        "checkpoints",
        "points",
        help="Points that were surveyed on the ground. None are needed if points are held out.",
        label="Checkpoints",
    ),
    Input(
        "columns",
        "text",
        help="The columns or attributes of the checkpoints, by name or by number from 1 on, such as"
        " x=E,y=N,z=H,cover=Class,type=Use,name=ID. All others are recognised by their"
        " names.",
    ),
    Input(
        "checkpoints_crs",
        "crs",
        help="The CRS of x and y of the checkpoints. Empty: what the file states, or the CRS of the"
        " points.",
    ),
    Input(
        "z_field",
        "attribute",
        help="The attribute with the heights, in the unit of the heights of the points."
        " Empty: z of the points, or an attribute with a usual name, such as H or elevation.",
        label="Height of the checkpoints",
    ),
    Input(
        "cover_field",
        "attribute",
        help="The attribute with the land cover, such as forest or NVA. Points on vegetated"
        " land are reported apart, and those of type Control are left out. Empty: an attribute with"
        " a usual name, such as class.",
        label="Land cover of the checkpoints",
    ),
    Input(
        "name_field",
        "attribute",
        help="The attribute with the names. Empty: an attribute with a usual name, such as"
        " id, or else numbers from 1 on.",
        label="Name of the checkpoints",
        advanced=True,
    ),
)
_TARGET = (
    Input(
        "like",
        "raster",
        help="All rasters get the grid of this raster: CRS, cell size, position of the cells,"
        " and extent. It must be in the CRS of the points, with square cells and north up. It"
        " replaces the cell size.",
        label="Raster with the grid to use",
        optional=True,
        advanced=True,
    ),
    Input(
        "raster_extent",
        "extent",
        help="The rasters cover this rectangle, widened to whole cells, which stay where they"
        " are. All points are used. Empty: where the points are.",
        label="Extent of the rasters",
        advanced=True,
    ),
)
# By the kind of the input: attributes have no option, and those without a label no field.
GROUPS = {
    "constraints": _CONSTRAINTS, "corrections": _CORRECTIONS, "checkpoints": _CHECKPOINTS,
    "target": _TARGET,
}  # fmt: skip
