"""Python packages that a QGIS may lack: where they are kept, and how to get them. No qgis here."""
