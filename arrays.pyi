# Made by tools/stub.py from what tools declare. Do not edit.
# ruff: noqa
# fmt: off
from os import PathLike
from typing import Any, Callable, Iterable, Literal, Sequence

from numpy import bool_, float64, uint8
from numpy.typing import ArrayLike, NDArray

from .algorithms.core.progress import Progress
from .algorithms.library.blocks import Block as Block
from .algorithms.library.features import Features as Features
from .algorithms.library.given import Bar
from .algorithms.library.rasters import Raster as Raster
from .algorithms.tools.check.results import Check

_Path = str | PathLike[str]

def above_ground(
    points: Any,
    y: ArrayLike | None = None,
    z: ArrayLike | None = None,
    *,
    ground: ArrayLike | None = None,
    classification: ArrayLike | None = None,
    return_number: ArrayLike | None = None,
    number_of_returns: ArrayLike | None = None,
    withheld: ArrayLike | None = None,
    in_overlap: ArrayLike | None = None,
    extent: Sequence[float] | None = None,
    boundary: Any | None = None,
    above_ground: Literal["asprs", "ign", "own"] = 'asprs',
    medium_height: float = 0.5,
    high_height: float = 2.0,
    low_height: float = 0.0,
    buildings: bool = True,
    building_area: float = 10.0,
    building_height: float = 2.0,
    mark_bridges: bool = True,
    mark_high_noise: bool = True,
    reclassify: bool = False,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    threads: int | None = None,
    crs: Any | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> NDArray[uint8]:
    """Classify vegetation (3, 4, 5), buildings (6), bridges (17) and high noise (18).

    Only points of class 0 and 1 change.

    Parameters
    ----------
    points : array, laspy.LasData or table
        X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a
        laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and,
        where they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a
        structured array, such as PDAL has, a dict of arrays, a table of pandas, polars or
        pyarrow, or a GeoDataFrame of points with z, whose CRS counts; of terrain() also
        blocks().
    y : array of float, shape (n,), optional
        Y of the points, if `points` is x.
    z : array of float, shape (n,), optional
        Z of the points, if `points` is x.
    ground : array of bool, shape (n,), optional
        Which points are ground, as ground() returns them, in place of their classes.
    classification : array of int, shape (n,), optional
        The classes of the points, in place of those of a table.
    return_number : array of int, shape (n,), optional
        The return numbers, from 1 on.
    number_of_returns : array of int, shape (n,), optional
        How many returns the pulse of each point has.
    withheld : array of bool, shape (n,), optional
        Which points are left out of everything.
    in_overlap : array of bool, shape (n,), optional
        Which points lie in the overlap of flight strips.
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: change only points in this rectangle, in the CRS of the points;
        points outside keep their class.
    boundary : path or polygons, optional
        Change only points in these polygons (GeoPackage, GeoJSON, shapefile and others, which
        pyogrio reads; if the file states its CRS, it is transformed to that of the points);
        with an extent only what lies in both.
    above_ground : {"asprs", "ign", "own"}, default "asprs"
        What is no building, no bridge and no noise becomes low (3), medium (4) or high (5)
        vegetation by its height above ground. The LAS specification has these classes, but no
        limits: 0.5 and 2 m are usual. IGN's LiDAR HD has 0.5 and 1.5 m. "asprs": Vegetation low
        below 0.5 m, medium to 2 m, high above. "ign": Vegetation low below 0.5 m, medium to 1.5
        m, high above (IGN). "own": Vegetation by limits of your own.
    medium_height : float, default 0.5 m
        Used only with limits of your own. From 0 to 100 m.
    high_height : float, default 2.0 m
        Used only with limits of your own. From 0 to 100 m.
    low_height : float, default 0.0 m
        Points below this height above ground, and points below the ground, become class 1. From
        0 to 100 m.
    buildings : bool, default True
        Roofs are planes of some size that a laser pulse meets once. Walls below their edges,
        and chimneys and dormers, belong to them.
    building_area : float, default 10.0 m2
        A building has a plane of at least this area. Smaller planes are found only within 5 m
        of a larger one. If this is half as large, tops of conifers become buildings. From 1 to
        10000 m2.
    building_height : float, default 2.0 m
        Roofs are at least this high above the ground. Lower ones are cars and hedges too. From
        0.5 to 100 m.
    mark_bridges : bool, default True
        Decks of bridges, found by their cross-sections. Otherwise they become buildings or
        vegetation. Points that have class 17 already keep it.
    mark_high_noise : bool, default True
        Small groups of points that hang at least 10 m above all others of their place: birds,
        clouds.
    reclassify : bool, default False
        If this is off, only points of class 0 and 1 change. If it is on, points of class 3 to 6
        are decided anew as well. All others keep their class, such as water (9) and wires.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    crs : str, int or pyproj.CRS, optional
        The CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it
        replaces that of a laspy.LasData, and without both coordinates are metres.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    NDArray[uint8]
        The class of each point, shape (n,).

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def blocks(
    sources: _Path | Iterable[_Path],
    *,
    classified: bool = False,
    extent: Sequence[float] | None = None,
    corrections: Any | None = None,
    method: Literal["tin-densification", "grid-minimum", "slope"] = 'tin-densification',
    preset: Literal["automatic", "flat", "hilly", "steep", "town", "city", "site", "lidar360"] | Literal["automatic", "flat", "hilly", "steep", "town", "city", "site", "paper"] | Literal["automatic", "flat", "hilly", "steep", "town", "city", "site", "whitebox"] | None = None,
    max_building_size: float | None = None,
    max_terrain_angle: float | None = None,
    iteration_angle: float | None = None,
    iteration_distance: float | None = None,
    cell_size: float | None = None,
    reduce_angle_edge: float | None = None,
    stop_edge: float | None = None,
    noise_distance: float | None = None,
    ground_tolerance: float | None = None,
    ground_tolerance_below: float | None = None,
    slope_tolerance: float | None = None,
    only_key_points: bool | None = None,
    key_point_tolerance_above: float | None = None,
    key_point_tolerance_below: float | None = None,
    key_point_grid_size: float | None = None,
    height_thresholds: Sequence[float] | None = None,
    final_height: float | None = None,
    max_object_size: float | None = None,
    search_radius: float | None = None,
    min_neighbours: int | None = None,
    slope_threshold: float | None = None,
    height_threshold: float | None = None,
    slope_norm: bool | None = None,
    from_classes: Sequence[int] | Literal["all"] | None = None,
    seed_classes: Sequence[int] | None = None,
    to_class: int = 2,
    returns: Literal["last", "all"] = 'last',
    overlap: Literal["use", "leave-out"] = 'use',
    others: Literal["keep", "unclassified"] = 'keep',
    low_noise_class: bool = False,
    low_noise_depth: float = 1.0,
    high_noise_class: bool = False,
    high_noise_height: float = 10.0,
    bridges: Literal["automatic", "find", "keep"] = 'automatic',
    bridge_class: int | None = None,
    recursive: bool = False,
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> list[Block]:
    """Cut a survey of files into blocks, each of them a task for a cluster.

    Only headers are read. A block is called with no arguments, wherever its files are there
    under the same names, and returns its points with the classes that classify() gives them.
    Functions on arrays take what it returns. terrain() takes all blocks, and gives rasters
    whose values are dask arrays. A task works in one thread, and has its points in memory.

    Parameters
    ----------
    sources : paths or addresses
        Files, folders, virtual point clouds (.vpc), lists of files (.txt), or addresses (https,
        s3, gs, az) of remote point clouds; all of them together are one survey.
    classified : bool, default "False"
        The points are classified already: nothing is found in them anew.
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: only blocks that touch this rectangle, in the CRS of the points.
    corrections : path or polygons, optional
        Polygons in which you know the class; the attribute 'class' holds it, and it replaces
        the result of the filter.
    method : {"tin-densification", "grid-minimum", "slope"}, default "tin-densification"
        The ground filter. TIN densification is the most accurate. "tin-densification": TIN
        densification. "grid-minimum": Grid minimum. "slope": Slope filter.
    preset : by method
        With method='tin-densification': {"automatic", "flat", "hilly", "steep", "town", "city",
        "site", "lidar360"}, default "automatic". Sets the fields that are left empty: from the
        points (automatic), or to values that suit a kind of terrain. The log says which values
        were used. "automatic": Automatic. "flat": Flat land, fields. "hilly": Hilly land,
        forest. "steep": Steep or rugged terrain. "town": Town. "city": City, large halls.
        "site": Drone survey, construction or mining site. "lidar360": LiDAR360's values. With
        method='grid-minimum': {"automatic", "flat", "hilly", "steep", "town", "city", "site",
        "paper"}, default "automatic". Sets the fields that are left empty, to values that suit
        most land (automatic) or a kind of terrain. The log says which values were used.
        "automatic": Automatic. "flat": Flat land, fields. "hilly": Hilly land, forest. "steep":
        Steep or rugged terrain. "town": Town. "city": City, large halls. "site": Drone survey,
        construction or mining site. "paper": The paper's values. With method='slope':
        {"automatic", "flat", "hilly", "steep", "town", "city", "site", "whitebox"}, default
        "automatic". Sets the fields that are left empty. Automatic and the kinds of terrain
        remove buildings as well as shrubs. Whitebox is the classic filter with the values of
        WhiteboxTools: within its radius of 2 m it cannot find a building. "automatic":
        Automatic (many scales, follows the terrain). "flat": Flat land, fields. "hilly": Hilly
        land, forest. "steep": Steep or rugged terrain. "town": Town. "city": City, large halls.
        "site": Drone survey, construction or mining site. "whitebox": Whitebox (one scale, 2 m,
        45 deg, 1 m).
    max_building_size : by method
        With method='tin-densification': float, optional. Shorter side of the largest building
        or other object. Nothing that is narrower and stands out from its surroundings can be a
        seed of the ground. A value that is too large takes longer and loses sharp hilltops.
        None: from the preset. From 1 to 500 m. With method='slope': float, optional. Shorter
        side of the largest building. Buildings wider than two search radii are found by the
        drop on all their sides. None: from the preset, or two search radii if the search radius
        is given. Not used with the preset Whitebox. From 0.1 to 500 m.
    max_terrain_angle : float, default 88.0 deg
        Only of method='tin-densification'. Steepest slope of the ground. In steeper triangles,
        the mirror image of a point beyond the nearest vertex is judged in its place. From 1 to
        89.9 deg.
    iteration_angle : float, optional
        Only of method='tin-densification'. Largest angle between a triangle and the line from
        one of its corners to a new point. A larger angle follows rugged ground better, a
        smaller one keeps low objects out: 4 deg in flat terrain, 10 deg and more in steep
        terrain. None: from the preset. From 0.1 to 90 deg.
    iteration_distance : float, optional
        Only of method='tin-densification'. Largest distance of a new point from its triangle.
        None: from the preset. From 0.01 to 50 m.
    cell_size : by method
        With method='tin-densification': float, optional. Side of the cells whose lowest points
        may become vertices of the TIN; at least the usual distance between points. Smaller
        cells keep narrow banks and sharp edges, but under trees also more plants. None: from
        the preset. From 0.1 to 50 m. With method='grid-minimum': float, optional. Side of the
        square cells whose lowest points are compared. Smaller cells follow finer terrain if
        they hold at least one point, but have more rims at low plants. None: from the preset,
        or larger if points are too sparse for it. From 0.01 to 100 m. With method='slope':
        float, optional. Side of the cells whose lowest points are compared. Not used with the
        preset Whitebox. None: the usual distance between points, at least 1 m (0.5 m in the
        preset for sites). From 0.05 to 50 m.
    reduce_angle_edge : float, default 5.0 m
        Only of method='tin-densification'. In triangles whose longest edge is shorter than
        this, the iteration angle is reduced in proportion. So the TIN does not climb low
        vegetation step by step. None: the angle is never reduced. From 0 to 100 m.
    stop_edge : float, default 2.0 m
        Only of method='tin-densification'. Triangles whose longest edge is shorter than this
        take no more points. None: all triangles can take points. From 0 to 100 m.
    noise_distance : float, default 0.3 m
        Only of method='tin-densification'. A point that is closer to its triangle than this
        joins the TIN whatever its angle. Near a corner, noise alone makes a large angle. From 0
        to 5 m.
    ground_tolerance : by method
        With method='tin-densification': float, optional. In level terrain, points up to this
        height above the final surface are ground. A larger value takes in grass and low bushes.
        None: 0.18 m, and more where points are sparse or noisy. From 0 to 10 m. With
        method='grid-minimum': float, optional. In level terrain, points up to this height above
        the surface of the ground are ground. None: 0.18 m, and more where points are sparse or
        noisy; in the paper's preset 0.4 m. From 0 to 10 m. With method='slope': float,
        optional. In level terrain, points up to this height above the surface through the
        ground are ground. None: 0.18 m, and more where points are sparse or noisy. Not used
        with the preset Whitebox. From 0 to 10 m.
    ground_tolerance_below : float, default 0.6 m
        Only of method='tin-densification'. In level terrain, points down to this depth below
        the final surface are ground. The surface goes through the lowest points, but is
        smoother than they are. From 0 to 10 m.
    slope_tolerance : by method
        With method='tin-densification': float, default 1.4 m. Added to both ground tolerances
        on a slope of 45 degrees. On gentler slopes less is added, in proportion. From 0 to 10
        m. With method='grid-minimum': float, optional. This share of the rise of the ground
        from point to point, over at most a metre, is added to the ground tolerance. In the
        paper's preset it is a share of the rise over one cell. None: from the preset. From 0 to
        10. With method='slope': float, default 1.4 m. Added to the ground tolerance on a slope
        of 45 degrees, if points are a metre apart. Less is added, in proportion, on gentler
        slopes and if points are closer. From 0 to 10 m.
    only_key_points : bool, default False
        Only of method='tin-densification'. Only the points that a terrain model needs become
        ground. Of all other ground points, none lies farther from the TIN of these key points
        than the two tolerances below.
    key_point_tolerance_above : float, default 0.15 m
        Only of method='tin-densification'. How far a ground point may lie above the TIN of the
        key points. Choose about the accuracy of the heights, or half the contour interval that
        you want. From 0 to 100 m.
    key_point_tolerance_below : float, default 0.15 m
        Only of method='tin-densification'. How far a ground point may lie below the TIN of the
        key points. From 0 to 100 m.
    key_point_grid_size : float, default 20.0 m
        Only of method='tin-densification'. In each cell of this size that has ground points, at
        least the lowest one is a key point, however flat the ground is. From 0.1 to 10000 m.
    height_thresholds : sequence of float, optional
        Only of method='grid-minimum'. One pass for each threshold, the largest first. If two
        neighbouring cells differ by more than the threshold, the higher one is the rim of an
        object. None: from the preset. From 0.05 to 1000 m.
    final_height : float, optional
        Only of method='grid-minimum'. The last pass removes whatever stands this far above the
        ground beside it: bushes, cars, walls. A larger value keeps more of rough ground. None:
        from the preset. From 0.01 to 100 m.
    max_object_size : float, optional
        Only of method='grid-minimum'. Shorter side of the largest building. Anything wider is
        terrain. None: from the preset. From 0.1 to 1000 m.
    search_radius : float, optional
        Only of method='slope'. Points are compared with their neighbours up to this distance.
        Choose at least half the shorter side of the largest building. None: from the preset, 18
        m in the automatic one (more if points are sparse), 2 m in Whitebox. From 0.1 to 500 m.
    min_neighbours : int, default 0 points
        Only of method='slope'. A point with fewer neighbours within the search radius is
        compared with this many nearest points. Only for the preset Whitebox. From 0 to 10000
        points.
    slope_threshold : float, optional
        Only of method='slope'. A point is not ground if it stands above a neighbour at a
        steeper slope than this. In all presets but Whitebox, the slope of the terrain around
        the point is added to it. None: from the preset, 15 deg in most, 45 deg in Whitebox.
        From 0 to 88 deg.
    height_threshold : float, optional
        Only of method='slope'. A point is not ground only if it stands at least this high above
        a neighbour. None: from the preset, 0.5 m in most, 1 m in Whitebox. From 0 to 100 m.
    slope_norm : bool, default True
        Only of method='slope'. Compares heights above a surface that follows the terrain (white
        top-hat), not elevations, so that ground on slopes is not lost.
    from_classes : sequence of int or "all", optional
        Only points of these classes take part and may change their class. None: 0 to 6, 8, 12
        and the class of the ground. Points of other classes, such as water (9) and bridge decks
        (17), keep their class. Rails and roads (10 and 11) keep theirs too, but take part. all:
        all classes but low and high noise (7 and 18). From 0 to 255.
    seed_classes : sequence of int, optional
        Points of these classes are certain ground, whatever their return: the filter does not
        judge them, and TIN densification starts from them. They get the class of the ground,
        unless their class is not among the classes to classify. None: none. From 0 to 255.
    to_class : int, default 2
        The class that ground points get; 2 is ground in the LAS specification. Point formats 0
        to 5 hold classes up to 31. From 0 to 255.
    returns : {"last", "all"}, default "last"
        Last returns reach the ground. Take all returns if the return numbers of the file are
        wrong. "last": Last and single returns (return number = number of returns). "all": All
        returns.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out: ground, and rasters made in
        the same run, then come from one strip everywhere. "use": Take part as others do.
        "leave-out": Leave out; they keep their class.
    others : {"keep", "unclassified"}, default "keep"
        The class of points that are not ground. Points that were never classified (0) become 1
        in both cases. Noise, withheld points, and classes that are not classified stay as they
        are. "keep": Keep; old ground that is not ground now becomes 1. "unclassified": Set to 1
        (unclassified).
    low_noise_class : bool, default False
        Points that took part and lie far below the ground (multipath, faults of the sensor)
        become low noise, class 7. If this is off, they are treated as other points.
    low_noise_depth : float, default 1.0 m
        A point becomes low noise if it lies farther below the ground than this. On slopes, the
        rise of the ground over 1 m is added. Points with ground all round them that lie 0.4 m
        and more below it become low noise too. Used only if low outliers are put into class 7.
        From 0.05 to 1000 m.
    high_noise_class : bool, default False
        Points that took part and hang far above all others of their place, alone or in small
        groups (birds, clouds, faults of the sensor) become high noise, class 18. Wires, masts
        and trees do not. Surface and canopy models never use such points, whether this is on or
        off.
    high_noise_height : float, default 10.0 m
        A point becomes high noise if it hangs at least this far above all others within about
        10 m. Used only if high outliers are put into class 18. From 1 to 1000 m.
    bridges : {"automatic", "find", "keep"}, default "automatic"
        The class of bridge decks. They are found by cross-sections that fall to lower ground on
        both sides; ramps, dams and embankments stay ground. A classic preset (Whitebox,
        LiDAR360's, the paper's) works as the original does, and does not look for bridges.
        "automatic": Not ground, except with a classic preset. "find": Not ground. "keep": As
        the filter classifies them.
    bridge_class : int, optional
        The class of bridge decks that are not ground. In the LAS specification it is 17, and
        every point format can hold it. None: the class of other points. From 0 to 255.
    recursive : bool, default False
        Searches each folder with all its subfolders.
    crs : str, int or pyproj.CRS, optional
        The CRS of the points, for files that state none or a wrong one: an EPSG code, such as
        EPSG:2230 or EPSG:2230+6360 (with heights), or WKT; it replaces what files state.
    cache : path, optional
        The folder that keeps what is fetched of remote point clouds; without it that of
        BARE_EARTH_CACHE, or one of the user.
    limit : float, optional
        Gigabytes that may be fetched of remote point clouds; without it 2.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    list[Block]
        The blocks from south to north, as :class:`Block`.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def check(
    points: Any,
    y: ArrayLike | None = None,
    z: ArrayLike | None = None,
    *,
    ground: ArrayLike | None = None,
    classification: ArrayLike | None = None,
    return_number: ArrayLike | None = None,
    number_of_returns: ArrayLike | None = None,
    withheld: ArrayLike | None = None,
    in_overlap: ArrayLike | None = None,
    checkpoints: Any | None = None,
    columns: str | None = None,
    checkpoints_crs: Any | None = None,
    vegetated: Sequence[str] | None = None,
    accuracy_class: float | None = None,
    survey_error: float = 0.0,
    max_edge: float = 20.0,
    min_confidence: float = 0.5,
    hold_out: float | None = None,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    crs: Any | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Check:
    """Compare the ground with checkpoints, or with ground points that are held out.

    The figures are those of check() for a file with the same points.

    Parameters
    ----------
    points : array, laspy.LasData or table
        X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a
        laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and,
        where they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a
        structured array, such as PDAL has, a dict of arrays, a table of pandas, polars or
        pyarrow, or a GeoDataFrame of points with z, whose CRS counts; of terrain() also
        blocks().
    y : array of float, shape (n,), optional
        Y of the points, if `points` is x.
    z : array of float, shape (n,), optional
        Z of the points, if `points` is x.
    ground : array of bool, shape (n,), optional
        Which points are ground, as ground() returns them, in place of their classes.
    classification : array of int, shape (n,), optional
        The classes of the points, in place of those of a table.
    return_number : array of int, shape (n,), optional
        The return numbers, from 1 on.
    number_of_returns : array of int, shape (n,), optional
        How many returns the pulse of each point has.
    withheld : array of bool, shape (n,), optional
        Which points are left out of everything.
    in_overlap : array of bool, shape (n,), optional
        Which points lie in the overlap of flight strips.
    checkpoints : path, points or array of shape (n, 3), optional
        Points that were surveyed on the ground (CSV and other tables in the CRS of the points,
        GeoJSON, or with pyogrio GeoPackage, shapefile and others, whose CRS is transformed to
        that of the points), or their x, y and z in the CRS of the points.
    columns : str, optional
        The columns or attributes of the checkpoints, by name or by number from 1 on, such as
        x=E,y=N,z=H,cover=Class,type=Use,name=ID; those that are not given are recognised by
        their names.
    checkpoints_crs : str, int or pyproj.CRS, optional
        The CRS of x and y of the checkpoints, such as EPSG:4326; without it, what the file
        states, or the CRS of the points.
    vegetated : sequence of str, optional
        Land covers with one of these words are vegetated, and no others.
    accuracy_class : float, optional
        The vertical accuracy class that the data are to meet, as RMSE: 0.1 for the 10 cm class.
        It is tested by the checkpoints on land without vegetation. None: the figures are only
        reported. From 0.001 to 100 m.
    survey_error : float, default 0.0 m
        RMSE of the heights of the checkpoints themselves, as their survey states it. The
        standard adds it to that of the data: square root of the sum of the squares. From 0 to
        10 m.
    max_edge : float, default 20.0 m
        Checkpoints in triangles with a longer edge lie in a void of the ground, such as a
        building, and are not counted. From 0.1 to 1000 m.
    min_confidence : float, default 0.5
        Checkpoints where the raster of confidence has less are not counted. From 0 to 1.
    hold_out : float, optional
        Leaves out so large a share of the ground points, such as 0.02, and measures how well
        the others predict them, on open land, under trees and on steep land. This needs no
        checkpoints, but it does not tell how right the heights are. From 0.0001 to 0.5. None:
        not used.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    crs : str, int or pyproj.CRS, optional
        The CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it
        replaces that of a laspy.LasData, and without both coordinates are metres.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    Check
        The result of a comparison with checkpoints; all errors are in metres.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def classify(
    points: Any,
    y: ArrayLike | None = None,
    z: ArrayLike | None = None,
    *,
    classification: ArrayLike | None = None,
    return_number: ArrayLike | None = None,
    number_of_returns: ArrayLike | None = None,
    withheld: ArrayLike | None = None,
    in_overlap: ArrayLike | None = None,
    extent: Sequence[float] | None = None,
    boundary: Any | None = None,
    corrections: Any | None = None,
    method: Literal["tin-densification", "grid-minimum", "slope"] = 'tin-densification',
    preset: Literal["automatic", "flat", "hilly", "steep", "town", "city", "site", "lidar360"] | Literal["automatic", "flat", "hilly", "steep", "town", "city", "site", "paper"] | Literal["automatic", "flat", "hilly", "steep", "town", "city", "site", "whitebox"] | None = None,
    max_building_size: float | None = None,
    max_terrain_angle: float | None = None,
    iteration_angle: float | None = None,
    iteration_distance: float | None = None,
    cell_size: float | None = None,
    reduce_angle_edge: float | None = None,
    stop_edge: float | None = None,
    noise_distance: float | None = None,
    ground_tolerance: float | None = None,
    ground_tolerance_below: float | None = None,
    slope_tolerance: float | None = None,
    only_key_points: bool | None = None,
    key_point_tolerance_above: float | None = None,
    key_point_tolerance_below: float | None = None,
    key_point_grid_size: float | None = None,
    height_thresholds: Sequence[float] | None = None,
    final_height: float | None = None,
    max_object_size: float | None = None,
    search_radius: float | None = None,
    min_neighbours: int | None = None,
    slope_threshold: float | None = None,
    height_threshold: float | None = None,
    slope_norm: bool | None = None,
    from_classes: Sequence[int] | Literal["all"] | None = None,
    seed_classes: Sequence[int] | None = None,
    to_class: int = 2,
    returns: Literal["last", "all"] = 'last',
    overlap: Literal["use", "leave-out"] = 'use',
    others: Literal["keep", "unclassified"] = 'keep',
    low_noise_class: bool = False,
    low_noise_depth: float = 1.0,
    high_noise_class: bool = False,
    high_noise_height: float = 10.0,
    bridges: Literal["automatic", "find", "keep"] = 'automatic',
    bridge_class: int | None = None,
    threads: int | None = None,
    crs: Any | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> NDArray[uint8]:
    """Classify ground (2), low noise (7) and bridge decks (17).

    The labels are those of classify() on a file with the same points.

    Parameters
    ----------
    points : array, laspy.LasData or table
        X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a
        laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and,
        where they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a
        structured array, such as PDAL has, a dict of arrays, a table of pandas, polars or
        pyarrow, or a GeoDataFrame of points with z, whose CRS counts; of terrain() also
        blocks().
    y : array of float, shape (n,), optional
        Y of the points, if `points` is x.
    z : array of float, shape (n,), optional
        Z of the points, if `points` is x.
    classification : array of int, shape (n,), optional
        The classes of the points, in place of those of a table.
    return_number : array of int, shape (n,), optional
        The return numbers, from 1 on.
    number_of_returns : array of int, shape (n,), optional
        How many returns the pulse of each point has.
    withheld : array of bool, shape (n,), optional
        Which points are left out of everything.
    in_overlap : array of bool, shape (n,), optional
        Which points lie in the overlap of flight strips.
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: classify only points in this rectangle, in the CRS of the
        points; points nearby help.
    boundary : path or polygons, optional
        Classify only points in these polygons (GeoPackage, GeoJSON, shapefile and others, which
        pyogrio reads; if the file states its CRS, it is transformed to that of the points);
        with an extent only what lies in both.
    corrections : path or polygons, optional
        Polygons in which you know the class; the attribute 'class' holds it, and it replaces
        the result of the filter.
    method : {"tin-densification", "grid-minimum", "slope"}, default "tin-densification"
        The ground filter. TIN densification is the most accurate. "tin-densification": TIN
        densification. "grid-minimum": Grid minimum. "slope": Slope filter.
    preset : by method
        With method='tin-densification': {"automatic", "flat", "hilly", "steep", "town", "city",
        "site", "lidar360"}, default "automatic". Sets the fields that are left empty: from the
        points (automatic), or to values that suit a kind of terrain. The log says which values
        were used. "automatic": Automatic. "flat": Flat land, fields. "hilly": Hilly land,
        forest. "steep": Steep or rugged terrain. "town": Town. "city": City, large halls.
        "site": Drone survey, construction or mining site. "lidar360": LiDAR360's values. With
        method='grid-minimum': {"automatic", "flat", "hilly", "steep", "town", "city", "site",
        "paper"}, default "automatic". Sets the fields that are left empty, to values that suit
        most land (automatic) or a kind of terrain. The log says which values were used.
        "automatic": Automatic. "flat": Flat land, fields. "hilly": Hilly land, forest. "steep":
        Steep or rugged terrain. "town": Town. "city": City, large halls. "site": Drone survey,
        construction or mining site. "paper": The paper's values. With method='slope':
        {"automatic", "flat", "hilly", "steep", "town", "city", "site", "whitebox"}, default
        "automatic". Sets the fields that are left empty. Automatic and the kinds of terrain
        remove buildings as well as shrubs. Whitebox is the classic filter with the values of
        WhiteboxTools: within its radius of 2 m it cannot find a building. "automatic":
        Automatic (many scales, follows the terrain). "flat": Flat land, fields. "hilly": Hilly
        land, forest. "steep": Steep or rugged terrain. "town": Town. "city": City, large halls.
        "site": Drone survey, construction or mining site. "whitebox": Whitebox (one scale, 2 m,
        45 deg, 1 m).
    max_building_size : by method
        With method='tin-densification': float, optional. Shorter side of the largest building
        or other object. Nothing that is narrower and stands out from its surroundings can be a
        seed of the ground. A value that is too large takes longer and loses sharp hilltops.
        None: from the preset. From 1 to 500 m. With method='slope': float, optional. Shorter
        side of the largest building. Buildings wider than two search radii are found by the
        drop on all their sides. None: from the preset, or two search radii if the search radius
        is given. Not used with the preset Whitebox. From 0.1 to 500 m.
    max_terrain_angle : float, default 88.0 deg
        Only of method='tin-densification'. Steepest slope of the ground. In steeper triangles,
        the mirror image of a point beyond the nearest vertex is judged in its place. From 1 to
        89.9 deg.
    iteration_angle : float, optional
        Only of method='tin-densification'. Largest angle between a triangle and the line from
        one of its corners to a new point. A larger angle follows rugged ground better, a
        smaller one keeps low objects out: 4 deg in flat terrain, 10 deg and more in steep
        terrain. None: from the preset. From 0.1 to 90 deg.
    iteration_distance : float, optional
        Only of method='tin-densification'. Largest distance of a new point from its triangle.
        None: from the preset. From 0.01 to 50 m.
    cell_size : by method
        With method='tin-densification': float, optional. Side of the cells whose lowest points
        may become vertices of the TIN; at least the usual distance between points. Smaller
        cells keep narrow banks and sharp edges, but under trees also more plants. None: from
        the preset. From 0.1 to 50 m. With method='grid-minimum': float, optional. Side of the
        square cells whose lowest points are compared. Smaller cells follow finer terrain if
        they hold at least one point, but have more rims at low plants. None: from the preset,
        or larger if points are too sparse for it. From 0.01 to 100 m. With method='slope':
        float, optional. Side of the cells whose lowest points are compared. Not used with the
        preset Whitebox. None: the usual distance between points, at least 1 m (0.5 m in the
        preset for sites). From 0.05 to 50 m.
    reduce_angle_edge : float, default 5.0 m
        Only of method='tin-densification'. In triangles whose longest edge is shorter than
        this, the iteration angle is reduced in proportion. So the TIN does not climb low
        vegetation step by step. None: the angle is never reduced. From 0 to 100 m.
    stop_edge : float, default 2.0 m
        Only of method='tin-densification'. Triangles whose longest edge is shorter than this
        take no more points. None: all triangles can take points. From 0 to 100 m.
    noise_distance : float, default 0.3 m
        Only of method='tin-densification'. A point that is closer to its triangle than this
        joins the TIN whatever its angle. Near a corner, noise alone makes a large angle. From 0
        to 5 m.
    ground_tolerance : by method
        With method='tin-densification': float, optional. In level terrain, points up to this
        height above the final surface are ground. A larger value takes in grass and low bushes.
        None: 0.18 m, and more where points are sparse or noisy. From 0 to 10 m. With
        method='grid-minimum': float, optional. In level terrain, points up to this height above
        the surface of the ground are ground. None: 0.18 m, and more where points are sparse or
        noisy; in the paper's preset 0.4 m. From 0 to 10 m. With method='slope': float,
        optional. In level terrain, points up to this height above the surface through the
        ground are ground. None: 0.18 m, and more where points are sparse or noisy. Not used
        with the preset Whitebox. From 0 to 10 m.
    ground_tolerance_below : float, default 0.6 m
        Only of method='tin-densification'. In level terrain, points down to this depth below
        the final surface are ground. The surface goes through the lowest points, but is
        smoother than they are. From 0 to 10 m.
    slope_tolerance : by method
        With method='tin-densification': float, default 1.4 m. Added to both ground tolerances
        on a slope of 45 degrees. On gentler slopes less is added, in proportion. From 0 to 10
        m. With method='grid-minimum': float, optional. This share of the rise of the ground
        from point to point, over at most a metre, is added to the ground tolerance. In the
        paper's preset it is a share of the rise over one cell. None: from the preset. From 0 to
        10. With method='slope': float, default 1.4 m. Added to the ground tolerance on a slope
        of 45 degrees, if points are a metre apart. Less is added, in proportion, on gentler
        slopes and if points are closer. From 0 to 10 m.
    only_key_points : bool, default False
        Only of method='tin-densification'. Only the points that a terrain model needs become
        ground. Of all other ground points, none lies farther from the TIN of these key points
        than the two tolerances below.
    key_point_tolerance_above : float, default 0.15 m
        Only of method='tin-densification'. How far a ground point may lie above the TIN of the
        key points. Choose about the accuracy of the heights, or half the contour interval that
        you want. From 0 to 100 m.
    key_point_tolerance_below : float, default 0.15 m
        Only of method='tin-densification'. How far a ground point may lie below the TIN of the
        key points. From 0 to 100 m.
    key_point_grid_size : float, default 20.0 m
        Only of method='tin-densification'. In each cell of this size that has ground points, at
        least the lowest one is a key point, however flat the ground is. From 0.1 to 10000 m.
    height_thresholds : sequence of float, optional
        Only of method='grid-minimum'. One pass for each threshold, the largest first. If two
        neighbouring cells differ by more than the threshold, the higher one is the rim of an
        object. None: from the preset. From 0.05 to 1000 m.
    final_height : float, optional
        Only of method='grid-minimum'. The last pass removes whatever stands this far above the
        ground beside it: bushes, cars, walls. A larger value keeps more of rough ground. None:
        from the preset. From 0.01 to 100 m.
    max_object_size : float, optional
        Only of method='grid-minimum'. Shorter side of the largest building. Anything wider is
        terrain. None: from the preset. From 0.1 to 1000 m.
    search_radius : float, optional
        Only of method='slope'. Points are compared with their neighbours up to this distance.
        Choose at least half the shorter side of the largest building. None: from the preset, 18
        m in the automatic one (more if points are sparse), 2 m in Whitebox. From 0.1 to 500 m.
    min_neighbours : int, default 0 points
        Only of method='slope'. A point with fewer neighbours within the search radius is
        compared with this many nearest points. Only for the preset Whitebox. From 0 to 10000
        points.
    slope_threshold : float, optional
        Only of method='slope'. A point is not ground if it stands above a neighbour at a
        steeper slope than this. In all presets but Whitebox, the slope of the terrain around
        the point is added to it. None: from the preset, 15 deg in most, 45 deg in Whitebox.
        From 0 to 88 deg.
    height_threshold : float, optional
        Only of method='slope'. A point is not ground only if it stands at least this high above
        a neighbour. None: from the preset, 0.5 m in most, 1 m in Whitebox. From 0 to 100 m.
    slope_norm : bool, default True
        Only of method='slope'. Compares heights above a surface that follows the terrain (white
        top-hat), not elevations, so that ground on slopes is not lost.
    from_classes : sequence of int or "all", optional
        Only points of these classes take part and may change their class. None: 0 to 6, 8, 12
        and the class of the ground. Points of other classes, such as water (9) and bridge decks
        (17), keep their class. Rails and roads (10 and 11) keep theirs too, but take part. all:
        all classes but low and high noise (7 and 18). From 0 to 255.
    seed_classes : sequence of int, optional
        Points of these classes are certain ground, whatever their return: the filter does not
        judge them, and TIN densification starts from them. They get the class of the ground,
        unless their class is not among the classes to classify. None: none. From 0 to 255.
    to_class : int, default 2
        The class that ground points get; 2 is ground in the LAS specification. Point formats 0
        to 5 hold classes up to 31. From 0 to 255.
    returns : {"last", "all"}, default "last"
        Last returns reach the ground. Take all returns if the return numbers of the file are
        wrong. "last": Last and single returns (return number = number of returns). "all": All
        returns.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out: ground, and rasters made in
        the same run, then come from one strip everywhere. "use": Take part as others do.
        "leave-out": Leave out; they keep their class.
    others : {"keep", "unclassified"}, default "keep"
        The class of points that are not ground. Points that were never classified (0) become 1
        in both cases. Noise, withheld points, and classes that are not classified stay as they
        are. "keep": Keep; old ground that is not ground now becomes 1. "unclassified": Set to 1
        (unclassified).
    low_noise_class : bool, default False
        Points that took part and lie far below the ground (multipath, faults of the sensor)
        become low noise, class 7. If this is off, they are treated as other points.
    low_noise_depth : float, default 1.0 m
        A point becomes low noise if it lies farther below the ground than this. On slopes, the
        rise of the ground over 1 m is added. Points with ground all round them that lie 0.4 m
        and more below it become low noise too. Used only if low outliers are put into class 7.
        From 0.05 to 1000 m.
    high_noise_class : bool, default False
        Points that took part and hang far above all others of their place, alone or in small
        groups (birds, clouds, faults of the sensor) become high noise, class 18. Wires, masts
        and trees do not. Surface and canopy models never use such points, whether this is on or
        off.
    high_noise_height : float, default 10.0 m
        A point becomes high noise if it hangs at least this far above all others within about
        10 m. Used only if high outliers are put into class 18. From 1 to 1000 m.
    bridges : {"automatic", "find", "keep"}, default "automatic"
        The class of bridge decks. They are found by cross-sections that fall to lower ground on
        both sides; ramps, dams and embankments stay ground. A classic preset (Whitebox,
        LiDAR360's, the paper's) works as the original does, and does not look for bridges.
        "automatic": Not ground, except with a classic preset. "find": Not ground. "keep": As
        the filter classifies them.
    bridge_class : int, optional
        The class of bridge decks that are not ground. In the LAS specification it is 17, and
        every point format can hold it. None: the class of other points. From 0 to 255.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    crs : str, int or pyproj.CRS, optional
        The CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it
        replaces that of a laspy.LasData, and without both coordinates are metres.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    NDArray[uint8]
        The class of each point, shape (n,).

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def confidence(
    points: Any,
    y: ArrayLike | None = None,
    z: ArrayLike | None = None,
    *,
    ground: ArrayLike | None = None,
    classification: ArrayLike | None = None,
    return_number: ArrayLike | None = None,
    number_of_returns: ArrayLike | None = None,
    withheld: ArrayLike | None = None,
    in_overlap: ArrayLike | None = None,
    like: Any | None = None,
    raster_extent: Sequence[float] | None = None,
    extent: Sequence[float] | None = None,
    boundary: Any | None = None,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    dtm_cell_size: float = 1.0,
    threads: int | None = None,
    crs: Any | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Raster:
    """Tell how sure the terrain is in each cell, from 0 to 1.

    The cells are those of the confidence that terrain() makes.

    Parameters
    ----------
    points : array, laspy.LasData or table
        X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a
        laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and,
        where they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a
        structured array, such as PDAL has, a dict of arrays, a table of pandas, polars or
        pyarrow, or a GeoDataFrame of points with z, whose CRS counts; of terrain() also
        blocks().
    y : array of float, shape (n,), optional
        Y of the points, if `points` is x.
    z : array of float, shape (n,), optional
        Z of the points, if `points` is x.
    ground : array of bool, shape (n,), optional
        Which points are ground, as ground() returns them, in place of their classes.
    classification : array of int, shape (n,), optional
        The classes of the points, in place of those of a table.
    return_number : array of int, shape (n,), optional
        The return numbers, from 1 on.
    number_of_returns : array of int, shape (n,), optional
        How many returns the pulse of each point has.
    withheld : array of bool, shape (n,), optional
        Which points are left out of everything.
    in_overlap : array of bool, shape (n,), optional
        Which points lie in the overlap of flight strips.
    like : path, Raster or xarray.DataArray, optional
        A raster in the CRS of the points, such as dem.tif: all rasters get its CRS, cell size,
        position of the cells, and extent; it replaces the cell size.
    raster_extent : four floats, optional
        Xmin, ymin, xmax, ymax: the rasters cover this rectangle in the CRS of the points,
        widened to whole cells, which stay where they are; all points are used.
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: make the raster only in this rectangle, in the CRS of the
        points.
    boundary : path or polygons, optional
        Make the raster only in these polygons (GeoPackage, GeoJSON, shapefile and others, which
        pyogrio reads; if the file states its CRS, it is transformed to that of the points);
        with an extent only what lies in both.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    dtm_cell_size : float, default 1.0 m
        Side of a cell of the terrain model and of its hillshade. Choose about the distance
        between ground points; smaller cells only make the file larger. From 0.01 to 1000 m.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    crs : str, int or pyproj.CRS, optional
        The CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it
        replaces that of a laspy.LasData, and without both coordinates are metres.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    Raster
        The confidence; NaN where it is not known.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def contours(
    raster: Any,
    *,
    contour_interval: float | None = None,
    interval: float | None = None,
    contour_smoothing: float = 3.0,
    contour_min_length: float = 10.0,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Features:
    """Draw contour lines of a terrain model, of its heights smoothed for the lines only.

    The lines are those that contours() writes for a file with the same cells.

    Parameters
    ----------
    raster : path, Raster or xarray.DataArray
        A raster of heights, such as terrain(points)["dtm"], an xarray.DataArray with x and y,
        or a file.
    contour_interval : float, optional
        The height between contour lines, in the vertical unit of the CRS: metres, or feet if
        the heights are feet. None: 1, 2 or 5 times a power of ten, so that there are about 20
        lines. Every fifth line is an index contour. From 0.001 to 10000 m or ft.
    interval : optional
        The same as `contour_interval`, of one value.
    contour_smoothing : float, default 3.0 m
        For the lines, each height is averaged with its surroundings up to about this distance,
        so that they do not show noise. The terrain model does not change. 0: as the terrain
        model is. From 0 to 1000 m.
    contour_min_length : float, default 10.0 m
        Closed lines that are shorter are left out: they show single plants and noise. From 0 to
        10000 m.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    Features
        The lines: ELEV is the height, INDEX 1 for every fifth line.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def ground(
    points: Any,
    y: ArrayLike | None = None,
    z: ArrayLike | None = None,
    *,
    classification: ArrayLike | None = None,
    return_number: ArrayLike | None = None,
    number_of_returns: ArrayLike | None = None,
    withheld: ArrayLike | None = None,
    in_overlap: ArrayLike | None = None,
    extent: Sequence[float] | None = None,
    boundary: Any | None = None,
    corrections: Any | None = None,
    method: Literal["tin-densification", "grid-minimum", "slope"] = 'tin-densification',
    preset: Literal["automatic", "flat", "hilly", "steep", "town", "city", "site", "lidar360"] | Literal["automatic", "flat", "hilly", "steep", "town", "city", "site", "paper"] | Literal["automatic", "flat", "hilly", "steep", "town", "city", "site", "whitebox"] | None = None,
    max_building_size: float | None = None,
    max_terrain_angle: float | None = None,
    iteration_angle: float | None = None,
    iteration_distance: float | None = None,
    cell_size: float | None = None,
    reduce_angle_edge: float | None = None,
    stop_edge: float | None = None,
    noise_distance: float | None = None,
    ground_tolerance: float | None = None,
    ground_tolerance_below: float | None = None,
    slope_tolerance: float | None = None,
    only_key_points: bool | None = None,
    key_point_tolerance_above: float | None = None,
    key_point_tolerance_below: float | None = None,
    key_point_grid_size: float | None = None,
    height_thresholds: Sequence[float] | None = None,
    final_height: float | None = None,
    max_object_size: float | None = None,
    search_radius: float | None = None,
    min_neighbours: int | None = None,
    slope_threshold: float | None = None,
    height_threshold: float | None = None,
    slope_norm: bool | None = None,
    from_classes: Sequence[int] | Literal["all"] | None = None,
    seed_classes: Sequence[int] | None = None,
    to_class: int = 2,
    returns: Literal["last", "all"] = 'last',
    overlap: Literal["use", "leave-out"] = 'use',
    others: Literal["keep", "unclassified"] = 'keep',
    low_noise_class: bool = False,
    low_noise_depth: float = 1.0,
    high_noise_class: bool = False,
    high_noise_height: float = 10.0,
    bridges: Literal["automatic", "find", "keep"] = 'automatic',
    bridge_class: int | None = None,
    threads: int | None = None,
    crs: Any | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> NDArray[bool_]:
    """Find the ground points.

    The labels are those of classify() on a file with the same points.

    Parameters
    ----------
    points : array, laspy.LasData or table
        X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a
        laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and,
        where they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a
        structured array, such as PDAL has, a dict of arrays, a table of pandas, polars or
        pyarrow, or a GeoDataFrame of points with z, whose CRS counts; of terrain() also
        blocks().
    y : array of float, shape (n,), optional
        Y of the points, if `points` is x.
    z : array of float, shape (n,), optional
        Z of the points, if `points` is x.
    classification : array of int, shape (n,), optional
        The classes of the points, in place of those of a table.
    return_number : array of int, shape (n,), optional
        The return numbers, from 1 on.
    number_of_returns : array of int, shape (n,), optional
        How many returns the pulse of each point has.
    withheld : array of bool, shape (n,), optional
        Which points are left out of everything.
    in_overlap : array of bool, shape (n,), optional
        Which points lie in the overlap of flight strips.
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: classify only points in this rectangle, in the CRS of the
        points; points nearby help.
    boundary : path or polygons, optional
        Classify only points in these polygons (GeoPackage, GeoJSON, shapefile and others, which
        pyogrio reads; if the file states its CRS, it is transformed to that of the points);
        with an extent only what lies in both.
    corrections : path or polygons, optional
        Polygons in which you know the class; the attribute 'class' holds it, and it replaces
        the result of the filter.
    method : {"tin-densification", "grid-minimum", "slope"}, default "tin-densification"
        The ground filter. TIN densification is the most accurate. "tin-densification": TIN
        densification. "grid-minimum": Grid minimum. "slope": Slope filter.
    preset : by method
        With method='tin-densification': {"automatic", "flat", "hilly", "steep", "town", "city",
        "site", "lidar360"}, default "automatic". Sets the fields that are left empty: from the
        points (automatic), or to values that suit a kind of terrain. The log says which values
        were used. "automatic": Automatic. "flat": Flat land, fields. "hilly": Hilly land,
        forest. "steep": Steep or rugged terrain. "town": Town. "city": City, large halls.
        "site": Drone survey, construction or mining site. "lidar360": LiDAR360's values. With
        method='grid-minimum': {"automatic", "flat", "hilly", "steep", "town", "city", "site",
        "paper"}, default "automatic". Sets the fields that are left empty, to values that suit
        most land (automatic) or a kind of terrain. The log says which values were used.
        "automatic": Automatic. "flat": Flat land, fields. "hilly": Hilly land, forest. "steep":
        Steep or rugged terrain. "town": Town. "city": City, large halls. "site": Drone survey,
        construction or mining site. "paper": The paper's values. With method='slope':
        {"automatic", "flat", "hilly", "steep", "town", "city", "site", "whitebox"}, default
        "automatic". Sets the fields that are left empty. Automatic and the kinds of terrain
        remove buildings as well as shrubs. Whitebox is the classic filter with the values of
        WhiteboxTools: within its radius of 2 m it cannot find a building. "automatic":
        Automatic (many scales, follows the terrain). "flat": Flat land, fields. "hilly": Hilly
        land, forest. "steep": Steep or rugged terrain. "town": Town. "city": City, large halls.
        "site": Drone survey, construction or mining site. "whitebox": Whitebox (one scale, 2 m,
        45 deg, 1 m).
    max_building_size : by method
        With method='tin-densification': float, optional. Shorter side of the largest building
        or other object. Nothing that is narrower and stands out from its surroundings can be a
        seed of the ground. A value that is too large takes longer and loses sharp hilltops.
        None: from the preset. From 1 to 500 m. With method='slope': float, optional. Shorter
        side of the largest building. Buildings wider than two search radii are found by the
        drop on all their sides. None: from the preset, or two search radii if the search radius
        is given. Not used with the preset Whitebox. From 0.1 to 500 m.
    max_terrain_angle : float, default 88.0 deg
        Only of method='tin-densification'. Steepest slope of the ground. In steeper triangles,
        the mirror image of a point beyond the nearest vertex is judged in its place. From 1 to
        89.9 deg.
    iteration_angle : float, optional
        Only of method='tin-densification'. Largest angle between a triangle and the line from
        one of its corners to a new point. A larger angle follows rugged ground better, a
        smaller one keeps low objects out: 4 deg in flat terrain, 10 deg and more in steep
        terrain. None: from the preset. From 0.1 to 90 deg.
    iteration_distance : float, optional
        Only of method='tin-densification'. Largest distance of a new point from its triangle.
        None: from the preset. From 0.01 to 50 m.
    cell_size : by method
        With method='tin-densification': float, optional. Side of the cells whose lowest points
        may become vertices of the TIN; at least the usual distance between points. Smaller
        cells keep narrow banks and sharp edges, but under trees also more plants. None: from
        the preset. From 0.1 to 50 m. With method='grid-minimum': float, optional. Side of the
        square cells whose lowest points are compared. Smaller cells follow finer terrain if
        they hold at least one point, but have more rims at low plants. None: from the preset,
        or larger if points are too sparse for it. From 0.01 to 100 m. With method='slope':
        float, optional. Side of the cells whose lowest points are compared. Not used with the
        preset Whitebox. None: the usual distance between points, at least 1 m (0.5 m in the
        preset for sites). From 0.05 to 50 m.
    reduce_angle_edge : float, default 5.0 m
        Only of method='tin-densification'. In triangles whose longest edge is shorter than
        this, the iteration angle is reduced in proportion. So the TIN does not climb low
        vegetation step by step. None: the angle is never reduced. From 0 to 100 m.
    stop_edge : float, default 2.0 m
        Only of method='tin-densification'. Triangles whose longest edge is shorter than this
        take no more points. None: all triangles can take points. From 0 to 100 m.
    noise_distance : float, default 0.3 m
        Only of method='tin-densification'. A point that is closer to its triangle than this
        joins the TIN whatever its angle. Near a corner, noise alone makes a large angle. From 0
        to 5 m.
    ground_tolerance : by method
        With method='tin-densification': float, optional. In level terrain, points up to this
        height above the final surface are ground. A larger value takes in grass and low bushes.
        None: 0.18 m, and more where points are sparse or noisy. From 0 to 10 m. With
        method='grid-minimum': float, optional. In level terrain, points up to this height above
        the surface of the ground are ground. None: 0.18 m, and more where points are sparse or
        noisy; in the paper's preset 0.4 m. From 0 to 10 m. With method='slope': float,
        optional. In level terrain, points up to this height above the surface through the
        ground are ground. None: 0.18 m, and more where points are sparse or noisy. Not used
        with the preset Whitebox. From 0 to 10 m.
    ground_tolerance_below : float, default 0.6 m
        Only of method='tin-densification'. In level terrain, points down to this depth below
        the final surface are ground. The surface goes through the lowest points, but is
        smoother than they are. From 0 to 10 m.
    slope_tolerance : by method
        With method='tin-densification': float, default 1.4 m. Added to both ground tolerances
        on a slope of 45 degrees. On gentler slopes less is added, in proportion. From 0 to 10
        m. With method='grid-minimum': float, optional. This share of the rise of the ground
        from point to point, over at most a metre, is added to the ground tolerance. In the
        paper's preset it is a share of the rise over one cell. None: from the preset. From 0 to
        10. With method='slope': float, default 1.4 m. Added to the ground tolerance on a slope
        of 45 degrees, if points are a metre apart. Less is added, in proportion, on gentler
        slopes and if points are closer. From 0 to 10 m.
    only_key_points : bool, default False
        Only of method='tin-densification'. Only the points that a terrain model needs become
        ground. Of all other ground points, none lies farther from the TIN of these key points
        than the two tolerances below.
    key_point_tolerance_above : float, default 0.15 m
        Only of method='tin-densification'. How far a ground point may lie above the TIN of the
        key points. Choose about the accuracy of the heights, or half the contour interval that
        you want. From 0 to 100 m.
    key_point_tolerance_below : float, default 0.15 m
        Only of method='tin-densification'. How far a ground point may lie below the TIN of the
        key points. From 0 to 100 m.
    key_point_grid_size : float, default 20.0 m
        Only of method='tin-densification'. In each cell of this size that has ground points, at
        least the lowest one is a key point, however flat the ground is. From 0.1 to 10000 m.
    height_thresholds : sequence of float, optional
        Only of method='grid-minimum'. One pass for each threshold, the largest first. If two
        neighbouring cells differ by more than the threshold, the higher one is the rim of an
        object. None: from the preset. From 0.05 to 1000 m.
    final_height : float, optional
        Only of method='grid-minimum'. The last pass removes whatever stands this far above the
        ground beside it: bushes, cars, walls. A larger value keeps more of rough ground. None:
        from the preset. From 0.01 to 100 m.
    max_object_size : float, optional
        Only of method='grid-minimum'. Shorter side of the largest building. Anything wider is
        terrain. None: from the preset. From 0.1 to 1000 m.
    search_radius : float, optional
        Only of method='slope'. Points are compared with their neighbours up to this distance.
        Choose at least half the shorter side of the largest building. None: from the preset, 18
        m in the automatic one (more if points are sparse), 2 m in Whitebox. From 0.1 to 500 m.
    min_neighbours : int, default 0 points
        Only of method='slope'. A point with fewer neighbours within the search radius is
        compared with this many nearest points. Only for the preset Whitebox. From 0 to 10000
        points.
    slope_threshold : float, optional
        Only of method='slope'. A point is not ground if it stands above a neighbour at a
        steeper slope than this. In all presets but Whitebox, the slope of the terrain around
        the point is added to it. None: from the preset, 15 deg in most, 45 deg in Whitebox.
        From 0 to 88 deg.
    height_threshold : float, optional
        Only of method='slope'. A point is not ground only if it stands at least this high above
        a neighbour. None: from the preset, 0.5 m in most, 1 m in Whitebox. From 0 to 100 m.
    slope_norm : bool, default True
        Only of method='slope'. Compares heights above a surface that follows the terrain (white
        top-hat), not elevations, so that ground on slopes is not lost.
    from_classes : sequence of int or "all", optional
        Only points of these classes take part and may change their class. None: 0 to 6, 8, 12
        and the class of the ground. Points of other classes, such as water (9) and bridge decks
        (17), keep their class. Rails and roads (10 and 11) keep theirs too, but take part. all:
        all classes but low and high noise (7 and 18). From 0 to 255.
    seed_classes : sequence of int, optional
        Points of these classes are certain ground, whatever their return: the filter does not
        judge them, and TIN densification starts from them. They get the class of the ground,
        unless their class is not among the classes to classify. None: none. From 0 to 255.
    to_class : int, default 2
        The class that ground points get; 2 is ground in the LAS specification. Point formats 0
        to 5 hold classes up to 31. From 0 to 255.
    returns : {"last", "all"}, default "last"
        Last returns reach the ground. Take all returns if the return numbers of the file are
        wrong. "last": Last and single returns (return number = number of returns). "all": All
        returns.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out: ground, and rasters made in
        the same run, then come from one strip everywhere. "use": Take part as others do.
        "leave-out": Leave out; they keep their class.
    others : {"keep", "unclassified"}, default "keep"
        The class of points that are not ground. Points that were never classified (0) become 1
        in both cases. Noise, withheld points, and classes that are not classified stay as they
        are. "keep": Keep; old ground that is not ground now becomes 1. "unclassified": Set to 1
        (unclassified).
    low_noise_class : bool, default False
        Points that took part and lie far below the ground (multipath, faults of the sensor)
        become low noise, class 7. If this is off, they are treated as other points.
    low_noise_depth : float, default 1.0 m
        A point becomes low noise if it lies farther below the ground than this. On slopes, the
        rise of the ground over 1 m is added. Points with ground all round them that lie 0.4 m
        and more below it become low noise too. Used only if low outliers are put into class 7.
        From 0.05 to 1000 m.
    high_noise_class : bool, default False
        Points that took part and hang far above all others of their place, alone or in small
        groups (birds, clouds, faults of the sensor) become high noise, class 18. Wires, masts
        and trees do not. Surface and canopy models never use such points, whether this is on or
        off.
    high_noise_height : float, default 10.0 m
        A point becomes high noise if it hangs at least this far above all others within about
        10 m. Used only if high outliers are put into class 18. From 1 to 1000 m.
    bridges : {"automatic", "find", "keep"}, default "automatic"
        The class of bridge decks. They are found by cross-sections that fall to lower ground on
        both sides; ramps, dams and embankments stay ground. A classic preset (Whitebox,
        LiDAR360's, the paper's) works as the original does, and does not look for bridges.
        "automatic": Not ground, except with a classic preset. "find": Not ground. "keep": As
        the filter classifies them.
    bridge_class : int, optional
        The class of bridge decks that are not ground. In the LAS specification it is 17, and
        every point format can hold it. None: the class of other points. From 0 to 255.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    crs : str, int or pyproj.CRS, optional
        The CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it
        replaces that of a laspy.LasData, and without both coordinates are metres.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    NDArray[bool_]
        Which points are ground.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def heights(
    points: Any,
    y: ArrayLike | None = None,
    z: ArrayLike | None = None,
    *,
    ground: ArrayLike | None = None,
    classification: ArrayLike | None = None,
    return_number: ArrayLike | None = None,
    number_of_returns: ArrayLike | None = None,
    withheld: ArrayLike | None = None,
    in_overlap: ArrayLike | None = None,
    dtm: Any | None = None,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    threads: int | None = None,
    crs: Any | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> NDArray[float64]:
    """Measure the height of each point above the ground.

    Parameters
    ----------
    points : array, laspy.LasData or table
        X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a
        laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and,
        where they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a
        structured array, such as PDAL has, a dict of arrays, a table of pandas, polars or
        pyarrow, or a GeoDataFrame of points with z, whose CRS counts; of terrain() also
        blocks().
    y : array of float, shape (n,), optional
        Y of the points, if `points` is x.
    z : array of float, shape (n,), optional
        Z of the points, if `points` is x.
    ground : array of bool, shape (n,), optional
        Which points are ground, as ground() returns them, in place of their classes.
    classification : array of int, shape (n,), optional
        The classes of the points, in place of those of a table.
    return_number : array of int, shape (n,), optional
        The return numbers, from 1 on.
    number_of_returns : array of int, shape (n,), optional
        How many returns the pulse of each point has.
    withheld : array of bool, shape (n,), optional
        Which points are left out of everything.
    in_overlap : array of bool, shape (n,), optional
        Which points lie in the overlap of flight strips.
    dtm : path, Raster or xarray.DataArray, optional
        Measure the heights above this raster, in the CRS of the points, and not above the
        ground points; the points need no classes.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    crs : str, int or pyproj.CRS, optional
        The CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it
        replaces that of a laspy.LasData, and without both coordinates are metres.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    NDArray[float64]
        The heights in the vertical unit of the CRS; NaN far from ground.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def key_points(
    points: Any,
    y: ArrayLike | None = None,
    z: ArrayLike | None = None,
    *,
    ground: ArrayLike | None = None,
    classification: ArrayLike | None = None,
    return_number: ArrayLike | None = None,
    number_of_returns: ArrayLike | None = None,
    withheld: ArrayLike | None = None,
    in_overlap: ArrayLike | None = None,
    tolerance_above: float = 0.15,
    tolerance_below: float = 0.15,
    grid_size: float = 20.0,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    threads: int | None = None,
    crs: Any | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> NDArray[bool_]:
    """Find the model key points: the few ground points that a terrain model needs.

    Parameters
    ----------
    points : array, laspy.LasData or table
        X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a
        laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and,
        where they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a
        structured array, such as PDAL has, a dict of arrays, a table of pandas, polars or
        pyarrow, or a GeoDataFrame of points with z, whose CRS counts; of terrain() also
        blocks().
    y : array of float, shape (n,), optional
        Y of the points, if `points` is x.
    z : array of float, shape (n,), optional
        Z of the points, if `points` is x.
    ground : array of bool, shape (n,), optional
        Which points are ground, as ground() returns them, in place of their classes.
    classification : array of int, shape (n,), optional
        The classes of the points, in place of those of a table.
    return_number : array of int, shape (n,), optional
        The return numbers, from 1 on.
    number_of_returns : array of int, shape (n,), optional
        How many returns the pulse of each point has.
    withheld : array of bool, shape (n,), optional
        Which points are left out of everything.
    in_overlap : array of bool, shape (n,), optional
        Which points lie in the overlap of flight strips.
    tolerance_above : float, default 0.15 m
        How far a ground point may lie above the TIN of the key points. Choose about the
        accuracy of the heights, or half the contour interval that you want. From 0 to 100 m.
    tolerance_below : float, default 0.15 m
        How far a ground point may lie below the TIN of the key points. From 0 to 100 m.
    grid_size : float, default 20.0 m
        In each cell of this size that has ground points, at least the lowest one is a key
        point, however flat the ground is. From 0.1 to 10000 m.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    crs : str, int or pyproj.CRS, optional
        The CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it
        replaces that of a laspy.LasData, and without both coordinates are metres.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    NDArray[bool_]
        Which points are model key points.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def relief(
    raster: Any,
    *,
    kinds: Sequence[Literal["hillshade", "local-relief", "multi-scale-relief", "slope", "sky-view", "openness", "negative-openness", "local-dominance", "vat", "red-relief"]] = ('local-relief',),
    kind: Literal["hillshade", "local-relief", "multi-scale-relief", "slope", "sky-view", "openness", "negative-openness", "local-dominance", "vat", "red-relief"] | None = None,
    relief_radius: float = 10.0,
    relief_smoothing: Literal["automatic", "none"] = 'automatic',
    hillshade_light: Literal["one", "multidirectional"] = 'multidirectional',
    hillshade_azimuth: float = 315.0,
    hillshade_altitude: float = 45.0,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> dict[str, Raster]:
    """Show mounds, walls, ditches and old paths: sky view, openness, local relief, VAT.

    The cells are those that relief() writes for a file with the same cells; cells without data
    are NaN, or 0 in pictures.

    Parameters
    ----------
    raster : path, Raster or xarray.DataArray
        A raster of heights, such as terrain(points)["dtm"], an xarray.DataArray with x and y,
        or a file.
    kinds : sequence of {"hillshade", "local-relief", "multi-scale-relief", "slope", "sky-view", "openness", "negative-openness", "local-dominance", "vat", "red-relief"}, default ('local-relief',)
        What to make, a raster for each. Archaeological topography (VAT) shows the most in one
        picture. "hillshade": Hillshade. "local-relief": Local relief. "multi-scale-relief":
        Multi-scale relief. "slope": Slope. "sky-view": Sky-view factor. "openness": Positive
        openness. "negative-openness": Negative openness. "local-dominance": Local dominance.
        "vat": Archaeological topography (VAT). "red-relief": Red relief image map.
    kind : optional
        The same as `kinds`, of one value.
    relief_radius : float, default 10.0 m
        Local relief, openness, sky view and the like compare a place with its surroundings up
        to this distance. Choose about the width of the features that you want to see; larger
        landforms disappear. From 0.1 to 1000 m.
    relief_smoothing : {"automatic", "none"}, default "automatic"
        Automatic: for the pictures, heights are smoothed as much as they are noisy, so that low
        plants in a forest do not speckle them. Banks, ditches and walls stay sharp, and so does
        open ground. The terrain model does not change. "automatic": Automatic. "none": None.
    hillshade_light : {"one", "multidirectional"}, default "multidirectional"
        One light shows best the landforms that lie across it, but slopes that face away are
        dark. Four lights show landforms of any direction. "one": One light. "multidirectional":
        Four lights, from southwest to north.
    hillshade_azimuth : float, default 315.0 deg
        Direction from which the light comes, clockwise from north. Four lights have their own
        directions. From 0 to 360 deg.
    hillshade_altitude : float, default 45.0 deg
        Angle of the light above the horizon. From 0 to 90 deg.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    dict[str, Raster]
        The rasters by their kinds.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def remove_off_terrain_objects(
    raster: Any,
    *,
    max_object_size: float = 40.0,
    slope_threshold: float = 15.0,
    band: int = 1,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Raster:
    """Remove buildings and trees from an elevation raster.

    The cells are those that remove_off_terrain_objects() writes for a file with the same cells;
    cells without data are NaN.

    Parameters
    ----------
    raster : path, Raster or xarray.DataArray
        A raster of heights, such as terrain(points)["dtm"], an xarray.DataArray with x and y,
        or a file.
    max_object_size : float, default 40.0 m
        Shorter side of the largest building. A larger value takes longer, and may remove steep
        hilltops as objects. From 0.1 to 1000 m.
    slope_threshold : float, default 15.0 deg
        Objects have edges steeper than this on all sides. What rises more gently on some side
        is a hill. The slopes of the terrain below do not count. From 0.1 to 88 deg.
    band : int, default 1
        Number of the raster's band that holds the heights. From 1 to 65535.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    Raster
        The heights on the same grid.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def residuals(
    points: Any,
    y: ArrayLike | None = None,
    z: ArrayLike | None = None,
    *,
    ground: ArrayLike | None = None,
    classification: ArrayLike | None = None,
    return_number: ArrayLike | None = None,
    number_of_returns: ArrayLike | None = None,
    withheld: ArrayLike | None = None,
    in_overlap: ArrayLike | None = None,
    checkpoints: Any | None = None,
    columns: str | None = None,
    checkpoints_crs: Any | None = None,
    vegetated: Sequence[str] | None = None,
    max_edge: float = 20.0,
    min_confidence: float = 0.5,
    hold_out: float | None = None,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    crs: Any | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Features:
    """Measure the error of the ground at each checkpoint.

    The values are those of the layer that check() writes.

    Parameters
    ----------
    points : array, laspy.LasData or table
        X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a
        laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and,
        where they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a
        structured array, such as PDAL has, a dict of arrays, a table of pandas, polars or
        pyarrow, or a GeoDataFrame of points with z, whose CRS counts; of terrain() also
        blocks().
    y : array of float, shape (n,), optional
        Y of the points, if `points` is x.
    z : array of float, shape (n,), optional
        Z of the points, if `points` is x.
    ground : array of bool, shape (n,), optional
        Which points are ground, as ground() returns them, in place of their classes.
    classification : array of int, shape (n,), optional
        The classes of the points, in place of those of a table.
    return_number : array of int, shape (n,), optional
        The return numbers, from 1 on.
    number_of_returns : array of int, shape (n,), optional
        How many returns the pulse of each point has.
    withheld : array of bool, shape (n,), optional
        Which points are left out of everything.
    in_overlap : array of bool, shape (n,), optional
        Which points lie in the overlap of flight strips.
    checkpoints : path, points or array of shape (n, 3), optional
        Points that were surveyed on the ground (CSV and other tables in the CRS of the points,
        GeoJSON, or with pyogrio GeoPackage, shapefile and others, whose CRS is transformed to
        that of the points), or their x, y and z in the CRS of the points.
    columns : str, optional
        The columns or attributes of the checkpoints, by name or by number from 1 on, such as
        x=E,y=N,z=H,cover=Class,type=Use,name=ID; those that are not given are recognised by
        their names.
    checkpoints_crs : str, int or pyproj.CRS, optional
        The CRS of x and y of the checkpoints, such as EPSG:4326; without it, what the file
        states, or the CRS of the points.
    vegetated : sequence of str, optional
        Land covers with one of these words are vegetated, and no others.
    max_edge : float, default 20.0 m
        Checkpoints in triangles with a longer edge lie in a void of the ground, such as a
        building, and are not counted. From 0.1 to 1000 m.
    min_confidence : float, default 0.5
        Checkpoints where the raster of confidence has less are not counted. From 0 to 1.
    hold_out : float, optional
        Leaves out so large a share of the ground points, such as 0.02, and measures how well
        the others predict them, on open land, under trees and on steep land. This needs no
        checkpoints, but it does not tell how right the heights are. From 0.0001 to 0.5. None:
        not used.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    crs : str, int or pyproj.CRS, optional
        The CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it
        replaces that of a laspy.LasData, and without both coordinates are metres.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    Features
        The checkpoints: STATE, and where it is counted ERROR in metres.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def terrain(
    points: Any,
    y: ArrayLike | None = None,
    z: ArrayLike | None = None,
    *,
    rasters: Literal["dtm", "dsm", "chm", "hillshade", "confidence", "relief", "multi_scale_relief", "slope", "sky_view", "openness", "negative_openness", "local_dominance", "vat", "red_relief"] | Sequence[Literal["dtm", "dsm", "chm", "hillshade", "confidence", "relief", "multi_scale_relief", "slope", "sky_view", "openness", "negative_openness", "local_dominance", "vat", "red_relief"]] = ('dtm',),
    ground: ArrayLike | None = None,
    classification: ArrayLike | None = None,
    return_number: ArrayLike | None = None,
    number_of_returns: ArrayLike | None = None,
    withheld: ArrayLike | None = None,
    in_overlap: ArrayLike | None = None,
    like: Any | None = None,
    raster_extent: Sequence[float] | None = None,
    extent: Sequence[float] | None = None,
    boundary: Any | None = None,
    breaklines: Any | None = None,
    water: Any | None = None,
    rivers: Any | None = None,
    no_ground: Any | None = None,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    dtm_cell_size: float = 1.0,
    dtm_cell_unit: Literal["m", "crs"] = 'm',
    raster_nodata: float | None = None,
    hillshade_light: Literal["one", "multidirectional"] = 'one',
    hillshade_azimuth: float = 315.0,
    hillshade_altitude: float = 45.0,
    relief_smoothing: Literal["automatic", "none"] = 'automatic',
    relief_radius: float = 10.0,
    surface_returns: Literal["first", "all"] = 'first',
    surface_classes: Sequence[int] | None = None,
    max_edge: float | None = None,
    pit_free: bool = False,
    threads: int | None = None,
    crs: Any | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> dict[str, Raster]:
    """Make rasters of the terrain and of what stands on it.

    The cells are those that terrain() writes for a file with the same points; cells without
    data are NaN, or 0 in pictures.

    Parameters
    ----------
    points : array, laspy.LasData or table
        X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a
        laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and,
        where they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a
        structured array, such as PDAL has, a dict of arrays, a table of pandas, polars or
        pyarrow, or a GeoDataFrame of points with z, whose CRS counts; of terrain() also
        blocks().
    y : array of float, shape (n,), optional
        Y of the points, if `points` is x.
    z : array of float, shape (n,), optional
        Z of the points, if `points` is x.
    rasters : str or sequence of str, default "('dtm',)"
        Which rasters to make. dtm: Heights of the bare ground. dsm: The highest point of each
        cell, noise left out. chm: Surface minus terrain: the height of trees, and of buildings
        too. Empty where no ground point lies within 50 m (or 20 cells), and in gaps of the
        surface. hillshade: The terrain model, lit by one light or by four. confidence: The
        probability, 0 to 1, that the terrain model is right: low under dense trees, across gaps
        and at breaks. relief: The terrain model minus a smoothed one. Mounds, ditches and old
        paths stand out. multi_scale_relief: The mean of local reliefs of four sizes, from half
        of the radius to four times it, so that narrow and wide features are in one picture.
        slope: How steep the terrain model is, in degrees. sky_view: The share of the sky that
        can be seen: dark in ditches, pits and sunken paths, whatever their direction. openness:
        The mean angle between zenith and horizon in degrees: bright banks and edges. Even
        slopes look like level land. negative_openness: The same upside down: large in ditches,
        pits and at the foot of banks. local_dominance: How steeply one looks down from a place,
        1 on level land: low mounds and banks on level land stand out. vat: A hillshade blended
        with slope, openness and sky-view factor: one picture for features of any kind.
        red_relief: Slopes in red, ridges bright, hollows dark: a picture without light and
        shadow.
    ground : array of bool, shape (n,), optional
        Which points are ground, as ground() returns them, in place of their classes.
    classification : array of int, shape (n,), optional
        The classes of the points, in place of those of a table.
    return_number : array of int, shape (n,), optional
        The return numbers, from 1 on.
    number_of_returns : array of int, shape (n,), optional
        How many returns the pulse of each point has.
    withheld : array of bool, shape (n,), optional
        Which points are left out of everything.
    in_overlap : array of bool, shape (n,), optional
        Which points lie in the overlap of flight strips.
    like : path, Raster or xarray.DataArray, optional
        A raster in the CRS of the points, such as dem.tif: all rasters get its CRS, cell size,
        position of the cells, and extent; it replaces the cell size.
    raster_extent : four floats, optional
        Xmin, ymin, xmax, ymax: the rasters cover this rectangle in the CRS of the points,
        widened to whole cells, which stay where they are; all points are used.
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: make the rasters only in this rectangle, in the CRS of the
        points.
    boundary : path or polygons, optional
        Make the rasters only in these polygons (GeoPackage, GeoJSON, shapefile and others,
        which pyogrio reads; if the file states its CRS, it is transformed to that of the
        points); with an extent only what lies in both.
    breaklines : path or lines, optional
        Lines that no triangle of the terrain crosses; z is in the unit of heights of the
        points, and a line without z gets the height of the nearest ground point on each side
        (GeoPackage, GeoJSON, shapefile and others, which pyogrio reads; if the file states its
        CRS, it is transformed to that of the points).
    water : path or polygons, optional
        Polygons of water; each is flattened to one level (GeoPackage, GeoJSON, shapefile and
        others, which pyogrio reads; if the file states its CRS, it is transformed to that of
        the points).
    rivers : path or lines, optional
        Lines along which the level of the water polygons falls (GeoPackage, GeoJSON, shapefile
        and others, which pyogrio reads; if the file states its CRS, it is transformed to that
        of the points).
    no_ground : path or polygons, optional
        Polygons in which the terrain uses no ground points, such as bridges and roofs
        (GeoPackage, GeoJSON, shapefile and others, which pyogrio reads; if the file states its
        CRS, it is transformed to that of the points).
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    dtm_cell_size : float, default 1.0 m
        Side of a cell of the terrain model and of its hillshade. Choose about the distance
        between ground points; smaller cells only make the file larger. From 0.01 to 1000 m.
    dtm_cell_unit : {"m", "crs"}, default "m"
        In a CRS in feet, a size of 3 in units of the CRS gives cells of exactly 3 feet that
        begin at whole multiples of 3 feet. "m": Metres. "crs": Units of the CRS, such as its
        feet.
    raster_nodata : float, optional
        The value of cells without data. Choose one that no height has. None: NaN. The hillshade
        has 0. From -3.40282e+38 to 3.40282e+38.
    hillshade_light : {"one", "multidirectional"}, default "one"
        One light shows best the landforms that lie across it, but slopes that face away are
        dark. Four lights show landforms of any direction. "one": One light. "multidirectional":
        Four lights, from southwest to north.
    hillshade_azimuth : float, default 315.0 deg
        Direction from which the light comes, clockwise from north. Four lights have their own
        directions. From 0 to 360 deg.
    hillshade_altitude : float, default 45.0 deg
        Angle of the light above the horizon. From 0 to 90 deg.
    relief_smoothing : {"automatic", "none"}, default "automatic"
        Automatic: for the pictures, heights are smoothed as much as they are noisy, so that low
        plants in a forest do not speckle them. Banks, ditches and walls stay sharp, and so does
        open ground. The terrain model does not change. "automatic": Automatic. "none": None.
    relief_radius : float, default 10.0 m
        Local relief, openness, sky view and the like compare a place with its surroundings up
        to this distance. Choose about the width of the features that you want to see; larger
        landforms disappear. From 0.1 to 1000 m.
    surface_returns : {"first", "all"}, default "first"
        First returns hit the tops of trees and buildings. Take all returns if the return
        numbers of the file are wrong. "first": First and single returns. "all": All returns.
    surface_classes : sequence of int, optional
        Only points of these classes make the surface, such as 41 for a water surface, or 2 and
        6 for terrain with buildings. None: all classes but low and high noise (7 and 18) and
        what lies in water (43 to 45); if the bottom of waters (40) is ground, their surfaces
        (41 and 42) are left out, too. From 0 to 255.
    max_edge : float, optional
        Gaps inside the survey are filled by triangles. A triangle with a longer edge than this
        has no data, for example over water. None: all gaps inside are filled. Beyond the
        outline of the points no raster has data in any case. From 0.1 to 100000 m.
    pit_free : bool, default False
        Where a pulse passed between the branches, the canopy height has pits. This raises cells
        that lie over 2 m below the mean of their neighbours to the median of them, as crowns
        and trees are easier to find without pits. The surface model keeps them.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    crs : str, int or pyproj.CRS, optional
        The CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it
        replaces that of a laspy.LasData, and without both coordinates are metres.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    dict[str, Raster]
        The rasters by their names.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def water(
    points: Any,
    y: ArrayLike | None = None,
    z: ArrayLike | None = None,
    *,
    ground: ArrayLike | None = None,
    classification: ArrayLike | None = None,
    return_number: ArrayLike | None = None,
    number_of_returns: ArrayLike | None = None,
    withheld: ArrayLike | None = None,
    in_overlap: ArrayLike | None = None,
    min_area: float = 8000.0,
    min_width: float = 30.0,
    water_cell: float | None = None,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    crs: Any | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> dict[str, Features]:
    """Find lakes and rivers.

    The polygons and lines are those that water() writes for a file with the same points.

    Parameters
    ----------
    points : array, laspy.LasData or table
        X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a
        laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and,
        where they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a
        structured array, such as PDAL has, a dict of arrays, a table of pandas, polars or
        pyarrow, or a GeoDataFrame of points with z, whose CRS counts; of terrain() also
        blocks().
    y : array of float, shape (n,), optional
        Y of the points, if `points` is x.
    z : array of float, shape (n,), optional
        Z of the points, if `points` is x.
    ground : array of bool, shape (n,), optional
        Which points are ground, as ground() returns them, in place of their classes.
    classification : array of int, shape (n,), optional
        The classes of the points, in place of those of a table.
    return_number : array of int, shape (n,), optional
        The return numbers, from 1 on.
    number_of_returns : array of int, shape (n,), optional
        How many returns the pulse of each point has.
    withheld : array of bool, shape (n,), optional
        Which points are left out of everything.
    in_overlap : array of bool, shape (n,), optional
        Which points lie in the overlap of flight strips.
    min_area : float, default 8000.0 m2
        Smaller water is left out. The Lidar Base Specification asks for lakes of 8,000 m² (2
        acres) and more. From 100 to 900000 m2.
    min_width : float, default 30.0 m
        Rivers that are narrower on average are left out. The Lidar Base Specification asks for
        30 m (100 ft) and more. From 1 to 10000 m.
    water_cell : float, optional
        Side of the cells in which points are counted. None: twice the distance between points,
        at least 1 m, and up to 5 m if a large survey would have too many cells. From 0.1 to 100
        m.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    crs : str, int or pyproj.CRS, optional
        The CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it
        replaces that of a laspy.LasData, and without both coordinates are metres.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    dict[str, Features]
        "water", polygons, and "breaklines", lines with heights: shores, islands, rivers.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """
