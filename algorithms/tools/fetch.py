"""Downloads part of a remote point cloud."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..core.temporary import shown
from ..remote.fetching import Fetched, Wanted, fetch
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
        empty="all points",
        help="Distance between points. If it is larger than that of the cloud, only the upper"
        " levels of its octree are downloaded, whose points are about so far apart.",
    )
    limit: float = parameter(
        2.0,
        label="Limit",
        unit="GB",
        minimum=0.0,
        help="A download of more is refused before it begins. The error says how large it is.",
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
    return fetch(address, output, Wanted(area, how.resolution, how.limit * 1e9), waiting, progress)


TOOL = FileTool(
    work=download,
    sets=(Download,),
    inputs=(
        Input(
            "address",
            "address",
            help="the address of a COPC file (https, s3, gs or az), or the path of one",
            named="ADDRESS",
        ),
        Input(
            "area",
            "area",
            help="download only points in",
            more="; without an area all points",
            optional=True,
        ),
    ),
    outputs=(
        Output("output", "points", help="the file to write (.copc.laz or .laz)", is_main=True),
    ),
    command="fetch",
    command_about="Downloads the points of a remote point cloud that lie in an area, and nothing"
    " else: only the parts of the file that are needed, as they are, with all of their dimensions."
    " If it is stopped, the same command goes on where it was.",
    title="Download part of a remote point cloud",
    summary="Downloads the points of a remote point cloud that lie in an area.",
    page="fetch",
    words=(CLOUD, "download,remote,url,web,http,copc,clip,cloud storage"),
)
