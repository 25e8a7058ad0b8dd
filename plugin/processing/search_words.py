"""Words for the search of the toolbox, for each algorithm."""

from __future__ import annotations

from ...algorithms.filters import METHODS
from ..i18n import mark, tr

_CLOUD = mark("lidar,laser scanning,als,uav,drone,las,laz,copc,point cloud")
_GROUND = mark(
    "ground,bare earth,ground filter,ground classification,classify ground,extract ground,"
    "ground points,noise,outliers,vegetation removal,smrf,pmf,csf,mcc,lasground,classifyground"
)
_TERRAIN = mark("terrain,terrain model,elevation model,dtm,dem,dsm,hillshade,relief")
_CANOPY = mark("chm,ndsm,canopy,vegetation,vegetation height,normalize,normalise,hag,lasheight")
_TILES = mark("vpc,tiles,batch,survey,folder,many files")
_TIN = mark("tin,triangulation")
_RASTER = mark("grid,raster,rasterize,interpolate")

# Groups of words, by the second half of the id.
_WORDS = {
    "pointcloudtoterrain": (
        _CLOUD, _GROUND, _TERRAIN, _CANOPY, _TILES, mark("contours,workflow"),
        mark("deliverables,archaeology,forestry,flood,drone"),
    ),
    **{
        each.toolbox.identifier: (_CLOUD, _GROUND, _TERRAIN, *each.toolbox.words)
        for each in METHODS.values()
    },
    "classifytiles": (_CLOUD, _GROUND, _TERRAIN, _TILES),
    "terrainmodel": (_CLOUD, _TERRAIN, _CANOPY, _TIN, _RASTER),
    "heightaboveground": (_CLOUD, _CANOPY, _TIN, mark("height,extra bytes")),
    "classifyaboveground": (
        _CLOUD, _CANOPY,
        mark("buildings,roofs,trees,classes,classification,bridges,noise,lasclassify,asprs,ign"),
    ),
    "modelkeypoints": (
        _CLOUD, _TERRAIN, _TIN, mark("ground,thin,thinning,generalize,keypoints,contours"),
    ),
    "water": (
        _CLOUD, mark("lake,river,pond,shore,shoreline,hydro-flattening,hydroflatten,breaklines"),
    ),
    "waterclasses": (
        _CLOUD,
        mark(
            "lake,river,pond,shore,breaklines,hydro-flattening,class 9,class 20,ignored ground,"
            "usgs,lbs,classes,classification"
        ),
    ),
    "comparesettings": (
        _CLOUD, _GROUND, _TERRAIN, mark("preview,try,test,preset,parameters,compare,profile"),
    ),
    "check": (
        _CLOUD, _TERRAIN, _TIN,
        mark(
            "checkpoints,check points,control points,gcp,accuracy,quality,rmse,rmsez,vertical"
            " accuracy,nva,vva,asprs,validation,lascontrol,hold-out"
        ),
    ),
    "quality": (
        _CLOUD, _TERRAIN,
        mark(
            "quality,qc,density,pulse density,voids,swath,strips,overlap,usgs,lbs,linz,ign,"
            "specification,lasoverlap,lasgrid"
        ),
    ),
    "assess": (
        _CLOUD,
        mark("ground,accuracy,quality,error,validation,kappa,confusion matrix,reference"),
    ),
    "removeoffterrainobjects": (
        _TERRAIN, _RASTER,
        mark(
            "bare earth,surface,buildings,trees,vegetation,off-terrain objects,oto,whitebox,"
            "lindsay,top-hat"
        ),
    ),
    "relief": (
        _TERRAIN, _RASTER,
        mark(
            "sky-view factor,svf,openness,local dominance,local relief model,lrm,vat,red relief,"
            "rrim,slope,archaeology,rvt,relief visualization toolbox,visualization"
        ),
    ),
    "terraincontours": (_CLOUD, _GROUND, _TERRAIN, mark("contours,workflow")),
    "cloudheights": (_CLOUD, _GROUND, _CANOPY, mark("height,extra bytes")),
    "twomethods": (_CLOUD, _GROUND, mark("preview,try,test,preset,parameters,compare,profile")),
}  # fmt: skip


def words_of(identifier: str) -> list[str]:
    """Return the words for an algorithm, by half of its id, in English and the user's language."""
    groups = _WORDS[identifier]
    words = (word for group in groups for text in (group, tr(group)) for word in text.split(","))
    return list(dict.fromkeys(words))
