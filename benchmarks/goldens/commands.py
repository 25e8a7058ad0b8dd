"""The commands that are run, by the names of what they show. OUT is the folder of a command.

What uses classified points starts from the true classes, so that another result of a filter does
not change the digests of all other tools.
"""

from __future__ import annotations

_PICTURES = (
    "--hillshade OUT/hillshade.tif --relief OUT/relief.tif --multi-scale-relief OUT/scales.tif"
    " --slope OUT/slope.tif --sky-view OUT/sky.tif --openness OUT/openness.tif"
    " --negative-openness OUT/negative.tif --local-dominance OUT/dominance.tif"
    " --vat OUT/vat.tif --red-relief OUT/red.tif"
)
_MODELS = (
    "--dtm OUT/dtm.tif --dsm OUT/dsm.tif --chm OUT/chm.tif"
    " --expected-error OUT/error.tif --error-cause OUT/cause.tif"
)
_KNOWN = (
    "--breaklines breaklines.geojson --water water.geojson --rivers rivers.geojson"
    " --no-ground no-ground.geojson"
)
_ALL_CLASSES = "--bridge-class 17 --low-noise-class --high-noise-class"
_CHECKPOINTS = "--checkpoints checkpoints.csv"
_POINTS = "--height-above-ground --above-ground"

COMMANDS = {
    # Labels: methods, presets, and which points take part.
    "classify/tin": f"classify raw.laz OUT/a.laz {_MODELS} {_ALL_CLASSES} {_POINTS} asprs"
    f" --contours OUT/lines.geojson --json",
    "classify/slope": f"classify raw.laz OUT/a.laz --method slope --dtm OUT/dtm.tif {_ALL_CLASSES}"
    f" {_POINTS} ign --json",
    "classify/grid-minimum": "classify raw.laz OUT/a.laz --method grid-minimum --dtm OUT/dtm.tif"
    f" {_ALL_CLASSES} {_POINTS} own --json",
    "classify/lidar360": "classify raw.laz OUT/a.las --preset lidar360 --verbose",
    "classify/whitebox": "classify raw.laz OUT/a.las --method slope --preset whitebox",
    "classify/paper": "classify raw.laz OUT/a.las --method grid-minimum --preset paper",
    "classify/all-points": "classify raw.laz OUT/a.laz --from-classes all --returns all"
    " --others unclassified --to-class 8 --preset city",
    "classify/seeds": "classify truth.laz OUT/a.laz --seed-classes 2 --from-classes none"
    " --overlap leave-out --bridges keep",
    "classify/key-points": "classify raw.laz OUT/a.copc.laz --only-key-points --remember-classes",
    "classify/area": f"classify raw.laz OUT/a.laz --boundary boundary.geojson --extent 569970"
    f" 5932470 570020 5932530 --dtm OUT/dtm.tif --corrections corrections.geojson {_KNOWN}",
    "classify/area-only": "classify raw.laz OUT/a.laz --boundary boundary.geojson --area-only"
    " --ground-only --method slope",
    "classify/old": "classify old.las OUT/a.laz --crs EPSG:25832 --from-classes all --json",
    "classify/out-of-core": "classify raw.laz OUT/a.laz --memory 0.001 --dtm OUT/dtm.tif",
    # Many files.
    "classify/survey-tin": f"classify raw OUT/tiles --dtm OUT/dtm.tif {_ALL_CLASSES} {_POINTS}"
    " asprs --format copc.laz --json",
    "classify/survey-slope": f"classify raw OUT/tiles --method slope {_POINTS} ign --vpc"
    " OUT/all.vpc --corrections corrections.geojson --raster-per-file --dtm OUT/dtm.tif",
    "classify/survey-grid-minimum": "classify raw OUT/tiles --method grid-minimum --format las"
    " --boundary boundary.geojson --area-only --hillshade OUT/shade.tif --dtm-cell-size 2",
    # Deliveries.
    "deliver/survey": f"deliver survey raw OUT/all --specification lbs-ql2 {_CHECKPOINTS}"
    " --key-points --min-area 200 --corrections corrections.geojson --json",
    "deliver/archaeology": "deliver archaeology raw.laz OUT/all --dtm-cell-size 1",
    "deliver/forestry": "deliver forestry raw.laz OUT/all --dtm-cell-size 1 --specification ign",
    "deliver/flood": "deliver flood raw.laz OUT/all --dtm-cell-size 1 --min-area 200 --boundary"
    " boundary.geojson --breaklines breaklines.geojson",
    "deliver/drone-site": f"deliver drone-site raw.laz OUT/all --dtm-cell-size 1 {_CHECKPOINTS}",
    # Rasters.
    "terrain/file": f"terrain truth.laz {_MODELS} {_PICTURES} --contours OUT/lines.geojson --json",
    "terrain/survey": f"terrain truth {_MODELS} --relief OUT/relief.tif --vat OUT/vat.tif"
    " --contours OUT/lines.gpkg --pit-free",
    "terrain/known": f"terrain truth.laz {_MODELS} {_KNOWN} --boundary boundary.geojson --max-edge"
    " 8 --dtm-cell-size 2 --surface-returns all --raster-nodata -99999",
    "terrain/water": "terrain truth.laz --dtm OUT/dtm.tif --water automatic --hillshade"
    " OUT/shade.tif --hillshade-light one --ground-classes 2 9",
    "terrain/per-file": "terrain truth --dtm OUT/dtm.tif --raster-per-file",
    "terrain/feet": "terrain old.las --dtm OUT/dtm.tif --contours OUT/lines.geojson --crs EPSG:2230"
    " --dtm-cell-size 5 --dtm-cell-unit crs --json",
    "terrain/like": "terrain truth.laz --dtm OUT/dtm.tif --like terrain/known/dtm.tif",
    "terrain/extent": "terrain truth.laz --dtm OUT/dtm.tif --raster-extent 569980.5 5932470.2"
    " 570020 5932503",
    # From one raster to another.
    "contours": "contours terrain/file/dtm.tif OUT/lines.geojson --interval 0.5 --json",
    "canopy": "canopy terrain/file/dsm.tif terrain/file/dtm.tif OUT/chm.tif --pit-free --json",
    "canopy-change": "canopy-change terrain/file/chm.tif canopy/chm.tif OUT/change.tif"
    " --places OUT/places.geojson --least-width 1 --json",
    "off-terrain": "remove-off-terrain-objects terrain/file/dsm.tif OUT/dtm.tif --json",
    **{
        f"relief/{kind}": f"relief terrain/file/dtm.tif OUT/relief.tif --kind {kind}"
        for kind in ("hillshade", "local-relief", "vat", "red-relief", "slope")
    },
    # Classes and heights.
    **{
        f"above-ground/{scheme}": f"above-ground truth.laz OUT/a.laz --above-ground {scheme}"
        " --reclassify --mark-bridges --json"
        for scheme in ("asprs", "ign", "own")
    },
    "above-ground/survey": "above-ground truth OUT/tiles --above-ground asprs --no-buildings",
    "height/dimension": "height truth.laz OUT/a.laz --json",
    "height/z": "height old.las OUT/a.laz --output-as z",
    "height/raster": "height raw.laz OUT/a.laz --dtm terrain/file/dtm.tif",
    "height/survey": "height truth OUT/tiles --format las",
    "key-points/class": "key-points truth.laz OUT/a.laz --tolerance-above 0.05 --json",
    "key-points/flag": "key-points truth.laz OUT/a.laz --mark-as flag --grid-size 10",
    "key-points/survey": "key-points truth OUT/tiles",
    "water/file": "water truth.laz OUT/water.geojson --breaklines-out OUT/lines.geojson --min-area"
    " 200 --min-width 4 --json",
    "water/survey": "water truth OUT/water.gpkg --breaklines-out OUT/lines.gpkg --min-area 200",
    "water-classes/file": "water-classes truth.laz OUT/a.laz --water water.geojson --json",
    "clip/file": "clip truth.laz OUT/a.laz --boundary boundary.geojson --json",
    "clip/survey": "clip truth OUT/tiles --extent 569970 5932470 570020 5932530",
    "water-classes/survey": "water-classes truth OUT/tiles --water water.geojson"
    " --shore-distance 1",
    # Parts.
    "clear-cache": "clear-cache --cache OUT/none",
    "fetch/area": "fetch classify/key-points/a.copc.laz OUT/a.copc.laz --extent 569970 5932470"
    " 570030 5932530 --boundary boundary.geojson --json",
    # Figures.
    "check/file": f"check truth.laz {_CHECKPOINTS} --dtm terrain/file/dtm.tif"
    " --report OUT/page.html --table OUT/points.csv --residuals"
    " OUT/points.geojson --accuracy-class 0.1 --json",
    "check/survey": f"check truth {_CHECKPOINTS} --hold-out 0.1 --residuals OUT/points.gpkg"
    " --low-confidence water.geojson",
    "review": "review terrain/file/error.tif OUT/places.gpkg --dtm terrain/file/dtm.tif --cause"
    " terrain/file/cause.tif --page OUT/page.html --json",
    "change": "change truth.laz classify/tin/a.laz OUT/change.tif --limit OUT/limit.tif --places"
    " OUT/places.gpkg --page OUT/page.html --no-find-ground --json",
    "quality/file": "quality truth.laz --specification lbs-ql1 --page OUT/page.html --folder OUT/q"
    " --low-confidence OUT/areas.geojson --low-confidence-area 100 --json",
    "quality/survey": "quality truth --specification linz --page OUT/page.html",
    "assess": "assess classify/tin/a.laz truth.laz --report OUT/page.html --error-map OUT/map.tif"
    " --json",
    "compare-settings": "compare-settings raw OUT/page.html --extent 569970 5932470 570030 5932530"
    " --settings grid-minimum:automatic slope:town --json",
    "info/file": "info truth.laz",
    "info/old": "info old.las --json",
    # What is refused.
    "errors/missing": "classify missing.laz OUT/a.laz",
    "errors/same-file": "height raw.laz raw.laz",
    "errors/no-ground": "terrain raw.laz --dtm OUT/dtm.tif",
    "errors/no-crs": "terrain old.las --dtm OUT/dtm.tif --crs EPSG:4326",
    "errors/outside": "classify raw.laz OUT/a.laz --extent 0 0 10 10",
    "errors/no-raster": "contours missing.tif OUT/lines.geojson",
    "errors/nothing": "terrain truth.laz",
    "errors/value": "classify raw.laz OUT/a.laz --max-building-size -3",
    "errors/suffix": "quality truth.laz --page OUT/page.txt",
    "errors/no-checkpoints": "check truth.laz",
}

# What is run on a tile of real land with its own classes, which is TILE.
TILE_COMMANDS = {
    "tin": "classify TILE OUT/a.laz --dtm OUT/dtm.tif --json --bridge-class 17 --low-noise-class",
    "slope": "classify TILE OUT/a.laz --method slope --json",
    "grid-minimum": "classify TILE OUT/a.laz --method grid-minimum --json",
    "lidar360": "classify TILE OUT/a.laz --preset lidar360 --json",
    "terrain": f"terrain TILE {_MODELS} --relief OUT/relief.tif --contours OUT/lines.geojson",
    "height": "height TILE OUT/a.laz --json",
    "key-points": "key-points TILE OUT/a.laz --json",
    "above-ground": "above-ground TILE OUT/a.laz --above-ground asprs --reclassify --json",
    "water": "water TILE OUT/water.geojson --breaklines-out OUT/lines.geojson --json",
    "quality": "quality TILE --specification lbs-ql2 --folder OUT/all --json",
}
