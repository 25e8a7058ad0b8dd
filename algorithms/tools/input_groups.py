"""The inputs that have several options and fields: constraints, corrections, checkpoints, grid."""

from __future__ import annotations

from .declaration import Input

# What the terrain must respect; the fields of `Constraints`.
_CONSTRAINTS = (
    Input(
        "breaklines",
        "lines",
        help="lines that no triangle of the terrain crosses; z is in the unit of heights of the"
        " points, and a line without z gets the height of the nearest ground point on each side"
        " ({formats})",
        label="Breaklines",
        field_help="Lines that no triangle of the terrain crosses: edges of walls, dykes and"
        " terraces. A line with z has this height. Without z, each side of the line has the height"
        " of the nearest ground point on that side.",
        advanced=True,
    ),
    Input(
        "water",
        "polygons",
        help="polygons of water; each is flattened to one level ({formats})",
        label="Water",
        field_help="Polygons of water. Each is flattened to one level, that of the ground along its"
        " border.",
        advanced=True,
    ),
    Input(
        "rivers",
        "lines",
        help="lines along which the level of the water polygons falls ({formats})",
        label="Rivers",
        field_help="Lines along which the level of the water polygons falls. They may be drawn in"
        " either direction.",
        advanced=True,
    ),
    Input(
        "no_ground",
        "polygons",
        help="polygons in which the terrain uses no ground points, such as bridges and roofs"
        " ({formats})",
        label="No ground here",
        field_help="Polygons in which the terrain uses no ground points, such as bridges and roofs."
        " The classes of the points do not change.",
        advanced=True,
    ),
)
_CORRECTIONS = (
    Input(
        "corrections",
        "polygons",
        help="polygons in which you know the class; the attribute 'class' holds it, and it replaces"
        " the result of the filter",
        label="Corrections",
        field_help="Polygons in which you know the class. It replaces the result of the filter. If"
        " it is the class of the ground, points of the chosen returns are ground. Any other class"
        " is given to all points, and the filter does not use them. Where polygons overlap, the"
        " last one counts.",
        advanced=True,
    ),
    Input(
        "corrections_field",
        "attribute",
        label="Class of the corrections",
        field_help="The attribute of these polygons that holds their class: 2 for ground, 1 for"
        " unclassified.",
        advanced=True,
    ),
)
_CHECKPOINTS = (
    Input(
        "checkpoints",
        "points",
        help="points that were surveyed on the ground ({point_formats}), or their x, y and z in the"
        " CRS of the points",
        label="Checkpoints",
        field_help="Points that were surveyed on the ground, of any CRS, or a table (.csv, .txt,"
        " .xyz) in the CRS of the point cloud. May stay empty if points are held out.",
    ),
    Input(
        "columns",
        "text",
        help="the columns or attributes of the checkpoints, by name or by number from 1 on, such as"
        " x=E,y=N,z=H,cover=Class,type=Use,name=ID; those that are not given are recognised by"
        " their names",
    ),
    Input(
        "checkpoints_crs",
        "crs",
        help="the CRS of x and y of the checkpoints, such as EPSG:4326; without it, what the file"
        " states, or the CRS of the points",
    ),
    Input(
        "z_field",
        "attribute",
        label="Height of the checkpoints",
        field_help="The attribute with the heights, in the unit of the heights of the points."
        " Empty: z of the points, or an attribute with a usual name, such as H or elevation.",
    ),
    Input(
        "cover_field",
        "attribute",
        label="Land cover of the checkpoints",
        field_help="The attribute with the land cover, such as forest or NVA. Points on vegetated"
        " land are reported apart, and those of type Control are left out. Empty: an attribute with"
        " a usual name, such as class.",
    ),
    Input(
        "name_field",
        "attribute",
        label="Name of the checkpoints",
        field_help="The attribute with the names. Empty: an attribute with a usual name, such as"
        " id, or else numbers from 1 on.",
        advanced=True,
    ),
)
_TARGET = (
    Input(
        "like",
        "raster",
        help="a raster in the CRS of the points, such as dem.tif: all rasters get its CRS, cell"
        " size, position of the cells, and extent; it replaces the cell size",
        label="Raster with the grid to use",
        field_help="All rasters get the grid of this raster: CRS, cell size, position of the cells,"
        " and extent. It must be in the CRS of the points, with square cells and north up. It"
        " replaces the cell size.",
        optional=True,
        advanced=True,
    ),
    Input(
        "raster_extent",
        "extent",
        help="xmin, ymin, xmax, ymax: the rasters cover this rectangle in the CRS of the points,"
        " widened to whole cells, which stay where they are; all points are used",
        label="Extent of the rasters",
        field_help="The rasters cover this rectangle, widened to whole cells, which stay where they"
        " are. All points are used. Empty: where the points are.",
        advanced=True,
    ),
)
# By the kind of the input: those without a help have no option, those without a label no field.
GROUPS = {
    "constraints": _CONSTRAINTS, "corrections": _CORRECTIONS, "checkpoints": _CHECKPOINTS,
    "target": _TARGET,
}  # fmt: skip
