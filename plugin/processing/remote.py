"""Remote point clouds as inputs: layers and addresses, and which part of them is downloaded."""

from __future__ import annotations

import re
from typing import NamedTuple

from qgis.core import (
    QgsPointCloudLayer,
    QgsProcessingAlgorithm,
    QgsProcessingParameterExtent,
    QgsProcessingParameterNumber,
    QgsProviderRegistry,
)

from ...algorithms.library.arguments import LIMIT_HELP, MOST
from ...algorithms.remote.addresses import checked, name_of
from .. import compat
from ..network import use_for

# Ends the help of an input that is an address.
LAYER_HELP = "Also a point cloud layer. Only what lies in the extent is downloaded."
ADDRESS_HELP = (
    "The address (https://...) of a COPC file, of the ept.json of an EPT data set, of a virtual"
    f" point cloud or of a STAC item. {LAYER_HELP}"
)
# Ends the help of other inputs.
ALSO_REMOTE = (
    " Also a remote point cloud (COPC, EPT, VPC), or its address (https://...): what the extent"
    " needs of it is downloaded first."
)
# The fields of inputs that can be remote; of points, those only for remote ones.
PART = "EXTENT"
LIMIT = "LIMIT"
ADDRESS = "ADDRESS"
REMOTE = "REMOTE"
_PART_HELP = (
    "The points of a remote point cloud that lie in this rectangle are downloaded, and are all that"
    " is used. Only for point clouds that are not on this computer."
)
# QGIS 3.40 and newer hand over such a source of a layer: its provider and its address.
_WITH_PROVIDER = re.compile(r"(copc|ept|vpc|pdal)://(?=[a-z][a-z0-9]+://)")


class Remote(NamedTuple):
    """A remote point cloud."""

    address: str
    name: str
    crs: str | None = None  # of its layer, as well-known text; None if it is not known


def remote_at(address: str, login: str = "") -> Remote:
    """Return the point cloud at an address, and let it be read; in the main thread."""
    address = checked(address)
    use_for(address, login)
    return Remote(address, name_of(address).partition(".")[0])


def remote_of(layer: QgsPointCloudLayer) -> Remote:
    """Return what a layer shows, and let it be read with its login; in the main thread."""
    parts = QgsProviderRegistry.instance().decodeUri(layer.providerType(), layer.source())
    # Before QGIS 4.0, layers of point clouds had no login.
    remote = remote_at(str(parts.get("path") or layer.source()), str(parts.get("authcfg") or ""))
    crs = layer.crs().toWkt(compat.WKT) if layer.crs().isValid() else None
    return Remote(remote.address, layer.name(), crs)


def without_provider(source: str) -> str:
    """Return the address in the source of a layer."""
    return _WITH_PROVIDER.sub("", source)


def add_remote(algorithm: QgsProcessingAlgorithm, has_area: bool) -> None:
    """Add the fields for remote inputs to a dialog, as advanced parameters."""
    part = QgsProcessingParameterExtent(PART, "Extent of a remote point cloud", None, True)
    limit = QgsProcessingParameterNumber(
        LIMIT, "Limit of the download [GB]", compat.NUMBER, MOST, True, 0.0, 100_000.0
    )
    for field, help in ((part, _PART_HELP), (limit, LIMIT_HELP))[has_area:]:
        field.setFlags(field.flags() | compat.ADVANCED)
        algorithm.addParameter(field, help)


def extent_of_map() -> str | None:
    """Return the extent of the map as a field shows it; None if there is no map."""
    from qgis.utils import iface

    if iface is None or iface.mapCanvas() is None or iface.mapCanvas().extent().isEmpty():
        return None
    box, crs = iface.mapCanvas().extent(), iface.mapCanvas().mapSettings().destinationCrs()
    edges = box.xMinimum(), box.xMaximum(), box.yMinimum(), box.yMaximum()
    return f"{','.join(map(repr, edges))} [{crs.authid()}]"
