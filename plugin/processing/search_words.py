"""The words that the search of the toolbox finds each algorithm by: those that people type."""

from __future__ import annotations

_CLOUD = "lidar,laser scanning,als,uav,drone,las,laz,copc,point cloud"
_GROUND = (
    "ground,bare earth,ground filter,ground classification,classify ground,extract ground,"
    "ground points,noise,outliers,vegetation removal,smrf,pmf,csf,mcc,lasground,classifyground"
)
_TERRAIN = "terrain,terrain model,elevation model,dtm,dem,dsm,hillshade,relief"
_CANOPY = "chm,ndsm,canopy,vegetation height,normalize,normalise,hag,lasheight"
_TILES = "vpc,tiles,batch,survey,folder,many files"
_QUALITY = "accuracy,quality,error,validation,kappa,confusion matrix,reference"

# By the second half of the id.
_WORDS = {
    "pointcloudtoterrain": f"{_CLOUD},{_GROUND},{_TERRAIN},{_CANOPY},{_TILES},contours,workflow",
    "tindensification": f"{_CLOUD},{_GROUND},{_TERRAIN},tin,ptd,axelsson,densification",
    "gridminimum": f"{_CLOUD},{_GROUND},{_TERRAIN},grid,raster,lowest,minimum",
    "slopefilter": f"{_CLOUD},{_GROUND},{_TERRAIN},slope,vosselman,whitebox,top-hat",
    "classifytiles": f"{_CLOUD},{_GROUND},{_TERRAIN},{_TILES}",
    "terrainmodel": f"{_CLOUD},{_TERRAIN},{_CANOPY},tin,raster,rasterize,interpolate",
    "heightaboveground": f"{_CLOUD},{_CANOPY},height,vegetation,tin,extra bytes",
    "modelkeypoints": f"{_CLOUD},{_TERRAIN},ground,thin,thinning,generalize,keypoints,contours",
    "comparesettings": f"{_CLOUD},{_GROUND},preview,try,test,preset,parameters,compare,profile",
    "assess": f"{_CLOUD},ground,{_QUALITY}",
    "removeoffterrainobjects": (
        f"{_TERRAIN},bare earth,raster,surface,buildings,trees,vegetation,off-terrain objects,oto,"
        "whitebox,lindsay,top-hat"
    ),
}


def words_of(identifier: str) -> list[str]:
    """Return the words for an algorithm, by the second half of its id."""
    return _WORDS[identifier].split(",")
