# Made by tools/stub.py from what tools declare. Do not edit.
# ruff: noqa
# fmt: off
from os import PathLike
from typing import Any, Callable, Iterable, Literal, Sequence

from .algorithms.core.errors import BareEarthError as BareEarthError
from .algorithms.core.errors import Cancelled as Cancelled
from .algorithms.core.progress import Progress as Progress
from .algorithms.core.version import __version__ as __version__
from .algorithms.library.given import Bar
from .algorithms.delivery.summary import DeliverySummary
from .algorithms.las.reading import Description
from .algorithms.remote.fetching import Fetched
from .algorithms.tools.above_ground import AboveGroundSummary
from .algorithms.tools.assess import Assessment
from .algorithms.tools.check.results import Check
from .algorithms.tools.compare_settings import TrialSummary
from .algorithms.tools.contours import Interval
from .algorithms.tools.ground.step import Summary
from .algorithms.tools.heights import HeightSummary
from .algorithms.tools.key_points import KeyPointSummary
from .algorithms.tools.off_terrain import Removal
from .algorithms.tools.quality.figures import Quality
from .algorithms.tools.rasters.output import RasterSize
from .algorithms.tools.water.tool import WaterSummary
from .algorithms.tools.water_classes import WaterClassSummary

_Path = str | PathLike[str]

def classFactory(iface: Any) -> Any: ...

def above_ground(
    sources: _Path | Iterable[_Path],
    output: _Path,
    *,
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
    recursive: bool = False,
    format: Literal["same", "las", "laz", "copc.laz"] = 'same',
    resume: bool = False,
    overview: bool = False,
    threads: int | None = None,
    memory: float | None = None,
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    scheduler: str | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> AboveGroundSummary | Any:
    """Classify vegetation, buildings and bridges.

    Classifies the points above the ground of a classified file, or of many as one survey: low,
    medium and high vegetation (3, 4, 5) by height above ground, buildings (6), bridges (17) and
    high noise (18). Only points of class 0 and 1 change.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Classified files, folders, virtual point clouds (.vpc), lists of files (.txt), or
        addresses (https, s3, gs, az) of remote point clouds; all of them together are one
        survey.
    output : path
        The file to write (.las, .laz or .copc.laz), or a folder if there are many inputs.
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
    recursive : bool, default False
        Searches each folder with all its subfolders.
    format : {"same", "las", "laz", "copc.laz"}, default "same"
        Files keep their names; only the ending follows the format. "same": As the input. "las":
        LAS. "laz": LAZ. "copc.laz": COPC, which QGIS shows at once.
    resume : bool, default False
        Keeps the tiles that an earlier run finished, if they were made from the same files with
        the same parameters. All other tiles are classified again.
    overview : bool, default False
        Writes a few points of all tiles into a further COPC file beside the virtual point
        cloud, if the tiles are COPC. QGIS 3.42 and newer shows them at small scales.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    memory : float, optional
        About how much memory a run may use. A file that needs more is read twice, and its
        points wait in a temporary file in the output folder. With many files, fewer are worked
        on at the same time. The result does not depend on it. None: half of the free memory.
        From 0.001 to 100000 GB.
    crs : str, int or pyproj.CRS, optional
        The CRS of the points, for files that state none or a wrong one: an EPSG code, such as
        EPSG:2230 or EPSG:2230+6360 (with heights), or WKT; it replaces what files state;
        written point clouds keep the records that the files have.
    cache : path, optional
        The folder that keeps what is fetched of remote point clouds; without it that of
        BARE_EARTH_CACHE, or one of the user.
    limit : float, optional
        Gigabytes that may be fetched of remote point clouds; without it 2.
    scheduler : str, optional
        With many files: the address of a Dask scheduler, such as tcp://host:8786, whose workers
        do the work, or the word processes; without it, threads of this process do it.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    AboveGroundSummary
        The classes of the points above the ground of a file; of many files a `SurveySummary`.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def assess(
    classified: _Path,
    reference: _Path,
    *,
    report: _Path | None = None,
    error_map: _Path | None = None,
    ground_classes: Sequence[int] = (2,),
    ignored_classes: Sequence[int] | None = None,
    map_cell_size: float = 1.0,
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Assessment:
    """Compare a classified file with a reference.

    Compares the ground (class 2) of a classified file with a reference that holds the same
    points, or a part of them: type I error (ground rejected), type II error (other accepted),
    total error and kappa, in percent.

    Parameters
    ----------
    classified : path or address
        The file to check.
    reference : path or address
        A file with the same points and their true classes; one can be a part of the other.
    report : path, optional
        Write a report (.html).
    error_map : path, optional
        Write the share of wrong points in each cell, 0 to 1 (.tif).
    ground_classes : sequence of int, default (2,)
        Classes of the reference that are ground. Add 9 if water counts as ground. From 0 to
        255.
    ignored_classes : sequence of int, optional
        Points of these classes of the reference are not counted, for example noise (7, 18).
        None: all points are counted. From 0 to 255.
    map_cell_size : float, default 1.0 m
        Side of a cell of the error map. The map in the report has its own cell size. From 0.01
        to 1000 m.
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
    Assessment
        Agreement of a classification with a reference, in percent; NaN without points to count.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def check(
    sources: _Path | Iterable[_Path],
    *,
    checkpoints: Any | None = None,
    columns: str | None = None,
    checkpoints_crs: Any | None = None,
    dtm: Any | None = None,
    vegetated: Sequence[str] | None = None,
    confidence: Any | None = None,
    residuals: _Path | None = None,
    report: _Path | None = None,
    table: _Path | None = None,
    accuracy_class: float | None = None,
    survey_error: float = 0.0,
    max_edge: float = 20.0,
    min_confidence: float = 0.5,
    hold_out: float | None = None,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Check:
    """Compare the ground with checkpoints, or with points that are held out.

    Compares the TIN of the ground points, and a terrain model, with checkpoints: RMSE and other
    figures, on land with and without vegetation, and the statement of the ASPRS Positional
    Accuracy Standards, edition 2. If points are held out, it needs none.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Classified files, folders, virtual point clouds (.vpc), lists of files (.txt), or
        addresses (https, s3, gs, az) of remote point clouds; all of them together are one
        survey.
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
    dtm : path, Raster or xarray.DataArray, optional
        Check this terrain model as well, in the CRS of the points.
    vegetated : sequence of str, optional
        Land covers with one of these words are vegetated, and no others (default: words such as
        forest, crops and brush in several languages).
    confidence : path, Raster or xarray.DataArray, optional
        The confidence of the terrain model, 0 to 1, as the command terrain makes it;
        checkpoints where it is low are not counted.
    residuals : path, optional
        Write the checkpoints and their errors as points (.gpkg, .geojson, .shp, .fgb); all but
        .geojson need pyogrio.
    report : path, optional
        Write a page (.html).
    table : path, optional
        Write the checkpoints and their errors (.csv).
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
    sources: _Path | Iterable[_Path],
    output: _Path,
    *,
    dtm: _Path | None = None,
    dsm: _Path | None = None,
    chm: _Path | None = None,
    hillshade: _Path | None = None,
    confidence: _Path | None = None,
    relief: _Path | None = None,
    multi_scale_relief: _Path | None = None,
    slope: _Path | None = None,
    sky_view: _Path | None = None,
    openness: _Path | None = None,
    negative_openness: _Path | None = None,
    local_dominance: _Path | None = None,
    vat: _Path | None = None,
    red_relief: _Path | None = None,
    contours: _Path | None = None,
    like: Any | None = None,
    raster_extent: Sequence[float] | None = None,
    breaklines: Any | None = None,
    water: Any | None = None,
    rivers: Any | None = None,
    no_ground: Any | None = None,
    extent: Sequence[float] | None = None,
    boundary: Any | None = None,
    corrections: Any | None = None,
    explain: _Path | None = None,
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
    remember_classes: bool = False,
    above_ground: Literal["none", "asprs", "ign", "own"] = 'none',
    medium_height: float = 0.5,
    high_height: float = 2.0,
    low_height: float = 0.0,
    buildings: bool = True,
    building_area: float = 10.0,
    building_height: float = 2.0,
    mark_bridges: bool = True,
    mark_high_noise: bool = True,
    reclassify: bool = False,
    dtm_cell_size: float = 1.0,
    dtm_cell_unit: Literal["m", "crs"] = 'm',
    raster_nodata: float | None = -9999.0,
    hillshade_light: Literal["one", "multidirectional"] = 'one',
    hillshade_azimuth: float = 315.0,
    hillshade_altitude: float = 45.0,
    relief_smoothing: Literal["automatic", "none"] = 'automatic',
    relief_radius: float = 10.0,
    surface_returns: Literal["first", "all"] = 'first',
    surface_classes: Sequence[int] | None = None,
    max_edge: float | None = None,
    pit_free: bool = False,
    contour_interval: float | None = None,
    contour_smoothing: float = 3.0,
    contour_min_length: float = 10.0,
    ground_only: bool = False,
    area_only: bool = False,
    height_above_ground: bool = False,
    recursive: bool = False,
    format: Literal["same", "las", "laz", "copc.laz"] = 'same',
    resume: bool = False,
    overview: bool = False,
    raster_per_file: bool = False,
    threads: int | None = None,
    memory: float | None = None,
    crs: Any | None = None,
    vpc: _Path | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    scheduler: str | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Summary | Any:
    """Classify the ground points of a file, or of many files as one survey, and make products of
    them.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Files, folders, virtual point clouds (.vpc), lists of files (.txt), or addresses (https,
        s3, gs, az) of remote point clouds; all of them together are one survey.
    output : path
        The file to write (.las, .laz or .copc.laz), or a folder if there are many inputs.
    dtm : path, optional
        GeoTIFF (.tif). Heights of the bare ground.
    dsm : path, optional
        GeoTIFF (.tif). The highest point of each cell, noise left out.
    chm : path, optional
        GeoTIFF (.tif). Surface minus terrain: the height of trees, and of buildings too. Empty
        where no ground point lies within 50 m (or 20 cells), and in gaps of the surface.
    hillshade : path, optional
        GeoTIFF (.tif). The terrain model, lit by one light or by four.
    confidence : path, optional
        GeoTIFF (.tif). The probability, 0 to 1, that the terrain model is right: low under
        dense trees, across gaps and at breaks.
    relief : path, optional
        GeoTIFF (.tif). The terrain model minus a smoothed one. Mounds, ditches and old paths
        stand out.
    multi_scale_relief : path, optional
        GeoTIFF (.tif). The mean of local reliefs of four sizes, from half of the radius to four
        times it, so that narrow and wide features are in one picture.
    slope : path, optional
        GeoTIFF (.tif). How steep the terrain model is, in degrees.
    sky_view : path, optional
        GeoTIFF (.tif). The share of the sky that can be seen: dark in ditches, pits and sunken
        paths, whatever their direction.
    openness : path, optional
        GeoTIFF (.tif). The mean angle between zenith and horizon in degrees: bright banks and
        edges. Even slopes look like level land.
    negative_openness : path, optional
        GeoTIFF (.tif). The same upside down: large in ditches, pits and at the foot of banks.
    local_dominance : path, optional
        GeoTIFF (.tif). How steeply one looks down from a place, 1 on level land: low mounds and
        banks on level land stand out.
    vat : path, optional
        GeoTIFF (.tif). A hillshade blended with slope, openness and sky-view factor: one
        picture for features of any kind.
    red_relief : path, optional
        GeoTIFF (.tif). Slopes in red, ridges bright, hollows dark: a picture without light and
        shadow.
    contours : path, optional
        Contour lines of the terrain model (.gpkg, .geojson, .shp, .fgb); the field ELEV has the
        height, INDEX is 1 for every fifth line. All but .geojson need pyogrio.
    like : path, Raster or xarray.DataArray, optional
        A raster in the CRS of the points, such as dem.tif: all rasters get its CRS, cell size,
        position of the cells, and extent; it replaces the cell size.
    raster_extent : four floats, optional
        Xmin, ymin, xmax, ymax: the rasters cover this rectangle in the CRS of the points,
        widened to whole cells, which stay where they are; all points are used.
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
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: classify only points in this rectangle, in the CRS of the
        points; points outside are written too, with the class that they have, unless
        `area_only` is given; rasters end at its border.
    boundary : path or polygons, optional
        Classify only points in these polygons (GeoPackage, GeoJSON, shapefile and others, which
        pyogrio reads; if the file states its CRS, it is transformed to that of the points);
        with an extent only what lies in both.
    corrections : path or polygons, optional
        Polygons in which you know the class; the attribute 'class' holds it, and it replaces
        the result of the filter.
    explain : path, optional
        Of one file: write a GeoTIFF of the rule that decided each cell; its band lists the
        rules.
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
    remember_classes : bool, default False
        Adds the extra dimension BareEarthClass with the class that this run gives to each
        point. A later run on the output finds the classes that were changed by hand since, and
        keeps them, whatever its settings. It then remembers the classes again.
    above_ground : {"none", "asprs", "ign", "own"}, default "none"
        Classifies the points above the ground as well: low, medium and high vegetation (3, 4,
        5) by height above ground, buildings (6), bridges (17) and high noise (18). "none":
        None: what is not ground has no further class. "asprs": Vegetation low below 0.5 m,
        medium to 2 m, high above. "ign": Vegetation low below 0.5 m, medium to 1.5 m, high
        above (IGN). "own": Vegetation by limits of your own.
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
    dtm_cell_size : float, default 1.0 m
        Side of a cell of the terrain model and of its hillshade. Choose about the distance
        between ground points; smaller cells only make the file larger. From 0.01 to 1000 m.
    dtm_cell_unit : {"m", "crs"}, default "m"
        In a CRS in feet, a size of 3 in units of the CRS gives cells of exactly 3 feet that
        begin at whole multiples of 3 feet. "m": Metres. "crs": Units of the CRS, such as its
        feet.
    raster_nodata : float, default -9999.0
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
    contour_interval : float, optional
        The height between contour lines, in the vertical unit of the CRS: metres, or feet if
        the heights are feet. None: 1, 2 or 5 times a power of ten, so that there are about 20
        lines. Every fifth line is an index contour. From 0.001 to 10000 m or ft.
    contour_smoothing : float, default 3.0 m
        For the lines, each height is averaged with its surroundings up to about this distance,
        so that they do not show noise. The terrain model does not change. 0: as the terrain
        model is. From 0 to 1000 m.
    contour_min_length : float, default 10.0 m
        Closed lines that are shorter are left out: they show single plants and noise. From 0 to
        10000 m.
    ground_only : bool, default False
        Writes only the points that have the class of the ground. The log says how many points
        are left out.
    area_only : bool, default False
        Writes only the points inside the extent and the boundary, and makes the rasters from
        them. Files without such points are not written. If this is off, all files are written
        with all their points, and points outside keep their class. In QGIS, it is on for remote
        points.
    height_above_ground : bool, default False
        Adds the extra dimension HeightAboveGround, the height of each point above the ground,
        in the vertical unit of the CRS.
    recursive : bool, default False
        Searches each folder with all its subfolders.
    format : {"same", "las", "laz", "copc.laz"}, default "same"
        Files keep their names; only the ending follows the format. "same": As the input. "las":
        LAS. "laz": LAZ. "copc.laz": COPC, which QGIS shows at once.
    resume : bool, default False
        Keeps the tiles that an earlier run finished, if they were made from the same files with
        the same parameters. All other tiles are classified again.
    overview : bool, default False
        Writes a few points of all tiles into a further COPC file beside the virtual point
        cloud, if the tiles are COPC. QGIS 3.42 and newer shows them at small scales.
    raster_per_file : bool, default False
        Cuts each raster of many files into one GeoTIFF for each file. They get the names of the
        files, in a folder with the name of the raster. A virtual raster (.vrt) beside this
        folder shows them as one.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    memory : float, optional
        About how much memory a run may use. A file that needs more is read twice, and its
        points wait in a temporary file in the output folder. With many files, fewer are worked
        on at the same time. The result does not depend on it. None: half of the free memory.
        From 0.001 to 100000 GB.
    crs : str, int or pyproj.CRS, optional
        The CRS of the points, for files that state none or a wrong one: an EPSG code, such as
        EPSG:2230 or EPSG:2230+6360 (with heights), or WKT; it replaces what files state;
        written point clouds keep the records that the files have.
    vpc : path, optional
        With many files: the virtual point cloud that lists the results, by default in OUTPUT.
    cache : path, optional
        The folder that keeps what is fetched of remote point clouds; without it that of
        BARE_EARTH_CACHE, or one of the user.
    limit : float, optional
        Gigabytes that may be fetched of remote point clouds; without it 2.
    scheduler : str, optional
        With many files: the address of a Dask scheduler, such as tcp://host:8786, whose workers
        do the work, or the word processes; without it, threads of this process do it.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    Summary
        The result of a classification; without an area, all points are in it; of many files a `SurveySummary`.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def compare_settings(
    sources: _Path | Iterable[_Path],
    page: _Path,
    *,
    extent: Sequence[float] | None = None,
    settings: Sequence[Literal["tin-densification:automatic", "tin-densification:flat", "tin-densification:hilly", "tin-densification:steep", "tin-densification:town", "tin-densification:city", "tin-densification:site", "tin-densification:lidar360", "grid-minimum:automatic", "grid-minimum:flat", "grid-minimum:hilly", "grid-minimum:steep", "grid-minimum:town", "grid-minimum:city", "grid-minimum:site", "grid-minimum:paper", "slope:automatic", "slope:flat", "slope:hilly", "slope:steep", "slope:town", "slope:city", "slope:site", "slope:whitebox"]] = ('tin-densification:automatic', 'grid-minimum:automatic', 'slope:automatic'),
    context: float | None = None,
    profile: Sequence[float] | None = None,
    threads: int | None = None,
    memory: float | None = None,
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> TrialSummary:
    """Try methods and presets on a window, and show them side by side.

    Classifies a window of one or many files with each of the settings, and writes a page that
    shows their terrain, a profile and where they differ. No point cloud is written. A setting
    is a method with a preset, such as slope:town.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Files, folders, virtual point clouds (.vpc), lists of files (.txt), or addresses (https,
        s3, gs, az) of remote point clouds; all of them together are one survey.
    page : path
        The page to write (.html).
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: the window, in the CRS of the points; without it, 250 x 250 m in
        the middle of the points.
    settings : sequence of {"tin-densification:automatic", "tin-densification:flat", "tin-densification:hilly", "tin-densification:steep", "tin-densification:town", "tin-densification:city", "tin-densification:site", "tin-densification:lidar360", "grid-minimum:automatic", "grid-minimum:flat", "grid-minimum:hilly", "grid-minimum:steep", "grid-minimum:town", "grid-minimum:city", "grid-minimum:site", "grid-minimum:paper", "slope:automatic", "slope:flat", "slope:hilly", "slope:steep", "slope:town", "slope:city", "slope:site", "slope:whitebox"}, default ('tin-densification:automatic', 'grid-minimum:automatic', 'slope:automatic')
        Methods, each with a preset. All others are compared with the first one.
        "tin-densification:automatic": TIN densification, Automatic. "tin-densification:flat":
        TIN densification, Flat land, fields. "tin-densification:hilly": TIN densification,
        Hilly land, forest. "tin-densification:steep": TIN densification, Steep or rugged
        terrain. "tin-densification:town": TIN densification, Town. "tin-densification:city":
        TIN densification, City, large halls. "tin-densification:site": TIN densification, Drone
        survey, construction or mining site. "tin-densification:lidar360": TIN densification,
        LiDAR360's values. "grid-minimum:automatic": Grid minimum, Automatic.
        "grid-minimum:flat": Grid minimum, Flat land, fields. "grid-minimum:hilly": Grid
        minimum, Hilly land, forest. "grid-minimum:steep": Grid minimum, Steep or rugged
        terrain. "grid-minimum:town": Grid minimum, Town. "grid-minimum:city": Grid minimum,
        City, large halls. "grid-minimum:site": Grid minimum, Drone survey, construction or
        mining site. "grid-minimum:paper": Grid minimum, The paper's values. "slope:automatic":
        Slope filter, Automatic (many scales, follows the terrain). "slope:flat": Slope filter,
        Flat land, fields. "slope:hilly": Slope filter, Hilly land, forest. "slope:steep": Slope
        filter, Steep or rugged terrain. "slope:town": Slope filter, Town. "slope:city": Slope
        filter, City, large halls. "slope:site": Slope filter, Drone survey, construction or
        mining site. "slope:whitebox": Slope filter, Whitebox (one scale, 2 m, 45 deg, 1 m).
    context : float, optional
        Points up to this distance outside the window are read too, but not shown. A larger
        value is slower, and gives classes closer to those of the whole file near the edges of
        the window and beside large buildings. None: as far as the methods look, at most 50 m.
        From 0 to 1000 m.
    profile : sequence of float, optional
        X and Y of both ends, in the CRS of the points: X1 Y1 X2 Y2. None: straight across the
        window where the terrains differ most, from west to east or from south to north.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    memory : float, optional
        About how much memory a run may use. A file that needs more is read twice, and its
        points wait in a temporary file in the output folder. With many files, fewer are worked
        on at the same time. The result does not depend on it. None: half of the free memory.
        From 0.001 to 100000 GB.
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
    TrialSummary
        The result of a comparison.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def contours(
    source: Any,
    output: _Path,
    *,
    contour_interval: float | None = None,
    interval: float | None = None,
    contour_smoothing: float = 3.0,
    contour_min_length: float = 10.0,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Interval:
    """Draw contour lines of a terrain model.

    Draws contour lines of an elevation raster, of its heights smoothed for the lines only.

    Parameters
    ----------
    source : path, Raster or xarray.DataArray
        A raster that GDAL reads.
    output : path
        The lines to write (.gpkg, .geojson, .shp, .fgb); all but .geojson need pyogrio.
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
    Interval
        The height between contour lines.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def deliver(
    sources: _Path | Iterable[_Path],
    output: _Path,
    *,
    delivery: Literal["survey", "archaeology", "forestry", "flood", "drone-site"] = 'survey',
    checkpoints: Any | None = None,
    columns: str | None = None,
    checkpoints_crs: Any | None = None,
    corrections: Any | None = None,
    extent: Sequence[float] | None = None,
    boundary: Any | None = None,
    breaklines: Any | None = None,
    water: Any | None = None,
    rivers: Any | None = None,
    no_ground: Any | None = None,
    like: Any | None = None,
    raster_extent: Sequence[float] | None = None,
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
    specification: Literal["as-delivery", "none", "lbs-ql1", "lbs-ql2", "linz", "ign"] = 'as-delivery',
    key_points: bool = False,
    hold_out_share: float | None = 0.02,
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
    remember_classes: bool = False,
    dtm_cell_size: float | None = None,
    dtm_cell_unit: Literal["m", "crs"] = 'm',
    raster_nodata: float | None = -9999.0,
    hillshade_light: Literal["one", "multidirectional"] = 'multidirectional',
    hillshade_azimuth: float = 315.0,
    hillshade_altitude: float = 45.0,
    relief_smoothing: Literal["automatic", "none"] = 'automatic',
    relief_radius: float = 10.0,
    surface_returns: Literal["first", "all"] = 'first',
    surface_classes: Sequence[int] | None = None,
    max_edge: float | None = None,
    pit_free: bool = False,
    contour_interval: float | None = None,
    contour_smoothing: float = 3.0,
    contour_min_length: float = 10.0,
    min_area: float | None = None,
    min_width: float | None = None,
    water_cell: float | None = None,
    accuracy_class: float | None = None,
    survey_error: float = 0.0,
    recursive: bool = False,
    format: Literal["same", "las", "laz", "copc.laz"] = 'same',
    resume: bool = False,
    overview: bool = False,
    threads: int | None = None,
    memory: float | None = None,
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    scheduler: str | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> DeliverySummary:
    """Classify raw points and make everything that a job hands over, in one folder.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Files, folders, virtual point clouds (.vpc), lists of files (.txt), or addresses (https,
        s3, gs, az) of remote point clouds; all of them together are one survey.
    output : path
        The folder for all outputs: a new or empty one, or that of an earlier delivery, which is
        replaced.
    delivery : {"survey", "archaeology", "forestry", "flood", "drone-site"}, default "survey"
        What to deliver. survey: What a survey hands over: points with classes for ground,
        water, noise and bridges, a terrain model with flat water and its breaklines, and the
        quality compared with a specification. archaeology: Small features of the terrain: low
        walls and banks stay in a fine terrain model, and many pictures show its relief.
        forestry: Vegetation: its classes by height, the height above ground of every point, a
        canopy model without pits, and the density of the undergrowth. flood: The terrain as
        water meets it: bridges are removed, lakes and rivers are flat and come as polygons and
        breaklines, and buildings have a class. drone-site: A site from a drone: stockpiles and
        slopes are terrain, machines are not, in small cells, with contour lines and a measure
        of accuracy.
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
    corrections : path or polygons, optional
        Polygons in which you know the class; the attribute 'class' holds it, and it replaces
        the result of the filter.
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: deliver only this rectangle, in the CRS of the points; points
        nearby help to judge.
    boundary : path or polygons, optional
        Deliver only these polygons (GeoPackage, GeoJSON, shapefile and others, which pyogrio
        reads; if the file states its CRS, it is transformed to that of the points); with an
        extent only what lies in both.
    breaklines : path or lines, optional
        Lines that no triangle of the terrain crosses; z is in the unit of heights of the
        points, and a line without z gets the height of the nearest ground point on each side
        (GeoPackage, GeoJSON, shapefile and others, which pyogrio reads; if the file states its
        CRS, it is transformed to that of the points).
    water : path or polygons, optional
        Polygons of water; each is flattened to one level (GeoPackage, GeoJSON, shapefile and
        others, which pyogrio reads; if the file states its CRS, it is transformed to that of
        the points); the word automatic: the water is found first.
    rivers : path or lines, optional
        Lines along which the level of the water polygons falls (GeoPackage, GeoJSON, shapefile
        and others, which pyogrio reads; if the file states its CRS, it is transformed to that
        of the points).
    no_ground : path or polygons, optional
        Polygons in which the terrain uses no ground points, such as bridges and roofs
        (GeoPackage, GeoJSON, shapefile and others, which pyogrio reads; if the file states its
        CRS, it is transformed to that of the points).
    like : path, Raster or xarray.DataArray, optional
        A raster in the CRS of the points, such as dem.tif: all rasters get its CRS, cell size,
        position of the cells, and extent; it replaces the cell size.
    raster_extent : four floats, optional
        Xmin, ymin, xmax, ymax: the rasters cover this rectangle in the CRS of the points,
        widened to whole cells, which stay where they are; all points are used.
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
    specification : {"as-delivery", "none", "lbs-ql1", "lbs-ql2", "linz", "ign"}, default "as-delivery"
        The specification with which a delivery is compared. It also sets the cell size of the
        delivery for surveys, and the classes that it asks for. "as-delivery": The usual one of
        the delivery. "none": No specification. "lbs-ql1": USGS Lidar Base Specification, QL1.
        "lbs-ql2": USGS Lidar Base Specification, QL2. "linz": LINZ, New Zealand National Aerial
        LiDAR Base Specification (PGF version). "ign": IGN LiDAR HD.
    key_points : bool, default False
        Marks the ground points of a delivery that a terrain model needs, by the key-point flag
        of LAS.
    hold_out_share : float, default 0.02
        Leaves out so large a share of the ground points of a delivery, and states how well the
        others predict them. None: this is not measured. From 0.0001 to 0.5.
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
    remember_classes : bool, default False
        Adds the extra dimension BareEarthClass with the class that this run gives to each
        point. A later run on the output finds the classes that were changed by hand since, and
        keeps them, whatever its settings. It then remembers the classes again.
    dtm_cell_size : float, optional
        Side of a cell of the terrain model and of its hillshade. None: 1 m, and for a delivery
        as fine as the ground points allow, or as the specification states. From 0.01 to 1000 m.
    dtm_cell_unit : {"m", "crs"}, default "m"
        In a CRS in feet, a size of 3 in units of the CRS gives cells of exactly 3 feet that
        begin at whole multiples of 3 feet. "m": Metres. "crs": Units of the CRS, such as its
        feet.
    raster_nodata : float, default -9999.0
        The value of cells without data. Choose one that no height has. None: NaN. The hillshade
        has 0. From -3.40282e+38 to 3.40282e+38.
    hillshade_light : {"one", "multidirectional"}, default "multidirectional"
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
    contour_interval : float, optional
        The height between contour lines, in the vertical unit of the CRS: metres, or feet if
        the heights are feet. None: 1, 2 or 5 times a power of ten, so that there are about 20
        lines. Every fifth line is an index contour. From 0.001 to 10000 m or ft.
    contour_smoothing : float, default 3.0 m
        For the lines, each height is averaged with its surroundings up to about this distance,
        so that they do not show noise. The terrain model does not change. 0: as the terrain
        model is. From 0 to 1000 m.
    contour_min_length : float, default 10.0 m
        Closed lines that are shorter are left out: they show single plants and noise. From 0 to
        10000 m.
    min_area : float, optional
        A delivery leaves out smaller water. None: 8,000 m² for a survey, 1,000 m² for a flood
        model. From 100 to 900000 m2.
    min_width : float, optional
        A delivery leaves out rivers that are narrower on average. None: 30 m for a survey, 5 m
        for a flood model. From 1 to 10000 m.
    water_cell : float, optional
        Side of the cells in which points are counted. None: twice the distance between points,
        at least 1 m, and up to 5 m if a large survey would have too many cells. From 0.1 to 100
        m.
    accuracy_class : float, optional
        The vertical accuracy class that the data are to meet, as RMSE: 0.1 for the 10 cm class.
        It is tested by the checkpoints on land without vegetation. None: the figures are only
        reported. From 0.001 to 100 m.
    survey_error : float, default 0.0 m
        RMSE of the heights of the checkpoints themselves, as their survey states it. The
        standard adds it to that of the data: square root of the sum of the squares. From 0 to
        10 m.
    recursive : bool, default False
        Searches each folder with all its subfolders.
    format : {"same", "las", "laz", "copc.laz"}, default "same"
        Files keep their names; only the ending follows the format. "same": As the input. "las":
        LAS. "laz": LAZ. "copc.laz": COPC, which QGIS shows at once.
    resume : bool, default False
        Keeps the tiles that an earlier run finished, if they were made from the same files with
        the same parameters. All other tiles are classified again.
    overview : bool, default False
        Writes a few points of all tiles into a further COPC file beside the virtual point
        cloud, if the tiles are COPC. QGIS 3.42 and newer shows them at small scales.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    memory : float, optional
        About how much memory a run may use. A file that needs more is read twice, and its
        points wait in a temporary file in the output folder. With many files, fewer are worked
        on at the same time. The result does not depend on it. None: half of the free memory.
        From 0.001 to 100000 GB.
    crs : str, int or pyproj.CRS, optional
        The CRS of the points, for files that state none or a wrong one: an EPSG code, such as
        EPSG:2230 or EPSG:2230+6360 (with heights), or WKT; it replaces what files state;
        written point clouds keep the records that the files have.
    cache : path, optional
        The folder that keeps what is fetched of remote point clouds; without it that of
        BARE_EARTH_CACHE, or one of the user.
    limit : float, optional
        Gigabytes that may be fetched of remote point clouds; without it 2.
    scheduler : str, optional
        With many files: the address of a Dask scheduler, such as tcp://host:8786, whose workers
        do the work, or the word processes; without it, threads of this process do it.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    DeliverySummary
        What a delivery holds.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def fetch(
    address: str,
    output: _Path,
    *,
    extent: Sequence[float] | None = None,
    boundary: Any | None = None,
    resolution: float | None = None,
    limit: float = 2.0,
    skip_missing: bool = False,
    to_utm: bool = False,
    height_unit: Literal["stated", "metre", "foot", "us-foot"] = 'stated',
    follow: bool = False,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Fetched:
    """Download part of a remote point cloud.

    Downloads the points of a remote point cloud that lie in an area, and nothing else: only the
    parts of the file that are needed, as they are, with all of their dimensions. If it is
    stopped, the same command goes on where it was.

    Parameters
    ----------
    address : str
        The address (https, s3, gs or az) of a COPC file, of the ept.json of an EPT data set, of
        a virtual point cloud (.vpc), or of a STAC item or collection with such files; or the
        path of one.
    output : path
        The file to write (.copc.laz or .laz), or a new folder, without an ending, with a file
        for each point cloud of a list.
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: download only points in this rectangle, in the CRS of the
        points; without an area all points.
    boundary : path or polygons, optional
        Download only points in these polygons (GeoPackage, GeoJSON, shapefile and others, which
        pyogrio reads; if the file states its CRS, it is transformed to that of the points);
        with an extent only what lies in both.
    resolution : float, optional
        Distance between points. If it is larger than that of the cloud, only the upper levels
        of its octree are downloaded, whose points are about so far apart. From 0.001 to 10000
        m. None: all points.
    limit : float, default 2.0 GB
        A download of more is refused before it begins. The error says how large it is. From 0
        to 100000 GB.
    skip_missing : bool, default False
        Go on if tiles of an EPT data set are missing on the server. A warning counts them.
    to_utm : bool, default False
        Whether points in Web Mercator, such as those of 3DEP, are transformed to the zone of
        UTM (WGS 84) of the area, and their heights to metres. Nothing can be measured in Web
        Mercator.
    height_unit : {"stated", "metre", "foot", "us-foot"}, default "stated"
        The unit of the heights of points that are transformed to UTM, if their CRS does not
        state it. "stated": As the CRS states. "metre": Metre. "foot": International foot.
        "us-foot": US survey foot.
    follow : bool, default False
        Whether a virtual point cloud or a STAC item may name files on servers that you did not
        name. Without it, they are named and nothing is downloaded. With it, the Planetary
        Computer is asked for signatures of its files.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    Fetched
        What was downloaded.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def heights(
    sources: _Path | Iterable[_Path],
    output: _Path,
    *,
    dtm: Any | None = None,
    output_as: Literal["dimension", "z"] = 'dimension',
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    recursive: bool = False,
    format: Literal["same", "las", "laz", "copc.laz"] = 'same',
    resume: bool = False,
    overview: bool = False,
    threads: int | None = None,
    memory: float | None = None,
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    scheduler: str | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> HeightSummary | Any:
    """Add the height above ground of every point.

    Adds to every point its height above the TIN of the ground points, in the vertical unit of
    the CRS. The input is a classified file, or many as one survey. Given a terrain model,
    heights are above this raster.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Classified files, folders, virtual point clouds (.vpc), lists of files (.txt), or
        addresses (https, s3, gs, az) of remote point clouds; all of them together are one
        survey.
    output : path
        The file to write (.las, .laz or .copc.laz), or a folder if there are many inputs.
    dtm : path, Raster or xarray.DataArray, optional
        Measure the heights above this raster, in the CRS of the points, and not above the
        ground points; the points need no classes.
    output_as : {"dimension", "z"}, default "dimension"
        An extra dimension leaves everything else as it is. If the height replaces z, programs
        that cannot show extra dimensions show it too, but the terrain is flat. "dimension":
        Extra dimension HeightAboveGround. "z": Z, in place of the elevation.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    recursive : bool, default False
        Searches each folder with all its subfolders.
    format : {"same", "las", "laz", "copc.laz"}, default "same"
        Files keep their names; only the ending follows the format. "same": As the input. "las":
        LAS. "laz": LAZ. "copc.laz": COPC, which QGIS shows at once.
    resume : bool, default False
        Keeps the tiles that an earlier run finished, if they were made from the same files with
        the same parameters. All other tiles are classified again.
    overview : bool, default False
        Writes a few points of all tiles into a further COPC file beside the virtual point
        cloud, if the tiles are COPC. QGIS 3.42 and newer shows them at small scales.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    memory : float, optional
        About how much memory a run may use. A file that needs more is read twice, and its
        points wait in a temporary file in the output folder. With many files, fewer are worked
        on at the same time. The result does not depend on it. None: half of the free memory.
        From 0.001 to 100000 GB.
    crs : str, int or pyproj.CRS, optional
        The CRS of the points, for files that state none or a wrong one: an EPSG code, such as
        EPSG:2230 or EPSG:2230+6360 (with heights), or WKT; it replaces what files state;
        written point clouds keep the records that the files have.
    cache : path, optional
        The folder that keeps what is fetched of remote point clouds; without it that of
        BARE_EARTH_CACHE, or one of the user.
    limit : float, optional
        Gigabytes that may be fetched of remote point clouds; without it 2.
    scheduler : str, optional
        With many files: the address of a Dask scheduler, such as tcp://host:8786, whose workers
        do the work, or the word processes; without it, threads of this process do it.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    HeightSummary
        The heights above ground of a file, in the vertical unit of the CRS; of many files a `SurveySummary`.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def info(
    source: _Path,
    *,
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Description:
    """Describe a file.

    Describes a point cloud file.

    Parameters
    ----------
    source : path or address
        A .las, .laz or .copc.laz file.
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
    Description
        The description of a file, for `bare-earth info`.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def key_points(
    sources: _Path | Iterable[_Path],
    output: _Path,
    *,
    tolerance_above: float = 0.15,
    tolerance_below: float = 0.15,
    grid_size: float = 20.0,
    mark_as: Literal["class", "flag"] = 'class',
    key_class: int = 8,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    recursive: bool = False,
    format: Literal["same", "las", "laz", "copc.laz"] = 'same',
    resume: bool = False,
    overview: bool = False,
    threads: int | None = None,
    memory: float | None = None,
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    scheduler: str | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> KeyPointSummary | Any:
    """Mark the ground points that a terrain model needs.

    Marks the model key points of a classified file, or of many as one survey: the few ground
    points that a terrain model needs. No other ground point lies farther from their TIN than
    the tolerances.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Classified files, folders, virtual point clouds (.vpc), lists of files (.txt), or
        addresses (https, s3, gs, az) of remote point clouds; all of them together are one
        survey.
    output : path
        The file to write (.las, .laz or .copc.laz), or a folder if there are many inputs.
    tolerance_above : float, default 0.15 m
        How far a ground point may lie above the TIN of the key points. Choose about the
        accuracy of the heights, or half the contour interval that you want. From 0 to 100 m.
    tolerance_below : float, default 0.15 m
        How far a ground point may lie below the TIN of the key points. From 0 to 100 m.
    grid_size : float, default 20.0 m
        In each cell of this size that has ground points, at least the lowest one is a key
        point, however flat the ground is. From 0.1 to 10000 m.
    mark_as : {"class", "flag"}, default "class"
        Up to LAS 1.3, and in most programs, key points have a class. LAS 1.4 has a flag for
        them, so that they keep the class of the ground. "class": A class of their own. "flag":
        The key-point flag of LAS; the class stays.
    key_class : int, default 8
        The class that key points get. Points that already have it count as ground; those that
        are not needed get the first of the ground classes. Point formats 0 to 5 hold classes up
        to 31. From 0 to 255.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    recursive : bool, default False
        Searches each folder with all its subfolders.
    format : {"same", "las", "laz", "copc.laz"}, default "same"
        Files keep their names; only the ending follows the format. "same": As the input. "las":
        LAS. "laz": LAZ. "copc.laz": COPC, which QGIS shows at once.
    resume : bool, default False
        Keeps the tiles that an earlier run finished, if they were made from the same files with
        the same parameters. All other tiles are classified again.
    overview : bool, default False
        Writes a few points of all tiles into a further COPC file beside the virtual point
        cloud, if the tiles are COPC. QGIS 3.42 and newer shows them at small scales.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    memory : float, optional
        About how much memory a run may use. A file that needs more is read twice, and its
        points wait in a temporary file in the output folder. With many files, fewer are worked
        on at the same time. The result does not depend on it. None: half of the free memory.
        From 0.001 to 100000 GB.
    crs : str, int or pyproj.CRS, optional
        The CRS of the points, for files that state none or a wrong one: an EPSG code, such as
        EPSG:2230 or EPSG:2230+6360 (with heights), or WKT; it replaces what files state;
        written point clouds keep the records that the files have.
    cache : path, optional
        The folder that keeps what is fetched of remote point clouds; without it that of
        BARE_EARTH_CACHE, or one of the user.
    limit : float, optional
        Gigabytes that may be fetched of remote point clouds; without it 2.
    scheduler : str, optional
        With many files: the address of a Dask scheduler, such as tcp://host:8786, whose workers
        do the work, or the word processes; without it, threads of this process do it.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    KeyPointSummary
        The numbers of key points of a file; of many files a `SurveySummary`.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def quality(
    sources: _Path | Iterable[_Path],
    *,
    page: _Path | None = None,
    folder: _Path | None = None,
    specification: Literal["none", "lbs-ql1", "lbs-ql2", "linz", "ign"] = 'none',
    cell_size: float = 1.0,
    void_distance: float = 3.0,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Quality:
    """Measure density, voids and overlap of a survey, and compare it with a specification.

    Measures the quality of a classified survey: densities, voids, overlap of strips and
    differences between them, classes and formats. Compares it with what a specification asks
    for.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Classified files, folders, virtual point clouds (.vpc), lists of files (.txt), or
        addresses (https, s3, gs, az) of remote point clouds; all of them together are one
        survey.
    page : path, optional
        Write a page (.html).
    folder : path, optional
        Write rasters (.tif) into this folder, which is made if need be: densities, voids, low
        vegetation, overlap of strips, differences between strips, maximum surface height.
    specification : {"none", "lbs-ql1", "lbs-ql2", "linz", "ign"}, default "none"
        The specification with which the survey is compared. "none": No specification.
        "lbs-ql1": USGS Lidar Base Specification, QL1. "lbs-ql2": USGS Lidar Base Specification,
        QL2. "linz": LINZ, New Zealand National Aerial LiDAR Base Specification (PGF version).
        "ign": IGN LiDAR HD.
    cell_size : float, default 1.0 m
        Side of the cells of densities and voids. Strips and maximum heights have cells of twice
        this size. From 0.05 to 1000 m.
    void_distance : float, default 3.0 m
        Cells that are farther from a ground point are voids of the ground. From 0.1 to 100 m.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
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
    Quality
        The figures of a survey; withheld points are left out, and noise is left out of densities.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def relief(
    source: Any,
    output: _Path,
    *,
    kinds: Sequence[Literal["hillshade", "local-relief", "multi-scale-relief", "slope", "sky-view", "openness", "negative-openness", "local-dominance", "vat", "red-relief"]] = ('local-relief',),
    kind: Literal["hillshade", "local-relief", "multi-scale-relief", "slope", "sky-view", "openness", "negative-openness", "local-dominance", "vat", "red-relief"] | None = None,
    relief_radius: float = 10.0,
    relief_smoothing: Literal["automatic", "none"] = 'automatic',
    hillshade_light: Literal["one", "multidirectional"] = 'multidirectional',
    hillshade_azimuth: float = 315.0,
    hillshade_altitude: float = 45.0,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> None:
    """Make pictures of the relief of a terrain model.

    Makes a raster (GeoTIFF) that shows the relief of an elevation raster: local relief,
    sky-view factor, openness, local dominance, slope, hillshade, or a picture of several of
    them (vat, red-relief). They show mounds, walls, ditches and old paths.

    Parameters
    ----------
    source : path, Raster or xarray.DataArray
        A raster that GDAL reads.
    output : path
        A GeoTIFF (.tif) to write, or a folder if there are several kinds.
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

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def remove_off_terrain_objects(
    source: Any,
    output: _Path,
    *,
    max_object_size: float = 40.0,
    slope_threshold: float = 15.0,
    band: int = 1,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> Removal:
    """Remove buildings and trees from an elevation raster.

    Removes buildings, trees and other steep-sided objects from an elevation raster, and fills
    the gaps smoothly.

    Parameters
    ----------
    source : path, Raster or xarray.DataArray
        A raster that GDAL reads.
    output : path
        A GeoTIFF (.tif) to write.
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
    Removal
        Numbers of cells.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def terrain(
    sources: _Path | Iterable[_Path],
    *,
    dtm: _Path | None = None,
    dsm: _Path | None = None,
    chm: _Path | None = None,
    hillshade: _Path | None = None,
    confidence: _Path | None = None,
    relief: _Path | None = None,
    multi_scale_relief: _Path | None = None,
    slope: _Path | None = None,
    sky_view: _Path | None = None,
    openness: _Path | None = None,
    negative_openness: _Path | None = None,
    local_dominance: _Path | None = None,
    vat: _Path | None = None,
    red_relief: _Path | None = None,
    contours: _Path | None = None,
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
    raster_nodata: float | None = -9999.0,
    hillshade_light: Literal["one", "multidirectional"] = 'one',
    hillshade_azimuth: float = 315.0,
    hillshade_altitude: float = 45.0,
    relief_smoothing: Literal["automatic", "none"] = 'automatic',
    relief_radius: float = 10.0,
    surface_returns: Literal["first", "all"] = 'first',
    surface_classes: Sequence[int] | None = None,
    max_edge: float | None = None,
    pit_free: bool = False,
    contour_interval: float | None = None,
    contour_smoothing: float = 3.0,
    contour_min_length: float = 10.0,
    recursive: bool = False,
    raster_per_file: bool = False,
    threads: int | None = None,
    memory: float | None = None,
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    scheduler: str | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> RasterSize:
    """Make rasters of the terrain and of what stands on it, and contour lines, of classified
    points; all files together are one survey.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Classified files, folders, virtual point clouds (.vpc), lists of files (.txt), or
        addresses (https, s3, gs, az) of remote point clouds; all of them together are one
        survey.
    dtm : path, optional
        GeoTIFF (.tif). Heights of the bare ground.
    dsm : path, optional
        GeoTIFF (.tif). The highest point of each cell, noise left out.
    chm : path, optional
        GeoTIFF (.tif). Surface minus terrain: the height of trees, and of buildings too. Empty
        where no ground point lies within 50 m (or 20 cells), and in gaps of the surface.
    hillshade : path, optional
        GeoTIFF (.tif). The terrain model, lit by one light or by four.
    confidence : path, optional
        GeoTIFF (.tif). The probability, 0 to 1, that the terrain model is right: low under
        dense trees, across gaps and at breaks.
    relief : path, optional
        GeoTIFF (.tif). The terrain model minus a smoothed one. Mounds, ditches and old paths
        stand out.
    multi_scale_relief : path, optional
        GeoTIFF (.tif). The mean of local reliefs of four sizes, from half of the radius to four
        times it, so that narrow and wide features are in one picture.
    slope : path, optional
        GeoTIFF (.tif). How steep the terrain model is, in degrees.
    sky_view : path, optional
        GeoTIFF (.tif). The share of the sky that can be seen: dark in ditches, pits and sunken
        paths, whatever their direction.
    openness : path, optional
        GeoTIFF (.tif). The mean angle between zenith and horizon in degrees: bright banks and
        edges. Even slopes look like level land.
    negative_openness : path, optional
        GeoTIFF (.tif). The same upside down: large in ditches, pits and at the foot of banks.
    local_dominance : path, optional
        GeoTIFF (.tif). How steeply one looks down from a place, 1 on level land: low mounds and
        banks on level land stand out.
    vat : path, optional
        GeoTIFF (.tif). A hillshade blended with slope, openness and sky-view factor: one
        picture for features of any kind.
    red_relief : path, optional
        GeoTIFF (.tif). Slopes in red, ridges bright, hollows dark: a picture without light and
        shadow.
    contours : path, optional
        Contour lines of the terrain model (.gpkg, .geojson, .shp, .fgb); the field ELEV has the
        height, INDEX is 1 for every fifth line. All but .geojson need pyogrio.
    like : path, Raster or xarray.DataArray, optional
        A raster in the CRS of the points, such as dem.tif: all rasters get its CRS, cell size,
        position of the cells, and extent; it replaces the cell size.
    raster_extent : four floats, optional
        Xmin, ymin, xmax, ymax: the rasters cover this rectangle in the CRS of the points,
        widened to whole cells, which stay where they are; all points are used.
    extent : four floats, optional
        Xmin, ymin, xmax, ymax: make the rasters only in this rectangle, in the CRS of the
        points; points outside still help along its border.
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
        the points); the word automatic: the water is found first.
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
    raster_nodata : float, default -9999.0
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
    contour_interval : float, optional
        The height between contour lines, in the vertical unit of the CRS: metres, or feet if
        the heights are feet. None: 1, 2 or 5 times a power of ten, so that there are about 20
        lines. Every fifth line is an index contour. From 0.001 to 10000 m or ft.
    contour_smoothing : float, default 3.0 m
        For the lines, each height is averaged with its surroundings up to about this distance,
        so that they do not show noise. The terrain model does not change. 0: as the terrain
        model is. From 0 to 1000 m.
    contour_min_length : float, default 10.0 m
        Closed lines that are shorter are left out: they show single plants and noise. From 0 to
        10000 m.
    recursive : bool, default False
        Searches each folder with all its subfolders.
    raster_per_file : bool, default False
        Cuts each raster of many files into one GeoTIFF for each file. They get the names of the
        files, in a folder with the name of the raster. A virtual raster (.vrt) beside this
        folder shows them as one.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    memory : float, optional
        About how much memory a run may use. A file that needs more is read twice, and its
        points wait in a temporary file in the output folder. With many files, fewer are worked
        on at the same time. The result does not depend on it. None: half of the free memory.
        From 0.001 to 100000 GB.
    crs : str, int or pyproj.CRS, optional
        The CRS of the points, for files that state none or a wrong one: an EPSG code, such as
        EPSG:2230 or EPSG:2230+6360 (with heights), or WKT; it replaces what files state.
    cache : path, optional
        The folder that keeps what is fetched of remote point clouds; without it that of
        BARE_EARTH_CACHE, or one of the user.
    limit : float, optional
        Gigabytes that may be fetched of remote point clouds; without it 2.
    scheduler : str, optional
        With many files: the address of a Dask scheduler, such as tcp://host:8786, whose workers
        do the work, or the word processes; without it, threads of this process do it.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    RasterSize
        The size of rasters, and the points that terrain and surface were made from.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def water(
    sources: _Path | Iterable[_Path],
    output: _Path,
    *,
    breaklines_out: _Path | None = None,
    min_area: float = 8000.0,
    min_width: float = 30.0,
    water_cell: float | None = None,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> WaterSummary:
    """Find lakes and rivers in classified points.

    Finds water where hardly any last return is, and the ground along its shore is level or
    falls steadily: polygons with level, spread of the shore and a grade of certainty, and
    breaklines with heights.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Classified files, folders, virtual point clouds (.vpc), lists of files (.txt), or
        addresses (https, s3, gs, az) of remote point clouds; all of them together are one
        survey.
    output : path
        The polygons of water to write (.gpkg, .geojson, .shp, .fgb); all but .geojson need
        pyogrio.
    breaklines_out : path, optional
        Write shores, islands and the middles of rivers as lines with heights (.gpkg, .geojson,
        .shp, .fgb); all but .geojson need pyogrio.
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
    WaterSummary
        What was found.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """

def water_classes(
    sources: _Path | Iterable[_Path],
    output: _Path,
    *,
    water: Any,
    shore_distance: float = 0.7,
    water_class: int = 9,
    ignored_class: int = 20,
    ground_classes: Sequence[int] = (2,),
    overlap: Literal["use", "leave-out"] = 'use',
    recursive: bool = False,
    format: Literal["same", "las", "laz", "copc.laz"] = 'same',
    resume: bool = False,
    overview: bool = False,
    threads: int | None = None,
    memory: float | None = None,
    crs: Any | None = None,
    cache: _Path | None = None,
    limit: float | None = None,
    scheduler: str | None = None,
    progress: Progress | Bar | Callable[[float], object] | None = None,
) -> WaterClassSummary | Any:
    """Give classes to ground points in water and beside its shore.

    Gives class 9 (water) to the ground points of a classified file, or of many as one survey,
    that lie in polygons of water, and class 20 (ignored ground) to those beside the shore, as
    the Lidar Base Specification asks for. Nothing else changes.

    Parameters
    ----------
    sources : path, address, or iterable of them
        Classified files, folders, virtual point clouds (.vpc), lists of files (.txt), or
        addresses (https, s3, gs, az) of remote point clouds; all of them together are one
        survey.
    output : path
        The file to write (.las, .laz or .copc.laz), or a folder if there are many inputs.
    water : path or polygons
        Polygons of water (GeoPackage, GeoJSON, shapefile and others, which pyogrio reads; if
        the file states its CRS, it is transformed to that of the points); with the word
        automatic, the water is found first, as the command 'water' does.
    shore_distance : float, default 0.7 m
        Ground points outside of the water, up to this far from its shore, become ignored
        ground: there the breakline alone decides the terrain. The Lidar Base Specification asks
        for one nominal point spacing: 0.7 m for QL2, 0.35 m for QL1. 0: none. From 0 to 1000 m.
    water_class : int, default 9
        The class that ground points in the water get. Point formats 0 to 5 hold classes up to
        31. From 0 to 255.
    ignored_class : int, default 20
        The class that ground points beside the shore get. Points that have it already keep it,
        also in the water, unless it is one of the ground classes. From 0 to 255.
    ground_classes : sequence of int, default (2,)
        Classes of the points that are ground. Add 8 if model key points have that class, 10 and
        11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld
        points are not used. From 0 to 255.
    overlap : {"use", "leave-out"}, default "use"
        Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in
        older files. If strips do not fit together, leave them out of ground and surface. "use":
        Use as others. "leave-out": Leave out.
    recursive : bool, default False
        Searches each folder with all its subfolders.
    format : {"same", "las", "laz", "copc.laz"}, default "same"
        Files keep their names; only the ending follows the format. "same": As the input. "las":
        LAS. "laz": LAZ. "copc.laz": COPC, which QGIS shows at once.
    resume : bool, default False
        Keeps the tiles that an earlier run finished, if they were made from the same files with
        the same parameters. All other tiles are classified again.
    overview : bool, default False
        Writes a few points of all tiles into a further COPC file beside the virtual point
        cloud, if the tiles are COPC. QGIS 3.42 and newer shows them at small scales.
    threads : int, optional
        How many threads compute at the same time. The result does not depend on it. None: as
        many as there are processors. From 1 to 1024.
    memory : float, optional
        About how much memory a run may use. A file that needs more is read twice, and its
        points wait in a temporary file in the output folder. With many files, fewer are worked
        on at the same time. The result does not depend on it. None: half of the free memory.
        From 0.001 to 100000 GB.
    crs : str, int or pyproj.CRS, optional
        The CRS of the points, for files that state none or a wrong one: an EPSG code, such as
        EPSG:2230 or EPSG:2230+6360 (with heights), or WKT; it replaces what files state;
        written point clouds keep the records that the files have.
    cache : path, optional
        The folder that keeps what is fetched of remote point clouds; without it that of
        BARE_EARTH_CACHE, or one of the user.
    limit : float, optional
        Gigabytes that may be fetched of remote point clouds; without it 2.
    scheduler : str, optional
        With many files: the address of a Dask scheduler, such as tcp://host:8786, whose workers
        do the work, or the word processes; without it, threads of this process do it.
    progress : Progress, bar of tqdm, or callable that takes a float, optional
        Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a
        `Progress` receives messages, too.

    Returns
    -------
    WaterClassSummary
        The points of a file that became water or ignored ground; of many files a `SurveySummary`.

    Raises
    ------
    BareEarthError
        If an input cannot be read, a value is not allowed, or an output cannot be written.
    Cancelled
        If `progress` asked to stop; no output is incomplete.
    """
