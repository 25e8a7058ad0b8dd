<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>BareEarth</name>
    <message>
        <source>"{}" can't be written: the answer is not saved. Export it as GeoPackage.</source>
        <translation>„{}“ lässt sich nicht schreiben: Die Antwort ist nicht gespeichert. Exportieren Sie den Layer als GeoPackage.</translation>
    </message>
    <message>
        <source>"{}" is from the run "{}", and "{}" from "{}": choose both from one run.</source>
        <translation>„{}“ stammt aus dem Lauf „{}“, „{}“ aber aus „{}“: Wählen Sie beide aus einem Lauf.</translation>
    </message>
    <message>
        <source>0 to 1</source>
        <translation>0 bis 1</translation>
    </message>
    <message>
        <source>1 is level</source>
        <translation>1 ist eben</translation>
    </message>
    <message>
        <source>1 to 255</source>
        <translation>1 bis 255</translation>
    </message>
    <message>
        <source>1 to 7</source>
        <translation>1 bis 7</translation>
    </message>
    <message>
        <source>1 where ground points are far away</source>
        <translation>1, wo Bodenpunkte weit entfernt sind</translation>
    </message>
    <message>
        <source>A class of their own</source>
        <translation>Eine eigene Klasse</translation>
    </message>
    <message>
        <source>A layer, a file, or an address (https://…)</source>
        <translation>Ein Layer, eine Datei oder eine Adresse (https://…)</translation>
    </message>
    <message>
        <source>Accuracy class</source>
        <translation>Genauigkeitsklasse</translation>
    </message>
    <message>
        <source>Add the height above ground</source>
        <translation>Höhe über Grund hinzufügen</translation>
    </message>
    <message>
        <source>Adds the height of every point above the ground points of a point cloud.</source>
        <translation>Fügt jedem Punkt einer Punktwolke seine Höhe über den Bodenpunkten hinzu.</translation>
    </message>
    <message>
        <source>Alignment</source>
        <translation>Ausrichtung</translation>
    </message>
    <message>
        <source>All files</source>
        <translation>Alle Dateien</translation>
    </message>
    <message>
        <source>All in one</source>
        <translation>Alles in einem</translation>
    </message>
    <message>
        <source>All places are answered or skipped.</source>
        <translation>Alle Stellen sind beantwortet oder übersprungen.</translation>
    </message>
    <message>
        <source>All returns</source>
        <translation>Alle Echos</translation>
    </message>
    <message>
        <source>Another file…</source>
        <translation>Andere Datei …</translation>
    </message>
    <message>
        <source>Archaeological topography</source>
        <translation>Archäologische Topographie</translation>
    </message>
    <message>
        <source>Archaeological topography (VAT)</source>
        <translation>Archäologische Topographie (VAT)</translation>
    </message>
    <message>
        <source>Archaeology</source>
        <translation>Archäologie</translation>
    </message>
    <message>
        <source>Area [m²]</source>
        <translation>Fläche [m²]</translation>
    </message>
    <message>
        <source>Area of canopy after, m2</source>
        <translation>Kronenfläche nachher, m2</translation>
    </message>
    <message>
        <source>Area of canopy before, m2</source>
        <translation>Kronenfläche vorher, m2</translation>
    </message>
    <message>
        <source>As ground, this place would rise by up to {} m; its expected error is {} m. Press G again if that is right.</source>
        <translation>Als Boden würde diese Stelle um bis zu {} m höher; ihr erwarteter Fehler ist {} m. Drücken Sie noch einmal G, wenn das stimmt.</translation>
    </message>
    <message>
        <source>As the CRS states</source>
        <translation>Wie das KBS angibt</translation>
    </message>
    <message>
        <source>As the filter classifies them</source>
        <translation>Wie der Filter sie klassifiziert</translation>
    </message>
    <message>
        <source>As the input</source>
        <translation>Wie die Eingabe</translation>
    </message>
    <message>
        <source>Assess a ground classification</source>
        <translation>Bodenklassifikation bewerten</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>Automatic (many scales, follows the terrain)</source>
        <translation>Automatisch (viele Maßstäbe, folgt dem Gelände)</translation>
    </message>
    <message>
        <source>Band</source>
        <translation>Kanal</translation>
    </message>
    <message>
        <source>Bare Earth: LAZ support</source>
        <translation>Bare Earth: LAZ-Unterstützung</translation>
    </message>
    <message>
        <source>Bare Earth: Review</source>
        <translation>Bare Earth: Durchsicht</translation>
    </message>
    <message>
        <source>Bare Earth: points of the places to review</source>
        <translation>Bare Earth: Punkte der zu prüfenden Stellen</translation>
    </message>
    <message>
        <source>Bathymetric bottom</source>
        <translation>Gewässergrund</translation>
    </message>
    <message>
        <source>Boundary</source>
        <translation>Begrenzung</translation>
    </message>
    <message>
        <source>Breaklines</source>
        <translation>Bruchkanten</translation>
    </message>
    <message>
        <source>Bridges</source>
        <translation>Brücken</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Helligkeit</translation>
    </message>
    <message>
        <source>COPC, which QGIS shows at once</source>
        <translation>COPC, das QGIS sofort zeigt</translation>
    </message>
    <message>
        <source>CRS of the points</source>
        <translation>KBS der Punkte</translation>
    </message>
    <message>
        <source>Cancelled.</source>
        <translation>Abgebrochen.</translation>
    </message>
    <message>
        <source>Canopy change</source>
        <translation>Veränderung der Kronen</translation>
    </message>
    <message>
        <source>Canopy gained, m2</source>
        <translation>Gewonnene Kronenfläche, m2</translation>
    </message>
    <message>
        <source>Canopy height</source>
        <translation>Kronenhöhe</translation>
    </message>
    <message>
        <source>Canopy height (CHM)</source>
        <translation>Kronenhöhe (nDOM)</translation>
    </message>
    <message>
        <source>Canopy height from two rasters</source>
        <translation>Kronenhöhe aus zwei Rastern</translation>
    </message>
    <message>
        <source>Canopy lost, m2</source>
        <translation>Verlorene Kronenfläche, m2</translation>
    </message>
    <message>
        <source>Cause</source>
        <translation>Ursache</translation>
    </message>
    <message>
        <source>Cause of the expected error</source>
        <translation>Ursache des erwarteten Fehlers</translation>
    </message>
    <message>
        <source>Cell size</source>
        <translation>Zellgröße</translation>
    </message>
    <message>
        <source>Cell size [m]</source>
        <translation>Zellgröße [m]</translation>
    </message>
    <message>
        <source>Cell size of the error map</source>
        <translation>Zellgröße der Fehlerkarte</translation>
    </message>
    <message>
        <source>Cell size of the terrain model</source>
        <translation>Zellgröße des Geländemodells</translation>
    </message>
    <message>
        <source>Cell size of the water</source>
        <translation>Zellgröße der Gewässer</translation>
    </message>
    <message>
        <source>Cells of objects</source>
        <translation>Zellen von Objekten</translation>
    </message>
    <message>
        <source>Cells with a height</source>
        <translation>Zellen mit einer Höhe</translation>
    </message>
    <message>
        <source>Certain</source>
        <translation>Sicher</translation>
    </message>
    <message>
        <source>Change between two surveys</source>
        <translation>Veränderung zwischen zwei Befliegungen</translation>
    </message>
    <message>
        <source>Change of the canopy</source>
        <translation>Veränderung der Kronenhöhe</translation>
    </message>
    <message>
        <source>Change of the ground</source>
        <translation>Veränderung des Bodens</translation>
    </message>
    <message>
        <source>Changes nothing, and is left out next time.</source>
        <translation>Ändert nichts und kommt nicht wieder.</translation>
    </message>
    <message>
        <source>Check against checkpoints</source>
        <translation>Mit Kontrollpunkten vergleichen</translation>
    </message>
    <message>
        <source>Checkpoints</source>
        <translation>Kontrollpunkte</translation>
    </message>
    <message>
        <source>Choose a file: {}.</source>
        <translation>Wählen Sie eine Datei: {}.</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Ordner wählen</translation>
    </message>
    <message>
        <source>Choose a folder for the delivery.</source>
        <translation>Wählen Sie einen Ordner für die Lieferung.</translation>
    </message>
    <message>
        <source>Choose a point cloud, or a folder of them.</source>
        <translation>Wählen Sie eine Punktwolke oder einen Ordner mit Punktwolken.</translation>
    </message>
    <message>
        <source>Choose a point cloud.</source>
        <translation>Wählen Sie eine Punktwolke.</translation>
    </message>
    <message>
        <source>Choose at least one raster to make.</source>
        <translation>Wählen Sie mindestens ein Raster, das entstehen soll.</translation>
    </message>
    <message>
        <source>Choose point clouds, or a folder of them.</source>
        <translation>Wählen Sie Punktwolken oder einen Ordner mit Punktwolken.</translation>
    </message>
    <message>
        <source>Choose the classified points above to see them here.</source>
        <translation>Wählen Sie oben die klassifizierten Punkte, um sie hier zu sehen.</translation>
    </message>
    <message>
        <source>City, large halls</source>
        <translation>Großstadt, große Hallen</translation>
    </message>
    <message>
        <source>Class</source>
        <translation>Klasse</translation>
    </message>
    <message>
        <source>Class of bridges</source>
        <translation>Klasse der Brücken</translation>
    </message>
    <message>
        <source>Class of ignored ground</source>
        <translation>Klasse des ignorierten Bodens</translation>
    </message>
    <message>
        <source>Class of key points</source>
        <translation>Klasse der Schlüsselpunkte</translation>
    </message>
    <message>
        <source>Class of other points</source>
        <translation>Klasse der übrigen Punkte</translation>
    </message>
    <message>
        <source>Class of the corrections</source>
        <translation>Klasse der Korrekturen</translation>
    </message>
    <message>
        <source>Class of the ground</source>
        <translation>Klasse des Bodens</translation>
    </message>
    <message>
        <source>Class of water</source>
        <translation>Klasse des Wassers</translation>
    </message>
    <message>
        <source>Classes</source>
        <translation>Klassen</translation>
    </message>
    <message>
        <source>Classes above the ground</source>
        <translation>Klassen über dem Boden</translation>
    </message>
    <message>
        <source>Classes of known ground</source>
        <translation>Klassen bekannten Bodens</translation>
    </message>
    <message>
        <source>Classes of the surface model</source>
        <translation>Klassen des Oberflächenmodells</translation>
    </message>
    <message>
        <source>Classes to classify</source>
        <translation>Zu klassifizierende Klassen</translation>
    </message>
    <message>
        <source>Classified point cloud</source>
        <translation>Klassifizierte Punktwolke</translation>
    </message>
    <message>
        <source>Classified points</source>
        <translation>Klassifizierte Punkte</translation>
    </message>
    <message>
        <source>Classified points only</source>
        <translation>Nur klassifizierte Punkte</translation>
    </message>
    <message>
        <source>Classified tiles</source>
        <translation>Klassifizierte Kacheln</translation>
    </message>
    <message>
        <source>Classifies a raw point cloud, and makes everything that a job hands over.</source>
        <translation>Klassifiziert eine rohe Punktwolke und erstellt alles, was ein Auftrag liefert.</translation>
    </message>
    <message>
        <source>Classify above ground</source>
        <translation>Über dem Boden klassifizieren</translation>
    </message>
    <message>
        <source>Classify ground (TIN densification)</source>
        <translation>Boden klassifizieren (TIN-Verdichtung)</translation>
    </message>
    <message>
        <source>Classify ground (grid minimum)</source>
        <translation>Boden klassifizieren (Rasterminimum)</translation>
    </message>
    <message>
        <source>Classify ground (many files)</source>
        <translation>Boden klassifizieren (viele Dateien)</translation>
    </message>
    <message>
        <source>Classify ground (slope filter)</source>
        <translation>Boden klassifizieren (Neigungsfilter)</translation>
    </message>
    <message>
        <source>Classify model key points</source>
        <translation>Modell-Schlüsselpunkte klassifizieren</translation>
    </message>
    <message>
        <source>Classify vegetation and buildings anew</source>
        <translation>Vegetation und Gebäude neu klassifizieren</translation>
    </message>
    <message>
        <source>Classify water</source>
        <translation>Gewässer klassifizieren</translation>
    </message>
    <message>
        <source>Clip point clouds</source>
        <translation>Punktwolken zuschneiden</translation>
    </message>
    <message>
        <source>Clipped point cloud</source>
        <translation>Zugeschnittene Punktwolke</translation>
    </message>
    <message>
        <source>Compare settings on a window</source>
        <translation>Einstellungen in einem Fenster vergleichen</translation>
    </message>
    <message>
        <source>Compares a classified point cloud with a reference: type I and II error, kappa.</source>
        <translation>Vergleicht eine klassifizierte Punktwolke mit einer Referenz: Fehler 1. und 2. Art, Kappa.</translation>
    </message>
    <message>
        <source>Compares ground points and a terrain model with points surveyed on the ground.</source>
        <translation>Vergleicht Bodenpunkte und ein Geländemodell mit Punkten, die am Boden vermessen wurden.</translation>
    </message>
    <message>
        <source>Comparison of settings</source>
        <translation>Vergleich von Einstellungen</translation>
    </message>
    <message>
        <source>Compressed point clouds (.laz, .copc.laz) need the Python package lazrs, which few builds of QGIS have. Here you can get it from the Python Package Index (0.6 MB) or, without internet, from a wheel file of lazrs for {}. It is stored in your profile; QGIS itself does not change.</source>
        <translation>Komprimierte Punktwolken (.laz, .copc.laz) brauchen das Python-Paket lazrs, das kaum ein QGIS mitbringt. Hier bekommen Sie es aus dem Python Package Index (0,6 MB) oder, ohne Internet, aus einer Wheel-Datei von lazrs für {}. Es wird in Ihrem Profil gespeichert; QGIS selbst ändert sich nicht.</translation>
    </message>
    <message>
        <source>Context round the window</source>
        <translation>Umgebung des Fensters</translation>
    </message>
    <message>
        <source>Continue an earlier run</source>
        <translation>Einen früheren Lauf fortsetzen</translation>
    </message>
    <message>
        <source>Contour interval</source>
        <translation>Äquidistanz der Höhenlinien</translation>
    </message>
    <message>
        <source>Contour lines</source>
        <translation>Höhenlinien</translation>
    </message>
    <message>
        <source>Correct and run again</source>
        <translation>Korrigieren und neu rechnen</translation>
    </message>
    <message>
        <source>Corrections</source>
        <translation>Korrekturen</translation>
    </message>
    <message>
        <source>Counted checkpoints</source>
        <translation>Gezählte Kontrollpunkte</translation>
    </message>
    <message>
        <source>Delivery</source>
        <translation>Lieferung</translation>
    </message>
    <message>
        <source>Density of first returns</source>
        <translation>Dichte der ersten Echos</translation>
    </message>
    <message>
        <source>Density of ground points</source>
        <translation>Dichte der Bodenpunkte</translation>
    </message>
    <message>
        <source>Density of low vegetation</source>
        <translation>Dichte der niedrigen Vegetation</translation>
    </message>
    <message>
        <source>Depression</source>
        <translation>Senke</translation>
    </message>
    <message>
        <source>Depth of low outliers</source>
        <translation>Tiefe tiefer Ausreißer</translation>
    </message>
    <message>
        <source>Derived water surface</source>
        <translation>Abgeleitete Wasseroberfläche</translation>
    </message>
    <message>
        <source>Detection limit</source>
        <translation>Nachweisgrenze</translation>
    </message>
    <message>
        <source>Difference between strips</source>
        <translation>Unterschied zwischen Flugstreifen</translation>
    </message>
    <message>
        <source>Differences between strips</source>
        <translation>Unterschiede zwischen Flugstreifen</translation>
    </message>
    <message>
        <source>Differences between strips [m]</source>
        <translation>Unterschiede zwischen Flugstreifen [m]</translation>
    </message>
    <message>
        <source>Distance of voids</source>
        <translation>Abstand für Lücken</translation>
    </message>
    <message>
        <source>Documentation</source>
        <translation>Dokumentation</translation>
    </message>
    <message>
        <source>Done; no restart is needed.</source>
        <translation>Fertig; ein Neustart ist nicht nötig.</translation>
    </message>
    <message>
        <source>Doubtful</source>
        <translation>Zweifelhaft</translation>
    </message>
    <message>
        <source>Download part of a remote point cloud</source>
        <translation>Teil einer entfernten Punktwolke herunterladen</translation>
    </message>
    <message>
        <source>Downloaded point cloud</source>
        <translation>Heruntergeladene Punktwolke</translation>
    </message>
    <message>
        <source>Downloads the points of a remote point cloud that lie in an area.</source>
        <translation>Lädt die Punkte einer entfernten Punktwolke herunter, die in einem Gebiet liegen.</translation>
    </message>
    <message>
        <source>Draws contour lines of an elevation raster.</source>
        <translation>Zeichnet Höhenlinien eines Höhenrasters.</translation>
    </message>
    <message>
        <source>Drone site</source>
        <translation>Gelände aus Drohnenflug</translation>
    </message>
    <message>
        <source>Drone survey, construction or mining site</source>
        <translation>Drohnenvermessung, Baustelle oder Abbau</translation>
    </message>
    <message>
        <source>Elevation raster</source>
        <translation>Höhenraster</translation>
    </message>
    <message>
        <source>Error map</source>
        <translation>Fehlerkarte</translation>
    </message>
    <message>
        <source>Error of the checkpoints</source>
        <translation>Fehler der Kontrollpunkte</translation>
    </message>
    <message>
        <source>Error of the volume down, m3</source>
        <translation>Fehler des Volumens nach unten, m3</translation>
    </message>
    <message>
        <source>Error of the volume up, m3</source>
        <translation>Fehler des Volumens nach oben, m3</translation>
    </message>
    <message>
        <source>Errors</source>
        <translation>Fehler</translation>
    </message>
    <message>
        <source>Errors at checkpoints</source>
        <translation>Fehler an Kontrollpunkten</translation>
    </message>
    <message>
        <source>Every {}</source>
        <translation>Alle {}</translation>
    </message>
    <message>
        <source>Expected RMSE, m</source>
        <translation>Erwarteter RMSE, m</translation>
    </message>
    <message>
        <source>Expected error</source>
        <translation>Erwarteter Fehler</translation>
    </message>
    <message>
        <source>Expected error (95 %)</source>
        <translation>Erwarteter Fehler (95 %)</translation>
    </message>
    <message>
        <source>Expected error of the new DTM</source>
        <translation>Erwarteter Fehler des neuen DGM</translation>
    </message>
    <message>
        <source>Expected error of the old DTM</source>
        <translation>Erwarteter Fehler des alten DGM</translation>
    </message>
    <message>
        <source>Expected error up to {} m on {} m²</source>
        <translation>Erwarteter Fehler bis {} m auf {} m²</translation>
    </message>
    <message>
        <source>Extent</source>
        <translation>Ausdehnung</translation>
    </message>
    <message>
        <source>Extent of a remote point cloud</source>
        <translation>Ausdehnung einer entfernten Punktwolke</translation>
    </message>
    <message>
        <source>Extent of the rasters</source>
        <translation>Ausdehnung der Raster</translation>
    </message>
    <message>
        <source>Extra dimension HeightAboveGround</source>
        <translation>Zusatzdimension HeightAboveGround</translation>
    </message>
    <message>
        <source>Factor of the expected error</source>
        <translation>Faktor des erwarteten Fehlers</translation>
    </message>
    <message>
        <source>Fill pits of the canopy</source>
        <translation>Löcher im Kronendach füllen</translation>
    </message>
    <message>
        <source>Final height</source>
        <translation>Höhe im letzten Durchgang</translation>
    </message>
    <message>
        <source>Find bridges (17)</source>
        <translation>Brücken finden (17)</translation>
    </message>
    <message>
        <source>Find buildings (6)</source>
        <translation>Gebäude finden (6)</translation>
    </message>
    <message>
        <source>Find high noise (18)</source>
        <translation>Hohes Rauschen finden (18)</translation>
    </message>
    <message>
        <source>Find the ground of point clouds</source>
        <translation>Boden der Punktwolken suchen</translation>
    </message>
    <message>
        <source>Find water</source>
        <translation>Gewässer finden</translation>
    </message>
    <message>
        <source>Finds lakes and rivers as polygons with their levels, and as breaklines.</source>
        <translation>Findet Seen und Flüsse als Polygone mit ihren Wasserspiegeln und als Bruchkanten.</translation>
    </message>
    <message>
        <source>Finds the few ground points that make as good a terrain model as all of them.</source>
        <translation>Findet die wenigen Bodenpunkte, die ein ebenso gutes Geländemodell ergeben wie alle zusammen.</translation>
    </message>
    <message>
        <source>Finds the ground by two methods, and says where they differ.</source>
        <translation>Findet den Boden mit zwei Verfahren und sagt, wo sie sich unterscheiden.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud by rules on the lowest points of cells.</source>
        <translation>Findet die Bodenpunkte einer Lidar-Punktwolke durch Regeln über die tiefsten Punkte von Zellen.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud by the slopes between neighbouring points.</source>
        <translation>Findet die Bodenpunkte einer Lidar-Punktwolke an den Neigungen zwischen benachbarten Punkten.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud, and makes a terrain model of them.</source>
        <translation>Findet die Bodenpunkte einer Lidar-Punktwolke und macht aus ihnen ein Geländemodell.</translation>
    </message>
    <message>
        <source>Finds the ground points of the many files of a survey, without seams between them.</source>
        <translation>Findet die Bodenpunkte der vielen Dateien einer Befliegung, ohne Nähte zwischen ihnen.</translation>
    </message>
    <message>
        <source>Finds vegetation, buildings and bridges in a point cloud whose ground is known.</source>
        <translation>Findet Vegetation, Gebäude und Brücken in einer Punktwolke, deren Boden bekannt ist.</translation>
    </message>
    <message>
        <source>Finds where a terrain model may be wrong: what to look at first, and why.</source>
        <translation>Findet, wo ein Geländemodell falsch sein kann: was zuerst anzusehen ist, und warum.</translation>
    </message>
    <message>
        <source>Finds where canopy was lost and gained between two surveys, and how it grew.</source>
        <translation>Findet, wo zwischen zwei Befliegungen Kronenfläche verloren ging und dazukam, und wie die Kronen wuchsen.</translation>
    </message>
    <message>
        <source>Finds where the ground changed between two surveys, how much, and how surely.</source>
        <translation>Findet, wo sich der Boden zwischen zwei Befliegungen verändert hat, wie stark und wie sicher.</translation>
    </message>
    <message>
        <source>First and single returns</source>
        <translation>Erste und einzige Echos</translation>
    </message>
    <message>
        <source>First returns</source>
        <translation>Erste Echos</translation>
    </message>
    <message>
        <source>First returns per m²</source>
        <translation>Erste Echos je m²</translation>
    </message>
    <message>
        <source>Flat land, fields</source>
        <translation>Flachland, Felder</translation>
    </message>
    <message>
        <source>Flood model</source>
        <translation>Hochwassermodell</translation>
    </message>
    <message>
        <source>Folder of point clouds</source>
        <translation>Ordner mit Punktwolken</translation>
    </message>
    <message>
        <source>Folder of the classified point clouds</source>
        <translation>Ordner der klassifizierten Punktwolken</translation>
    </message>
    <message>
        <source>Folder of the delivery</source>
        <translation>Ordner der Lieferung</translation>
    </message>
    <message>
        <source>Folder of the rasters</source>
        <translation>Ordner der Raster</translation>
    </message>
    <message>
        <source>Follow lists to other servers</source>
        <translation>Listen zu anderen Servern folgen</translation>
    </message>
    <message>
        <source>Forestry</source>
        <translation>Forst</translation>
    </message>
    <message>
        <source>Format of the output</source>
        <translation>Format der Ausgabe</translation>
    </message>
    <message>
        <source>Four lights, from southwest to north</source>
        <translation>Vier Lichter, von Südwest bis Nord</translation>
    </message>
    <message>
        <source>From a raw point cloud to heights above ground, of points and as a raster.</source>
        <translation>Von der rohen Punktwolke zu Höhen über Grund, an den Punkten und als Raster.</translation>
    </message>
    <message>
        <source>From a raw point cloud to terrain model, hillshade and contour lines.</source>
        <translation>Von der rohen Punktwolke zu Geländemodell, Schummerung und Höhenlinien.</translation>
    </message>
    <message>
        <source>From a wheel file…</source>
        <translation>Aus einer Wheel-Datei…</translation>
    </message>
    <message>
        <source>From the delivery</source>
        <translation>Wie die Lieferung</translation>
    </message>
    <message>
        <source>GB</source>
        <translation>GB</translation>
    </message>
    <message>
        <source>Get lazrs</source>
        <translation>lazrs holen</translation>
    </message>
    <message>
        <source>Give an extent or a boundary, not both, for an address.</source>
        <translation>Geben Sie für eine Adresse eine Ausdehnung oder eine Begrenzung an, nicht beides.</translation>
    </message>
    <message>
        <source>Given</source>
        <translation>Vorgegeben</translation>
    </message>
    <message>
        <source>Gives class 9 to ground points in water, and class 20 to those beside its shore.</source>
        <translation>Gibt Bodenpunkten im Wasser die Klasse 9 und denen neben dem Ufer die Klasse 20.</translation>
    </message>
    <message>
        <source>Greatest height</source>
        <translation>Größte Höhe</translation>
    </message>
    <message>
        <source>Grid minimum</source>
        <translation>Rasterminimum</translation>
    </message>
    <message>
        <source>Grid minimum, Automatic</source>
        <translation>Rasterminimum, Automatisch</translation>
    </message>
    <message>
        <source>Grid minimum, City, large halls</source>
        <translation>Rasterminimum, Großstadt, große Hallen</translation>
    </message>
    <message>
        <source>Grid minimum, Drone survey, construction or mining site</source>
        <translation>Rasterminimum, Drohnenvermessung, Baustelle oder Abbau</translation>
    </message>
    <message>
        <source>Grid minimum, Flat land, fields</source>
        <translation>Rasterminimum, Flachland, Felder</translation>
    </message>
    <message>
        <source>Grid minimum, Hilly land, forest</source>
        <translation>Rasterminimum, Hügelland, Wald</translation>
    </message>
    <message>
        <source>Grid minimum, Steep or rugged terrain</source>
        <translation>Rasterminimum, Steiles oder raues Gelände</translation>
    </message>
    <message>
        <source>Grid minimum, The paper's values</source>
        <translation>Rasterminimum, Werte der Veröffentlichung</translation>
    </message>
    <message>
        <source>Grid minimum, Town</source>
        <translation>Rasterminimum, Stadt</translation>
    </message>
    <message>
        <source>Grid size</source>
        <translation>Rasterweite</translation>
    </message>
    <message>
        <source>Ground</source>
        <translation>Boden</translation>
    </message>
    <message>
        <source>Ground (G)</source>
        <translation>Boden (G)</translation>
    </message>
    <message>
        <source>Ground and height above ground</source>
        <translation>Boden und Höhe über Grund</translation>
    </message>
    <message>
        <source>Ground classes</source>
        <translation>Bodenklassen</translation>
    </message>
    <message>
        <source>Ground classes of the reference</source>
        <translation>Bodenklassen der Referenz</translation>
    </message>
    <message>
        <source>Ground classification</source>
        <translation>Bodenklassifikation</translation>
    </message>
    <message>
        <source>Ground points</source>
        <translation>Bodenpunkte</translation>
    </message>
    <message>
        <source>Ground points per m²</source>
        <translation>Bodenpunkte je m²</translation>
    </message>
    <message>
        <source>Ground tolerance</source>
        <translation>Bodentoleranz</translation>
    </message>
    <message>
        <source>Ground tolerance above</source>
        <translation>Bodentoleranz nach oben</translation>
    </message>
    <message>
        <source>Ground tolerance below</source>
        <translation>Bodentoleranz nach unten</translation>
    </message>
    <message>
        <source>Ground tolerance on slopes</source>
        <translation>Bodentoleranz am Hang</translation>
    </message>
    <message>
        <source>HTML files (*.html)</source>
        <translation>HTML-Dateien (*.html)</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>Height above ground</source>
        <translation>Höhe über Grund</translation>
    </message>
    <message>
        <source>Height at which high vegetation begins</source>
        <translation>Höhe, ab der hohe Vegetation beginnt</translation>
    </message>
    <message>
        <source>Height at which low vegetation begins</source>
        <translation>Höhe, ab der niedrige Vegetation beginnt</translation>
    </message>
    <message>
        <source>Height at which medium vegetation begins</source>
        <translation>Höhe, ab der mittlere Vegetation beginnt</translation>
    </message>
    <message>
        <source>Height of high outliers</source>
        <translation>Höhe hoher Ausreißer</translation>
    </message>
    <message>
        <source>Height of the checkpoints</source>
        <translation>Höhe der Kontrollpunkte</translation>
    </message>
    <message>
        <source>Height threshold</source>
        <translation>Höhenschwelle</translation>
    </message>
    <message>
        <source>Height thresholds</source>
        <translation>Höhenschwellen</translation>
    </message>
    <message>
        <source>Heights of vegetation</source>
        <translation>Höhen der Vegetation</translation>
    </message>
    <message>
        <source>Highest height</source>
        <translation>Größte Höhe</translation>
    </message>
    <message>
        <source>Hillshade</source>
        <translation>Schummerung</translation>
    </message>
    <message>
        <source>Hillshade altitude</source>
        <translation>Höhe der Lichtquelle</translation>
    </message>
    <message>
        <source>Hillshade azimuth</source>
        <translation>Azimut der Lichtquelle</translation>
    </message>
    <message>
        <source>Hillshade, TIN densification</source>
        <translation>Schummerung, TIN-Verdichtung</translation>
    </message>
    <message>
        <source>Hillshade, slope filter</source>
        <translation>Schummerung, Neigungsfilter</translation>
    </message>
    <message>
        <source>Hilly land, forest</source>
        <translation>Hügelland, Wald</translation>
    </message>
    <message>
        <source>IGN LiDAR HD</source>
        <translation>IGN LiDAR HD</translation>
    </message>
    <message>
        <source>Ignored classes of the reference</source>
        <translation>Ignorierte Klassen der Referenz</translation>
    </message>
    <message>
        <source>Ignored ground</source>
        <translation>Ignorierter Boden</translation>
    </message>
    <message>
        <source>Ignored ground beside the shore</source>
        <translation>Ignorierter Boden neben dem Ufer</translation>
    </message>
    <message>
        <source>In the next run, no point here is ground.</source>
        <translation>Beim nächsten Lauf ist hier kein Punkt Boden.</translation>
    </message>
    <message>
        <source>In the next run, the ground around is continued through the place.</source>
        <translation>Beim nächsten Lauf wird der Boden ringsum durch die Stelle fortgesetzt.</translation>
    </message>
    <message>
        <source>Include subfolders</source>
        <translation>Unterordner einbeziehen</translation>
    </message>
    <message>
        <source>International foot</source>
        <translation>Internationaler Fuß</translation>
    </message>
    <message>
        <source>Iteration angle</source>
        <translation>Iterationswinkel</translation>
    </message>
    <message>
        <source>Iteration distance</source>
        <translation>Iterationsabstand</translation>
    </message>
    <message>
        <source>Kappa [%]</source>
        <translation>Kappa [%]</translation>
    </message>
    <message>
        <source>Keep small knolls and pits</source>
        <translation>Kleine Kuppen und Mulden behalten</translation>
    </message>
    <message>
        <source>Keep; old ground that is not ground now becomes 1</source>
        <translation>Behalten; früherer Boden, der jetzt kein Boden ist, wird 1</translation>
    </message>
    <message>
        <source>Key points</source>
        <translation>Schlüsselpunkte</translation>
    </message>
    <message>
        <source>Key points: grid size</source>
        <translation>Schlüsselpunkte: Rasterweite</translation>
    </message>
    <message>
        <source>Key points: tolerance above</source>
        <translation>Schlüsselpunkte: Toleranz nach oben</translation>
    </message>
    <message>
        <source>Key points: tolerance below</source>
        <translation>Schlüsselpunkte: Toleranz nach unten</translation>
    </message>
    <message>
        <source>Kinds of relief</source>
        <translation>Arten des Reliefs</translation>
    </message>
    <message>
        <source>LAS</source>
        <translation>LAS</translation>
    </message>
    <message>
        <source>LAZ</source>
        <translation>LAZ</translation>
    </message>
    <message>
        <source>LAZ support</source>
        <translation>LAZ-Unterstützung</translation>
    </message>
    <message>
        <source>LAZ support…</source>
        <translation>LAZ-Unterstützung…</translation>
    </message>
    <message>
        <source>LINZ, New Zealand National Aerial LiDAR Base Specification (PGF version)</source>
        <translation>LINZ, New Zealand National Aerial LiDAR Base Specification (PGF-Fassung)</translation>
    </message>
    <message>
        <source>Lakes</source>
        <translation>Seen</translation>
    </message>
    <message>
        <source>Land cover of the checkpoints</source>
        <translation>Bodenbedeckung der Kontrollpunkte</translation>
    </message>
    <message>
        <source>Last and single returns (return number = number of returns)</source>
        <translation>Letzte und einzige Echos (Nummer des Echos = Anzahl der Echos)</translation>
    </message>
    <message>
        <source>Least area</source>
        <translation>Kleinste Fläche</translation>
    </message>
    <message>
        <source>Least area of a roof</source>
        <translation>Kleinste Fläche eines Dachs</translation>
    </message>
    <message>
        <source>Least expected error</source>
        <translation>Kleinster erwarteter Fehler</translation>
    </message>
    <message>
        <source>Least height of a roof</source>
        <translation>Kleinste Höhe eines Dachs</translation>
    </message>
    <message>
        <source>Least height of canopy</source>
        <translation>Kleinste Kronenhöhe</translation>
    </message>
    <message>
        <source>Least low confidence area</source>
        <translation>Kleinste solche Fläche</translation>
    </message>
    <message>
        <source>Least width</source>
        <translation>Kleinste Breite</translation>
    </message>
    <message>
        <source>Leave out</source>
        <translation>Weglassen</translation>
    </message>
    <message>
        <source>Leave out; they keep their class</source>
        <translation>Weglassen; sie behalten ihre Klasse</translation>
    </message>
    <message>
        <source>LiDAR360's values</source>
        <translation>Werte von LiDAR360</translation>
    </message>
    <message>
        <source>Light of the hillshade</source>
        <translation>Licht der Schummerung</translation>
    </message>
    <message>
        <source>Likely</source>
        <translation>Wahrscheinlich</translation>
    </message>
    <message>
        <source>Limit</source>
        <translation>Grenze</translation>
    </message>
    <message>
        <source>Limit of the download [GB]</source>
        <translation>Grenze des Herunterladens [GB]</translation>
    </message>
    <message>
        <source>Local dominance</source>
        <translation>Lokale Dominanz</translation>
    </message>
    <message>
        <source>Local relief</source>
        <translation>Lokales Relief</translation>
    </message>
    <message>
        <source>Longest edge of a triangle</source>
        <translation>Längste Kante eines Dreiecks</translation>
    </message>
    <message>
        <source>Low confidence areas</source>
        <translation>Flächen mit geringer Verlässlichkeit</translation>
    </message>
    <message>
        <source>Low noise</source>
        <translation>Tiefes Rauschen</translation>
    </message>
    <message>
        <source>Lowest height</source>
        <translation>Kleinste Höhe</translation>
    </message>
    <message>
        <source>Made by Bare Earth with these settings:</source>
        <translation>Von Bare Earth mit diesen Einstellungen gemacht:</translation>
    </message>
    <message>
        <source>Makes terrain model, surface model, canopy height and hillshade of a point cloud.</source>
        <translation>Macht Geländemodell, Oberflächenmodell, Kronenhöhe und Schummerung aus einer Punktwolke.</translation>
    </message>
    <message>
        <source>Makes the canopy height of a surface model and a terrain model, two rasters.</source>
        <translation>Berechnet die Kronenhöhe aus einem Oberflächen- und einem Geländemodell, zwei Rastern.</translation>
    </message>
    <message>
        <source>Mark key points by</source>
        <translation>Schlüsselpunkte kennzeichnen durch</translation>
    </message>
    <message>
        <source>Mark model key points</source>
        <translation>Modell-Schlüsselpunkte kennzeichnen</translation>
    </message>
    <message>
        <source>Maximum building size</source>
        <translation>Größte Gebäudebreite</translation>
    </message>
    <message>
        <source>Maximum edge</source>
        <translation>Größte Kantenlänge</translation>
    </message>
    <message>
        <source>Maximum object size</source>
        <translation>Größte Objektbreite</translation>
    </message>
    <message>
        <source>Maximum surface height</source>
        <translation>Größte Höhe der Oberfläche</translation>
    </message>
    <message>
        <source>Maximum terrain angle</source>
        <translation>Größte Geländeneigung</translation>
    </message>
    <message>
        <source>Mean growth where canopy stays, m</source>
        <translation>Mittlerer Zuwachs, wo Kronen bleiben, m</translation>
    </message>
    <message>
        <source>Measures densities, voids and strips, and compares them with a specification.</source>
        <translation>Misst Dichten, Lücken und Flugstreifen und vergleicht sie mit einer Spezifikation.</translation>
    </message>
    <message>
        <source>Meets the accuracy class (1 or 0)</source>
        <translation>Erfüllt die Genauigkeitsklasse (1 oder 0)</translation>
    </message>
    <message>
        <source>Meets the specification (1 or 0)</source>
        <translation>Erfüllt die Spezifikation (1 oder 0)</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Arbeitsspeicher</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>Metre</source>
        <translation>Meter</translation>
    </message>
    <message>
        <source>Metres</source>
        <translation>Meter</translation>
    </message>
    <message>
        <source>Minimum number of neighbours</source>
        <translation>Mindestzahl der Nachbarn</translation>
    </message>
    <message>
        <source>Model key point</source>
        <translation>Modell-Schlüsselpunkt</translation>
    </message>
    <message>
        <source>Models</source>
        <translation>Modelle</translation>
    </message>
    <message>
        <source>Most places</source>
        <translation>Höchste Zahl der Stellen</translation>
    </message>
    <message>
        <source>Multi-scale relief</source>
        <translation>Relief in mehreren Maßstäben</translation>
    </message>
    <message>
        <source>Name of the checkpoints</source>
        <translation>Name der Kontrollpunkte</translation>
    </message>
    <message>
        <source>Negative openness</source>
        <translation>Negative Offenheit</translation>
    </message>
    <message>
        <source>New canopy height (CHM)</source>
        <translation>Neue Kronenhöhe (nDOM)</translation>
    </message>
    <message>
        <source>New survey</source>
        <translation>Neue Befliegung</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>No</source>
        <translation>Nein</translation>
    </message>
    <message>
        <source>No Python interpreter was found beside this QGIS, so pip cannot be run: choose a wheel file instead.</source>
        <translation>Neben diesem QGIS wurde kein Python-Interpreter gefunden, pip lässt sich also nicht ausführen: Wählen Sie stattdessen eine Wheel-Datei.</translation>
    </message>
    <message>
        <source>No ground here</source>
        <translation>Hier kein Boden</translation>
    </message>
    <message>
        <source>No ground near</source>
        <translation>Kein Boden in der Nähe</translation>
    </message>
    <message>
        <source>No places to review</source>
        <translation>Keine Stellen zu prüfen</translation>
    </message>
    <message>
        <source>No specification</source>
        <translation>Keine Spezifikation</translation>
    </message>
    <message>
        <source>No-data value of the rasters</source>
        <translation>NoData-Wert der Raster</translation>
    </message>
    <message>
        <source>Noise distance</source>
        <translation>Rauschabstand</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Keine</translation>
    </message>
    <message>
        <source>None: what is not ground has no further class</source>
        <translation>Keine: was kein Boden ist, hat keine weitere Klasse</translation>
    </message>
    <message>
        <source>Not counted</source>
        <translation>Nicht gezählt</translation>
    </message>
    <message>
        <source>Not ground</source>
        <translation>Kein Boden</translation>
    </message>
    <message>
        <source>Not ground (N)</source>
        <translation>Kein Boden (N)</translation>
    </message>
    <message>
        <source>Not ground, except with a classic preset</source>
        <translation>Kein Boden, außer mit einer klassischen Voreinstellung</translation>
    </message>
    <message>
        <source>Not installed yet: .laz and .copc.laz files cannot be read or written.</source>
        <translation>Noch nicht installiert: Dateien .laz und .copc.laz lassen sich weder lesen noch schreiben.</translation>
    </message>
    <message>
        <source>Number of strips</source>
        <translation>Anzahl der Flugstreifen</translation>
    </message>
    <message>
        <source>Old canopy height (CHM)</source>
        <translation>Alte Kronenhöhe (nDOM)</translation>
    </message>
    <message>
        <source>Old survey</source>
        <translation>Alte Befliegung</translation>
    </message>
    <message>
        <source>One light</source>
        <translation>Ein Licht</translation>
    </message>
    <message>
        <source>One raster for each file</source>
        <translation>Ein Raster je Datei</translation>
    </message>
    <message>
        <source>Only key points</source>
        <translation>Nur Schlüsselpunkte</translation>
    </message>
    <message>
        <source>Overhead structure</source>
        <translation>Überspannende Struktur</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>Überlappung</translation>
    </message>
    <message>
        <source>Overlap of strips</source>
        <translation>Überlappung der Flugstreifen</translation>
    </message>
    <message>
        <source>Own choice of outputs</source>
        <translation>Eigene Auswahl der Ausgaben</translation>
    </message>
    <message>
        <source>Page</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>Page about the quality</source>
        <translation>Seite über die Qualität</translation>
    </message>
    <message>
        <source>Page of the delivery</source>
        <translation>Seite der Lieferung</translation>
    </message>
    <message>
        <source>Parts of rivers</source>
        <translation>Flussabschnitte</translation>
    </message>
    <message>
        <source>Place {}</source>
        <translation>Stelle {}</translation>
    </message>
    <message>
        <source>Place {} of {}</source>
        <translation>Stelle {} von {}</translation>
    </message>
    <message>
        <source>Places</source>
        <translation>Stellen</translation>
    </message>
    <message>
        <source>Places of change</source>
        <translation>Orte der Veränderung</translation>
    </message>
    <message>
        <source>Places to review</source>
        <translation>Stellen zum Prüfen</translation>
    </message>
    <message>
        <source>Point cloud</source>
        <translation>Punktwolke</translation>
    </message>
    <message>
        <source>Point cloud to terrain</source>
        <translation>Von der Punktwolke zum Gelände</translation>
    </message>
    <message>
        <source>Point cloud to terrain…</source>
        <translation>Punktwolke zu Gelände …</translation>
    </message>
    <message>
        <source>Point cloud with all classes</source>
        <translation>Punktwolke mit allen Klassen</translation>
    </message>
    <message>
        <source>Point cloud with heights</source>
        <translation>Punktwolke mit Höhen</translation>
    </message>
    <message>
        <source>Point cloud with key points</source>
        <translation>Punktwolke mit Schlüsselpunkten</translation>
    </message>
    <message>
        <source>Point cloud with water</source>
        <translation>Punktwolke mit Wasser</translation>
    </message>
    <message>
        <source>Point clouds</source>
        <translation>Punktwolken</translation>
    </message>
    <message>
        <source>Point clouds (*.las *.laz *.vpc)</source>
        <translation>Punktwolken (*.las *.laz *.vpc)</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Points 0.2 to 2 m above the ground</source>
        <translation>Punkte 0,2 bis 2 m über dem Boden</translation>
    </message>
    <message>
        <source>Points are being read: it is not known yet how far this place would rise as ground. Press G again to answer without that.</source>
        <translation>Die Punkte werden gelesen: Noch ist nicht bekannt, wie weit diese Stelle als Boden höher würde. Drücken Sie noch einmal G, um ohne das zu antworten.</translation>
    </message>
    <message>
        <source>Points in the area</source>
        <translation>Punkte im Gebiet</translation>
    </message>
    <message>
        <source>Points of overlap</source>
        <translation>Punkte der Überlappung</translation>
    </message>
    <message>
        <source>Points of the surface</source>
        <translation>Punkte der Oberfläche</translation>
    </message>
    <message>
        <source>Points that became ignored ground</source>
        <translation>Punkte, die ignorierter Boden wurden</translation>
    </message>
    <message>
        <source>Points that became water</source>
        <translation>Punkte, die Wasser wurden</translation>
    </message>
    <message>
        <source>Points that took part</source>
        <translation>Punkte, die teilnahmen</translation>
    </message>
    <message>
        <source>Points with a new class</source>
        <translation>Punkte mit neuer Klasse</translation>
    </message>
    <message>
        <source>Positive openness</source>
        <translation>Positive Offenheit</translation>
    </message>
    <message>
        <source>Preset</source>
        <translation>Voreinstellung</translation>
    </message>
    <message>
        <source>Previous</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Probably no earth</source>
        <translation>Wahrscheinlich kein Boden</translation>
    </message>
    <message>
        <source>Products</source>
        <translation>Produkte</translation>
    </message>
    <message>
        <source>Put high outliers into class 18</source>
        <translation>Hohe Ausreißer in Klasse 18</translation>
    </message>
    <message>
        <source>Put low outliers into class 7</source>
        <translation>Tiefe Ausreißer in Klasse 7</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualität</translation>
    </message>
    <message>
        <source>Quality of a survey</source>
        <translation>Qualität einer Befliegung</translation>
    </message>
    <message>
        <source>RMSE of held-out points [m]</source>
        <translation>RMSE weggelassener Punkte [m]</translation>
    </message>
    <message>
        <source>RMSE with vegetation [m]</source>
        <translation>RMSE mit Vegetation [m]</translation>
    </message>
    <message>
        <source>RMSE without vegetation [m]</source>
        <translation>RMSE ohne Vegetation [m]</translation>
    </message>
    <message>
        <source>Radius of the relief</source>
        <translation>Radius des Reliefs</translation>
    </message>
    <message>
        <source>Raster with the grid to use</source>
        <translation>Raster, dessen Gitter gilt</translation>
    </message>
    <message>
        <source>Reading the points…</source>
        <translation>Die Punkte werden gelesen …</translation>
    </message>
    <message>
        <source>Ready. Point clouds in .laz need one more package.</source>
        <translation>Bereit. Für Punktwolken in .laz fehlt noch ein Paket.</translation>
    </message>
    <message>
        <source>Ready. The package lazrs is in {}</source>
        <translation>Bereit. Das Paket lazrs ist in {}</translation>
    </message>
    <message>
        <source>Ready. This QGIS has the package lazrs.</source>
        <translation>Bereit. Dieses QGIS hat das Paket lazrs.</translation>
    </message>
    <message>
        <source>Red relief</source>
        <translation>Rotes Relief</translation>
    </message>
    <message>
        <source>Red relief image map</source>
        <translation>Rotes Reliefbild</translation>
    </message>
    <message>
        <source>Reduce iteration angle when edges are shorter than</source>
        <translation>Iterationswinkel verkleinern, wenn Kanten kürzer sind als</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>Reference points only</source>
        <translation>Nur Punkte der Referenz</translation>
    </message>
    <message>
        <source>Relief of a terrain model</source>
        <translation>Relief eines Geländemodells</translation>
    </message>
    <message>
        <source>Remember the classes</source>
        <translation>Klassen merken</translation>
    </message>
    <message>
        <source>Remote point cloud</source>
        <translation>Entfernte Punktwolke</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Remove downloaded point clouds</source>
        <translation>Heruntergeladene Punktwolken entfernen</translation>
    </message>
    <message>
        <source>Remove off-terrain objects</source>
        <translation>Objekte über dem Gelände entfernen</translation>
    </message>
    <message>
        <source>Removed.</source>
        <translation>Entfernt.</translation>
    </message>
    <message>
        <source>Removed. Files that are in use are removed when QGIS starts next.</source>
        <translation>Entfernt. Dateien, die in Benutzung sind, werden beim nächsten Start von QGIS entfernt.</translation>
    </message>
    <message>
        <source>Removes buildings, trees and other steep-sided objects from an elevation raster.</source>
        <translation>Entfernt Gebäude, Bäume und andere Objekte mit steilen Seiten aus einem Höhenraster.</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Resolution</source>
        <translation>Auflösung</translation>
    </message>
    <message>
        <source>Returns</source>
        <translation>Echos</translation>
    </message>
    <message>
        <source>Returns of the surface model</source>
        <translation>Echos des Oberflächenmodells</translation>
    </message>
    <message>
        <source>Review</source>
        <translation>Durchsicht</translation>
    </message>
    <message>
        <source>Right as it is</source>
        <translation>Richtig so</translation>
    </message>
    <message>
        <source>Right as it is (R)</source>
        <translation>Richtig so (R)</translation>
    </message>
    <message>
        <source>Risen</source>
        <translation>Höher</translation>
    </message>
    <message>
        <source>Rivers</source>
        <translation>Flüsse</translation>
    </message>
    <message>
        <source>Run a tool with the expected error of the terrain, then Places to review; or choose a layer of places.</source>
        <translation>Starten Sie ein Werkzeug mit dem erwarteten Fehler des Geländes, dann „Zu prüfende Stellen“; oder wählen Sie einen Layer mit Stellen.</translation>
    </message>
    <message>
        <source>Search radius</source>
        <translation>Suchradius</translation>
    </message>
    <message>
        <source>Set to 1 (unclassified)</source>
        <translation>Auf 1 setzen (nicht klassifiziert)</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>Share of ground points to hold out</source>
        <translation>Anteil wegzulassender Bodenpunkte</translation>
    </message>
    <message>
        <source>Share of low confidence areas</source>
        <translation>Anteil der Flächen mit geringer Verlässlichkeit</translation>
    </message>
    <message>
        <source>Share of wrong points</source>
        <translation>Anteil falscher Punkte</translation>
    </message>
    <message>
        <source>Shift and tilt</source>
        <translation>Versatz und Neigung</translation>
    </message>
    <message>
        <source>Shift only</source>
        <translation>Nur Versatz</translation>
    </message>
    <message>
        <source>Shift that would remove the mean difference [m]</source>
        <translation>Verschiebung, die die mittlere Abweichung aufheben würde [m]</translation>
    </message>
    <message>
        <source>Shortest closed contour line</source>
        <translation>Kürzeste geschlossene Höhenlinie</translation>
    </message>
    <message>
        <source>Shows mounds, walls, ditches and old paths: sky view, openness, local relief, VAT.</source>
        <translation>Zeigt Hügel, Mauern, Gräben und alte Wege: sichtbarer Himmel, Offenheit, lokales Relief, VAT.</translation>
    </message>
    <message>
        <source>Skip (S)</source>
        <translation>Überspringen (S)</translation>
    </message>
    <message>
        <source>Skip missing tiles</source>
        <translation>Fehlende Kacheln auslassen</translation>
    </message>
    <message>
        <source>Skipped</source>
        <translation>Übersprungen</translation>
    </message>
    <message>
        <source>Sky-view factor</source>
        <translation>Himmelssichtfaktor</translation>
    </message>
    <message>
        <source>Slope</source>
        <translation>Neigung</translation>
    </message>
    <message>
        <source>Slope filter</source>
        <translation>Neigungsfilter</translation>
    </message>
    <message>
        <source>Slope filter, Automatic (many scales, follows the terrain)</source>
        <translation>Neigungsfilter, Automatisch (viele Maßstäbe, folgt dem Gelände)</translation>
    </message>
    <message>
        <source>Slope filter, City, large halls</source>
        <translation>Neigungsfilter, Großstadt, große Hallen</translation>
    </message>
    <message>
        <source>Slope filter, Drone survey, construction or mining site</source>
        <translation>Neigungsfilter, Drohnenvermessung, Baustelle oder Abbau</translation>
    </message>
    <message>
        <source>Slope filter, Flat land, fields</source>
        <translation>Neigungsfilter, Flachland, Felder</translation>
    </message>
    <message>
        <source>Slope filter, Hilly land, forest</source>
        <translation>Neigungsfilter, Hügelland, Wald</translation>
    </message>
    <message>
        <source>Slope filter, Steep or rugged terrain</source>
        <translation>Neigungsfilter, Steiles oder raues Gelände</translation>
    </message>
    <message>
        <source>Slope filter, Town</source>
        <translation>Neigungsfilter, Stadt</translation>
    </message>
    <message>
        <source>Slope filter, Whitebox (one scale, 2 m, 45 deg, 1 m)</source>
        <translation>Neigungsfilter, Whitebox (ein Maßstab, 2 m, 45 Grad, 1 m)</translation>
    </message>
    <message>
        <source>Slope normalisation</source>
        <translation>Neigungsausgleich</translation>
    </message>
    <message>
        <source>Slope threshold</source>
        <translation>Neigungsschwelle</translation>
    </message>
    <message>
        <source>Smallest area</source>
        <translation>Kleinste Fläche</translation>
    </message>
    <message>
        <source>Smallest water</source>
        <translation>Kleinstes Gewässer</translation>
    </message>
    <message>
        <source>Smallest width of a river</source>
        <translation>Kleinste Breite eines Flusses</translation>
    </message>
    <message>
        <source>Smoothing of pictures of the relief</source>
        <translation>Glättung der Bilder des Reliefs</translation>
    </message>
    <message>
        <source>Smoothing of the contour lines</source>
        <translation>Glättung der Höhenlinien</translation>
    </message>
    <message>
        <source>Snow</source>
        <translation>Schnee</translation>
    </message>
    <message>
        <source>Specification</source>
        <translation>Spezifikation</translation>
    </message>
    <message>
        <source>Steep or rugged terrain</source>
        <translation>Steiles oder raues Gelände</translation>
    </message>
    <message>
        <source>Stop triangulation when edges are shorter than</source>
        <translation>Vermaschung beenden, wenn Kanten kürzer sind als</translation>
    </message>
    <message>
        <source>Submerged object</source>
        <translation>Objekt unter Wasser</translation>
    </message>
    <message>
        <source>Sunk</source>
        <translation>Tiefer</translation>
    </message>
    <message>
        <source>Surface model</source>
        <translation>Oberflächenmodell</translation>
    </message>
    <message>
        <source>Surface model (DSM)</source>
        <translation>Oberflächenmodell (DOM)</translation>
    </message>
    <message>
        <source>Survey</source>
        <translation>Vermessung</translation>
    </message>
    <message>
        <source>TIN densification</source>
        <translation>TIN-Verdichtung</translation>
    </message>
    <message>
        <source>TIN densification, Automatic</source>
        <translation>TIN-Verdichtung, Automatisch</translation>
    </message>
    <message>
        <source>TIN densification, City, large halls</source>
        <translation>TIN-Verdichtung, Großstadt, große Hallen</translation>
    </message>
    <message>
        <source>TIN densification, Drone survey, construction or mining site</source>
        <translation>TIN-Verdichtung, Drohnenvermessung, Baustelle oder Abbau</translation>
    </message>
    <message>
        <source>TIN densification, Flat land, fields</source>
        <translation>TIN-Verdichtung, Flachland, Felder</translation>
    </message>
    <message>
        <source>TIN densification, Hilly land, forest</source>
        <translation>TIN-Verdichtung, Hügelland, Wald</translation>
    </message>
    <message>
        <source>TIN densification, LiDAR360's values</source>
        <translation>TIN-Verdichtung, Werte von LiDAR360</translation>
    </message>
    <message>
        <source>TIN densification, Steep or rugged terrain</source>
        <translation>TIN-Verdichtung, Steiles oder raues Gelände</translation>
    </message>
    <message>
        <source>TIN densification, Town</source>
        <translation>TIN-Verdichtung, Stadt</translation>
    </message>
    <message>
        <source>Tables</source>
        <translation>Tabellen</translation>
    </message>
    <message>
        <source>Take off the horizontal shift</source>
        <translation>Waagerechten Versatz abziehen</translation>
    </message>
    <message>
        <source>Take part as others do</source>
        <translation>Teilnehmen wie die übrigen</translation>
    </message>
    <message>
        <source>Temporal exclusion</source>
        <translation>Zeitlich ausgeschlossen</translation>
    </message>
    <message>
        <source>Terrain model</source>
        <translation>Geländemodell</translation>
    </message>
    <message>
        <source>Terrain model (DTM)</source>
        <translation>Geländemodell (DGM)</translation>
    </message>
    <message>
        <source>Terrain model of the run before</source>
        <translation>Geländemodell des vorigen Laufs</translation>
    </message>
    <message>
        <source>Terrain with buildings</source>
        <translation>Gelände mit Gebäuden</translation>
    </message>
    <message>
        <source>Terrain, hillshade and contours</source>
        <translation>Gelände, Schummerung und Höhenlinien</translation>
    </message>
    <message>
        <source>Terrain, surface and canopy height models</source>
        <translation>Gelände-, Oberflächen- und Kronenhöhenmodelle</translation>
    </message>
    <message>
        <source>The Python of this QGIS has no pip. In Debian and Ubuntu run sudo apt-get install python3-pip, elsewhere install pip for it, and try again; or choose a wheel file.</source>
        <translation>Dem Python dieses QGIS fehlt pip. Führen Sie unter Debian und Ubuntu sudo apt-get install python3-pip aus, sonst installieren Sie pip dafür, und versuchen Sie es erneut; oder wählen Sie eine Wheel-Datei.</translation>
    </message>
    <message>
        <source>The corrections have no attribute {}. Choose the one to use.</source>
        <translation>Die Korrekturen haben kein Attribut {}. Wählen Sie, welches gelten soll.</translation>
    </message>
    <message>
        <source>The elevation raster is not a file. Export it as GeoTIFF first.</source>
        <translation>Das Höhenraster ist keine Datei. Exportieren Sie es zuerst als GeoTIFF.</translation>
    </message>
    <message>
        <source>The expected error is not a file. Export it as GeoTIFF first.</source>
        <translation>Der erwartete Fehler ist keine Datei. Exportieren Sie ihn zuerst als GeoTIFF.</translation>
    </message>
    <message>
        <source>The key-point flag of LAS; the class stays</source>
        <translation>Das Kennzeichen der Schlüsselpunkte in LAS; die Klasse bleibt</translation>
    </message>
    <message>
        <source>The layer "{}" cannot be read.</source>
        <translation>Der Layer „{}“ lässt sich nicht lesen.</translation>
    </message>
    <message>
        <source>The layer "{}" holds no line. Choose one that does.</source>
        <translation>Der Layer „{}“ enthält keine Linie. Wählen Sie einen, der eine enthält.</translation>
    </message>
    <message>
        <source>The layer "{}" holds no point. Choose one that does.</source>
        <translation>Der Layer „{}“ enthält keinen Punkt. Wählen Sie einen, der einen enthält.</translation>
    </message>
    <message>
        <source>The layer "{}" holds no polygon. Choose one that does.</source>
        <translation>Der Layer „{}“ enthält kein Polygon. Wählen Sie einen, der eines enthält.</translation>
    </message>
    <message>
        <source>The layer "{}" is being edited. Save or discard the edits first.</source>
        <translation>Der Layer „{}“ wird gerade bearbeitet. Speichern oder verwerfen Sie zuerst die Änderungen.</translation>
    </message>
    <message>
        <source>The paper's values</source>
        <translation>Werte der Veröffentlichung</translation>
    </message>
    <message>
        <source>The place stays for another time.</source>
        <translation>Die Stelle bleibt für ein anderes Mal.</translation>
    </message>
    <message>
        <source>The raster with the grid to use is not a file. Export it as GeoTIFF first.</source>
        <translation>Das Raster, dessen Gitter gilt, ist keine Datei. Exportieren Sie es zuerst als GeoTIFF.</translation>
    </message>
    <message>
        <source>The removed lazrs is still in use: restart QGIS and try again.</source>
        <translation>Das entfernte lazrs ist noch in Benutzung: Starten Sie QGIS neu, und versuchen Sie es noch einmal.</translation>
    </message>
    <message>
        <source>The same without QGIS:</source>
        <translation>Dasselbe ohne QGIS:</translation>
    </message>
    <message>
        <source>The terrain changed on {} m², by {} m on average and {} at most.</source>
        <translation>Das Gelände hat sich auf {} m² geändert, im Mittel um {} m, höchstens um {}.</translation>
    </message>
    <message>
        <source>The terrain has not changed.</source>
        <translation>Das Gelände hat sich nicht geändert.</translation>
    </message>
    <message>
        <source>The terrain model is not a file. Export it as GeoTIFF first.</source>
        <translation>Das Geländemodell ist keine Datei. Exportieren Sie es zuerst als GeoTIFF.</translation>
    </message>
    <message>
        <source>The usual one of the delivery</source>
        <translation>Die übliche der Lieferung</translation>
    </message>
    <message>
        <source>This QGIS cannot load the installed lazrs: {}.</source>
        <translation>Dieses QGIS kann das installierte lazrs nicht laden: {}.</translation>
    </message>
    <message>
        <source>This QGIS has no scipy. On Windows, install python3-scipy with the OSGeo4W setup. Elsewhere, install the scipy of the system, or a newer QGIS.</source>
        <translation>Dieses QGIS hat kein scipy. Installieren Sie unter Windows python3-scipy mit dem Setup von OSGeo4W. Sonst installieren Sie das scipy des Systems oder ein neueres QGIS.</translation>
    </message>
    <message>
        <source>Threads</source>
        <translation>Threads</translation>
    </message>
    <message>
        <source>Tiles</source>
        <translation>Kacheln</translation>
    </message>
    <message>
        <source>Tiles kept</source>
        <translation>Behaltene Kacheln</translation>
    </message>
    <message>
        <source>To review</source>
        <translation>Zu prüfen</translation>
    </message>
    <message>
        <source>Tolerance above</source>
        <translation>Toleranz nach oben</translation>
    </message>
    <message>
        <source>Tolerance below</source>
        <translation>Toleranz nach unten</translation>
    </message>
    <message>
        <source>Total error [%]</source>
        <translation>Gesamtfehler [%]</translation>
    </message>
    <message>
        <source>Town</source>
        <translation>Stadt</translation>
    </message>
    <message>
        <source>Transform Web Mercator to UTM</source>
        <translation>Web-Mercator nach UTM umrechnen</translation>
    </message>
    <message>
        <source>Tries methods and presets on a part of a point cloud, and shows them side by side.</source>
        <translation>Probiert Verfahren und Voreinstellungen an einem Teil einer Punktwolke und zeigt sie nebeneinander.</translation>
    </message>
    <message>
        <source>Two methods compared</source>
        <translation>Zwei Verfahren im Vergleich</translation>
    </message>
    <message>
        <source>Type I error [%]</source>
        <translation>Fehler 1. Art [%]</translation>
    </message>
    <message>
        <source>Type II error [%]</source>
        <translation>Fehler 2. Art [%]</translation>
    </message>
    <message>
        <source>US survey foot</source>
        <translation>US-Vermessungsfuß</translation>
    </message>
    <message>
        <source>USGS Lidar Base Specification, QL1</source>
        <translation>USGS Lidar Base Specification, QL1</translation>
    </message>
    <message>
        <source>USGS Lidar Base Specification, QL2</source>
        <translation>USGS Lidar Base Specification, QL2</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Unit of the cell size</source>
        <translation>Einheit der Zellgröße</translation>
    </message>
    <message>
        <source>Unit of the heights</source>
        <translation>Einheit der Höhen</translation>
    </message>
    <message>
        <source>Units of the CRS, such as its feet</source>
        <translation>Einheiten des KBS, zum Beispiel Fuß</translation>
    </message>
    <message>
        <source>Use as others</source>
        <translation>Wie die übrigen benutzen</translation>
    </message>
    <message>
        <source>Vegetated land covers</source>
        <translation>Bewachsene Bodenbedeckungen</translation>
    </message>
    <message>
        <source>Vegetation by limits of your own</source>
        <translation>Vegetation nach eigenen Grenzen</translation>
    </message>
    <message>
        <source>Vegetation low below 0.5 m, medium to 1.5 m, high above (IGN)</source>
        <translation>Vegetation niedrig unter 0,5 m, mittel bis 1,5 m, darüber hoch (IGN)</translation>
    </message>
    <message>
        <source>Vegetation low below 0.5 m, medium to 2 m, high above</source>
        <translation>Vegetation niedrig unter 0,5 m, mittel bis 2 m, darüber hoch</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Vertical shift taken off, m</source>
        <translation>Abgezogener Höhenversatz, m</translation>
    </message>
    <message>
        <source>Virtual point cloud</source>
        <translation>Virtuelle Punktwolke</translation>
    </message>
    <message>
        <source>Voids of the ground</source>
        <translation>Lücken des Bodens</translation>
    </message>
    <message>
        <source>Volume down, m3</source>
        <translation>Volumen nach unten, m3</translation>
    </message>
    <message>
        <source>Volume up, m3</source>
        <translation>Volumen nach oben, m3</translation>
    </message>
    <message>
        <source>Water</source>
        <translation>Gewässer</translation>
    </message>
    <message>
        <source>Water column</source>
        <translation>Wassersäule</translation>
    </message>
    <message>
        <source>Water surface</source>
        <translation>Wasseroberfläche</translation>
    </message>
    <message>
        <source>What changed is not known: one of the two runs has no terrain model.</source>
        <translation>Was sich geändert hat, ist nicht bekannt: Einer der beiden Läufe hat kein Geländemodell.</translation>
    </message>
    <message>
        <source>What changed is not known: the new terrain model has other cells.</source>
        <translation>Was sich geändert hat, ist nicht bekannt: Das neue Geländemodell hat andere Zellen.</translation>
    </message>
    <message>
        <source>Wheel file of lazrs</source>
        <translation>Wheel-Datei von lazrs</translation>
    </message>
    <message>
        <source>Wheel files (*.whl)</source>
        <translation>Wheel-Dateien (*.whl)</translation>
    </message>
    <message>
        <source>Where they differ</source>
        <translation>Wo sie sich unterscheiden</translation>
    </message>
    <message>
        <source>Whitebox (one scale, 2 m, 45 deg, 1 m)</source>
        <translation>Whitebox (ein Maßstab, 2 m, 45 Grad, 1 m)</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>Fenster</translation>
    </message>
    <message>
        <source>Without objects</source>
        <translation>Ohne Objekte</translation>
    </message>
    <message>
        <source>Working…</source>
        <translation>In Arbeit…</translation>
    </message>
    <message>
        <source>Write ground points only</source>
        <translation>Nur Bodenpunkte schreiben</translation>
    </message>
    <message>
        <source>Write points of the area only</source>
        <translation>Nur Punkte des Gebiets schreiben</translation>
    </message>
    <message>
        <source>Write the heights as</source>
        <translation>Höhen schreiben als</translation>
    </message>
    <message>
        <source>Writes the points of an area as they are, and nothing else.</source>
        <translation>Schreibt die Punkte eines Gebiets unverändert, und sonst nichts.</translation>
    </message>
    <message>
        <source>Yes</source>
        <translation>Ja</translation>
    </message>
    <message>
        <source>Z, in place of the elevation</source>
        <translation>Z, an Stelle der Höhe</translation>
    </message>
    <message>
        <source>a gap of {width} without ground</source>
        <translation>eine Lücke von {width} ohne Boden</translation>
    </message>
    <message>
        <source>a gap of {width} without ground, beside a step or a slope</source>
        <translation>eine Lücke von {width} ohne Boden, neben einer Stufe oder einem Hang</translation>
    </message>
    <message>
        <source>a large expected error</source>
        <translation>ein großer erwarteter Fehler</translation>
    </message>
    <message>
        <source>bare earth,surface,buildings,trees,vegetation,off-terrain objects,oto,whitebox,lindsay,top-hat</source>
        <translation>Boden,Oberfläche,Gebäude,Bäume,Vegetation,Objekte,oto,whitebox,lindsay,top-hat</translation>
    </message>
    <message>
        <source>beside water or the border of the survey</source>
        <translation>neben Wasser oder am Rand der Befliegung</translation>
    </message>
    <message>
        <source>buildings,roofs,trees,classes,classification,bridges,noise,lasclassify,asprs,ign</source>
        <translation>Gebäude,Dächer,Bäume,Klassen,Klassifikation,Brücken,Rauschen,lasclassify,asprs,ign</translation>
    </message>
    <message>
        <source>canopy</source>
        <translation>Kronenhöhe</translation>
    </message>
    <message>
        <source>canopy change</source>
        <translation>Veränderung der Kronen</translation>
    </message>
    <message>
        <source>change</source>
        <translation>Veränderung</translation>
    </message>
    <message>
        <source>change,difference,dod,volume,erosion,landslide,detection,m3c2</source>
        <translation>Veränderung,Differenz,DoD,Volumen,Erosion,Rutschung,Erdrutsch,Nachweis,M3C2</translation>
    </message>
    <message>
        <source>change,difference,forest,growth,loss,logging,windthrow,gaps,cover</source>
        <translation>Veränderung,Differenz,Wald,Zuwachs,Verlust,Holzernte,Windwurf,Lücken,Deckung</translation>
    </message>
    <message>
        <source>checkpoints,check points,control points,gcp,accuracy,quality,rmse,rmsez,vertical accuracy,nva,vva,asprs,validation,lascontrol,hold-out</source>
        <translation>kontrollpunkte,passpunkte,prüfpunkte,gcp,genauigkeit,qualität,rmse,rmsez,höhengenauigkeit,nva,vva,asprs,validierung,lascontrol</translation>
    </message>
    <message>
        <source>chm,ndsm,canopy,vegetation,vegetation height,normalize,normalise,hag,lasheight</source>
        <translation>chm,ndom,Kronenhöhe,Kronenhöhenmodell,Vegetation,Vegetationshöhe,normalisieren,Höhe über Grund</translation>
    </message>
    <message>
        <source>classified files</source>
        <translation>klassifizierte Dateien</translation>
    </message>
    <message>
        <source>clip,crop,cut,extent,boundary,polygon,subset,las2las,pdal crop</source>
        <translation>zuschneiden,ausschneiden,clip,Ausdehnung,Grenze,Polygon,Teil,las2las,pdal crop</translation>
    </message>
    <message>
        <source>contours</source>
        <translation>Höhenlinien</translation>
    </message>
    <message>
        <source>contours,isolines,contour map,depression,knoll,dxf,cad,ocad</source>
        <translation>Höhenlinien,Isolinien,Höhenlinienkarte,Senke,Kuppe,dxf,cad,ocad</translation>
    </message>
    <message>
        <source>contours,workflow</source>
        <translation>Höhenlinien,Isolinien,Arbeitsablauf</translation>
    </message>
    <message>
        <source>degrees</source>
        <translation>Grad</translation>
    </message>
    <message>
        <source>deliverables,archaeology,forestry,flood,drone,stockpile</source>
        <translation>Lieferung,Archäologie,Forst,Hochwasser,Drohne,Halde</translation>
    </message>
    <message>
        <source>download,remote,url,web,http,clip,cloud storage,reproject,utm</source>
        <translation>herunterladen,entfernt,url,web,http,ausschneiden,cloud-speicher,umprojizieren,utm</translation>
    </message>
    <message>
        <source>dsm,dtm,canopy height model,difference,subtract,raster calculator</source>
        <translation>dom,dgm,ndom,Kronenhöhenmodell,Differenz,Rasterrechner</translation>
    </message>
    <message>
        <source>grid,raster,rasterize,interpolate</source>
        <translation>Raster,Gitter,rastern,interpolieren</translation>
    </message>
    <message>
        <source>ground,accuracy,quality,error,validation,kappa,confusion matrix,reference</source>
        <translation>Boden,Genauigkeit,Qualität,Fehler,Validierung,Kappa,Konfusionsmatrix,Referenz</translation>
    </message>
    <message>
        <source>ground,bare earth,ground filter,ground classification,classify ground,extract ground,ground points,noise,outliers,vegetation removal,smrf,pmf,csf,mcc,lasground,classifyground</source>
        <translation>Boden,Bodenpunkte,Bodenfilter,Bodenklassifikation,Klassifikation,Klassifizierung,klassifizieren,Rauschen,Ausreißer,Vegetation entfernen,Filter</translation>
    </message>
    <message>
        <source>ground,thin,thinning,generalize,keypoints,contours</source>
        <translation>Boden,ausdünnen,Ausdünnung,Generalisierung,Schlüsselpunkte,Höhenlinien</translation>
    </message>
    <message>
        <source>hardly any ground under plants or on roofs</source>
        <translation>kaum Boden unter Pflanzen oder auf Dächern</translation>
    </message>
    <message>
        <source>height,extra bytes</source>
        <translation>Höhe,Zusatzdimension</translation>
    </message>
    <message>
        <source>heights times {}</source>
        <translation>Höhen mal {}</translation>
    </message>
    <message>
        <source>key points</source>
        <translation>Schlüsselpunkte</translation>
    </message>
    <message>
        <source>lake,river,pond,shore,breaklines,hydro-flattening,class 9,class 20,ignored ground,usgs,lbs,classes,classification</source>
        <translation>See,Fluss,Teich,Ufer,Bruchkanten,Gewässer,Wasser,Klasse 9,Klasse 20,ignorierter Boden,Klassen,Klassifikation</translation>
    </message>
    <message>
        <source>lake,river,pond,shore,shoreline,hydro-flattening,hydroflatten,breaklines</source>
        <translation>See,Fluss,Teich,Ufer,Uferlinie,Gewässer,Bruchkanten</translation>
    </message>
    <message>
        <source>lazrs could not be installed: {}</source>
        <translation>lazrs ließ sich nicht installieren: {}</translation>
    </message>
    <message>
        <source>lazrs could not be stored: {}.</source>
        <translation>lazrs ließ sich nicht speichern: {}.</translation>
    </message>
    <message>
        <source>lidar,laser scanning,als,uav,drone,las,laz,copc,ept,point cloud</source>
        <translation>Lidar,Laserscanning,Airborne Laserscanning,Drohne,las,laz,copc,ept,Punktwolke</translation>
    </message>
    <message>
        <source>low plants: the ground may be up to {error} too high</source>
        <translation>niedrige Pflanzen: Der Boden ist vielleicht bis zu {error} zu hoch</translation>
    </message>
    <message>
        <source>lowest,minimum</source>
        <translation>tiefster,Minimum</translation>
    </message>
    <message>
        <source>m</source>
        <translation>m</translation>
    </message>
    <message>
        <source>m or ft</source>
        <translation>m oder ft</translation>
    </message>
    <message>
        <source>no change</source>
        <translation>keine Änderung</translation>
    </message>
    <message>
        <source>pip cannot work through the SOCKS proxy of QGIS's settings: choose a wheel file.</source>
        <translation>pip kann nicht über den SOCKS-Proxy der QGIS-Einstellungen arbeiten: Wählen Sie eine Wheel-Datei.</translation>
    </message>
    <message>
        <source>pip gave no reason</source>
        <translation>pip nannte keinen Grund</translation>
    </message>
    <message>
        <source>place</source>
        <translation>Stelle</translation>
    </message>
    <message>
        <source>places to review</source>
        <translation>Stellen zum Prüfen</translation>
    </message>
    <message>
        <source>plants or ground: low points were not taken for ground, up to {error} off</source>
        <translation>Pflanzen oder Boden: Tiefe Punkte wurden nicht als Boden genommen, bis zu {error} daneben</translation>
    </message>
    <message>
        <source>points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>preview,try,test,preset,parameters,compare</source>
        <translation>Vorschau,probieren,testen,Voreinstellung,Parameter,vergleichen</translation>
    </message>
    <message>
        <source>ptd,axelsson,densification</source>
        <translation>ptd,axelsson,Verdichtung</translation>
    </message>
    <message>
        <source>quality</source>
        <translation>Qualität</translation>
    </message>
    <message>
        <source>quality,qc,density,pulse density,voids,low confidence,swath,strips,overlap,usgs,lbs,linz,ign,specification,lasoverlap,lasgrid</source>
        <translation>qualität,qc,dichte,punktdichte,lücken,geringe verlässlichkeit,streifen,überlappung,usgs,lbs,linz,ign,spezifikation,lasoverlap,lasgrid</translation>
    </message>
    <message>
        <source>relief</source>
        <translation>Relief</translation>
    </message>
    <message>
        <source>review,error,uncertainty,confidence,quality</source>
        <translation>prüfen,fehler,unsicherheit,konfidenz,qualität</translation>
    </message>
    <message>
        <source>rough ground: a step, rocks or plants that were kept as ground</source>
        <translation>rauer Boden: eine Stufe, Felsen oder Pflanzen, die Boden geblieben sind</translation>
    </message>
    <message>
        <source>sky-view factor,svf,openness,local dominance,local relief model,lrm,vat,red relief,rrim,slope,archaeology,rvt,relief visualization toolbox,visualization</source>
        <translation>Himmelssichtfaktor,Sky-View-Faktor,svf,Offenheit,lokale Dominanz,lokales Reliefmodell,lrm,vat,rotes Relief,rrim,Neigung,Archäologie,rvt,Relief Visualization Toolbox,Visualisierung</translation>
    </message>
    <message>
        <source>slope,vosselman,whitebox,top-hat</source>
        <translation>Neigung,Hangneigung,vosselman,whitebox,top-hat</translation>
    </message>
    <message>
        <source>steep ground</source>
        <translation>steiler Boden</translation>
    </message>
    <message>
        <source>terrain</source>
        <translation>Gelände</translation>
    </message>
    <message>
        <source>terrain and surface</source>
        <translation>Gelände und Oberfläche</translation>
    </message>
    <message>
        <source>terrain from {} to {}</source>
        <translation>Gelände von {} bis {}</translation>
    </message>
    <message>
        <source>terrain,terrain model,elevation model,dtm,dem,dsm,hillshade,relief</source>
        <translation>Gelände,Geländemodell,Höhenmodell,dgm,dhm,dom,dtm,dem,dsm,Schummerung,Relief</translation>
    </message>
    <message>
        <source>the certificate of the package index was not accepted.</source>
        <translation>das Zertifikat des Paketverzeichnisses wurde nicht angenommen.</translation>
    </message>
    <message>
        <source>the disk is full.</source>
        <translation>der Datenträger ist voll.</translation>
    </message>
    <message>
        <source>the package index has none for {}.</source>
        <translation>das Paketverzeichnis hat keines für {}.</translation>
    </message>
    <message>
        <source>the package index was not reached: check the connection, and the proxy in Settings &gt; Options &gt; Network, or choose a wheel file.</source>
        <translation>das Paketverzeichnis war nicht zu erreichen: Prüfen Sie die Verbindung und den Proxy in Einstellungen &gt; Optionen &gt; Netzwerk, oder wählen Sie eine Wheel-Datei.</translation>
    </message>
    <message>
        <source>the proxy wants a name and password: give them in Settings &gt; Options &gt; Network.</source>
        <translation>der Proxy verlangt Namen und Passwort: Geben Sie sie in Einstellungen &gt; Optionen &gt; Netzwerk an.</translation>
    </message>
    <message>
        <source>tin,triangulation</source>
        <translation>tin,Dreiecksvermaschung,Triangulation</translation>
    </message>
    <message>
        <source>vpc,tiles,batch,survey,folder,many files</source>
        <translation>vpc,Kacheln,Stapel,Befliegung,Ordner,viele Dateien</translation>
    </message>
    <message>
        <source>where it may be</source>
        <translation>wo es sein kann</translation>
    </message>
    <message>
        <source>you have no permission to write into the folder of the profile.</source>
        <translation>Sie dürfen nicht in den Ordner des Profils schreiben.</translation>
    </message>
    <message>
        <source>{file} could not be unzipped: {error}.</source>
        <translation>{file} ließ sich nicht entpacken: {error}.</translation>
    </message>
    <message>
        <source>{file} holds {held}; a wheel of {package} is needed.</source>
        <translation>{file} enthält {held}; gebraucht wird ein Wheel von {package}.</translation>
    </message>
    <message>
        <source>{file} holds {member}, which does not belong in a wheel of {package}. Download it again.</source>
        <translation>{file} enthält {member}, das nicht in ein Wheel von {package} gehört. Laden Sie es erneut herunter.</translation>
    </message>
    <message>
        <source>{file} is for another Python or system ({tag}); this QGIS needs one for {needed}.</source>
        <translation>{file} ist für ein anderes Python oder System ({tag}); dieses QGIS braucht eines für {needed}.</translation>
    </message>
    <message>
        <source>{file} is larger than any wheel of {package}.</source>
        <translation>{file} ist größer als jedes Wheel von {package}.</translation>
    </message>
    <message>
        <source>{label} must be a number, not {value}.</source>
        <translation>{label} muss eine Zahl sein, nicht {value}.</translation>
    </message>
    <message>
        <source>{rise} of relief</source>
        <translation>{rise} Höhenunterschied</translation>
    </message>
    <message>
        <source>{} and others</source>
        <translation>{} und andere</translation>
    </message>
    <message>
        <source>{} and {}</source>
        <translation>{} und {}</translation>
    </message>
    <message>
        <source>{} does not exist. Check the path.</source>
        <translation>{} gibt es nicht. Prüfen Sie den Pfad.</translation>
    </message>
    <message>
        <source>{} files (*.{})</source>
        <translation>{}-Dateien (*.{})</translation>
    </message>
    <message>
        <source>{} is damaged: a file differs from its list. Download it again.</source>
        <translation>{} ist beschädigt: Eine Datei weicht von ihrem Verzeichnis ab. Laden Sie es erneut herunter.</translation>
    </message>
    <message>
        <source>{} is no known CRS. Choose one from the list.</source>
        <translation>{} ist kein bekanntes KBS. Wählen Sie eines aus der Liste.</translation>
    </message>
    <message>
        <source>{} is not a file. Export it as GeoTIFF first.</source>
        <translation>{} ist keine Datei. Exportieren Sie das Raster zuerst als GeoTIFF.</translation>
    </message>
    <message>
        <source>{} is not a folder. Check the path.</source>
        <translation>{} ist kein Ordner. Prüfen Sie den Pfad.</translation>
    </message>
    <message>
        <source>{} is not a point cloud. Choose a point cloud layer, or a .las or .laz file.</source>
        <translation>{} ist keine Punktwolke. Wählen Sie einen Punktwolken-Layer oder eine Datei .las oder .laz.</translation>
    </message>
    <message>
        <source>{} is not a raster. Choose a GeoTIFF.</source>
        <translation>{} ist kein Raster. Wählen Sie ein GeoTIFF.</translation>
    </message>
    <message>
        <source>{} is not a wheel, or is damaged. Download it again.</source>
        <translation>{} ist kein Wheel oder beschädigt. Laden Sie es erneut herunter.</translation>
    </message>
    <message>
        <source>{} is not a wheel: choose a file with the ending .whl.</source>
        <translation>{} ist kein Wheel: Wählen Sie eine Datei mit der Endung .whl.</translation>
    </message>
    <message>
        <source>{} is not on this computer. Choose a file.</source>
        <translation>{} liegt nicht auf diesem Rechner. Wählen Sie eine Datei.</translation>
    </message>
    <message>
        <source>{} is not on this computer: give the extent to download.</source>
        <translation>{} ist nicht auf diesem Rechner: Geben Sie die Ausdehnung an, die heruntergeladen werden soll.</translation>
    </message>
    <message>
        <source>{} lists {} point clouds that have points there, and this algorithm reads one. Choose 'Point cloud to terrain', or download them first.</source>
        <translation>{} nennt {} Punktwolken, die dort Punkte haben, und dieser Algorithmus liest nur eine. Wählen Sie „Von der Punktwolke zum Gelände“, oder laden Sie sie zuerst herunter.</translation>
    </message>
    <message>
        <source>{} m² by {} m, at most {} m</source>
        <translation>{} m² um {} m, höchstens {} m</translation>
    </message>
    <message>
        <source>{} of {} answered</source>
        <translation>{} von {} beantwortet</translation>
    </message>
    <message>
        <source>{} points higher or lower</source>
        <translation>{} Punkte höher oder tiefer</translation>
    </message>
    <message>
        <source>{} were removed from {}.</source>
        <translation>{} wurden aus {} entfernt.</translation>
    </message>
</context>
</TS>
