<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>BareEarth</name>
    <message>
        <source>0 to 1</source>
        <translation>0 bis 1</translation>
    </message>
    <message>
        <source>1 to 255</source>
        <translation>1 bis 255</translation>
    </message>
    <message>
        <source>&lt;b&gt;Values of the presets&lt;/b&gt;, where they differ and a field is left empty</source>
        <translation>&lt;b&gt;Werte der Voreinstellungen&lt;/b&gt;, wo sie sich unterscheiden und ein Feld leer bleibt</translation>
    </message>
    <message>
        <source>A class of their own</source>
        <translation>Eine eigene Klasse</translation>
    </message>
    <message>
        <source>A list of the classified files, which QGIS shows as one layer from 3.32 on. Without a name it goes into their folder.</source>
        <translation>Ein Verzeichnis der klassifizierten Dateien, das QGIS ab 3.32 als einen Layer zeigt. Ohne Namen kommt es in deren Ordner.</translation>
    </message>
    <message>
        <source>A point cloud layer, a .las, .laz or .copc.laz file, a virtual point cloud (.vpc), or a text file (.txt) with a path a line. May be empty if a folder is given.</source>
        <translation>Ein Punktwolken-Layer, eine Datei .las, .laz oder .copc.laz, eine virtuelle Punktwolke (.vpc) oder eine Textdatei (.txt) mit einem Pfad je Zeile. Darf leer sein, wenn ein Ordner angegeben ist.</translation>
    </message>
    <message>
        <source>A point cloud layer, or a .las, .laz or .copc.laz file.</source>
        <translation>Ein Punktwolken-Layer oder eine Datei .las, .laz oder .copc.laz.</translation>
    </message>
    <message>
        <source>A point cloud layer, or a .las, .laz or .copc.laz file; also a virtual point cloud (.vpc) or a folder.</source>
        <translation>Ein Punktwolken-Layer oder eine Datei .las, .laz oder .copc.laz; auch eine virtuelle Punktwolke (.vpc) oder ein Ordner.</translation>
    </message>
    <message>
        <source>A point is not ground if it stands above a neighbour at a steeper slope than this; in the automatic preset, steeper by this than the terrain round it. Empty: 15 deg, or 45 deg in the preset Whitebox.</source>
        <translation>Ein Punkt ist kein Boden, wenn er mit einer größeren Neigung als dieser über einem Nachbarn liegt; in der automatischen Voreinstellung um so viel steiler als das Gelände ringsum. Leer: 15 Grad, in der Voreinstellung Whitebox 45 Grad.</translation>
    </message>
    <message>
        <source>A point this close to its triangle is a vertex whatever its angle: near a corner the angle of mere noise is large.</source>
        <translation>Ein Punkt so nahe an seinem Dreieck wird ein Eckpunkt, gleich unter welchem Winkel: Nahe einer Ecke ist schon der Winkel des bloßen Rauschens groß.</translation>
    </message>
    <message>
        <source>A point with fewer neighbours within the search radius is compared with this many nearest ones. For the preset Whitebox only.</source>
        <translation>Ein Punkt, der im Suchradius weniger Nachbarn hat, wird mit so vielen nächsten verglichen. Nur für die Voreinstellung Whitebox.</translation>
    </message>
    <message>
        <source>A raw .las, .laz or .copc.laz file.</source>
        <translation>Eine rohe Datei .las, .laz oder .copc.laz.</translation>
    </message>
    <message>
        <source>A surface model: a raster file with a band of heights.</source>
        <translation>Ein Oberflächenmodell: eine Rasterdatei mit einem Kanal aus Höhen.</translation>
    </message>
    <message>
        <source>A web page with the figures, and a map of where the errors are.</source>
        <translation>Eine Webseite mit den Zahlen und einer Karte, wo die Fehler liegen.</translation>
    </message>
    <message>
        <source>A web page, which the Results Viewer opens.</source>
        <translation>Eine Webseite, die sich aus der Ergebnisanzeige öffnen lässt.</translation>
    </message>
    <message>
        <source>About how much a run may take. A file that needs more is read twice, with its points in a temporary file in the folder of the output meanwhile; of many files, fewer blocks are in work at the same time. The result does not depend on it.</source>
        <translation>Wie viel Speicher ein Lauf etwa belegen darf. Eine Datei, die mehr braucht, wird zweimal gelesen; ihre Punkte liegen inzwischen in einer temporären Datei im Ausgabeordner. Bei vielen Dateien sind weniger Blöcke gleichzeitig in Arbeit. Das Ergebnis hängt nicht davon ab.</translation>
    </message>
    <message>
        <source>Add the height above ground</source>
        <translation>Höhe über Grund hinzufügen</translation>
    </message>
    <message>
        <source>Adds the extra dimension BareEarthClass, the class that this run gives. A later run on the file sees by it which classes were changed by hand since, and keeps them, whatever its settings; it remembers the classes again.</source>
        <translation>Fügt die Zusatzdimension BareEarthClass hinzu, die Klasse, die dieser Lauf vergibt. Ein späterer Lauf mit der Datei sieht daran, welche Klassen seither von Hand geändert wurden, und behält sie, gleich welche Einstellungen er hat; er merkt sich die Klassen wieder.</translation>
    </message>
    <message>
        <source>Adds the extra dimension HeightAboveGround: how high each point stands above the ground, in the vertical unit of the CRS.</source>
        <translation>Fügt die Zusatzdimension HeightAboveGround hinzu: wie hoch jeder Punkt über dem Boden liegt, in der Höheneinheit des KBS.</translation>
    </message>
    <message>
        <source>Adds the height of every point above the ground points of a point cloud.</source>
        <translation>Fügt jedem Punkt einer Punktwolke seine Höhe über den Bodenpunkten hinzu.</translation>
    </message>
    <message>
        <source>All .las, .laz and .copc.laz files in it are taken, too. Many files are one survey, without seams.</source>
        <translation>Alle Dateien .las, .laz und .copc.laz darin werden auch genommen. Viele Dateien sind eine Befliegung, ohne Nähte.</translation>
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
        <source>All returns</source>
        <translation>Alle Echos</translation>
    </message>
    <message>
        <source>An extra dimension keeps all else as it is. In place of the elevation the heights show in programs that know no extra dimensions, and the terrain is flat.</source>
        <translation>Eine Zusatzdimension lässt alles andere, wie es ist. An Stelle der Höhe sind die Werte auch in Programmen zu sehen, die keine Zusatzdimensionen kennen, und das Gelände ist eben.</translation>
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
        <source>Automatic finds buildings as well as shrubs; the kinds of terrain do so with other values for what is left empty. Whitebox is the classic filter with the values of WhiteboxTools: its radius of 2 m cannot see a building.</source>
        <translation>Automatisch findet Gebäude ebenso wie Sträucher; die Geländearten tun das auch, mit anderen Werten für leere Felder. Whitebox ist der klassische Filter mit den Werten der WhiteboxTools: Mit seinem Radius von 2 m erkennt er kein Gebäude.</translation>
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
        <source>COPC, which QGIS shows without an index of its own</source>
        <translation>COPC, das QGIS ohne eigenen Index zeigt</translation>
    </message>
    <message>
        <source>Cancelled.</source>
        <translation>Abgebrochen.</translation>
    </message>
    <message>
        <source>Cancelled; nothing was written.</source>
        <translation>Abgebrochen; es wurde nichts geschrieben.</translation>
    </message>
    <message>
        <source>Cancelled; the tiles that are finished stay, and a later run can go on with them.</source>
        <translation>Abgebrochen; die fertigen Kacheln bleiben, und ein späterer Lauf kann mit ihnen weitermachen.</translation>
    </message>
    <message>
        <source>Canopy height (CHM)</source>
        <translation>Kronenhöhe (nDOM)</translation>
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
        <source>Cells of objects</source>
        <translation>Zellen von Objekten</translation>
    </message>
    <message>
        <source>Cells with a height</source>
        <translation>Zellen mit einer Höhe</translation>
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
        <source>Chooses, of the ground points of a classified point cloud, the few that a terrain model needs: no other ground point lies farther above or below their triangulation (TIN) than the tolerances. They get a class of their own, or the key-point flag; nothing else in the file changes.
Lengths are metres, whatever the unit of the CRS.</source>
        <translation>Wählt aus den Bodenpunkten einer klassifizierten Punktwolke die wenigen, die ein Geländemodell braucht: Kein anderer Bodenpunkt liegt weiter über oder unter ihrer Dreiecksvermaschung (TIN), als die Toleranzen erlauben. Sie bekommen eine eigene Klasse oder das Kennzeichen der Schlüsselpunkte; sonst ändert sich nichts in der Datei.
Längen sind Meter, gleich welche Einheit das KBS hat.</translation>
    </message>
    <message>
        <source>Chosen automatically: {text}</source>
        <translation>Automatisch gewählt: {text}</translation>
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
        <source>Class {number} ({name}): {count:,} points ({share:.1%})</source>
        <translation>Klasse {number} ({name}): {count:,} Punkte ({share:.1%})</translation>
    </message>
    <message>
        <source>Classes of known ground</source>
        <translation>Klassen bekannten Bodens</translation>
    </message>
    <message>
        <source>Classes of the points that are ground. Add 8 where model key points have that class, and 9 where water counts as ground. Withheld points are left out.</source>
        <translation>Klassen der Punkte, die Boden sind. Fügen Sie 8 hinzu, wo Schlüsselpunkte diese Klasse haben, und 9, wo Wasser als Boden gilt. Zurückgehaltene Punkte (withheld) bleiben weg.</translation>
    </message>
    <message>
        <source>Classes of the reference that are ground; add 9 where water counts as ground.</source>
        <translation>Klassen der Referenz, die Boden sind; fügen Sie 9 hinzu, wo Wasser als Boden gilt.</translation>
    </message>
    <message>
        <source>Classes to classify anew</source>
        <translation>Neu zu klassifizierende Klassen</translation>
    </message>
    <message>
        <source>Classified point cloud</source>
        <translation>Klassifizierte Punktwolke</translation>
    </message>
    <message>
        <source>Classified tiles</source>
        <translation>Klassifizierte Kacheln</translation>
    </message>
    <message>
        <source>Classifies the ground points of many files, each as if all were one, and writes each anew under its name. A virtual point cloud (.vpc) lists the results.</source>
        <translation>Klassifiziert die Bodenpunkte vieler Dateien, jede so, als wären alle eine einzige, und schreibt jede unter ihrem Namen neu. Eine virtuelle Punktwolke (.vpc) verzeichnet die Ergebnisse.</translation>
    </message>
    <message>
        <source>Classifies the points in a window with each of the settings, without writing any point cloud, and makes a web page, opened from the Results Viewer: the terrain of each, a profile, the share of ground, where they differ, and how to run each on all points. Of COPC only the window is read, which takes seconds; a LAS or LAZ file is read as a whole.</source>
        <translation>Klassifiziert die Punkte eines Fensters mit jeder der Einstellungen, ohne eine Punktwolke zu schreiben, und macht eine Webseite, die sich aus der Ergebnisanzeige öffnen lässt: das Gelände zu jeder Einstellung, ein Profil, der Anteil des Bodens, wo sie sich unterscheiden, und wie man jede auf alle Punkte anwendet. Von COPC wird nur das Fenster gelesen, in Sekunden; eine LAS- oder LAZ-Datei wird ganz gelesen.</translation>
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
        <source>Compare heights above a surface that follows the terrain (white top-hat) instead of heights, so that sloping ground is not lost.</source>
        <translation>Statt der Höhen werden Höhen über einer Fläche verglichen, die dem Gelände folgt (weißer Top-Hat), damit Boden am Hang nicht verloren geht.</translation>
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
        <source>Compares the ground of a classified point cloud with a reference that holds the same points. Type I error: the share of the reference's ground that was rejected; type II: of all other points, the share that was accepted. The report is a web page with a map.</source>
        <translation>Vergleicht den Boden einer klassifizierten Punktwolke mit einer Referenz, die dieselben Punkte enthält. Fehler 1. Art: der Anteil des Bodens der Referenz, der verworfen wurde; 2. Art: der Anteil aller anderen Punkte, der angenommen wurde. Der Bericht ist eine Webseite mit einer Karte.</translation>
    </message>
    <message>
        <source>Comparison of settings</source>
        <translation>Vergleich von Einstellungen</translation>
    </message>
    <message>
        <source>Compressed point clouds (.laz, .copc.laz) need the package lazrs, which few builds of QGIS have. Here you get it from the Python Package Index (0.6 MB), or, without the internet, from a wheel file of lazrs for {}. It goes into your profile; QGIS itself is left as it is.</source>
        <translation>Komprimierte Punktwolken (.laz, .copc.laz) brauchen das Paket lazrs, das kaum ein QGIS mitbringt. Hier bekommen Sie es aus dem Python Package Index (0,6 MB) oder, ohne Internet, aus einer Wheel-Datei von lazrs für {}. Es kommt in Ihr Profil; QGIS selbst bleibt, wie es ist.</translation>
    </message>
    <message>
        <source>Confidence</source>
        <translation>Verlässlichkeit</translation>
    </message>
    <message>
        <source>Confidence of the terrain model</source>
        <translation>Verlässlichkeit des Geländemodells</translation>
    </message>
    <message>
        <source>Context round the window</source>
        <translation>Umgebung des Fensters</translation>
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
        <source>Corrections</source>
        <translation>Korrekturen</translation>
    </message>
    <message>
        <source>Depth of low outliers</source>
        <translation>Tiefe tiefer Ausreißer</translation>
    </message>
    <message>
        <source>Did you mean {name}?</source>
        <translation>War {name} gemeint?</translation>
    </message>
    <message>
        <source>Difference in height of neighbouring lines, in the unit of the heights.</source>
        <translation>Höhenunterschied benachbarter Linien, in der Einheit der Höhen.</translation>
    </message>
    <message>
        <source>Done; no restart is needed.</source>
        <translation>Fertig; ein Neustart ist nicht nötig.</translation>
    </message>
    <message>
        <source>Each {:g}</source>
        <translation>Alle {:g}</translation>
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
        <source>Every cell of this size that has ground points keeps at least one, its lowest, however flat the ground is.</source>
        <translation>Jede Zelle dieser Größe, die Bodenpunkte hat, behält mindestens einen, den tiefsten, wie eben der Boden auch ist.</translation>
    </message>
    <message>
        <source>Extent</source>
        <translation>Ausdehnung</translation>
    </message>
    <message>
        <source>Extra dimension HeightAboveGround</source>
        <translation>Zusatzdimension HeightAboveGround</translation>
    </message>
    <message>
        <source>Files .las, .laz and .copc.laz, virtual point clouds (.vpc), or text files (.txt) with a path a line. May be empty if a folder is given.</source>
        <translation>Dateien .las, .laz und .copc.laz, virtuelle Punktwolken (.vpc) oder Textdateien (.txt) mit einem Pfad je Zeile. Darf leer sein, wenn ein Ordner angegeben ist.</translation>
    </message>
    <message>
        <source>Final height</source>
        <translation>Höhe im letzten Durchgang</translation>
    </message>
    <message>
        <source>Finds the few ground points whose triangulation is as good as that of all of them.</source>
        <translation>Findet die wenigen Bodenpunkte, deren Dreiecksvermaschung so gut ist wie die von allen.</translation>
    </message>
    <message>
        <source>Finds the ground by two methods, and says where they differ.</source>
        <translation>Findet den Boden mit zwei Verfahren und sagt, wo sie sich unterscheiden.</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud (TIN densification), adds the height above it to every point, and makes rasters of terrain and canopy height.</source>
        <translation>Findet den Boden einer rohen Lidar-Punktwolke (TIN-Verdichtung), fügt jedem Punkt die Höhe darüber hinzu und macht Raster von Gelände und Kronenhöhe.</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud (TIN densification), makes terrain model and hillshade of it, and contour lines of the terrain model (GDAL).</source>
        <translation>Findet den Boden einer rohen Lidar-Punktwolke (TIN-Verdichtung), macht daraus Geländemodell und Schummerung und aus dem Geländemodell Höhenlinien (GDAL).</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud and makes maps of it, of which any may be left out. Local relief shows small features. Lengths are metres.</source>
        <translation>Findet den Boden einer rohen Lidar-Punktwolke und macht Karten davon, von denen jede entfallen kann. Das lokale Relief zeigt kleine Formen. Längen sind Meter.</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud by TIN densification and by the slope filter, and compares the two: a hillshade of each, and a report in which TIN densification stands as the reference. Where both agree, most can be trusted; where they differ, look.</source>
        <translation>Findet den Boden einer rohen Lidar-Punktwolke durch TIN-Verdichtung und durch den Neigungsfilter und vergleicht beide: je eine Schummerung und ein Bericht, in dem die TIN-Verdichtung als Referenz gilt. Wo beide übereinstimmen, ist das meiste verlässlich; wo sie sich unterscheiden, sehen Sie hin.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud by rules on the lowest points of cells.</source>
        <translation>Findet die Bodenpunkte einer Lidar-Punktwolke durch Regeln über die tiefsten Punkte von Zellen.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud by the slopes between neighbours.</source>
        <translation>Findet die Bodenpunkte einer Lidar-Punktwolke an den Neigungen zwischen Nachbarn.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud, and makes a terrain model of them.</source>
        <translation>Findet die Bodenpunkte einer Lidar-Punktwolke und macht aus ihnen ein Geländemodell.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar by progressive TIN densification, and writes the point cloud anew with their class; nothing else in it changes. It starts from a sparse triangulation of points that are surely ground and adds, round by round, the points that lie close to it.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Findet die Bodenpunkte von Lidar aus Flugzeug oder Drohne durch progressive TIN-Verdichtung und schreibt die Punktwolke mit deren Klasse neu; sonst ändert sich nichts in ihr. Das Verfahren beginnt mit einer weitmaschigen Dreiecksvermaschung aus Punkten, die sicher Boden sind, und fügt Runde um Runde die Punkte hinzu, die nahe an ihr liegen.
Längen sind Meter und Winkel Grad, gleich welche Einheit das KBS hat. Das Geländemodell und seine Schummerung sind GeoTIFFs.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar by slopes, and writes the point cloud anew with their class; nothing else in it changes. A point that stands above a neighbour by more than the terrain can is not ground. The preset Automatic compares on many scales and follows the terrain; the preset Whitebox repeats WhiteboxTools' LidarGroundPointFilter.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Findet die Bodenpunkte von Lidar aus Flugzeug oder Drohne an Neigungen und schreibt die Punktwolke mit deren Klasse neu; sonst ändert sich nichts in ihr. Ein Punkt, der höher über einem Nachbarn liegt, als es das Gelände kann, ist kein Boden. Die Voreinstellung Automatisch vergleicht in vielen Maßstäben und folgt dem Gelände; die Voreinstellung Whitebox wiederholt LidarGroundPointFilter der WhiteboxTools.
Längen sind Meter und Winkel Grad, gleich welche Einheit das KBS hat. Das Geländemodell und seine Schummerung sind GeoTIFFs.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar on a grid of lowest points, and writes the point cloud anew with their class; nothing else in it changes. Steps between neighbouring cells are the rims of objects; what such rims enclose is removed, the tall objects first. It needs heights only, no returns, and is fast.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Findet die Bodenpunkte von Lidar aus Flugzeug oder Drohne auf einem Raster tiefster Punkte und schreibt die Punktwolke mit deren Klasse neu; sonst ändert sich nichts in ihr. Stufen zwischen benachbarten Zellen sind die Ränder von Objekten; was solche Ränder umschließen, wird entfernt, die hohen Objekte zuerst. Das Verfahren braucht nur Höhen, keine Echos, und ist schnell.
Längen sind Meter und Winkel Grad, gleich welche Einheit das KBS hat. Das Geländemodell und seine Schummerung sind GeoTIFFs.</translation>
    </message>
    <message>
        <source>Finds the ground points of the many files of a survey, without seams between them.</source>
        <translation>Findet die Bodenpunkte der vielen Dateien einer Befliegung, ohne Nähte zwischen ihnen.</translation>
    </message>
    <message>
        <source>First and single returns</source>
        <translation>Erste und einzige Echos</translation>
    </message>
    <message>
        <source>Flat land, fields</source>
        <translation>Flachland, Felder</translation>
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
        <source>GB</source>
        <translation>GB</translation>
    </message>
    <message>
        <source>Gaps between points are interpolated by triangles; those with a longer edge have no data instead, as water should. Empty: all gaps are interpolated, as far as the convex hull of the points.</source>
        <translation>Lücken zwischen Punkten werden durch Dreiecke interpoliert; wo deren Kante länger ist, gibt es keine Werte, wie es über Wasser sein soll. Leer: Alle Lücken werden interpoliert, bis zur konvexen Hülle der Punkte.</translation>
    </message>
    <message>
        <source>Get lazrs</source>
        <translation>lazrs holen</translation>
    </message>
    <message>
        <source>Go on where a run before ended</source>
        <translation>Weitermachen, wo ein früherer Lauf endete</translation>
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
        <source>Ground, if the method takes them for it</source>
        <translation>Boden, wenn das Verfahren sie dafür hält</translation>
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
        <source>Height threshold</source>
        <translation>Höhenschwelle</translation>
    </message>
    <message>
        <source>Height thresholds</source>
        <translation>Höhenschwellen</translation>
    </message>
    <message>
        <source>Heights above ground are {low:.2f} to {high:.2f} {unit}.</source>
        <translation>Die Höhen über Grund reichen von {low:.2f} bis {high:.2f} {unit}.</translation>
    </message>
    <message>
        <source>Heights of the bare ground.</source>
        <translation>Höhen des nackten Bodens.</translation>
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
        <source>How far a ground point may lie above the TIN of the key points. About the accuracy of the heights, or half the interval of the contour lines to be made.</source>
        <translation>Wie weit ein Bodenpunkt über dem TIN der Schlüsselpunkte liegen darf. Etwa die Genauigkeit der Höhen oder die halbe Äquidistanz der gewünschten Höhenlinien.</translation>
    </message>
    <message>
        <source>How far a ground point may lie below the TIN of the key points.</source>
        <translation>Wie weit ein Bodenpunkt unter dem TIN der Schlüsselpunkte liegen darf.</translation>
    </message>
    <message>
        <source>How far a point is compared with its neighbours, the largest distance in the automatic preset: at least half the shorter side of the largest building. Empty: 18 m (more if points are sparse), or 2 m in the preset Whitebox.</source>
        <translation>Wie weit ein Punkt mit seinen Nachbarn verglichen wird, in der automatischen Voreinstellung die größte Entfernung: mindestens die halbe kürzere Seite des größten Gebäudes. Leer: 18 m (mehr bei geringer Punktdichte), in der Voreinstellung Whitebox 2 m.</translation>
    </message>
    <message>
        <source>How far below the ground a point must lie to become low noise, in level terrain; on slopes the rise of the ground over 1 m is added. Only where low outliers are put into class 7.</source>
        <translation>Wie weit ein Punkt unter dem Boden liegen muss, um tiefes Rauschen zu werden, in ebenem Gelände; am Hang kommt der Anstieg des Bodens auf 1 m hinzu. Nur wenn tiefe Ausreißer in Klasse 7 kommen.</translation>
    </message>
    <message>
        <source>How far the surroundings reach that a place is compared with. About as wide as the features to be seen; larger landforms vanish.</source>
        <translation>Wie weit die Umgebung reicht, mit der eine Stelle verglichen wird. Etwa so breit wie die Formen, die man sehen will; größere verschwinden.</translation>
    </message>
    <message>
        <source>How high the light stands above the horizon.</source>
        <translation>Wie hoch das Licht über dem Horizont steht.</translation>
    </message>
    <message>
        <source>How many threads compute at the same time. The result does not depend on it.</source>
        <translation>Wie viele Threads gleichzeitig rechnen. Das Ergebnis hängt nicht davon ab.</translation>
    </message>
    <message>
        <source>Ignored classes of the reference</source>
        <translation>Nicht beachtete Klassen der Referenz</translation>
    </message>
    <message>
        <source>In the command line some layers are missing: save each in the CRS of the points as GeoJSON, and add {}.</source>
        <translation>In der Befehlszeile fehlen einige Layer: Speichern Sie jeden im KBS der Punkte als GeoJSON, und ergänzen Sie {}.</translation>
    </message>
    <message>
        <source>In the command line the boundary is missing: save it in the CRS of the points as boundary.geojson, and add --boundary boundary.geojson.</source>
        <translation>In der Befehlszeile fehlt die Begrenzung: Speichern Sie sie im KBS der Punkte als boundary.geojson, und fügen Sie --boundary boundary.geojson hinzu.</translation>
    </message>
    <message>
        <source>In the command line the corrections are missing: save them in the CRS of the points as corrections.geojson, their class as the attribute "{}", and add --corrections corrections.geojson.</source>
        <translation>In der Befehlszeile fehlen die Korrekturen: Speichern Sie sie im KBS der Punkte als corrections.geojson, ihre Klasse als Attribut „{}“, und fügen Sie --corrections corrections.geojson hinzu.</translation>
    </message>
    <message>
        <source>In the last pass whatever stands this far above the ground beside it is removed: bushes, cars, walls. Larger spares rough ground. Empty: from the preset.</source>
        <translation>Im letzten Durchgang wird entfernt, was so hoch über dem Boden daneben steht: Büsche, Autos, Mauern. Ein größerer Wert schont rauen Boden. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>In triangles whose longest edge is shorter the iteration angle is reduced in proportion, so that low vegetation is not climbed step by step. Empty: never.</source>
        <translation>In Dreiecken, deren längste Kante kürzer ist, wird der Iterationswinkel im Verhältnis kleiner, damit niedriger Bewuchs nicht Schritt für Schritt erklommen wird. Leer: nie.</translation>
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
        <source>Its class 2 counts as ground, all others do not.</source>
        <translation>Ihre Klasse 2 gilt als Boden, alle anderen nicht.</translation>
    </message>
    <message>
        <source>Kappa [%]</source>
        <translation>Kappa [%]</translation>
    </message>
    <message>
        <source>Keep, but old ground that is not confirmed becomes 1</source>
        <translation>Behalten, aber früherer Boden, der sich nicht bestätigt, wird 1</translation>
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
        <source>Largest angle between a triangle and the line from one of its corners to a new point. Larger follows rugged ground better, smaller keeps low objects out: 4 in flat, 10 and more in steep terrain. Empty: from the preset.</source>
        <translation>Größter Winkel zwischen einem Dreieck und der Linie von einer seiner Ecken zu einem neuen Punkt. Ein größerer folgt rauem Gelände besser, ein kleinerer hält niedrige Objekte fern: 4 in flachem, 10 und mehr in steilem Gelände. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>Largest distance of a new point from its triangle. Empty: from the preset.</source>
        <translation>Größter Abstand eines neuen Punkts von seinem Dreieck. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>Last and single returns (return number = number of returns)</source>
        <translation>Letzte und einzige Echos (Nummer des Echos = Anzahl der Echos)</translation>
    </message>
    <message>
        <source>Leaves all points out of the output that are not of the class of the ground. The log says how many.</source>
        <translation>Lässt in der Ausgabe alle Punkte weg, die nicht die Klasse des Bodens haben. Das Protokoll sagt, wie viele es sind.</translation>
    </message>
    <message>
        <source>Leaves all points out of the output that lie outside of the extent and the boundary, and out of the rasters. Files of a survey that have none in the area are not written.</source>
        <translation>Lässt alle Punkte außerhalb von Ausdehnung und Begrenzung weg, in der Ausgabe und in den Rastern. Dateien einer Befliegung, die im Gebiet keine haben, werden nicht geschrieben.</translation>
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
        <source>Line of the profile</source>
        <translation>Linie des Profils</translation>
    </message>
    <message>
        <source>Lines along which the water in such polygons falls, drawn in either direction.</source>
        <translation>Linien, entlang derer das Wasser in solchen Polygonen fällt, in beliebiger Richtung gezeichnet.</translation>
    </message>
    <message>
        <source>Lines of equal height of the terrain model, with the field ELEV.</source>
        <translation>Linien gleicher Höhe des Geländemodells, mit dem Feld ELEV.</translation>
    </message>
    <message>
        <source>Lines that no triangle of the terrain crosses: edges of walls, dykes and terraces. A line with z has that height; without z, each side of it has the height of the nearest ground point there.</source>
        <translation>Linien, über die kein Dreieck des Geländes hinweggeht: Kanten von Mauern, Deichen und Terrassen. Eine Linie mit z hat diese Höhe; ohne z hat jede ihrer Seiten dort die Höhe des nächsten Bodenpunkts.</translation>
    </message>
    <message>
        <source>Local relief</source>
        <translation>Lokales Relief</translation>
    </message>
    <message>
        <source>Lowest height</source>
        <translation>Kleinste Höhe</translation>
    </message>
    <message>
        <source>Makes a map of the terrain of a raw point cloud: classes, models, contours.</source>
        <translation>Macht aus einer rohen Punktwolke eine Karte des Geländes: Klassen, Modelle, Höhenlinien.</translation>
    </message>
    <message>
        <source>Makes a terrain model of a surface model where there is no point cloud. What stands above the terrain round it with steep edges on all sides, and is not larger than the largest object, is removed, and the gaps are filled smoothly. Hills and slopes stay.
The output has the same grid, CRS and unit. Lengths are metres, whatever the unit of the CRS.</source>
        <translation>Macht aus einem Oberflächenmodell ein Geländemodell, wo es keine Punktwolke gibt. Was mit allseits steilen Kanten über dem Gelände ringsum steht und nicht größer ist als das größte Objekt, wird entfernt, und die Lücken werden glatt gefüllt. Hügel und Hänge bleiben.
Die Ausgabe hat dasselbe Raster, KBS und dieselbe Einheit. Längen sind Meter, gleich welche Einheit das KBS hat.</translation>
    </message>
    <message>
        <source>Makes rasters (GeoTIFF) of a classified point cloud: the terrain, interpolated on the triangulation (TIN) of the ground points; the surface, the highest point of each cell without noise; canopy height, the difference of the two; and a hillshade of the terrain. All lie on the same grid. Heights are in the vertical unit of the CRS.</source>
        <translation>Macht Raster (GeoTIFF) aus einer klassifizierten Punktwolke: das Gelände, interpoliert auf der Dreiecksvermaschung (TIN) der Bodenpunkte; die Oberfläche, der höchste Punkt jeder Zelle ohne Rauschen; die Kronenhöhe, der Unterschied von beiden; und eine Schummerung des Geländes. Alle liegen auf demselben Gitter. Höhen stehen in der Höheneinheit des KBS.</translation>
    </message>
    <message>
        <source>Makes terrain model, surface model, canopy height and hillshade of a point cloud.</source>
        <translation>Macht Geländemodell, Oberflächenmodell, Kronenhöhe und Schummerung aus einer Punktwolke.</translation>
    </message>
    <message>
        <source>Mark key points by</source>
        <translation>Schlüsselpunkte kennzeichnen durch</translation>
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
        <source>Maximum terrain angle</source>
        <translation>Größte Geländeneigung</translation>
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
        <source>Methods with their presets. The others are compared with the first.</source>
        <translation>Verfahren mit ihren Voreinstellungen. Die anderen werden mit der ersten verglichen.</translation>
    </message>
    <message>
        <source>Minimum number of neighbours</source>
        <translation>Mindestzahl der Nachbarn</translation>
    </message>
    <message>
        <source>Model: heights above ground</source>
        <translation>Modell: Höhen über Grund</translation>
    </message>
    <message>
        <source>Model: terrain, hillshade and contours</source>
        <translation>Modell: Gelände, Schummerung und Höhenlinien</translation>
    </message>
    <message>
        <source>Model: two methods compared</source>
        <translation>Modell: zwei Verfahren im Vergleich</translation>
    </message>
    <message>
        <source>Models</source>
        <translation>Modelle</translation>
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
        <source>Noise distance</source>
        <translation>Rauschabstand</translation>
    </message>
    <message>
        <source>Not ground</source>
        <translation>Kein Boden</translation>
    </message>
    <message>
        <source>Not ground, but with a classic preset</source>
        <translation>Kein Boden, außer mit einer klassischen Voreinstellung</translation>
    </message>
    <message>
        <source>Not there yet: .laz and .copc.laz files cannot be read or written.</source>
        <translation>Noch nicht da: Dateien .laz und .copc.laz lassen sich weder lesen noch schreiben.</translation>
    </message>
    <message>
        <source>Number of the raster's band that holds the heights.</source>
        <translation>Nummer des Kanals, der die Höhen enthält.</translation>
    </message>
    <message>
        <source>Objects have edges steeper than this all round, measured above the terrain that the maximum object size gives; what rises more gently somewhere is a hill.</source>
        <translation>Objekte haben ringsum Kanten, die steiler sind als dies, gemessen über dem Gelände, das sich aus der größten Objektbreite ergibt; was irgendwo sanfter ansteigt, ist ein Hügel.</translation>
    </message>
    <message>
        <source>Of the ground, keep only the points that a terrain model needs: those whose TIN lies within the two tolerances below of every other ground point.</source>
        <translation>Vom Boden bleiben nur die Punkte, die ein Geländemodell braucht: jene, deren TIN innerhalb der beiden folgenden Toleranzen an jedem anderen Bodenpunkt liegt.</translation>
    </message>
    <message>
        <source>One light</source>
        <translation>Ein Licht</translation>
    </message>
    <message>
        <source>One light shows best what lies across it, and leaves slopes that turn away in the dark. Four lights show landforms of any direction.</source>
        <translation>Ein Licht zeigt am besten, was quer zu ihm liegt, und lässt abgewandte Hänge im Dunkeln. Vier Lichter zeigen Geländeformen jeder Richtung.</translation>
    </message>
    <message>
        <source>One pass for each, from the largest: of two neighbouring cells that differ by more, the higher is the rim of an object. Empty: from the preset.</source>
        <translation>Ein Durchgang für jede, von der größten an: Von zwei benachbarten Zellen, die sich um mehr unterscheiden, ist die höhere der Rand eines Objekts. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>Only key points</source>
        <translation>Nur Schlüsselpunkte</translation>
    </message>
    <message>
        <source>Only points in these polygons are classified, of an extent too if there is one. The others keep their class, but those near them help to judge. Empty: all points.</source>
        <translation>Nur Punkte in diesen Polygonen werden klassifiziert, und in der Ausdehnung, wenn es eine gibt. Die anderen behalten ihre Klasse, doch die in der Nähe helfen beim Urteil. Leer: alle Punkte.</translation>
    </message>
    <message>
        <source>Only points in this rectangle are classified. The others keep their class, but those near it help to judge. Empty: all points.</source>
        <translation>Nur Punkte in diesem Rechteck werden klassifiziert. Die anderen behalten ihre Klasse, doch die in der Nähe helfen beim Urteil. Leer: alle Punkte.</translation>
    </message>
    <message>
        <source>Only points of these classes take part and may change their class; every class but low and high noise (7 and 18) when none is given.</source>
        <translation>Nur Punkte dieser Klassen nehmen teil und können ihre Klasse ändern; ohne Angabe alle Klassen außer tiefem und hohem Rauschen (7 und 18).</translation>
    </message>
    <message>
        <source>Only points that stand above a neighbour by at least this much are not ground. Empty: 0.5 m, or 1 m in the preset Whitebox.</source>
        <translation>Nur Punkte, die mindestens so hoch über einem Nachbarn liegen, sind kein Boden. Leer: 0,5 m, in der Voreinstellung Whitebox 1 m.</translation>
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
        <source>Point cloud with heights</source>
        <translation>Punktwolke mit Höhen</translation>
    </message>
    <message>
        <source>Point cloud with key points</source>
        <translation>Punktwolke mit Schlüsselpunkten</translation>
    </message>
    <message>
        <source>Point clouds</source>
        <translation>Punktwolken</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Points in the area</source>
        <translation>Punkte im Gebiet</translation>
    </message>
    <message>
        <source>Points no deeper below the final surface are ground, in level terrain: it lies through the lowest points, and is smooth where they are not.</source>
        <translation>Punkte, die nicht tiefer unter der endgültigen Fläche liegen, sind Boden, in ebenem Gelände: Sie geht durch die tiefsten Punkte und ist glatt, wo diese es nicht sind.</translation>
    </message>
    <message>
        <source>Points no higher above the final surface are ground, in level terrain. More takes in grass and low bushes.</source>
        <translation>Punkte, die nicht höher über der endgültigen Fläche liegen, sind Boden, in ebenem Gelände. Mehr nimmt Gras und niedrige Büsche mit auf.</translation>
    </message>
    <message>
        <source>Points no higher above the ground's surface are ground, in level terrain. Empty: from the preset.</source>
        <translation>Punkte, die nicht höher über der Bodenfläche liegen, sind Boden, in ebenem Gelände. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>Points no higher above the surface through the ground are ground, in level terrain. Not for the preset Whitebox.</source>
        <translation>Punkte, die nicht höher über der Fläche durch den Boden liegen, sind Boden, in ebenem Gelände. Nicht für die Voreinstellung Whitebox.</translation>
    </message>
    <message>
        <source>Points of the surface</source>
        <translation>Punkte der Oberfläche</translation>
    </message>
    <message>
        <source>Points of these classes are ground for certain, whatever their return: they are not judged, and the TIN densification starts from them. They get the class of the ground, too, unless theirs is not among those to classify anew.</source>
        <translation>Punkte dieser Klassen sind sicher Boden, gleich welches Echo: Sie werden nicht beurteilt, und die TIN-Verdichtung beginnt mit ihnen. Auch sie bekommen die Klasse des Bodens, außer wenn ihre nicht zu den neu zu klassifizierenden gehört.</translation>
    </message>
    <message>
        <source>Points of these classes of the reference are left out, noise (7, 18) for example.</source>
        <translation>Punkte dieser Klassen der Referenz bleiben weg, zum Beispiel Rauschen (7, 18).</translation>
    </message>
    <message>
        <source>Points so far round the window are read to judge those in it, but not shown. More is slower, and closer to what the whole file gives near the edges of the window and beside large buildings. Empty: as far as the methods look, at most 50 m.</source>
        <translation>Punkte so weit um das Fenster werden gelesen, um die im Fenster zu beurteilen, aber nicht gezeigt. Mehr ist langsamer, und näher an dem, was die ganze Datei nahe dem Rand des Fensters und neben großen Gebäuden ergibt. Leer: so weit die Verfahren schauen, höchstens 50 m.</translation>
    </message>
    <message>
        <source>Points that took part</source>
        <translation>Punkte, die teilnahmen</translation>
    </message>
    <message>
        <source>Points that took part and lie far below the ground that was found (multipath, faults of the sensor) become low noise, class 7, instead of what becomes of other points.</source>
        <translation>Punkte, die teilnahmen und weit unter dem gefundenen Boden liegen (Mehrwegeausbreitung, Fehler des Sensors), werden tiefes Rauschen, Klasse 7, statt dessen, was aus den übrigen Punkten wird.</translation>
    </message>
    <message>
        <source>Polygons in which no point is ground, such as bridges and roofs.</source>
        <translation>Polygone, in denen kein Punkt Boden ist, etwa Brücken und Dächer.</translation>
    </message>
    <message>
        <source>Polygons in which the class is known: it holds whatever the filter makes of the points. Where it is that of the ground, points of the wanted returns are ground; else all points get it, and the filter does not see them. Where polygons overlap, the last one counts.</source>
        <translation>Polygone, in denen die Klasse bekannt ist: Sie gilt, was auch immer der Filter aus den Punkten macht. Wo es die des Bodens ist, sind Punkte der gewünschten Echos Boden; sonst bekommen sie alle Punkte, und der Filter sieht diese nicht. Wo sich Polygone überlappen, zählt das letzte.</translation>
    </message>
    <message>
        <source>Polygons of water: flattened to one level, that of the ground along their border.</source>
        <translation>Polygone von Gewässern: auf eine Höhe eingeebnet, die des Bodens an ihrem Rand.</translation>
    </message>
    <message>
        <source>Preset</source>
        <translation>Voreinstellung</translation>
    </message>
    <message>
        <source>Products</source>
        <translation>Produkte</translation>
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
        <source>Radius of the local relief</source>
        <translation>Radius des lokalen Reliefs</translation>
    </message>
    <message>
        <source>Ready. Compressed point clouds (.laz) need one package more, once.</source>
        <translation>Bereit. Komprimierte Punktwolken (.laz) brauchen noch ein Paket, einmalig.</translation>
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
        <source>Reduce iteration angle when edges are shorter than</source>
        <translation>Iterationswinkel verkleinern, wenn Kanten kürzer sind als</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>Remember the classes</source>
        <translation>Klassen merken</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
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
        <source>Removed; the files that are in use go when QGIS starts next.</source>
        <translation>Entfernt; Dateien, die in Benutzung sind, verschwinden beim nächsten Start von QGIS.</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
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
        <source>Rivers</source>
        <translation>Flüsse</translation>
    </message>
    <message>
        <source>Search radius</source>
        <translation>Suchradius</translation>
    </message>
    <message>
        <source>Searches a folder with all folders in it, instead of alone.</source>
        <translation>Durchsucht einen Ordner samt allen Ordnern darin, statt nur ihn selbst.</translation>
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
        <source>Share of the ground's rise from point to point, over a metre at most, that is added to the ground tolerance; in the paper's preset, of its rise over one cell. Empty: from the preset.</source>
        <translation>Anteil des Anstiegs des Bodens von Punkt zu Punkt, über höchstens einen Meter, der zur Bodentoleranz hinzukommt; in der Voreinstellung der Veröffentlichung von seinem Anstieg über eine Zelle. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>Share of wrong points</source>
        <translation>Anteil falscher Punkte</translation>
    </message>
    <message>
        <source>Shorter side of the largest building or other object. Whatever is narrower and stands out from its surroundings gives no seed of the ground. Too large costs time and sharp hilltops. Empty: from the preset.</source>
        <translation>Kürzere Seite des größten Gebäudes oder sonstigen Objekts. Was schmaler ist und aus seiner Umgebung herausragt, liefert keinen Startpunkt des Bodens. Zu groß kostet Zeit und spitze Kuppen. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building, which is found by the drop all round it even if it is wider than two search radii. Empty: 100 m, or two search radii where that is given. Not for the preset Whitebox.</source>
        <translation>Kürzere Seite des größten Gebäudes; es wird am Abfall ringsum erkannt, auch wenn es breiter ist als zwei Suchradien. Leer: 100 m, oder zwei Suchradien, wo einer angegeben ist. Nicht für die Voreinstellung Whitebox.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building. Larger costs time, and steep hilltops that are then taken for objects.</source>
        <translation>Kürzere Seite des größten Gebäudes. Größer kostet Zeit, und steile Kuppen, die dann für Objekte gehalten werden.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building. What is wider is terrain. Empty: from the preset.</source>
        <translation>Kürzere Seite des größten Gebäudes. Was breiter ist, ist Gelände. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>Side of a cell of the raster that tells the share of wrong points. The map in the report chooses its own.</source>
        <translation>Seite einer Zelle des Rasters, das den Anteil falscher Punkte angibt. Die Karte im Bericht wählt ihre selbst.</translation>
    </message>
    <message>
        <source>Side of a cell of the terrain model and of its hillshade. About the distance between ground points is sensible; smaller cells only make the file larger.</source>
        <translation>Seite einer Zelle des Geländemodells und seiner Schummerung. Sinnvoll ist etwa der Abstand der Bodenpunkte; kleinere Zellen machen nur die Datei größer.</translation>
    </message>
    <message>
        <source>Side of the cells of the rasters, about the distance between ground points.</source>
        <translation>Seite der Zellen der Raster, etwa der Abstand der Bodenpunkte.</translation>
    </message>
    <message>
        <source>Side of the cells whose lowest points are compared in the automatic preset. Empty: the usual distance between points, at least 1 m.</source>
        <translation>Seite der Zellen, deren tiefste Punkte in der automatischen Voreinstellung verglichen werden. Leer: der übliche Abstand der Punkte, mindestens 1 m.</translation>
    </message>
    <message>
        <source>Side of the square cells whose lowest points are compared. Smaller ones follow finer terrain, if they hold a point, and hold more rims of low plants. Empty: from the preset; where such a cell would hold less than a point, more.</source>
        <translation>Seite der quadratischen Zellen, deren tiefste Punkte verglichen werden. Kleinere folgen feinerem Gelände, wenn sie einen Punkt enthalten, und enthalten mehr Ränder niedriger Pflanzen. Leer: aus der Voreinstellung; mehr, wo eine solche Zelle weniger als einen Punkt enthielte.</translation>
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
        <source>Steep or rugged terrain</source>
        <translation>Steiles oder raues Gelände</translation>
    </message>
    <message>
        <source>Steepest slope of the ground. On steeper triangles a point is judged by its mirror image beyond the nearest vertex.</source>
        <translation>Größte Neigung des Bodens. Auf steileren Dreiecken wird ein Punkt nach seinem Spiegelbild jenseits des nächsten Eckpunkts beurteilt.</translation>
    </message>
    <message>
        <source>Stop triangulation when edges are shorter than</source>
        <translation>Vermaschung beenden, wenn Kanten kürzer sind als</translation>
    </message>
    <message>
        <source>Surface minus terrain: the height of trees, and of buildings too.</source>
        <translation>Oberfläche minus Gelände: die Höhe von Bäumen, und auch von Gebäuden.</translation>
    </message>
    <message>
        <source>Surface model (DSM)</source>
        <translation>Oberflächenmodell (DOM)</translation>
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
        <source>Take the files in folders of folders</source>
        <translation>Dateien auch in Unterordnern nehmen</translation>
    </message>
    <message>
        <source>Takes buildings, trees and other steep-sided objects out of an elevation raster.</source>
        <translation>Entfernt Gebäude, Bäume und andere Objekte mit steilen Seiten aus einem Höhenraster.</translation>
    </message>
    <message>
        <source>Terrain model (DTM)</source>
        <translation>Geländemodell (DGM)</translation>
    </message>
    <message>
        <source>Terrain, surface and canopy height models</source>
        <translation>Gelände-, Oberflächen- und Kronenhöhenmodelle</translation>
    </message>
    <message>
        <source>The attribute of these polygons that says their class: 2 is ground, 1 nothing else.</source>
        <translation>Das Attribut dieser Polygone, das ihre Klasse angibt: 2 ist Boden, 1 keines von allem.</translation>
    </message>
    <message>
        <source>The boundary holds no polygon. Choose one that does.</source>
        <translation>Die Begrenzung enthält kein Polygon. Wählen Sie eine, die eines enthält.</translation>
    </message>
    <message>
        <source>The class that decks of bridges get; 17 in the LAS specification, which point formats 0 to 5 hold as well. Only where bridges are not ground.</source>
        <translation>Die Klasse, die Fahrbahnen von Brücken bekommen; in der LAS-Spezifikation 17, das auch die Punktformate 0 bis 5 fassen. Nur wo Brücken kein Boden sind.</translation>
    </message>
    <message>
        <source>The class that ground points get; 2 is ground in the LAS specification. Point formats 0 to 5 hold classes up to 31.</source>
        <translation>Die Klasse, die Bodenpunkte bekommen; in der LAS-Spezifikation ist Boden 2. Die Punktformate 0 bis 5 fassen Klassen bis 31.</translation>
    </message>
    <message>
        <source>The class that key points get. Points that have it already are taken as ground, and get the first of the ground classes again if they are not needed. Point formats 0 to 5 hold classes up to 31.</source>
        <translation>Die Klasse, die Schlüsselpunkte bekommen. Punkte, die sie schon haben, gelten als Boden und bekommen wieder die erste der Bodenklassen, wenn sie nicht gebraucht werden. Die Punktformate 0 bis 5 fassen Klassen bis 31.</translation>
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
        <source>The ground filter. TIN densification is the most accurate.</source>
        <translation>Der Bodenfilter. TIN-Verdichtung ist am genauesten.</translation>
    </message>
    <message>
        <source>The height between contour lines, in the vertical unit of the CRS. Empty: what gives about 20 of them.</source>
        <translation>Der Höhenabstand der Höhenlinien, in der Höheneinheit des KBS. Leer: was etwa 20 davon ergibt.</translation>
    </message>
    <message>
        <source>The highest point of each cell, noise left out.</source>
        <translation>Der höchste Punkt jeder Zelle, ohne Rauschen.</translation>
    </message>
    <message>
        <source>The key-point flag of LAS; the class stays</source>
        <translation>Das Kennzeichen der Schlüsselpunkte in LAS; die Klasse bleibt</translation>
    </message>
    <message>
        <source>The laser meets the top first. Take all returns where the return numbers of the file are wrong.</source>
        <translation>Der Laser trifft zuerst, was oben ist. Nehmen Sie alle Echos, wo die Nummern der Echos in der Datei falsch sind.</translation>
    </message>
    <message>
        <source>The laser reaches the ground last. Take all returns where the return numbers of the file are wrong.</source>
        <translation>Der Laser erreicht den Boden zuletzt. Nehmen Sie alle Echos, wo die Nummern der Echos in der Datei falsch sind.</translation>
    </message>
    <message>
        <source>The layer "{}" cannot be read.</source>
        <translation>Der Layer „{}“ lässt sich nicht lesen.</translation>
    </message>
    <message>
        <source>The layer's filter is not applied: all points are read.</source>
        <translation>Der Filter des Layers wird nicht angewendet: Alle Punkte werden gelesen.</translation>
    </message>
    <message>
        <source>The lazrs that was got cannot be loaded by this QGIS: {}.</source>
        <translation>Das geholte lazrs lässt sich in diesem QGIS nicht laden: {}.</translation>
    </message>
    <message>
        <source>The lazrs that was removed is still in use: start QGIS anew and try again.</source>
        <translation>Das entfernte lazrs ist noch in Benutzung: Starten Sie QGIS neu, und versuchen Sie es noch einmal.</translation>
    </message>
    <message>
        <source>The names of the files stay, but for what a format needs.</source>
        <translation>Die Namen der Dateien bleiben, soweit ein Format keine anderen braucht.</translation>
    </message>
    <message>
        <source>The paper's values</source>
        <translation>Werte der Veröffentlichung</translation>
    </message>
    <message>
        <source>The probability, 0 to 1, that the terrain model is right: low under dense trees, across gaps and at breaks.</source>
        <translation>Die Wahrscheinlichkeit, 0 bis 1, dass das Geländemodell stimmt: gering unter dichten Bäumen, über Lücken und an Kanten.</translation>
    </message>
    <message>
        <source>The rasters have {:,} x {:,} cells.</source>
        <translation>Die Raster haben {:,} x {:,} Zellen.</translation>
    </message>
    <message>
        <source>The same points with their heights above ground.</source>
        <translation>Dieselben Punkte mit ihren Höhen über Grund.</translation>
    </message>
    <message>
        <source>The same points with their new classes.</source>
        <translation>Dieselben Punkte mit ihren neuen Klassen.</translation>
    </message>
    <message>
        <source>The same points with their true classes, in any order.</source>
        <translation>Dieselben Punkte mit ihren wahren Klassen, in beliebiger Reihenfolge.</translation>
    </message>
    <message>
        <source>The same points, the key points among them marked.</source>
        <translation>Dieselben Punkte, die Schlüsselpunkte darunter gekennzeichnet.</translation>
    </message>
    <message>
        <source>The same raster, with the terrain in place of the objects.</source>
        <translation>Dasselbe Raster, mit dem Gelände an Stelle der Objekte.</translation>
    </message>
    <message>
        <source>The same without QGIS:</source>
        <translation>Dasselbe ohne QGIS:</translation>
    </message>
    <message>
        <source>The share of wrong points in each cell of a raster, 0 to 1.</source>
        <translation>Der Anteil falscher Punkte in jeder Zelle eines Rasters, 0 bis 1.</translation>
    </message>
    <message>
        <source>The terrain model less a smoothed one: mounds, ditches and old paths stand out.</source>
        <translation>Das Geländemodell abzüglich eines geglätteten: Hügel, Gräben und alte Wege treten hervor.</translation>
    </message>
    <message>
        <source>The terrain model, lit by one light or by four.</source>
        <translation>Das Geländemodell, von einem Licht oder von vieren beleuchtet.</translation>
    </message>
    <message>
        <source>The values of the method, by terrain. Values of one's own can be given on the command line.</source>
        <translation>Die Werte des Verfahrens, nach Gelände. Eigene Werte lassen sich auf der Befehlszeile angeben.</translation>
    </message>
    <message>
        <source>The window that is classified, such as the map's extent; at most 1,000 m wide, and quick up to about 250 x 250 m. It is transformed to the CRS of the points.</source>
        <translation>Das Fenster, das klassifiziert wird, etwa die Kartenausdehnung; höchstens 1.000 m breit, und schnell bis etwa 250 x 250 m. Es wird in das KBS der Punkte transformiert.</translation>
    </message>
    <message>
        <source>There is no parameter {name}: it is ignored.</source>
        <translation>Es gibt keinen Parameter {name}: er wird nicht beachtet.</translation>
    </message>
    <message>
        <source>There is not enough memory for this file.</source>
        <translation>Der Arbeitsspeicher reicht für diese Datei nicht.</translation>
    </message>
    <message>
        <source>This Python has neither pip nor ensurepip: install pip for it (in Debian and Ubuntu python3-pip), or choose a wheel file.</source>
        <translation>Dieses Python hat weder pip noch ensurepip: Installieren Sie pip dafür (in Debian und Ubuntu python3-pip), oder wählen Sie eine Wheel-Datei.</translation>
    </message>
    <message>
        <source>This QGIS cannot show such a file as a layer. It is at {}.</source>
        <translation>Dieses QGIS kann eine solche Datei nicht als Layer zeigen. Sie liegt unter {}.</translation>
    </message>
    <message>
        <source>This QGIS cannot show such a file as a layer. It will be at {}.</source>
        <translation>Dieses QGIS kann eine solche Datei nicht als Layer zeigen. Sie wird unter {} liegen.</translation>
    </message>
    <message>
        <source>This QGIS has no scipy. On Windows, install python3-scipy with the OSGeo4W setup; elsewhere, the scipy of the system or of a newer QGIS.</source>
        <translation>Dieses QGIS hat kein scipy. Installieren Sie unter Windows python3-scipy mit dem Setup von OSGeo4W, sonst das scipy des Systems oder eines neueren QGIS.</translation>
    </message>
    <message>
        <source>This QGIS has no {}.</source>
        <translation>Diesem QGIS fehlt: {}.</translation>
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
        <source>Tiles that are done stay, if they were made from the same files with the same parameters. All others are classified anew.</source>
        <translation>Fertige Kacheln bleiben, wenn sie aus denselben Dateien mit denselben Parametern entstanden. Alle anderen werden neu klassifiziert.</translation>
    </message>
    <message>
        <source>Time: {seconds:.1f} s</source>
        <translation>Dauer: {seconds:.1f} s</translation>
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
        <source>Triangles whose longest edge is shorter take no further point. Empty: never.</source>
        <translation>Dreiecke, deren längste Kante kürzer ist, nehmen keinen weiteren Punkt auf. Leer: nie.</translation>
    </message>
    <message>
        <source>Tries methods and presets on a part of a point cloud, and shows them side by side.</source>
        <translation>Probiert Verfahren und Voreinstellungen an einem Teil einer Punktwolke und zeigt sie nebeneinander.</translation>
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
        <source>Up to LAS 1.3, and for most programs, key points are a class. LAS 1.4 has a flag for them, so that they stay ground.</source>
        <translation>Bis LAS 1.3, und für die meisten Programme, sind Schlüsselpunkte eine Klasse. LAS 1.4 hat ein Kennzeichen für sie, so dass sie Boden bleiben.</translation>
    </message>
    <message>
        <source>Virtual point cloud</source>
        <translation>Virtuelle Punktwolke</translation>
    </message>
    <message>
        <source>Water</source>
        <translation>Gewässer</translation>
    </message>
    <message>
        <source>What a slope of 45 degrees adds to both ground tolerances, less in proportion on gentler slopes.</source>
        <translation>Was eine Neigung von 45 Grad zu beiden Bodentoleranzen hinzufügt, bei sanfteren Neigungen im Verhältnis weniger.</translation>
    </message>
    <message>
        <source>What a slope of 45 degrees adds to the ground tolerance where points are a metre apart. Less in proportion on gentler slopes, and where points are closer.</source>
        <translation>Was eine Neigung von 45 Grad zur Bodentoleranz hinzufügt, wo Punkte einen Meter auseinander liegen. Im Verhältnis weniger bei sanfteren Neigungen, und wo Punkte näher beieinander liegen.</translation>
    </message>
    <message>
        <source>What becomes of points that are not ground. Points that were never classified (0) become 1 in either case; noise, withheld points and other classes than those to classify anew stay as they are.</source>
        <translation>Was aus Punkten wird, die kein Boden sind. Nie klassifizierte Punkte (0) werden in jedem Fall 1; Rauschen, zurückgehaltene Punkte (withheld) und andere als die neu zu klassifizierenden Klassen bleiben, wie sie sind.</translation>
    </message>
    <message>
        <source>What becomes of the decks of bridges. They are found by cross-sections that fall to lower ground on both sides; ramps, dams and embankments stay ground. A classic preset (Whitebox, LiDAR360's, the paper's) does just what the original does.</source>
        <translation>Was aus den Fahrbahnen von Brücken wird. Sie werden an Querschnitten erkannt, die auf beiden Seiten zu tieferem Boden abfallen; Rampen, Dämme und Böschungen bleiben Boden. Eine klassische Voreinstellung (Whitebox, LiDAR360, Veröffentlichung) tut genau, was das Original tut.</translation>
    </message>
    <message>
        <source>What the land is like. automatic: judged by the points.</source>
        <translation>Wie das Land ist. automatic: nach den Punkten beurteilt.</translation>
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
        <source>Where one light comes from, clockwise from north; four have their own directions.</source>
        <translation>Woher ein Licht kommt, von Norden aus im Uhrzeigersinn; vier haben ihre eigenen Richtungen.</translation>
    </message>
    <message>
        <source>Where the classified files go, each under its name.</source>
        <translation>Wohin die klassifizierten Dateien kommen, jede unter ihrem Namen.</translation>
    </message>
    <message>
        <source>Where the values come from that are left empty: from the points (automatic), or from what suits a kind of terrain. The log says which values were used.</source>
        <translation>Woher die Werte leerer Felder kommen: aus den Punkten (automatisch) oder aus dem, was zu einer Geländeart passt. Das Protokoll sagt, welche Werte benutzt wurden.</translation>
    </message>
    <message>
        <source>Where the values come from that are left empty: what suits most land (automatic) or a kind of terrain. The log says which values were used.</source>
        <translation>Woher die Werte leerer Felder kommen: was zu den meisten Landschaften passt (automatisch) oder zu einer Geländeart. Das Protokoll sagt, welche Werte benutzt wurden.</translation>
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
        <source>Writes a classified point cloud anew with the height of every point above the ground, that is above the triangulation (TIN) of the ground points, or beyond it above the nearest of them. Heights are in the vertical unit of the CRS. They become an extra dimension, HeightAboveGround, or take the place of z; nothing else in the file changes.</source>
        <translation>Schreibt eine klassifizierte Punktwolke neu, mit der Höhe jedes Punkts über dem Boden, das heißt über der Dreiecksvermaschung (TIN) der Bodenpunkte oder, jenseits davon, über dem nächsten von ihnen. Höhen stehen in der Höheneinheit des KBS. Sie werden eine Zusatzdimension, HeightAboveGround, oder treten an die Stelle von z; sonst ändert sich nichts in der Datei.</translation>
    </message>
    <message>
        <source>X and Y of its two ends, in the CRS of the points: X1 Y1 X2 Y2. Empty: straight across the window, from west to east or from south to north, where the terrains differ most.</source>
        <translation>X und Y der beiden Enden, im KBS der Punkte: X1 Y1 X2 Y2. Leer: gerade durch das Fenster, von West nach Ost oder von Süd nach Nord, wo sich die Gelände am meisten unterscheiden.</translation>
    </message>
    <message>
        <source>Z, in place of the elevation</source>
        <translation>Z, an Stelle der Höhe</translation>
    </message>
    <message>
        <source>bare earth,surface,buildings,trees,vegetation,off-terrain objects,oto,whitebox,lindsay,top-hat</source>
        <translation>Boden,Oberfläche,Gebäude,Bäume,Vegetation,Objekte,oto,whitebox,lindsay,top-hat</translation>
    </message>
    <message>
        <source>canopy height</source>
        <translation>Kronenhöhe</translation>
    </message>
    <message>
        <source>chm,ndsm,canopy,vegetation,vegetation height,normalize,normalise,hag,lasheight</source>
        <translation>chm,ndom,Kronenhöhe,Kronenhöhenmodell,Vegetation,Vegetationshöhe,normalisieren,Höhe über Grund</translation>
    </message>
    <message>
        <source>classes</source>
        <translation>Klassen</translation>
    </message>
    <message>
        <source>classified files</source>
        <translation>klassifizierte Dateien</translation>
    </message>
    <message>
        <source>confidence</source>
        <translation>Verlässlichkeit</translation>
    </message>
    <message>
        <source>contour lines</source>
        <translation>Höhenlinien</translation>
    </message>
    <message>
        <source>contours,workflow</source>
        <translation>Höhenlinien,Isolinien,Arbeitsablauf</translation>
    </message>
    <message>
        <source>errors</source>
        <translation>Fehler</translation>
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
        <source>height above ground</source>
        <translation>Höhe über Grund</translation>
    </message>
    <message>
        <source>height,extra bytes</source>
        <translation>Höhe,Zusatzdimension</translation>
    </message>
    <message>
        <source>hillshade</source>
        <translation>Schummerung</translation>
    </message>
    <message>
        <source>key points</source>
        <translation>Schlüsselpunkte</translation>
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
        <source>lidar,laser scanning,als,uav,drone,las,laz,copc,point cloud</source>
        <translation>Lidar,Laserscanning,Airborne Laserscanning,Drohne,las,laz,copc,Punktwolke</translation>
    </message>
    <message>
        <source>local relief</source>
        <translation>lokales Relief</translation>
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
        <source>pip cannot work through the SOCKS proxy of QGIS's settings: choose a wheel file.</source>
        <translation>pip kann nicht über den SOCKS-Proxy der QGIS-Einstellungen arbeiten: Wählen Sie eine Wheel-Datei.</translation>
    </message>
    <message>
        <source>pip failed without a word</source>
        <translation>pip scheiterte ohne ein Wort</translation>
    </message>
    <message>
        <source>points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>preview,try,test,preset,parameters,compare,profile</source>
        <translation>Vorschau,probieren,testen,Voreinstellung,Parameter,vergleichen,Profil</translation>
    </message>
    <message>
        <source>ptd,axelsson,densification</source>
        <translation>ptd,axelsson,Verdichtung</translation>
    </message>
    <message>
        <source>slope,vosselman,whitebox,top-hat</source>
        <translation>Neigung,Hangneigung,vosselman,whitebox,top-hat</translation>
    </message>
    <message>
        <source>surface model</source>
        <translation>Oberflächenmodell</translation>
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
        <source>terrain model</source>
        <translation>Geländemodell</translation>
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
        <source>the folder of the profile may not be written to.</source>
        <translation>in den Ordner des Profils darf nicht geschrieben werden.</translation>
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
        <source>without objects</source>
        <translation>ohne Objekte</translation>
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
        <source>{file} holds {member}, which has no place in a wheel of {package}. Get it anew.</source>
        <translation>{file} enthält {member}, das in einem Wheel von {package} nichts zu suchen hat. Holen Sie es neu.</translation>
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
        <source>{ground:,} of {count:,} points are ground ({share:.1%}).</source>
        <translation>{ground:,} von {count:,} Punkten sind Boden ({share:.1%}).</translation>
    </message>
    <message>
        <source>{ground:,} of {count:,} points in the area are ground ({share:.1%}).</source>
        <translation>{ground:,} von {count:,} Punkten im Gebiet sind Boden ({share:.1%}).</translation>
    </message>
    <message>
        <source>{key:,} of {ground:,} ground points are key points ({share:.1%}).</source>
        <translation>{key:,} von {ground:,} Bodenpunkten sind Schlüsselpunkte ({share:.1%}).</translation>
    </message>
    <message>
        <source>{label} must be a number, not {value}.</source>
        <translation>{label} muss eine Zahl sein, nicht {value}.</translation>
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
        <source>{} is damaged: a file differs from its list. Get it anew.</source>
        <translation>{} ist beschädigt: Eine Datei weicht von ihrem Verzeichnis ab. Holen Sie es neu.</translation>
    </message>
    <message>
        <source>{} is not a file of this computer. Download it as .las or .laz first.</source>
        <translation>{} ist keine Datei auf diesem Rechner. Laden Sie sie zuerst als .las oder .laz herunter.</translation>
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
        <source>{} is not a wheel, or damaged. Get it anew.</source>
        <translation>{} ist kein Wheel oder beschädigt. Holen Sie es neu.</translation>
    </message>
    <message>
        <source>{} is not a wheel: choose a file with the ending .whl.</source>
        <translation>{} ist kein Wheel: Wählen Sie eine Datei mit der Endung .whl.</translation>
    </message>
    <message>
        <source>{} must be installed first.</source>
        <translation>Zuerst zu installieren: {}.</translation>
    </message>
</context>
</TS>
