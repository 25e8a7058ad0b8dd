"""The field for a remote point cloud: a layer, or an address."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from qgis.core import (
    QgsPointCloudLayer,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingUtils,
    QgsProviderRegistry,
)

from ...algorithms.remote.addresses import is_address, name_of
from .. import compat
from ..i18n import mark
from ..network import use_for
from .feedback import Refusal
from .inputs import PointCloudInput

ADDRESS_HELP = (
    "A point cloud layer, or the address (https://...) of a COPC file, of the ept.json of an EPT"
    " data set, of a virtual point cloud or of a STAC item. Only what lies in the extent is"
    " downloaded."
)
# As a name, so that the widget is imported only in dialogs, not in qgis_process.
_WIDGET = f"{__package__}.widgets.AddressWidget"
# QGIS 3.40 and newer hand over such a source of a layer: its provider and its address.
_WITH_PROVIDER = re.compile(r"(copc|ept|vpc|pdal)://(?=[a-z][a-z0-9]+://)")


class RemoteInput(PointCloudInput):
    """A point cloud layer, or the address or path of a file."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.setMetadata({"widget_wrapper": {"class": _WIDGET}})

    def clone(self) -> RemoteInput:
        """Return a copy."""
        return RemoteInput(self)

    def checkValueIsAcceptable(
        self, value: Any, context: QgsProcessingContext | None = None
    ) -> bool:
        """Return whether `value` is an address, a file, or QGIS accepts it."""
        if isinstance(value, str) and is_address(value):
            return True
        return super().checkValueIsAcceptable(value, context)


class Remote(NamedTuple):
    """A remote point cloud."""

    address: str
    crs: str | None  # of its layer, as well-known text; None if it is not known
    name: str


def remote_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    name: str,
    context: QgsProcessingContext,
) -> Remote:
    """Return the cloud in a field, and let it be read with its login; in the main thread."""
    layer = parameters.get(name)
    if not isinstance(layer, QgsPointCloudLayer):
        text = _WITH_PROVIDER.sub("", algorithm.parameterAsString(parameters, name, context))
        # Only a layer of the project: of other texts, QGIS would make one, and ask the server.
        layer = QgsProcessingUtils.mapLayerFromString(text, context, False)
        if not isinstance(layer, QgsPointCloudLayer):
            if not text:
                raise Refusal(mark("Choose a point cloud."))
            use_for(text, "")
            return Remote(text, None, _stem(text))
    parts = QgsProviderRegistry.instance().decodeUri(layer.providerType(), layer.source())
    address = str(parts.get("path") or layer.source())
    # Before QGIS 4.0, layers of point clouds had no login.
    use_for(address, str(parts.get("authcfg") or ""))
    crs = layer.crs().toWkt(compat.WKT) if layer.crs().isValid() else None
    return Remote(address, crs, layer.name())


def extent_of_map() -> str | None:
    """Return the extent of the map as a field shows it; None if there is no map."""
    from qgis.utils import iface

    if iface is None or iface.mapCanvas() is None or iface.mapCanvas().extent().isEmpty():
        return None
    box, crs = iface.mapCanvas().extent(), iface.mapCanvas().mapSettings().destinationCrs()
    edges = box.xMinimum(), box.xMaximum(), box.yMinimum(), box.yMaximum()
    return f"{','.join(map(repr, edges))} [{crs.authid()}]"


def _stem(text: str) -> str:
    """Return the name of a file without its ending."""
    return name_of(text).partition(".")[0]
