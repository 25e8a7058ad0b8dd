"""Downloads part of a remote point cloud."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..core.temporary import shown
from ..remote.fetching import Fetched, Wanted, fetch
from ..remote.utm import STATED
from ..survey.area import Area
from .declaration import CLOUD, FileTool, Input, Output


@dataclass(frozen=True)
class Download(ParameterSet):
    """How much is downloaded."""

    resolution: float | None = parameter(
        None,
        kind="number",
        label="Resolution",
        unit="m",
        minimum=0.001,
        maximum=10_000.0,
        empty="all points",
        help="Distance between points. If it is larger than that of the cloud, only the upper"
        " levels of its octree are downloaded, whose points are about so far apart.",
    )
    limit: float = parameter(
        2.0,
        label="Limit",
        unit="GB",
        minimum=0.0,
        maximum=100_000.0,
        help="A download of more is refused before it begins. The error says how large it is.",
    )
    skip_missing: bool = parameter(
        False,
        label="Skip missing tiles",
        advanced=True,
        help="Go on if tiles of an EPT data set are missing on the server. A warning counts them.",
    )
    to_utm: bool = parameter(
        False,
        label="Transform Web Mercator to UTM",
        help="Whether points in Web Mercator, such as those of 3DEP, are transformed to the zone of"
        " UTM (WGS 84) of the area, and their heights to metres. Nothing can be measured in Web"
        " Mercator.",
    )
    height_unit: str = parameter(
        STATED,
        label="Unit of the heights",
        choices={
            STATED: "As the CRS states",
            "metre": "Metre",
            "foot": "International foot",
            "us-foot": "US survey foot",
        },
        advanced=True,
        help="The unit of the heights of points that are transformed to UTM, if their CRS does not"
        " state it.",
    )
    follow: bool = parameter(
        False,
        label="Follow lists to other servers",
        advanced=True,
        help="Whether a virtual point cloud or a STAC item may name files on servers that you did"
        " not name. Without it, they are named and nothing is downloaded. With it, the Planetary"
        " Computer is asked for signatures of its files.",
    )


def download(
    address: str,
    area: Area | None,
    output: Path,
    how: Download = Download(),
    progress: Progress = SILENT,
) -> Fetched:
    """Write the points of a remote cloud in an area, as they are."""
    # The folder for what is not finished is beside what the user names, not beside the temporary
    # file that is to become it.
    waiting = Path(f"{shown(output)}.parts")
    wanted = Wanted(
        area, how.resolution, how.limit * 1e9, how.skip_missing, how.follow,
        to_utm=how.to_utm, height_unit=how.height_unit,
    )  # fmt: skip
    return fetch(address, output, wanted, waiting, progress)


TOOL = FileTool(
    work=download,
    sets=(Download,),
    inputs=(
        Input(
            "address",
            "address",
            help="The address (https, s3, gs or az) of a COPC file, of the ept.json of an EPT data"
            " set, of a virtual point cloud (.vpc), or of a STAC item or collection with such"
            " files; or the path of one.",
            label="Remote point cloud",
            named="ADDRESS",
        ),
        Input(
            "area",
            "area",
            help="Only points in {area} are downloaded. Empty: all points.",
            label="Area",
            optional=True,
        ),
    ),
    outputs=(
        Output(
            "output",
            "points",
            help="The points, with all of their dimensions, as .copc.laz or .laz; of a list of"
            " point clouds a new folder, without an ending, with a file for each of them.",
            label="Downloaded point cloud",
            is_main=True,
        ),
    ),
    command="fetch",
    identifier="fetch",
    title="Download part of a remote point cloud",
    about="Of a COPC file, an EPT data set, or the files of a virtual point cloud or STAC item that"
    " have points there, only the parts that are needed are downloaded, as they are, with all of"
    " their dimensions. The log tells how much that is before the download begins. If it is"
    " stopped, the same run goes on where it was.",
    numbers=(("POINT_COUNT", "Points"),),
    page="fetch",
    words=(CLOUD, "download,remote,url,web,http,clip,cloud storage,reproject,utm"),
)
