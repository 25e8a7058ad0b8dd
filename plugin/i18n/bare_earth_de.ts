<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>BareEarth</name>
    <message>
        <source>.las, .laz and .copc.laz files, virtual point clouds (.vpc), or text files (.txt) with one path in each line. May stay empty if a folder is given.</source>
        <translation>Dateien .las, .laz und .copc.laz, virtuelle Punktwolken (.vpc) oder Textdateien (.txt) mit einem Pfad je Zeile. Darf leer sein, wenn ein Ordner angegeben ist.</translation>
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
        <source>1 where ground points are far away</source>
        <translation>1, wo Bodenpunkte weit entfernt sind</translation>
    </message>
    <message>
        <source>&lt;b&gt;Values of the presets&lt;/b&gt;</source>
        <translation>&lt;b&gt;Werte der Voreinstellungen&lt;/b&gt;</translation>
    </message>
    <message>
        <source>&lt;b&gt;Values of the presets&lt;/b&gt; for fields that are left empty</source>
        <translation>&lt;b&gt;Werte der Voreinstellungen&lt;/b&gt; für Felder, die leer bleiben</translation>
    </message>
    <message>
        <source>A building has a plane of at least this area. Smaller planes are found only within 5 m of a larger one. If this is half as large, tops of conifers become buildings.</source>
        <translation>Ein Gebäude hat eine Ebene von mindestens dieser Fläche. Kleinere Ebenen werden nur bis 5 m neben einer größeren gefunden. Ist dieser Wert halb so groß, werden Wipfel von Nadelbäumen zu Gebäuden.</translation>
    </message>
    <message>
        <source>A class of their own</source>
        <translation>Eine eigene Klasse</translation>
    </message>
    <message>
        <source>A delivery leaves out rivers that are narrower on average. Empty: 30 m for a survey, 5 m for a flood model.</source>
        <translation>Eine Lieferung lässt Flüsse weg, die im Mittel schmaler sind. Leer: 30 m bei einer Vermessung, 5 m bei einem Hochwassermodell.</translation>
    </message>
    <message>
        <source>A delivery leaves out smaller water. Empty: 8,000 m² for a survey, 1,000 m² for a flood model.</source>
        <translation>Eine Lieferung lässt kleinere Gewässer weg. Leer: 8.000 m² bei einer Vermessung, 1.000 m² bei einem Hochwassermodell.</translation>
    </message>
    <message>
        <source>A download of more is refused before it begins. The error says how large it is.</source>
        <translation>Ein größerer Download wird abgelehnt, bevor er beginnt. Die Fehlermeldung nennt seine Größe.</translation>
    </message>
    <message>
        <source>A layer, a file, or an address (https://…)</source>
        <translation>Ein Layer, eine Datei oder eine Adresse (https://…)</translation>
    </message>
    <message>
        <source>A list of the classified files, which QGIS 3.32 and newer shows as one layer. Without a name it is classified.vpc in their folder.</source>
        <translation>Ein Verzeichnis der klassifizierten Dateien, das QGIS 3.32 und neuer als einen Layer zeigt. Ohne Namen heißt es classified.vpc und kommt in deren Ordner.</translation>
    </message>
    <message>
        <source>A point becomes high noise if it hangs at least this far above all others within about 10 m. Used only if high outliers are put into class 18.</source>
        <translation>Ein Punkt wird hohes Rauschen, wenn er mindestens so hoch über allen anderen im Umkreis von etwa 10 m hängt. Gilt nur, wenn hohe Ausreißer in Klasse 18 kommen.</translation>
    </message>
    <message>
        <source>A point becomes low noise if it lies farther below the ground than this. On slopes, the rise of the ground over 1 m is added. Points with ground all round them that lie 0.4 m and more below it become low noise too. Used only if low outliers are put into class 7.</source>
        <translation>Ein Punkt wird tiefes Rauschen, wenn er weiter als dies unter dem Boden liegt. Am Hang kommt der Anstieg des Bodens auf 1 m hinzu. Punkte, die ringsum Boden haben und 0,4 m oder mehr darunter liegen, werden auch tiefes Rauschen. Gilt nur, wenn tiefe Ausreißer in Klasse 7 kommen.</translation>
    </message>
    <message>
        <source>A point cloud layer, a .las, .laz or .copc.laz file, a virtual point cloud (.vpc), or a text file (.txt) with one path in each line. May stay empty if a folder is given. Also a remote point cloud (COPC, EPT, VPC), or its address (https://...): what the extent needs of it is downloaded first.</source>
        <translation>Ein Punktwolken-Layer, eine Datei .las, .laz oder .copc.laz, eine virtuelle Punktwolke (.vpc) oder eine Textdatei (.txt) mit einem Pfad je Zeile. Darf leer sein, wenn ein Ordner angegeben ist. Auch eine entfernte Punktwolke (COPC, EPT, VPC) oder ihre Adresse (https://...): Was die Ausdehnung von ihr braucht, wird zuerst heruntergeladen.</translation>
    </message>
    <message>
        <source>A point cloud layer, or a .las, .laz or .copc.laz file. Also a remote point cloud (COPC, EPT, VPC), or its address (https://...): what the extent needs of it is downloaded first.</source>
        <translation>Ein Punktwolken-Layer oder eine Datei .las, .laz oder .copc.laz. Auch eine entfernte Punktwolke (COPC, EPT, VPC) oder ihre Adresse (https://...): Was die Ausdehnung von ihr braucht, wird zuerst heruntergeladen.</translation>
    </message>
    <message>
        <source>A point cloud layer, or a .las, .laz or .copc.laz file; also a virtual point cloud (.vpc) or a folder. Also a remote point cloud (COPC, EPT, VPC), or its address (https://...): what the extent needs of it is downloaded first.</source>
        <translation>Ein Punktwolken-Layer oder eine Datei .las, .laz oder .copc.laz; auch eine virtuelle Punktwolke (.vpc) oder ein Ordner. Auch eine entfernte Punktwolke (COPC, EPT, VPC) oder ihre Adresse (https://...): Was die Ausdehnung von ihr braucht, wird zuerst heruntergeladen.</translation>
    </message>
    <message>
        <source>A point cloud layer, or the address (https://...) of a COPC file, of the ept.json of an EPT data set, of a virtual point cloud or of a STAC item. Only what lies in the extent is downloaded.</source>
        <translation>Ein Punktwolkenlayer oder die Adresse (https://...) einer COPC-Datei, der ept.json eines EPT-Datensatzes, einer virtuellen Punktwolke oder eines STAC-Items. Nur was in der Ausdehnung liegt, wird heruntergeladen.</translation>
    </message>
    <message>
        <source>A point is not ground if it stands above a neighbour at a steeper slope than this. In all presets but Whitebox, the slope of the terrain around the point is added to it. Empty: from the preset, 15 deg in most, 45 deg in Whitebox.</source>
        <translation>Ein Punkt ist kein Boden, wenn er mit einer größeren Neigung als dieser über einem Nachbarn liegt. In allen Voreinstellungen außer Whitebox kommt die Neigung des Geländes um den Punkt hinzu. Leer: aus der Voreinstellung, meist 15 Grad, in Whitebox 45 Grad.</translation>
    </message>
    <message>
        <source>A point is not ground only if it stands at least this high above a neighbour. Empty: from the preset, 0.5 m in most, 1 m in Whitebox.</source>
        <translation>Ein Punkt ist nur dann kein Boden, wenn er mindestens so hoch über einem Nachbarn liegt. Leer: aus der Voreinstellung, meist 0,5 m, in Whitebox 1 m.</translation>
    </message>
    <message>
        <source>A point that is closer to its triangle than this joins the TIN whatever its angle. Near a corner, noise alone makes a large angle.</source>
        <translation>Ein Punkt, der näher an seinem Dreieck liegt als dies, kommt unter jedem Winkel zum TIN hinzu. Nahe einer Ecke ergibt schon das Rauschen einen großen Winkel.</translation>
    </message>
    <message>
        <source>A point with fewer neighbours within the search radius is compared with this many nearest points. Only for the preset Whitebox.</source>
        <translation>Ein Punkt, der im Suchradius weniger Nachbarn hat, wird mit so vielen nächsten verglichen. Nur für die Voreinstellung Whitebox.</translation>
    </message>
    <message>
        <source>A raster file with a band of heights.</source>
        <translation>Eine Rasterdatei mit einem Kanal mit Höhen.</translation>
    </message>
    <message>
        <source>A raster that tells why a place is ground or not: the rule of the filter that decided the cell. Its legend names the rules. Presets that decide points, not cells, cannot make it.</source>
        <translation>Ein Raster, das sagt, warum eine Stelle Boden ist oder nicht: die Regel des Filters, die über die Zelle entschied. Seine Legende nennt die Regeln. Voreinstellungen, die über Punkte statt über Zellen entscheiden, können es nicht erstellen.</translation>
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
        <source>A web page with the figures, the statement, and a map of the errors.</source>
        <translation>Eine Webseite mit den Kennzahlen, der Erklärung und einer Karte der Fehler.</translation>
    </message>
    <message>
        <source>A web page, which the Results Viewer opens.</source>
        <translation>Eine Webseite, die sich aus der Ergebnisanzeige öffnen lässt.</translation>
    </message>
    <message>
        <source>About how much memory a run may use. A file that needs more is read twice, and its points wait in a temporary file in the output folder. With many files, fewer are worked on at the same time. The result does not depend on it. Empty: half of the free memory.</source>
        <translation>Wie viel Arbeitsspeicher ein Lauf etwa belegen darf. Eine Datei, die mehr braucht, wird zweimal gelesen, und ihre Punkte warten in einer temporären Datei im Ausgabeordner. Bei vielen Dateien sind weniger gleichzeitig in Arbeit. Das Ergebnis hängt nicht davon ab. Leer: die Hälfte des freien Arbeitsspeichers.</translation>
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
        <source>Added to both ground tolerances on a slope of 45 degrees. On gentler slopes less is added, in proportion.</source>
        <translation>Kommt auf einem Hang von 45 Grad zu beiden Bodentoleranzen hinzu, auf sanfteren Hängen im Verhältnis weniger.</translation>
    </message>
    <message>
        <source>Added to the ground tolerance on a slope of 45 degrees, if points are a metre apart. Less is added, in proportion, on gentler slopes and if points are closer.</source>
        <translation>Kommt auf einem Hang von 45 Grad zur Bodentoleranz hinzu, wenn Punkte einen Meter auseinander liegen. Auf sanfteren Hängen, und wenn Punkte näher beieinander liegen, im Verhältnis weniger.</translation>
    </message>
    <message>
        <source>Adds the extra dimension BareEarthClass with the class that this run gives to each point. A later run on the output finds the classes that were changed by hand since, and keeps them, whatever its settings. It then remembers the classes again.</source>
        <translation>Fügt die Zusatzdimension BareEarthClass mit der Klasse hinzu, die dieser Lauf jedem Punkt gibt. Ein späterer Lauf mit der Ausgabe findet die Klassen, die seither von Hand geändert wurden, und behält sie, gleich welche Einstellungen er hat. Danach merkt er sich die Klassen wieder.</translation>
    </message>
    <message>
        <source>Adds the extra dimension HeightAboveGround, the height of each point above the ground, in the vertical unit of the CRS.</source>
        <translation>Fügt die Zusatzdimension HeightAboveGround hinzu, die Höhe jedes Punkts über dem Boden, in der Höheneinheit des KBS.</translation>
    </message>
    <message>
        <source>Adds the height above ground to every point of a classified point cloud: its height above the triangulation (TIN) of the ground points or, outside of it, above the nearest ground point. Heights are in the vertical unit of the CRS. They become an extra dimension, HeightAboveGround, or replace z; nothing else in the file changes.
With a terrain model, heights are measured above that raster, and the points need no classes.</source>
        <translation>Gibt jedem Punkt einer klassifizierten Punktwolke seine Höhe über dem Boden: über der Dreiecksvermaschung (TIN) der Bodenpunkte oder, außerhalb davon, über dem nächsten Bodenpunkt. Höhen stehen in der Höheneinheit des KBS. Sie werden eine Zusatzdimension, HeightAboveGround, oder treten an die Stelle von z; sonst ändert sich nichts in der Datei.
Mit einem Geländemodell werden die Höhen über diesem Raster gemessen, und die Punkte brauchen keine Klassen.</translation>
    </message>
    <message>
        <source>Adds the height of every point above the ground points of a point cloud.</source>
        <translation>Fügt jedem Punkt einer Punktwolke seine Höhe über den Bodenpunkten hinzu.</translation>
    </message>
    <message>
        <source>All .las, .laz and .copc.laz files in this folder are used, too. All files together are one survey, without seams.</source>
        <translation>Alle Dateien .las, .laz und .copc.laz in diesem Ordner werden auch genommen. Alle Dateien zusammen sind eine Befliegung, ohne Nähte.</translation>
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
        <source>All outputs that a job hands over, in one folder, with a page that lists them. Only with your own choice of outputs are the fields of single outputs used.</source>
        <translation>Alles, was ein Auftrag übergibt, in einem Ordner, mit einer Seite, die es auflistet. Die Felder der einzelnen Ausgaben gelten nur bei eigener Auswahl.</translation>
    </message>
    <message>
        <source>All rasters get the grid of this raster: CRS, cell size, position of the cells, and extent. It must be in the CRS of the points, with square cells and north up. It replaces the cell size.</source>
        <translation>Alle Raster bekommen das Gitter dieses Rasters: KBS, Zellgröße, Lage der Zellen und Ausdehnung. Dieses muss im KBS der Punkte sein, mit quadratischen Zellen und Norden oben. Es tritt an die Stelle der Zellgröße.</translation>
    </message>
    <message>
        <source>All returns</source>
        <translation>Alle Echos</translation>
    </message>
    <message>
        <source>An extra dimension leaves everything else as it is. If the height replaces z, programs that cannot show extra dimensions show it too, but the terrain is flat.</source>
        <translation>Eine Zusatzdimension lässt alles andere, wie es ist. Tritt die Höhe über dem Boden an die Stelle von z, zeigen sie auch Programme, die keine Zusatzdimensionen kennen, aber das Gelände ist eben.</translation>
    </message>
    <message>
        <source>Angle of the light above the horizon.</source>
        <translation>Winkel des Lichts über dem Horizont.</translation>
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
        <source>Automatic: for the pictures, heights are smoothed as much as they are noisy, so that low plants in a forest do not speckle them. Banks, ditches and walls stay sharp, and so does open ground. The terrain model does not change.</source>
        <translation>Automatisch: Für die Bilder werden Höhen so stark geglättet, wie sie verrauscht sind, damit niedrige Pflanzen im Wald die Bilder nicht sprenkeln. Böschungen, Gräben und Mauern bleiben scharf, offener Boden auch. Das Geländemodell ändert sich nicht.</translation>
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
        <source>Canopy height</source>
        <translation>Kronenhöhe</translation>
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
        <source>Cell size of the water</source>
        <translation>Zellgröße der Gewässer</translation>
    </message>
    <message>
        <source>Cells of objects</source>
        <translation>Zellen von Objekten</translation>
    </message>
    <message>
        <source>Cells that are farther from a ground point are voids of the ground.</source>
        <translation>Zellen, die weiter von einem Bodenpunkt entfernt sind, sind Lücken des Bodens.</translation>
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
        <source>Check against checkpoints</source>
        <translation>Mit Kontrollpunkten vergleichen</translation>
    </message>
    <message>
        <source>Checkpoints</source>
        <translation>Kontrollpunkte</translation>
    </message>
    <message>
        <source>Checkpoints in triangles with a longer edge lie in a void of the ground, such as a building, and are not counted.</source>
        <translation>Kontrollpunkte in Dreiecken mit einer längeren Kante liegen in einer Lücke des Bodens, etwa einem Gebäude, und zählen nicht.</translation>
    </message>
    <message>
        <source>Checkpoints where the raster of confidence has less are not counted.</source>
        <translation>Kontrollpunkte, an denen das Raster der Verlässlichkeit weniger hat, zählen nicht.</translation>
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
        <source>Classes of the points that are ground. Add 8 if model key points have that class, 10 and 11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld points are not used.</source>
        <translation>Klassen der Punkte, die Boden sind. Fügen Sie 8 hinzu, wenn Schlüsselpunkte diese Klasse haben, 10 und 11 für Schienen und Straßen, die auf dem Boden liegen, und 9, wenn Wasser als Boden gilt. Zurückgehaltene Punkte (withheld) werden nicht benutzt.</translation>
    </message>
    <message>
        <source>Classes of the reference that are ground. Add 9 if water counts as ground.</source>
        <translation>Klassen der Referenz, die Boden sind. Fügen Sie 9 hinzu, wenn Wasser als Boden gilt.</translation>
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
        <source>Classified points only</source>
        <translation>Nur klassifizierte Punkte</translation>
    </message>
    <message>
        <source>Classified tiles</source>
        <translation>Klassifizierte Kacheln</translation>
    </message>
    <message>
        <source>Classifies the ground points of many files as if they were one file, and writes each file under its name into the output folder. A virtual point cloud (.vpc) lists the results.</source>
        <translation>Klassifiziert die Bodenpunkte vieler Dateien, als wären alle eine einzige, und schreibt jede Datei unter ihrem Namen in den Ausgabeordner. Eine virtuelle Punktwolke (.vpc) verzeichnet die Ergebnisse.</translation>
    </message>
    <message>
        <source>Classifies the points above the ground as well: low, medium and high vegetation (3, 4, 5) by height above ground, buildings (6), bridges (17) and high noise (18).</source>
        <translation>Klassifiziert auch die Punkte über dem Boden: niedrige, mittlere und hohe Vegetation (3, 4, 5) nach der Höhe über dem Boden, Gebäude (6), Brücken (17) und hohes Rauschen (18).</translation>
    </message>
    <message>
        <source>Classifies the points above the ground of a classified point cloud: low, medium and high vegetation (3, 4, 5) by height above ground, buildings (6), bridges (17) and high noise (18). Buildings are found by planes that laser pulses meet once; without return numbers the planes alone decide, and smooth crowns can become buildings.
Only points of class 0 and 1 change, unless you ask for more. Nothing else in the file changes. Lengths are metres, whatever the unit of the CRS.</source>
        <translation>Klassifiziert die Punkte über dem Boden einer klassifizierten Punktwolke: niedrige, mittlere und hohe Vegetation (3, 4, 5) nach der Höhe über Grund, Gebäude (6), Brücken (17) und hohes Rauschen (18). Gebäude werden an Ebenen erkannt, die ein Laserpuls nur einmal trifft; ohne Nummern der Echos entscheiden allein die Ebenen, und glatte Kronen können zu Gebäuden werden.
Nur Punkte der Klassen 0 und 1 ändern sich, wenn Sie nicht mehr verlangen. Sonst ändert sich nichts in der Datei. Längen sind Meter, unabhängig von der Einheit des KBS.</translation>
    </message>
    <message>
        <source>Classifies the points in a window with each of the settings, and makes a web page, which opens from the Results Viewer. It shows the terrain of each setting, a profile, the share of ground, where the settings differ, and how to run each of them on all points. No point cloud is written. Of a COPC file only the window is read, which takes seconds; a LAS or LAZ file is read as a whole.</source>
        <translation>Klassifiziert die Punkte eines Fensters mit jeder der Einstellungen und macht eine Webseite, die sich aus der Ergebnisanzeige öffnen lässt. Sie zeigt das Gelände zu jeder Einstellung, ein Profil, den Anteil des Bodens, wo sich die Einstellungen unterscheiden, und wie man jede von ihnen auf alle Punkte anwendet. Es wird keine Punktwolke geschrieben. Von einer COPC-Datei wird nur das Fenster gelesen, in Sekunden; eine LAS- oder LAZ-Datei wird ganz gelesen.</translation>
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
        <source>Closed lines that are shorter are left out: they show single plants and noise.</source>
        <translation>Kürzere geschlossene Linien werden weggelassen: Sie zeigen einzelne Pflanzen und Rauschen.</translation>
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
        <source>Compares heights above a surface that follows the terrain (white top-hat), not elevations, so that ground on slopes is not lost.</source>
        <translation>Vergleicht Höhen über einer Fläche, die dem Gelände folgt (weißer Top-Hat), nicht die Höhen selbst, damit Boden am Hang nicht verloren geht.</translation>
    </message>
    <message>
        <source>Compares the ground of a classified point cloud with a reference that holds the same points, or a part of them. Type I error: the share of the reference's ground that was rejected. Type II error: the share of all other points that was accepted as ground. The report is a web page with a map.</source>
        <translation>Vergleicht den Boden einer klassifizierten Punktwolke mit einer Referenz, die dieselben Punkte oder einen Teil davon enthält. Fehler 1. Art: der Anteil des Bodens der Referenz, der verworfen wurde. Fehler 2. Art: der Anteil aller anderen Punkte, der als Boden angenommen wurde. Der Bericht ist eine Webseite mit einer Karte.</translation>
    </message>
    <message>
        <source>Compares the triangulation (TIN) of the ground points of a classified point cloud, and a terrain model, with checkpoints: points that were surveyed on the ground. It gives the figures and the statement of the ASPRS Positional Accuracy Standards, edition 2, on land without vegetation (NVA) and with it (VVA). Nothing is shifted.
Without checkpoints, it can leave out a share of the ground points and measure how well the others predict them.</source>
        <translation>Vergleicht die Dreiecksvermaschung (TIN) der Bodenpunkte einer klassifizierten Punktwolke und ein Geländemodell mit Kontrollpunkten: Punkten, die am Boden vermessen wurden. Das Ergebnis sind die Kennzahlen und die Erklärung der ASPRS Positional Accuracy Standards, Ausgabe 2, für Flächen ohne Bewuchs (NVA) und mit Bewuchs (VVA). Nichts wird verschoben.
Ohne Kontrollpunkte kann ein Anteil der Bodenpunkte weggelassen und gemessen werden, wie gut die übrigen sie vorhersagen.</translation>
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
        <source>Confidence</source>
        <translation>Verlässlichkeit</translation>
    </message>
    <message>
        <source>Confidence of the terrain model</source>
        <translation>Verlässlichkeit des Geländemodells</translation>
    </message>
    <message>
        <source>Confidence of the terrain model, 0 to 1. Checkpoints where it is low are not counted.</source>
        <translation>Verlässlichkeit des Geländemodells, 0 bis 1. Kontrollpunkte, an denen sie gering ist, zählen nicht.</translation>
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
        <source>Corrections</source>
        <translation>Korrekturen</translation>
    </message>
    <message>
        <source>Counted checkpoints</source>
        <translation>Gezählte Kontrollpunkte</translation>
    </message>
    <message>
        <source>Cuts each raster of many files into one GeoTIFF for each file. They get the names of the files, in a folder with the name of the raster. A virtual raster (.vrt) beside this folder shows them as one.</source>
        <translation>Zerschneidet jedes Raster vieler Dateien in ein GeoTIFF je Datei. Sie bekommen die Namen der Dateien, in einem Ordner mit dem Namen des Rasters. Ein virtuelles Raster (.vrt) neben diesem Ordner zeigt sie als eines.</translation>
    </message>
    <message>
        <source>Deciding rules</source>
        <translation>Entscheidende Regeln</translation>
    </message>
    <message>
        <source>Decks of bridges, found by their cross-sections. Otherwise they become buildings or vegetation. Points that have class 17 already keep it.</source>
        <translation>Brückendecks, an ihren Querschnitten erkannt. Sonst werden sie zu Gebäuden oder Vegetation. Punkte, die schon Klasse 17 haben, behalten sie.</translation>
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
        <source>Depth of low outliers</source>
        <translation>Tiefe tiefer Ausreißer</translation>
    </message>
    <message>
        <source>Derived water surface</source>
        <translation>Abgeleitete Wasseroberfläche</translation>
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
        <source>Direction from which the light comes, clockwise from north. Four lights have their own directions.</source>
        <translation>Richtung, aus der das Licht kommt, von Norden aus im Uhrzeigersinn. Vier Lichter haben ihre eigenen Richtungen.</translation>
    </message>
    <message>
        <source>Distance between points. If it is larger than that of the cloud, only the upper levels of its octree are downloaded, whose points are about so far apart.</source>
        <translation>Abstand der Punkte. Ist er größer als der der Punktwolke, werden nur die oberen Stufen ihres Octrees heruntergeladen, deren Punkte etwa so weit auseinander liegen.</translation>
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
        <source>Downloads the points of a remote point cloud (COPC, EPT, or the one in a virtual point cloud or STAC item that has points there) that lie in an extent or a boundary: only the parts that are needed, as they are, with all of their dimensions. The log tells how much that is before it begins. If it is stopped, the same run goes on where it was.</source>
        <translation>Lädt die Punkte einer entfernten Punktwolke herunter (COPC, EPT oder die eine in einer virtuellen Punktwolke oder einem STAC-Item, die dort Punkte hat), die in einer Ausdehnung oder einer Grenze liegen: nur die Teile, die nötig sind, unverändert und mit allen Dimensionen. Das Protokoll nennt die Größe, bevor es beginnt. Wird der Lauf abgebrochen, macht derselbe Lauf dort weiter, wo er war.</translation>
    </message>
    <message>
        <source>Downloads the points of a remote point cloud that lie in an area.</source>
        <translation>Lädt die Punkte einer entfernten Punktwolke herunter, die in einem Gebiet liegen.</translation>
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
        <source>Files keep their names; only the ending follows the format.</source>
        <translation>Die Dateien behalten ihre Namen; nur die Endung richtet sich nach dem Format.</translation>
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
        <source>Find water</source>
        <translation>Gewässer finden</translation>
    </message>
    <message>
        <source>Finds lakes and rivers as polygons with their levels, and as breaklines.</source>
        <translation>Findet Seen und Flüsse als Polygone mit ihren Wasserspiegeln und als Bruchkanten.</translation>
    </message>
    <message>
        <source>Finds the few ground points of a classified point cloud that a terrain model needs. Of all other ground points, none lies farther above or below the triangulation (TIN) of these key points than the tolerances. Key points get a class of their own, or the key-point flag; nothing else in the file changes.
Lengths are metres, whatever the unit of the CRS.</source>
        <translation>Findet die wenigen Bodenpunkte einer klassifizierten Punktwolke, die ein Geländemodell braucht. Von allen anderen Bodenpunkten liegt keiner weiter über oder unter der Dreiecksvermaschung (TIN) dieser Schlüsselpunkte, als die Toleranzen erlauben. Schlüsselpunkte bekommen eine eigene Klasse oder das Kennzeichen der Schlüsselpunkte; sonst ändert sich nichts in der Datei.
Längen sind Meter, gleich welche Einheit das KBS hat.</translation>
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
        <source>Finds the ground of a raw lidar point cloud (TIN densification), adds the height above it to every point, and makes rasters of terrain and canopy height.</source>
        <translation>Findet den Boden einer rohen Lidar-Punktwolke (TIN-Verdichtung), fügt jedem Punkt die Höhe darüber hinzu und macht Raster von Gelände und Kronenhöhe.</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud (TIN densification), makes terrain model and hillshade of it, and contour lines of the terrain model (GDAL).</source>
        <translation>Findet den Boden einer rohen Lidar-Punktwolke (TIN-Verdichtung), macht daraus Geländemodell und Schummerung und aus dem Geländemodell Höhenlinien (GDAL).</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud and makes maps of it. Each output is optional. A delivery makes all that a job hands over, in one folder: for a survey, archaeology, forestry, floods or a drone site. Lengths are metres.</source>
        <translation>Findet den Boden einer rohen Lidar-Punktwolke und macht Karten davon. Jede Ausgabe ist optional. Eine Lieferung macht alles, was ein Auftrag übergibt, in einem Ordner: für eine Vermessung, Archäologie, Forst, Hochwasser oder ein Gelände aus einem Drohnenflug. Längen sind in Metern.</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud by TIN densification and by the slope filter, and compares the two: a hillshade of each, and a report with TIN densification as the reference. Where both agree, the result is more certain; check the places where they differ.</source>
        <translation>Findet den Boden einer rohen Lidar-Punktwolke durch TIN-Verdichtung und durch den Neigungsfilter und vergleicht beide: je eine Schummerung und ein Bericht mit der TIN-Verdichtung als Referenz. Wo beide übereinstimmen, ist das Ergebnis sicherer; prüfen Sie die Stellen, an denen sie sich unterscheiden.</translation>
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
        <source>Finds the ground points of airborne or drone lidar by progressive TIN densification, and writes a point cloud with the new classes; nothing else in it changes. The filter starts from a sparse triangulation (TIN) of points that are surely ground. Round by round it adds points that lie close to the TIN.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Findet die Bodenpunkte von Lidar aus Flugzeug oder Drohne durch progressive TIN-Verdichtung und schreibt eine Punktwolke mit den neuen Klassen; sonst ändert sich nichts in ihr. Der Filter beginnt mit einer weitmaschigen Dreiecksvermaschung (TIN) aus Punkten, die sicher Boden sind. Runde um Runde fügt er Punkte hinzu, die nahe am TIN liegen.
Längen sind Meter und Winkel Grad, gleich welche Einheit das KBS hat. Das Geländemodell und seine Schummerung sind GeoTIFFs.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar by slopes, and writes a point cloud with the new classes; nothing else in it changes. A point is not ground if it stands higher above a neighbour than terrain can. The preset Automatic compares points on many scales and follows the terrain; the preset Whitebox repeats WhiteboxTools' LidarGroundPointFilter.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Findet die Bodenpunkte von Lidar aus Flugzeug oder Drohne an Neigungen und schreibt eine Punktwolke mit den neuen Klassen; sonst ändert sich nichts in ihr. Ein Punkt ist kein Boden, wenn er höher über einem Nachbarn liegt, als es Gelände kann. Die Voreinstellung Automatisch vergleicht Punkte in vielen Maßstäben und folgt dem Gelände; die Voreinstellung Whitebox wiederholt LidarGroundPointFilter der WhiteboxTools.
Längen sind Meter und Winkel Grad, gleich welche Einheit das KBS hat. Das Geländemodell und seine Schummerung sind GeoTIFFs.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar on a grid of lowest points, and writes a point cloud with the new classes; nothing else in it changes. Steps between neighbouring cells are the rims of objects. What such rims enclose is removed, tall objects first. The method is fast, and needs only heights, no return numbers.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Findet die Bodenpunkte von Lidar aus Flugzeug oder Drohne auf einem Raster tiefster Punkte und schreibt eine Punktwolke mit den neuen Klassen; sonst ändert sich nichts in ihr. Stufen zwischen benachbarten Zellen sind die Ränder von Objekten. Was solche Ränder umschließen, wird entfernt, hohe Objekte zuerst. Das Verfahren ist schnell und braucht nur Höhen, keine Echos.
Längen sind Meter und Winkel Grad, gleich welche Einheit das KBS hat. Das Geländemodell und seine Schummerung sind GeoTIFFs.</translation>
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
        <source>Finds water in a classified point cloud: where hardly any last return is, and the ground along the shore is level or falls steadily, or where points have class 9. Gaps between strips, roofs and woods are told from it. Each polygon has the level, the spread of the shore, and a grade of certainty. The terrain model takes the polygons as water.</source>
        <translation>Findet Gewässer in einer klassifizierten Punktwolke: wo kaum letzte Echos sind und der Boden am Ufer eben ist oder stetig fällt, oder wo Punkte die Klasse 9 haben. Lücken zwischen Flugstreifen, Dächer und Wälder werden davon unterschieden. Jedes Polygon hat den Wasserspiegel, die Streuung des Ufers und einen Grad der Sicherheit. Das Geländemodell nimmt die Polygone als Gewässer.</translation>
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
        <source>First returns hit the tops of trees and buildings. Take all returns if the return numbers of the file are wrong.</source>
        <translation>Erste Echos treffen die Oberseite von Bäumen und Gebäuden. Nehmen Sie alle Echos, wenn die Nummern der Echos in der Datei falsch sind.</translation>
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
        <source>For the lines, each height is averaged with its surroundings up to about this distance, so that they do not show noise. The terrain model does not change. 0: as the terrain model is.</source>
        <translation>Für die Linien wird jede Höhe mit ihrer Umgebung bis etwa zu dieser Entfernung gemittelt, damit sie kein Rauschen zeigen. Das Geländemodell ändert sich nicht. 0: wie das Geländemodell ist.</translation>
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
        <source>GB</source>
        <translation>GB</translation>
    </message>
    <message>
        <source>Gaps inside the survey are filled by triangles. A triangle with a longer edge than this has no data, for example over water. Empty: all gaps inside are filled. Beyond the outline of the points no raster has data in any case.</source>
        <translation>Lücken innerhalb der Befliegung werden mit Dreiecken gefüllt. Ein Dreieck mit einer längeren Kante als dieser hat keine Werte, zum Beispiel über Wasser. Leer: Alle Lücken darin werden gefüllt. Außerhalb des Umrisses der Punkte hat ein Raster in keinem Fall Werte.</translation>
    </message>
    <message>
        <source>Get lazrs</source>
        <translation>lazrs holen</translation>
    </message>
    <message>
        <source>Gigabytes that may be downloaded of a remote point cloud. The log tells how many it takes before the download begins; more are refused.</source>
        <translation>Gigabyte, die von einer entfernten Punktwolke heruntergeladen werden dürfen. Das Protokoll sagt vor dem Herunterladen, wie viele es sind; mehr werden abgelehnt.</translation>
    </message>
    <message>
        <source>Give an extent or a boundary, not both, for an address.</source>
        <translation>Geben Sie für eine Adresse eine Ausdehnung oder eine Grenze an, nicht beides.</translation>
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
        <source>Go on if tiles of an EPT data set are missing on the server. A warning counts them.</source>
        <translation>Weitermachen, wenn Kacheln eines EPT-Datensatzes auf dem Server fehlen. Eine Warnung zählt sie.</translation>
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
        <source>Ground points in polygons of water become water (9), and those within a distance of the shore ignored ground (20), as the Lidar Base Specification asks for. Nothing else in the file changes: points with other classes keep them.</source>
        <translation>Bodenpunkte in Polygonen des Wassers werden Wasser (9) und die in einem Abstand vom Ufer ignorierter Boden (20), wie es die Lidar Base Specification verlangt. Sonst ändert sich nichts in der Datei: Punkte mit anderen Klassen behalten diese.</translation>
    </message>
    <message>
        <source>Ground points outside of the water, up to this far from its shore, become ignored ground: there the breakline alone decides the terrain. The Lidar Base Specification asks for one nominal point spacing: 0.7 m for QL2, 0.35 m for QL1. 0: none.</source>
        <translation>Bodenpunkte außerhalb des Wassers bis zu diesem Abstand vom Ufer werden ignorierter Boden: Dort bestimmt allein die Bruchkante das Gelände. Die Lidar Base Specification verlangt den nominellen Punktabstand: 0,7 m bei QL2, 0,35 m bei QL1. 0: keine.</translation>
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
        <source>Ground: {}</source>
        <translation>Boden: {}</translation>
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
        <source>Heights above ground</source>
        <translation>Höhen über Grund</translation>
    </message>
    <message>
        <source>Heights are measured above this raster, and not above the ground points. It must have the CRS of the points. Empty: above the ground points.</source>
        <translation>Höhen werden über diesem Raster gemessen und nicht über den Bodenpunkten. Es muss das KBS der Punkte haben. Leer: über den Bodenpunkten.</translation>
    </message>
    <message>
        <source>Heights of the bare ground.</source>
        <translation>Höhen des nackten Bodens.</translation>
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
        <source>How far a ground point may lie above the TIN of the key points. Choose about the accuracy of the heights, or half the contour interval that you want.</source>
        <translation>Wie weit ein Bodenpunkt über dem TIN der Schlüsselpunkte liegen darf. Wählen Sie etwa die Genauigkeit der Höhen oder die halbe Äquidistanz der gewünschten Höhenlinien.</translation>
    </message>
    <message>
        <source>How far a ground point may lie below the TIN of the key points.</source>
        <translation>Wie weit ein Bodenpunkt unter dem TIN der Schlüsselpunkte liegen darf.</translation>
    </message>
    <message>
        <source>How many threads compute at the same time. The result does not depend on it. Empty: as many as there are processors.</source>
        <translation>Wie viele Threads gleichzeitig rechnen. Das Ergebnis hängt nicht davon ab. Leer: so viele, wie es Prozessoren gibt.</translation>
    </message>
    <message>
        <source>IGN LiDAR HD</source>
        <translation>IGN LiDAR HD</translation>
    </message>
    <message>
        <source>If this is off, only points of class 0 and 1 change. If it is on, points of class 3 to 6 are decided anew as well. All others keep their class, such as water (9) and wires.</source>
        <translation>Wenn dies aus ist, ändern sich nur Punkte der Klassen 0 und 1. Wenn es an ist, werden auch Punkte der Klassen 3 bis 6 neu entschieden. Alle anderen behalten ihre Klasse, etwa Wasser (9) und Leitungen.</translation>
    </message>
    <message>
        <source>Ignored classes of the reference</source>
        <translation>Nicht beachtete Klassen der Referenz</translation>
    </message>
    <message>
        <source>Ignored ground</source>
        <translation>Ausgelassener Boden</translation>
    </message>
    <message>
        <source>Ignored ground beside the shore</source>
        <translation>Ignorierter Boden neben dem Ufer</translation>
    </message>
    <message>
        <source>In a CRS in feet, a size of 3 in units of the CRS gives cells of exactly 3 feet that begin at whole multiples of 3 feet.</source>
        <translation>In einem KBS in Fuß ergibt eine Größe von 3 in Einheiten des KBS Zellen von genau 3 Fuß, die an ganzen Vielfachen von 3 Fuß beginnen.</translation>
    </message>
    <message>
        <source>In each cell of this size that has ground points, at least the lowest one is a key point, however flat the ground is.</source>
        <translation>In jeder Zelle dieser Größe, die Bodenpunkte hat, ist mindestens der tiefste ein Schlüsselpunkt, wie eben der Boden auch ist.</translation>
    </message>
    <message>
        <source>In level terrain, points down to this depth below the final surface are ground. The surface goes through the lowest points, but is smoother than they are.</source>
        <translation>In ebenem Gelände sind Punkte bis zu dieser Tiefe unter der endgültigen Fläche Boden. Die Fläche geht durch die tiefsten Punkte, ist aber glatter als sie.</translation>
    </message>
    <message>
        <source>In level terrain, points up to this height above the final surface are ground. A larger value takes in grass and low bushes.</source>
        <translation>In ebenem Gelände sind Punkte bis zu dieser Höhe über der endgültigen Fläche Boden. Ein größerer Wert nimmt Gras und niedrige Büsche mit auf.</translation>
    </message>
    <message>
        <source>In level terrain, points up to this height above the surface of the ground are ground. Empty: from the preset.</source>
        <translation>In ebenem Gelände sind Punkte bis zu dieser Höhe über der Bodenfläche Boden. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>In level terrain, points up to this height above the surface through the ground are ground. Not used with the preset Whitebox.</source>
        <translation>In ebenem Gelände sind Punkte bis zu dieser Höhe über der Fläche durch den Boden Boden. Nicht für die Voreinstellung Whitebox.</translation>
    </message>
    <message>
        <source>In scripts</source>
        <translation>In Skripten</translation>
    </message>
    <message>
        <source>In triangles whose longest edge is shorter than this, the iteration angle is reduced in proportion. So the TIN does not climb low vegetation step by step. Empty: the angle is never reduced.</source>
        <translation>In Dreiecken, deren längste Kante kürzer ist als dies, wird der Iterationswinkel im Verhältnis kleiner. So erklimmt das TIN niedrigen Bewuchs nicht Schritt für Schritt. Leer: Der Winkel wird nie kleiner.</translation>
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
        <source>Keep; old ground that is not ground now becomes 1</source>
        <translation>Behalten; früherer Boden, der jetzt kein Boden ist, wird 1</translation>
    </message>
    <message>
        <source>Keeps the tiles that an earlier run finished, if they were made from the same files with the same parameters. All other tiles are classified again.</source>
        <translation>Behält die Kacheln, die ein früherer Lauf fertiggestellt hat, wenn sie aus denselben Dateien mit denselben Parametern entstanden. Alle anderen Kacheln werden neu klassifiziert.</translation>
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
        <source>Largest angle between a triangle and the line from one of its corners to a new point. A larger angle follows rugged ground better, a smaller one keeps low objects out: 4 deg in flat terrain, 10 deg and more in steep terrain. Empty: from the preset.</source>
        <translation>Größter Winkel zwischen einem Dreieck und der Linie von einer seiner Ecken zu einem neuen Punkt. Ein größerer Winkel folgt rauem Gelände besser, ein kleinerer hält niedrige Objekte fern: 4 Grad in flachem, 10 Grad und mehr in steilem Gelände. Leer: aus der Voreinstellung.</translation>
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
        <source>Last returns reach the ground. Take all returns if the return numbers of the file are wrong.</source>
        <translation>Letzte Echos erreichen den Boden. Nehmen Sie alle Echos, wenn die Nummern der Echos in der Datei falsch sind.</translation>
    </message>
    <message>
        <source>Least area of a roof</source>
        <translation>Kleinste Fläche eines Dachs</translation>
    </message>
    <message>
        <source>Least confidence</source>
        <translation>Geringste Verlässlichkeit</translation>
    </message>
    <message>
        <source>Least height of a roof</source>
        <translation>Kleinste Höhe eines Dachs</translation>
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
        <source>Leaves out so large a share of the ground points of a delivery, and states how well the others predict them. Empty: this is not measured.</source>
        <translation>Lässt einen so großen Anteil der Bodenpunkte einer Lieferung weg und gibt an, wie gut die übrigen sie vorhersagen. Leer: Das wird nicht gemessen.</translation>
    </message>
    <message>
        <source>Leaves out so large a share of the ground points, such as 0.02, and measures how well the others predict them, on open land, under trees and on steep land. This needs no checkpoints, but it does not tell how right the heights are.</source>
        <translation>Lässt einen so großen Anteil der Bodenpunkte weg, etwa 0,02, und misst, wie gut die übrigen sie vorhersagen: auf freiem Land, unter Bäumen und an steilen Stellen. Das braucht keine Kontrollpunkte, sagt aber nicht, wie richtig die Höhen sind.</translation>
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
        <source>Line of the profile</source>
        <translation>Linie des Profils</translation>
    </message>
    <message>
        <source>Lines along which the level of the water polygons falls. They may be drawn in either direction.</source>
        <translation>Linien, entlang derer der Wasserspiegel der Wasserpolygone fällt. Sie dürfen in beliebiger Richtung gezeichnet sein.</translation>
    </message>
    <message>
        <source>Lines of equal height of the terrain model, with the field ELEV.</source>
        <translation>Linien gleicher Höhe des Geländemodells, mit dem Feld ELEV.</translation>
    </message>
    <message>
        <source>Lines of equal height of the terrain model, with the field ELEV. They are smoothed, so that they do not show noise. Every fifth line has its height as a label.</source>
        <translation>Linien gleicher Höhe des Geländemodells, mit dem Feld ELEV. Sie sind geglättet, damit sie kein Rauschen zeigen. Jede fünfte Linie ist mit ihrer Höhe beschriftet.</translation>
    </message>
    <message>
        <source>Lines that no triangle of the terrain crosses: edges of walls, dykes and terraces. A line with z has this height. Without z, each side of the line has the height of the nearest ground point on that side.</source>
        <translation>Linien, über die kein Dreieck des Geländes hinweggeht: Kanten von Mauern, Deichen und Terrassen. Eine Linie mit z hat diese Höhe. Ohne z hat jede Seite der Linie die Höhe des nächsten Bodenpunkts auf dieser Seite.</translation>
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
        <source>Local relief, openness, sky view and the like compare a place with its surroundings up to this distance. Choose about the width of the features that you want to see; larger landforms disappear.</source>
        <translation>Lokales Relief, Offenheit, sichtbarer Himmel und ähnliche vergleichen jeden Ort bis zu dieser Entfernung mit seiner Umgebung. Wählen Sie etwa die Breite der Formen, die Sie sehen wollen; größere Landformen verschwinden.</translation>
    </message>
    <message>
        <source>Longest edge of a triangle</source>
        <translation>Längste Kante eines Dreiecks</translation>
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
        <source>Makes a map of the terrain of a raw point cloud: classes, models, contours.</source>
        <translation>Macht aus einer rohen Punktwolke eine Karte des Geländes: Klassen, Modelle, Höhenlinien.</translation>
    </message>
    <message>
        <source>Makes a terrain model from a surface model, if there is no point cloud. Removes what stands above the terrain around it, has steep edges on all sides and is not wider than the maximum object size. Fills the gaps smoothly. Hills and slopes stay.
The output has the same grid, CRS and unit. Lengths are metres, whatever the unit of the CRS.</source>
        <translation>Macht aus einem Oberflächenmodell ein Geländemodell, wenn es keine Punktwolke gibt. Entfernt, was über dem Gelände ringsum steht, auf allen Seiten steile Kanten hat und nicht breiter ist als die größte Objektbreite. Füllt die Lücken glatt. Hügel und Hänge bleiben.
Die Ausgabe hat dasselbe Raster, KBS und dieselbe Einheit. Längen sind Meter, gleich welche Einheit das KBS hat.</translation>
    </message>
    <message>
        <source>Makes pictures of the relief of any elevation raster, on the same grid: sky-view factor, openness, local dominance, local relief, slope, hillshade, archaeological topography (VAT) and red relief. They show small features that a hillshade of one light hides.
For walls and banks make the terrain model in cells of 0.25 to 0.5 m.</source>
        <translation>Macht Bilder des Reliefs eines beliebigen Höhenrasters, im selben Gitter: Himmelssichtfaktor, Offenheit, lokale Dominanz, lokales Relief, Neigung, Schummerung, archäologische Topographie (VAT) und rotes Relief. Sie zeigen kleine Formen, die eine Schummerung mit nur einem Licht verbirgt.
Für Mauern und Wälle machen Sie das Geländemodell mit Zellen von 0,25 bis 0,5 m.</translation>
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
        <source>Mark model key points</source>
        <translation>Modell-Schlüsselpunkte kennzeichnen</translation>
    </message>
    <message>
        <source>Marks the ground points of a delivery that a terrain model needs, by the key-point flag of LAS.</source>
        <translation>Kennzeichnet die Bodenpunkte einer Lieferung, die ein Geländemodell braucht, mit dem Kennzeichen der Schlüsselpunkte in LAS.</translation>
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
        <source>Mean difference [m]</source>
        <translation>Mittlere Abweichung [m]</translation>
    </message>
    <message>
        <source>Measures a classified survey, of one file or many: densities of first returns and of ground points, voids, low vegetation, overlap of flight strips and differences between them, classes and file formats. It compares the figures with a specification, and makes a web page, which opens from the Results Viewer, and rasters.</source>
        <translation>Misst eine klassifizierte Befliegung, aus einer Datei oder vielen: Dichten der ersten Echos und der Bodenpunkte, Lücken, niedrige Vegetation, Überlappung der Flugstreifen und Unterschiede zwischen ihnen, Klassen und Dateiformate. Vergleicht die Zahlen mit einer Spezifikation und erstellt eine Webseite, die sich aus der Ergebnisanzeige öffnen lässt, und Raster.</translation>
    </message>
    <message>
        <source>Measures densities, voids and strips, and compares them with a specification.</source>
        <translation>Misst Dichten, Lücken und Flugstreifen und vergleicht sie mit einer Spezifikation.</translation>
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
        <source>Methods, each with a preset. All others are compared with the first one.</source>
        <translation>Verfahren, jedes mit einer Voreinstellung. Alle anderen werden mit dem ersten verglichen.</translation>
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
        <translation>Modellschlüsselpunkt</translation>
    </message>
    <message>
        <source>Models</source>
        <translation>Modelle</translation>
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
        <source>Not ground, except with a classic preset</source>
        <translation>Kein Boden, außer mit einer klassischen Voreinstellung</translation>
    </message>
    <message>
        <source>Not ground: {}</source>
        <translation>Kein Boden: {}</translation>
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
        <source>Number of the raster's band that holds the heights.</source>
        <translation>Nummer des Kanals, der die Höhen enthält.</translation>
    </message>
    <message>
        <source>Objects have edges steeper than this on all sides. What rises more gently on some side is a hill. The slopes of the terrain below do not count.</source>
        <translation>Objekte haben auf allen Seiten Kanten, die steiler sind als dies. Was auf einer Seite sanfter ansteigt, ist ein Hügel. Die Hänge des Geländes darunter zählen nicht.</translation>
    </message>
    <message>
        <source>One light</source>
        <translation>Ein Licht</translation>
    </message>
    <message>
        <source>One light shows best the landforms that lie across it, but slopes that face away are dark. Four lights show landforms of any direction.</source>
        <translation>Ein Licht zeigt am besten die Geländeformen, die quer zu ihm liegen, aber abgewandte Hänge sind dunkel. Vier Lichter zeigen Geländeformen jeder Richtung.</translation>
    </message>
    <message>
        <source>One pass for each threshold, the largest first. If two neighbouring cells differ by more than the threshold, the higher one is the rim of an object. Empty: from the preset.</source>
        <translation>Ein Durchgang für jede Schwelle, von der größten an. Wenn sich zwei benachbarte Zellen um mehr als die Schwelle unterscheiden, ist die höhere der Rand eines Objekts. Leer: aus der Voreinstellung.</translation>
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
        <source>Only points in these polygons are classified, and rasters end at them; with an extent, only what lies in both. Points outside keep their class, but those nearby help to judge. Empty: all points.</source>
        <translation>Nur Punkte in diesen Polygonen werden klassifiziert, und Raster enden an ihnen; gibt es eine Ausdehnung, gilt nur, was in beiden liegt. Punkte außerhalb behalten ihre Klasse, doch die in der Nähe helfen beim Urteil. Leer: alle Punkte.</translation>
    </message>
    <message>
        <source>Only points in these polygons are downloaded; with an extent, only points in both. Empty: all points.</source>
        <translation>Nur Punkte in diesen Polygonen werden heruntergeladen, mit einer Ausdehnung nur Punkte in beiden. Leer: alle Punkte.</translation>
    </message>
    <message>
        <source>Only points in these polygons are mapped and written; with an extent, only points in both. Points nearby help to judge. Empty: all points.</source>
        <translation>Nur Punkte in diesen Polygonen werden kartiert und geschrieben; gibt es eine Ausdehnung, nur Punkte in beiden. Punkte in der Nähe helfen beim Urteil. Leer: alle Punkte.</translation>
    </message>
    <message>
        <source>Only points in this rectangle are classified, and rasters end at it. Points outside keep their class, but those nearby help to judge. Empty: all points.</source>
        <translation>Nur Punkte in diesem Rechteck werden klassifiziert, und Raster enden an ihm. Punkte außerhalb behalten ihre Klasse, doch die in der Nähe helfen beim Urteil. Leer: alle Punkte.</translation>
    </message>
    <message>
        <source>Only points in this rectangle are downloaded. Empty: all points.</source>
        <translation>Nur Punkte in diesem Rechteck werden heruntergeladen. Leer: alle Punkte.</translation>
    </message>
    <message>
        <source>Only points in this rectangle are mapped and written. Points nearby help to judge. Empty: all points.</source>
        <translation>Nur Punkte in diesem Rechteck werden kartiert und geschrieben. Punkte in der Nähe helfen beim Urteil. Leer: alle Punkte.</translation>
    </message>
    <message>
        <source>Only points of these classes make the surface, such as 41 for a water surface, or 2 and 6 for terrain with buildings. Empty: all classes but low and high noise (7 and 18) and what lies in water (43 to 45); if the bottom of waters (40) is ground, their surfaces (41 and 42) are left out, too.</source>
        <translation>Nur Punkte dieser Klassen bilden die Oberfläche, etwa 41 für eine Wasseroberfläche, oder 2 und 6 für Gelände mit Gebäuden. Leer: alle Klassen außer tiefem und hohem Rauschen (7 und 18) und dem, was im Wasser liegt (43 bis 45); ist der Grund von Gewässern (40) Boden, bleiben auch ihre Oberflächen (41 und 42) weg.</translation>
    </message>
    <message>
        <source>Only points of these classes take part and may change their class. Empty: 0 to 6, 8, 12 and the class of the ground. Points of other classes, such as water (9) and bridge decks (17), keep their class. Rails and roads (10 and 11) keep theirs too, but take part. all: all classes but low and high noise (7 and 18).</source>
        <translation>Nur Punkte dieser Klassen nehmen teil und können ihre Klasse ändern. Leer: 0 bis 6, 8, 12 und die Klasse des Bodens. Punkte anderer Klassen, etwa Wasser (9) und Fahrbahnen von Brücken (17), behalten ihre Klasse. Schienen und Straßen (10 und 11) behalten ihre auch, nehmen aber teil. all: alle Klassen außer tiefem und hohem Rauschen (7 und 18).</translation>
    </message>
    <message>
        <source>Only the points that a terrain model needs become ground. Of all other ground points, none lies farther from the TIN of these key points than the two tolerances below.</source>
        <translation>Nur die Punkte, die ein Geländemodell braucht, werden Boden. Von allen anderen Bodenpunkten liegt keiner weiter vom TIN dieser Schlüsselpunkte entfernt, als die beiden folgenden Toleranzen erlauben.</translation>
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
        <source>Overview of the classes</source>
        <translation>Übersicht der Klassen</translation>
    </message>
    <message>
        <source>Overview of the virtual point cloud</source>
        <translation>Übersicht der virtuellen Punktwolke</translation>
    </message>
    <message>
        <source>Own choice of outputs</source>
        <translation>Eigene Auswahl der Ausgaben</translation>
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
        <source>Point cloud</source>
        <translation>Punktwolke</translation>
    </message>
    <message>
        <source>Point cloud to terrain</source>
        <translation>Von der Punktwolke zum Gelände</translation>
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
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Points 0.2 to 2 m above the ground</source>
        <translation>Punkte 0,2 bis 2 m über dem Boden</translation>
    </message>
    <message>
        <source>Points are compared with their neighbours up to this distance. Choose at least half the shorter side of the largest building. Empty: from the preset, 18 m in the automatic one (more if points are sparse), 2 m in Whitebox.</source>
        <translation>Punkte werden mit ihren Nachbarn bis zu dieser Entfernung verglichen. Wählen Sie mindestens die halbe kürzere Seite des größten Gebäudes. Leer: aus der Voreinstellung, in der automatischen 18 m (mehr bei geringer Punktdichte), in Whitebox 2 m.</translation>
    </message>
    <message>
        <source>Points below this height above ground, and points below the ground, become class 1.</source>
        <translation>Punkte unter dieser Höhe über Grund und Punkte unter dem Boden bekommen Klasse 1.</translation>
    </message>
    <message>
        <source>Points in the area</source>
        <translation>Punkte im Gebiet</translation>
    </message>
    <message>
        <source>Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in older files. If strips do not fit together, leave them out of ground and surface.</source>
        <translation>Punkte in der Überlappung von Flugstreifen, nach ihrem Kennzeichen in LAS 1.4 oder, in älteren Dateien, nach Klasse 12. Wenn Streifen nicht zusammenpassen, lassen Sie diese Punkte bei Boden und Oberfläche weg.</translation>
    </message>
    <message>
        <source>Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in older files. If strips do not fit together, leave them out: ground, and rasters made in the same run, then come from one strip everywhere.</source>
        <translation>Punkte in der Überlappung von Flugstreifen, nach ihrem Kennzeichen in LAS 1.4 oder, in älteren Dateien, nach Klasse 12. Wenn Streifen nicht zusammenpassen, lassen Sie diese Punkte weg: Der Boden, und Raster aus demselben Lauf, stammen dann überall aus einem einzigen Streifen.</translation>
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
        <source>Points of these classes are certain ground, whatever their return: the filter does not judge them, and TIN densification starts from them. They get the class of the ground, unless their class is not among the classes to classify. Empty: none.</source>
        <translation>Punkte dieser Klassen sind sicher Boden, gleich welches Echo: Der Filter beurteilt sie nicht, und die TIN-Verdichtung beginnt mit ihnen. Sie bekommen die Klasse des Bodens, außer wenn ihre Klasse nicht zu den zu klassifizierenden gehört. Leer: keine.</translation>
    </message>
    <message>
        <source>Points of these classes of the reference are not counted, for example noise (7, 18). Empty: all points are counted.</source>
        <translation>Punkte dieser Klassen der Referenz werden nicht gezählt, zum Beispiel Rauschen (7, 18). Leer: Alle Punkte zählen.</translation>
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
        <source>Points that took part and hang far above all others of their place, alone or in small groups (birds, clouds, faults of the sensor) become high noise, class 18. Wires, masts and trees do not. Surface and canopy models never use such points, whether this is on or off.</source>
        <translation>Punkte, die teilnahmen und weit über allen anderen an ihrer Stelle hängen, allein oder in kleinen Gruppen (Vögel, Wolken, Fehler des Sensors), werden hohes Rauschen, Klasse 18. Leitungen, Masten und Bäume nicht. Oberflächen- und Kronenhöhenmodelle benutzen solche Punkte nie, ob dies an ist oder aus.</translation>
    </message>
    <message>
        <source>Points that took part and lie far below the ground (multipath, faults of the sensor) become low noise, class 7. If this is off, they are treated as other points.</source>
        <translation>Punkte, die teilnahmen und weit unter dem Boden liegen (Mehrwegeausbreitung, Fehler des Sensors), werden tiefes Rauschen, Klasse 7. Ist dies aus, werden sie wie die übrigen Punkte behandelt.</translation>
    </message>
    <message>
        <source>Points that were surveyed on the ground, of any CRS, or a table (.csv) in the CRS of the point cloud. May stay empty if points are held out.</source>
        <translation>Punkte, die am Boden vermessen wurden, in beliebigem KBS, oder eine Tabelle (.csv) im KBS der Punktwolke. Kann leer bleiben, wenn Punkte weggelassen werden.</translation>
    </message>
    <message>
        <source>Points up to this distance outside the window are read too, but not shown. A larger value is slower, and gives classes closer to those of the whole file near the edges of the window and beside large buildings. Empty: as far as the methods look, at most 50 m.</source>
        <translation>Punkte bis zu dieser Entfernung außerhalb des Fensters werden auch gelesen, aber nicht gezeigt. Ein größerer Wert ist langsamer und gibt nahe dem Rand des Fensters und neben großen Gebäuden Klassen, die näher an denen der ganzen Datei sind. Leer: so weit die Verfahren schauen, höchstens 50 m.</translation>
    </message>
    <message>
        <source>Points with a new class</source>
        <translation>Punkte mit neuer Klasse</translation>
    </message>
    <message>
        <source>Polygons in which the terrain uses no ground points, such as bridges and roofs. The classes of the points do not change.</source>
        <translation>Polygone, in denen das Gelände keine Bodenpunkte benutzt, etwa Brücken und Dächer. Die Klassen der Punkte ändern sich nicht.</translation>
    </message>
    <message>
        <source>Polygons in which you know the class. It replaces the result of the filter. If it is the class of the ground, points of the chosen returns are ground. Any other class is given to all points, and the filter does not use them. Where polygons overlap, the last one counts.</source>
        <translation>Polygone, in denen Sie die Klasse kennen. Sie tritt an die Stelle des Ergebnisses des Filters. Ist es die Klasse des Bodens, sind Punkte der gewählten Echos Boden. Jede andere Klasse bekommen alle Punkte, und der Filter benutzt diese nicht. Wo sich Polygone überlappen, zählt das letzte.</translation>
    </message>
    <message>
        <source>Polygons of water, with islands as holes. Empty: the water is found first, as 'Find water' does with its default values.</source>
        <translation>Polygone des Wassers, mit Inseln als Löchern. Leer: Das Wasser wird zuerst gefunden, wie es 'Gewässer finden' mit seinen Vorgaben tut.</translation>
    </message>
    <message>
        <source>Polygons of water. Each is flattened to one level, that of the ground along its border.</source>
        <translation>Polygone von Gewässern. Jedes wird auf eine Höhe eingeebnet, die des Bodens an seinem Rand.</translation>
    </message>
    <message>
        <source>Polygons with the level (LEVEL), the spread of the shore in metres (SPREAD) and a grade of certainty (GRADE).</source>
        <translation>Polygone mit dem Wasserspiegel (LEVEL), der Streuung des Ufers in Metern (SPREAD) und einem Grad der Sicherheit (GRADE).</translation>
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
        <source>RMSE of the heights of the checkpoints themselves, as their survey states it. The standard adds it to that of the data: square root of the sum of the squares.</source>
        <translation>RMSE der Höhen der Kontrollpunkte selbst, wie ihre Vermessung sie angibt. Der Standard rechnet sie zu der der Daten: Wurzel aus der Summe der Quadrate.</translation>
    </message>
    <message>
        <source>RMSE with vegetation [m]</source>
        <translation>RMSE mit Bewuchs [m]</translation>
    </message>
    <message>
        <source>RMSE without vegetation [m]</source>
        <translation>RMSE ohne Bewuchs [m]</translation>
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
        <source>Ready. Compressed point clouds (.laz) need one more package, which is installed only once.</source>
        <translation>Bereit. Komprimierte Punktwolken (.laz) brauchen noch ein Paket, das nur einmal installiert wird.</translation>
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
        <source>Rivers</source>
        <translation>Flüsse</translation>
    </message>
    <message>
        <source>Rivers that are narrower on average are left out. The Lidar Base Specification asks for 30 m (100 ft) and more.</source>
        <translation>Flüsse, die im Mittel schmaler sind, werden weggelassen. Die Lidar Base Specification verlangt 30 m (100 ft) und mehr.</translation>
    </message>
    <message>
        <source>Roofs are at least this high above the ground. Lower ones are cars and hedges too.</source>
        <translation>Dächer sind mindestens so hoch über dem Boden. Niedrigeres sind auch Autos und Hecken.</translation>
    </message>
    <message>
        <source>Roofs are planes of some size that a laser pulse meets once. Walls below their edges, and chimneys and dormers, belong to them.</source>
        <translation>Dächer sind Ebenen von einiger Größe, die ein Laserpuls nur einmal trifft. Wände unter ihren Rändern, Schornsteine und Gauben gehören dazu.</translation>
    </message>
    <message>
        <source>Rule that decided each cell</source>
        <translation>Regel, die über jede Zelle entschied</translation>
    </message>
    <message>
        <source>Search radius</source>
        <translation>Suchradius</translation>
    </message>
    <message>
        <source>Searches each folder with all its subfolders.</source>
        <translation>Durchsucht jeden Ordner samt allen Unterordnern.</translation>
    </message>
    <message>
        <source>Set to 1 (unclassified)</source>
        <translation>Auf 1 setzen (nicht klassifiziert)</translation>
    </message>
    <message>
        <source>Sets the fields that are left empty, to values that suit most land (automatic) or a kind of terrain. The log says which values were used.</source>
        <translation>Bestimmt die Werte der leeren Felder: passend zu den meisten Landschaften (automatisch) oder zu einer Geländeart. Das Protokoll sagt, welche Werte benutzt wurden.</translation>
    </message>
    <message>
        <source>Sets the fields that are left empty. Automatic and the kinds of terrain remove buildings as well as shrubs. Whitebox is the classic filter with the values of WhiteboxTools: within its radius of 2 m it cannot find a building.</source>
        <translation>Bestimmt die Werte der leeren Felder. Automatisch und die Geländearten entfernen Gebäude ebenso wie Sträucher. Whitebox ist der klassische Filter mit den Werten der WhiteboxTools: In seinem Radius von 2 m erkennt er kein Gebäude.</translation>
    </message>
    <message>
        <source>Sets the fields that are left empty: from the points (automatic), or to values that suit a kind of terrain. The log says which values were used.</source>
        <translation>Bestimmt die Werte der leeren Felder: aus den Punkten (automatisch) oder passend zu einer Geländeart. Das Protokoll sagt, welche Werte benutzt wurden.</translation>
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
        <source>Share of wrong points</source>
        <translation>Anteil falscher Punkte</translation>
    </message>
    <message>
        <source>Shores, islands and the middles of rivers as lines with heights.</source>
        <translation>Ufer, Inseln und die Mitten der Flüsse als Linien mit Höhen.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building or other object. Nothing that is narrower and stands out from its surroundings can be a seed of the ground. A value that is too large takes longer and loses sharp hilltops. Empty: from the preset.</source>
        <translation>Kürzere Seite des größten Gebäudes oder sonstigen Objekts. Nichts, was schmaler ist und aus seiner Umgebung herausragt, kann ein Startpunkt des Bodens sein. Ein zu großer Wert dauert länger und verliert spitze Kuppen. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building. A larger value takes longer, and may remove steep hilltops as objects.</source>
        <translation>Kürzere Seite des größten Gebäudes. Ein größerer Wert dauert länger und kann steile Kuppen als Objekte entfernen.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building. Anything wider is terrain. Empty: from the preset.</source>
        <translation>Kürzere Seite des größten Gebäudes. Was breiter ist, ist Gelände. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building. Buildings wider than two search radii are found by the drop on all their sides. Empty: from the preset, or two search radii if the search radius is given. Not used with the preset Whitebox.</source>
        <translation>Kürzere Seite des größten Gebäudes. Gebäude, die breiter sind als zwei Suchradien, werden am Abfall auf allen Seiten erkannt. Leer: aus der Voreinstellung, oder zwei Suchradien, wenn der Suchradius angegeben ist. Nicht für die Voreinstellung Whitebox.</translation>
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
        <source>Side of a cell of the error map. The map in the report has its own cell size.</source>
        <translation>Seite einer Zelle der Fehlerkarte. Die Karte im Bericht hat ihre eigene Zellgröße.</translation>
    </message>
    <message>
        <source>Side of a cell of the rasters. Choose about the distance between ground points.</source>
        <translation>Seite einer Zelle der Raster. Wählen Sie etwa den Abstand der Bodenpunkte.</translation>
    </message>
    <message>
        <source>Side of a cell of the terrain model and of its hillshade. Choose about the distance between ground points; smaller cells only make the file larger.</source>
        <translation>Seite einer Zelle des Geländemodells und seiner Schummerung. Wählen Sie etwa den Abstand der Bodenpunkte; kleinere Zellen machen nur die Datei größer.</translation>
    </message>
    <message>
        <source>Side of a cell of the terrain model and of its hillshade. Empty: 1 m, and for a delivery as fine as the ground points allow, or as the specification states.</source>
        <translation>Seite einer Zelle des Geländemodells und seiner Schummerung. Leer: 1 m, und bei einer Lieferung so fein, wie es die Bodenpunkte erlauben, oder wie es die Spezifikation vorgibt.</translation>
    </message>
    <message>
        <source>Side of the cells in which points are counted. Empty: twice the distance between points, at least 1 m, and up to 5 m if a large survey would have too many cells.</source>
        <translation>Seite der Zellen, in denen Punkte gezählt werden. Leer: das Doppelte des Punktabstands, mindestens 1 m, und bis zu 5 m, wenn ein großes Projekt zu viele Zellen hätte.</translation>
    </message>
    <message>
        <source>Side of the cells of densities and voids. Strips and maximum heights have cells of twice this size.</source>
        <translation>Seitenlänge der Zellen von Dichten und Lücken. Flugstreifen und größte Höhen haben doppelt so große Zellen.</translation>
    </message>
    <message>
        <source>Side of the cells whose lowest points are compared. Not used with the preset Whitebox. Empty: the usual distance between points, at least 1 m (0.5 m in the preset for sites).</source>
        <translation>Seite der Zellen, deren tiefste Punkte verglichen werden. Nicht für die Voreinstellung Whitebox. Leer: der übliche Abstand der Punkte, mindestens 1 m (0,5 m in der Voreinstellung für Baustellen).</translation>
    </message>
    <message>
        <source>Side of the cells whose lowest points may become vertices of the TIN; at least the usual distance between points. Smaller cells keep narrow banks and sharp edges, but under trees also more plants. Empty: from the preset.</source>
        <translation>Seite der Zellen, deren tiefste Punkte Ecken des TIN werden können; mindestens der übliche Abstand der Punkte. Kleinere Zellen erhalten schmale Wälle und scharfe Kanten, unter Bäumen aber auch mehr Pflanzen. Leer: aus der Voreinstellung.</translation>
    </message>
    <message>
        <source>Side of the square cells whose lowest points are compared. Smaller cells follow finer terrain if they hold at least one point, but have more rims at low plants. Empty: from the preset, or larger if points are too sparse for it.</source>
        <translation>Seite der quadratischen Zellen, deren tiefste Punkte verglichen werden. Kleinere Zellen folgen feinerem Gelände, wenn sie mindestens einen Punkt enthalten, haben aber mehr Ränder an niedrigen Pflanzen. Leer: aus der Voreinstellung, oder größer, wenn die Punkte dafür zu dünn liegen.</translation>
    </message>
    <message>
        <source>Skip missing tiles</source>
        <translation>Fehlende Kacheln auslassen</translation>
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
        <source>Small groups of points that hang at least 10 m above all others of their place: birds, clouds.</source>
        <translation>Kleine Gruppen von Punkten, die mindestens 10 m über allen anderen ihres Orts hängen: Vögel, Wolken.</translation>
    </message>
    <message>
        <source>Smaller water is left out. The Lidar Base Specification asks for lakes of 8,000 m² (2 acres) and more.</source>
        <translation>Kleinere Gewässer werden weggelassen. Die Lidar Base Specification verlangt Seen von 8.000 m² (2 acres) und mehr.</translation>
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
        <source>Steepest slope of the ground. In steeper triangles, the mirror image of a point beyond the nearest vertex is judged in its place.</source>
        <translation>Größte Neigung des Bodens. In steileren Dreiecken wird an Stelle eines Punkts sein Spiegelbild jenseits des nächsten Eckpunkts beurteilt.</translation>
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
        <source>Surface minus terrain: the height of trees, and of buildings too. Empty where no ground point lies within 50 m (or 20 cells), and in gaps of the surface.</source>
        <translation>Oberfläche minus Gelände: die Höhe von Bäumen, und auch von Gebäuden. Leer, wo kein Bodenpunkt im Umkreis von 50 m (oder 20 Zellen) liegt, und in Lücken der Oberfläche.</translation>
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
        <source>The CRS of the points, for files that state none or a wrong one. It replaces what files state: it decides the units of lengths and heights, and rasters and layers get it. Written point clouds keep the records that the files have. Empty: what the files state.</source>
        <translation>Das KBS der Punkte, für Dateien, die keines oder ein falsches angeben. Es tritt an die Stelle dessen, was Dateien angeben: Es bestimmt die Einheiten von Längen und Höhen, und Raster und Layer bekommen es. Geschriebene Punktwolken behalten die Angaben der Dateien. Leer: was die Dateien angeben.</translation>
    </message>
    <message>
        <source>The Python of this QGIS has no pip. In Debian and Ubuntu run sudo apt-get install python3-pip, elsewhere install pip for it, and try again; or choose a wheel file.</source>
        <translation>Dem Python dieses QGIS fehlt pip. Führen Sie unter Debian und Ubuntu sudo apt-get install python3-pip aus, sonst installieren Sie pip dafür, und versuchen Sie es erneut; oder wählen Sie eine Wheel-Datei.</translation>
    </message>
    <message>
        <source>The attribute of these polygons that holds their class: 2 for ground, 1 for unclassified.</source>
        <translation>Das Attribut dieser Polygone, das ihre Klasse enthält: 2 für Boden, 1 für nicht klassifiziert.</translation>
    </message>
    <message>
        <source>The attribute with the heights, in the unit of the heights of the points. Empty: z of the points, or an attribute with a usual name, such as H or elevation.</source>
        <translation>Das Attribut mit den Höhen, in der Einheit der Höhen der Punktwolke. Leer: z der Punkte, oder ein Attribut mit einem üblichen Namen wie H oder Höhe.</translation>
    </message>
    <message>
        <source>The attribute with the land cover, such as forest or NVA. Points on vegetated land are reported apart, and those of type Control are left out. Empty: an attribute with a usual name, such as class.</source>
        <translation>Das Attribut mit der Bodenbedeckung, etwa forest oder NVA. Punkte auf bewachsenem Land werden gesondert ausgewiesen, die vom Typ Control bleiben weg. Leer: ein Attribut mit einem üblichen Namen, etwa class.</translation>
    </message>
    <message>
        <source>The attribute with the names. Empty: an attribute with a usual name, such as id, or else numbers from 1 on.</source>
        <translation>Das Attribut mit den Namen. Leer: ein Attribut mit einem üblichen Namen wie id, sonst Nummern ab 1.</translation>
    </message>
    <message>
        <source>The checkpoints with their errors (ERROR, in metres): ground minus checkpoint.</source>
        <translation>Die Kontrollpunkte mit ihren Fehlern (ERROR, in Metern): Boden minus Kontrollpunkt.</translation>
    </message>
    <message>
        <source>The class of bridge decks that are not ground. In the LAS specification it is 17, and every point format can hold it. Empty: the class of other points.</source>
        <translation>Die Klasse von Fahrbahnen von Brücken, die kein Boden sind. In der LAS-Spezifikation ist es 17, und jedes Punktformat kann sie fassen. Leer: die Klasse der übrigen Punkte.</translation>
    </message>
    <message>
        <source>The class of bridge decks. They are found by cross-sections that fall to lower ground on both sides; ramps, dams and embankments stay ground. A classic preset (Whitebox, LiDAR360's, the paper's) works as the original does, and does not look for bridges.</source>
        <translation>Die Klasse der Fahrbahnen von Brücken. Sie werden an Querschnitten erkannt, die auf beiden Seiten zu tieferem Boden abfallen; Rampen, Dämme und Böschungen bleiben Boden. Eine klassische Voreinstellung (Whitebox, LiDAR360, Veröffentlichung) arbeitet wie das Original und sucht keine Brücken.</translation>
    </message>
    <message>
        <source>The class of points that are not ground. Points that were never classified (0) become 1 in both cases. Noise, withheld points, and classes that are not classified stay as they are.</source>
        <translation>Die Klasse der Punkte, die kein Boden sind. Nie klassifizierte Punkte (0) werden in beiden Fällen 1. Rauschen, zurückgehaltene Punkte (withheld) und Klassen, die nicht klassifiziert werden, bleiben, wie sie sind.</translation>
    </message>
    <message>
        <source>The class that ground points beside the shore get. Points that have it already keep it, also in the water, unless it is one of the ground classes.</source>
        <translation>Die Klasse, die Bodenpunkte neben dem Ufer bekommen. Punkte, die sie schon haben, behalten sie, auch im Wasser, außer wenn sie eine der Bodenklassen ist.</translation>
    </message>
    <message>
        <source>The class that ground points get; 2 is ground in the LAS specification. Point formats 0 to 5 hold classes up to 31.</source>
        <translation>Die Klasse, die Bodenpunkte bekommen; in der LAS-Spezifikation ist Boden 2. Die Punktformate 0 bis 5 fassen Klassen bis 31.</translation>
    </message>
    <message>
        <source>The class that ground points in the water get. Point formats 0 to 5 hold classes up to 31.</source>
        <translation>Die Klasse, die Bodenpunkte im Wasser bekommen. Die Punktformate 0 bis 5 fassen Klassen bis 31.</translation>
    </message>
    <message>
        <source>The class that key points get. Points that already have it count as ground; those that are not needed get the first of the ground classes. Point formats 0 to 5 hold classes up to 31.</source>
        <translation>Die Klasse, die Schlüsselpunkte bekommen. Punkte, die sie schon haben, gelten als Boden; die nicht gebrauchten bekommen die erste der Bodenklassen. Die Punktformate 0 bis 5 fassen Klassen bis 31.</translation>
    </message>
    <message>
        <source>The confidence is not a file. Export it as GeoTIFF first.</source>
        <translation>Die Verlässlichkeit ist keine Datei. Exportieren Sie sie zuerst als GeoTIFF.</translation>
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
        <source>The folder for all outputs of a delivery: an empty or new one, or that of an earlier delivery, which is replaced.</source>
        <translation>Der Ordner für alle Ausgaben einer Lieferung: ein leerer oder neuer, oder der einer früheren Lieferung, die ersetzt wird.</translation>
    </message>
    <message>
        <source>The folder for the classified files. Each keeps its name.</source>
        <translation>Der Ordner für die klassifizierten Dateien. Jede behält ihren Namen.</translation>
    </message>
    <message>
        <source>The folder for the rasters (GeoTIFF). They are named after what they show, such as vat.tif and sky-view.tif.</source>
        <translation>Der Ordner für die Raster (GeoTIFF). Sie heißen nach dem, was sie zeigen, zum Beispiel vat.tif und sky-view.tif.</translation>
    </message>
    <message>
        <source>The folder for the rasters of densities, voids and strips, which are shown as layers.</source>
        <translation>Der Ordner für die Raster der Dichten, Lücken und Flugstreifen, die als Layer gezeigt werden.</translation>
    </message>
    <message>
        <source>The ground filter. TIN densification is the most accurate.</source>
        <translation>Der Bodenfilter. TIN-Verdichtung ist am genauesten.</translation>
    </message>
    <message>
        <source>The height between contour lines, in the unit of the heights.</source>
        <translation>Der Höhenabstand der Höhenlinien, in der Einheit der Höhen.</translation>
    </message>
    <message>
        <source>The height between contour lines, in the vertical unit of the CRS: metres, or feet if the heights are feet. Empty: 1, 2 or 5 times a power of ten, so that there are about 20 lines. Every fifth line is an index contour.</source>
        <translation>Der Höhenabstand der Höhenlinien, in der Höheneinheit des KBS: Meter, oder Fuß, wenn die Höhen in Fuß sind. Leer: das 1-, 2- oder 5-Fache einer Zehnerpotenz, so dass es etwa 20 Linien gibt. Jede fünfte Linie ist eine Zählkurve.</translation>
    </message>
    <message>
        <source>The heights of this raster are compared with the checkpoints as well.</source>
        <translation>Die Höhen dieses Rasters werden ebenfalls mit den Kontrollpunkten verglichen.</translation>
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
        <source>The kind of land. automatic: judged by the points.</source>
        <translation>Die Art des Landes. automatic: nach den Punkten beurteilt.</translation>
    </message>
    <message>
        <source>The last pass removes whatever stands this far above the ground beside it: bushes, cars, walls. A larger value keeps more of rough ground. Empty: from the preset.</source>
        <translation>Im letzten Durchgang wird entfernt, was so hoch über dem Boden daneben steht: Büsche, Autos, Mauern. Ein größerer Wert schont rauen Boden. Leer: aus der Voreinstellung.</translation>
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
        <source>The point cloud to check. Its class 2 counts as ground, all other classes do not.</source>
        <translation>Die Punktwolke, die geprüft wird. Ihre Klasse 2 gilt als Boden, alle anderen Klassen nicht.</translation>
    </message>
    <message>
        <source>The points of a remote point cloud that lie in this rectangle are downloaded, and are all that is used. Only for point clouds that are not on this computer.</source>
        <translation>Von einer entfernten Punktwolke werden die Punkte in diesem Rechteck heruntergeladen, und nur sie werden verwendet. Nur für Punktwolken, die nicht auf diesem Rechner sind.</translation>
    </message>
    <message>
        <source>The points, with all of their dimensions, as .copc.laz or .laz.</source>
        <translation>Die Punkte mit allen Dimensionen, als .copc.laz oder .laz.</translation>
    </message>
    <message>
        <source>The probability, 0 to 1, that the terrain model is right: low under dense trees, across gaps and at breaks.</source>
        <translation>Die Wahrscheinlichkeit, 0 bis 1, dass das Geländemodell stimmt: gering unter dichten Bäumen, über Lücken und an Kanten.</translation>
    </message>
    <message>
        <source>The raster with the grid to use is not a file. Export it as GeoTIFF first.</source>
        <translation>Das Raster, dessen Gitter gilt, ist keine Datei. Exportieren Sie es zuerst als GeoTIFF.</translation>
    </message>
    <message>
        <source>The rasters cover this rectangle, widened to whole cells, which stay where they are. All points are used. Empty: where the points are.</source>
        <translation>Die Raster bedecken dieses Rechteck, erweitert auf ganze Zellen, die an ihrem Ort bleiben. Alle Punkte werden benutzt. Leer: wo die Punkte sind.</translation>
    </message>
    <message>
        <source>The rasters end at this rectangle. Points outside still help along its border. Empty: the rasters cover all points.</source>
        <translation>Die Raster enden an diesem Rechteck. Punkte außerhalb helfen noch an seinem Rand. Leer: Die Raster bedecken alle Punkte.</translation>
    </message>
    <message>
        <source>The rasters have data only in these polygons; with an extent, only in both. Points outside still help along the border. Empty: the rasters cover all points.</source>
        <translation>Die Raster haben nur in diesen Polygonen Werte; gibt es eine Ausdehnung, nur in beiden. Punkte außerhalb helfen noch am Rand. Leer: Die Raster bedecken alle Punkte.</translation>
    </message>
    <message>
        <source>The removed lazrs is still in use: restart QGIS and try again.</source>
        <translation>Das entfernte lazrs ist noch in Benutzung: Starten Sie QGIS neu, und versuchen Sie es noch einmal.</translation>
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
        <source>The same points, or some of them, with their true classes.</source>
        <translation>Dieselben Punkte, oder einige davon, mit ihren wahren Klassen.</translation>
    </message>
    <message>
        <source>The same points, with the classes above the ground.</source>
        <translation>Dieselben Punkte mit den Klassen über dem Boden.</translation>
    </message>
    <message>
        <source>The same points, with the classes of water and of ignored ground.</source>
        <translation>Dieselben Punkte, mit den Klassen für Wasser und ignorierten Boden.</translation>
    </message>
    <message>
        <source>The same points, with the key points marked.</source>
        <translation>Dieselben Punkte, mit gekennzeichneten Schlüsselpunkten.</translation>
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
        <source>The specification with which a delivery is compared. It also sets the cell size of the delivery for surveys, and the classes that it asks for.</source>
        <translation>Die Spezifikation, mit der eine Lieferung verglichen wird. Sie bestimmt auch die Zellgröße der Lieferung für Vermessungen und die Klassen, die sie verlangt.</translation>
    </message>
    <message>
        <source>The specification with which the survey is compared.</source>
        <translation>Die Spezifikation, mit der die Befliegung verglichen wird.</translation>
    </message>
    <message>
        <source>The terrain model is not a file. Export it as GeoTIFF first.</source>
        <translation>Das Geländemodell ist keine Datei. Exportieren Sie es zuerst als GeoTIFF.</translation>
    </message>
    <message>
        <source>The terrain model minus a smoothed one. Mounds, ditches and old paths stand out.</source>
        <translation>Das Geländemodell abzüglich eines geglätteten. Hügel, Gräben und alte Wege treten hervor.</translation>
    </message>
    <message>
        <source>The terrain model, lit by one light or by four.</source>
        <translation>Das Geländemodell, von einem Licht oder von vieren beleuchtet.</translation>
    </message>
    <message>
        <source>The unit of the heights of points that are transformed to UTM, if their CRS does not state it.</source>
        <translation>Die Einheit der Höhen von Punkten, die nach UTM umgerechnet werden, wenn ihr KBS sie nicht angibt.</translation>
    </message>
    <message>
        <source>The usual one of the delivery</source>
        <translation>Die übliche der Lieferung</translation>
    </message>
    <message>
        <source>The value of cells without data. Choose one that no height has. Empty: NaN. The hillshade has 0.</source>
        <translation>Der Wert der Zellen ohne Daten. Wählen Sie einen, den keine Höhe hat. Leer: NaN. Die Schummerung hat 0.</translation>
    </message>
    <message>
        <source>The values of the method for a kind of terrain. For other values, use the command line or the algorithm of the method.</source>
        <translation>Die Werte des Verfahrens für eine Geländeart. Andere Werte nehmen die Befehlszeile und der Algorithmus des Verfahrens.</translation>
    </message>
    <message>
        <source>The vertical accuracy class that the data are to meet, as RMSE: 0.1 for the 10 cm class. It is tested by the checkpoints on land without vegetation. Empty: the figures are only reported.</source>
        <translation>Die Klasse der Höhengenauigkeit, die die Daten erfüllen sollen, als RMSE: 0,1 für die Klasse 10 cm. Geprüft wird sie an den Kontrollpunkten ohne Bewuchs. Leer: nur die Kennzahlen werden ausgewiesen.</translation>
    </message>
    <message>
        <source>The window to classify, such as the map's extent: at most 1,000 m wide, and quick up to about 250 x 250 m. It is transformed to the CRS of the points. Empty: 250 x 250 m in the middle of the points; the log says where.</source>
        <translation>Das Fenster, das klassifiziert wird, etwa die Kartenausdehnung; höchstens 1.000 m breit, und schnell bis etwa 250 x 250 m. Es wird in das KBS der Punkte transformiert. Leer: 250 x 250 m in der Mitte der Punkte; das Protokoll sagt, wo.</translation>
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
        <source>This share of the rise of the ground from point to point, over at most a metre, is added to the ground tolerance. In the paper's preset it is a share of the rise over one cell. Empty: from the preset.</source>
        <translation>Dieser Anteil des Anstiegs des Bodens von Punkt zu Punkt, über höchstens einen Meter, kommt zur Bodentoleranz hinzu. In der Voreinstellung der Veröffentlichung ist es ein Anteil des Anstiegs über eine Zelle. Leer: aus der Voreinstellung.</translation>
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
        <source>Triangles whose longest edge is shorter than this take no more points. Empty: all triangles can take points.</source>
        <translation>Dreiecke, deren längste Kante kürzer ist als dies, nehmen keine weiteren Punkte auf. Leer: Alle Dreiecke können Punkte aufnehmen.</translation>
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
        <source>Up to LAS 1.3, and in most programs, key points have a class. LAS 1.4 has a flag for them, so that they keep the class of the ground.</source>
        <translation>Bis LAS 1.3, und in den meisten Programmen, haben Schlüsselpunkte eine Klasse. LAS 1.4 hat ein Kennzeichen für sie, so dass sie die Klasse des Bodens behalten.</translation>
    </message>
    <message>
        <source>Use as others</source>
        <translation>Wie die übrigen benutzen</translation>
    </message>
    <message>
        <source>Used only with limits of your own.</source>
        <translation>Nur mit eigenen Grenzen benutzt.</translation>
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
        <source>Virtual point cloud</source>
        <translation>Virtuelle Punktwolke</translation>
    </message>
    <message>
        <source>Voids of the ground</source>
        <translation>Lücken des Bodens</translation>
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
        <source>What is no building, no bridge and no noise becomes low (3), medium (4) or high (5) vegetation by its height above ground. The LAS specification has these classes, but no limits: 0.5 and 2 m are usual. IGN's LiDAR HD has 0.5 and 1.5 m.</source>
        <translation>Was weder Gebäude noch Brücke noch Rauschen ist, wird nach seiner Höhe über Grund niedrige (3), mittlere (4) oder hohe (5) Vegetation. Die LAS-Spezifikation hat diese Klassen, aber keine Grenzen: 0,5 und 2 m sind üblich. LiDAR HD des IGN hat 0,5 und 1,5 m.</translation>
    </message>
    <message>
        <source>What to make, a raster for each. Archaeological topography (VAT) shows the most in one picture.</source>
        <translation>Was gemacht wird, je ein Raster. Die archäologische Topographie (VAT) zeigt am meisten in einem Bild.</translation>
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
        <source>Where a pulse passed between the branches, the canopy height has pits. This raises cells that lie over 2 m below the mean of their neighbours to the median of them, as crowns and trees are easier to find without pits. The surface model keeps them.</source>
        <translation>Wo ein Puls zwischen den Ästen hindurchging, hat die Kronenhöhe Löcher. Dies hebt Zellen, die mehr als 2 m unter dem Mittel ihrer Nachbarn liegen, auf deren Median, denn ohne Löcher sind Kronen und Bäume leichter zu finden. Das Oberflächenmodell behält die Löcher.</translation>
    </message>
    <message>
        <source>Where they differ</source>
        <translation>Wo sie sich unterscheiden</translation>
    </message>
    <message>
        <source>Whether a virtual point cloud or a STAC item may name files on servers that you did not name. Without it, they are named and nothing is downloaded. With it, the Planetary Computer is asked for signatures of its files.</source>
        <translation>Ob eine virtuelle Punktwolke oder ein STAC-Item Dateien auf Servern nennen darf, die Sie nicht genannt haben. Sonst werden sie genannt, und nichts wird heruntergeladen. Mit dieser Option wird auch der Planetary Computer um Signaturen für seine Dateien gebeten.</translation>
    </message>
    <message>
        <source>Whether points in Web Mercator, such as those of 3DEP, are transformed to the zone of UTM (WGS 84) of the area, and their heights to metres. Nothing can be measured in Web Mercator.</source>
        <translation>Ob Punkte in Web-Mercator, wie die von 3DEP, in die UTM-Zone (WGS 84) des Gebiets umgerechnet werden, und ihre Höhen in Meter. In Web-Mercator kann nichts gemessen werden.</translation>
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
        <source>Words separated by commas: a land cover with one of them is vegetated, and no other. Empty: words such as forest, crops and brush in several languages.</source>
        <translation>Durch Kommas getrennte Wörter: Eine Bodenbedeckung mit einem davon ist bewachsen, keine andere. Leer: Wörter wie Wald, Feldfrüchte und Gebüsch in mehreren Sprachen.</translation>
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
        <source>Writes a few points of all tiles into a further COPC file beside the virtual point cloud, if the tiles are COPC. QGIS 3.42 and newer shows them at small scales.</source>
        <translation>Schreibt einige Punkte aller Kacheln in eine weitere COPC-Datei neben der virtuellen Punktwolke, wenn die Kacheln COPC sind. QGIS 3.42 und neuer zeigt sie in kleinen Maßstäben.</translation>
    </message>
    <message>
        <source>Writes only the points inside the extent and the boundary, and makes the rasters from them. Files without such points are not written. If this is off, all files are written with all their points, and points outside keep their class.</source>
        <translation>Schreibt nur die Punkte innerhalb von Ausdehnung und Begrenzung und macht die Raster aus ihnen. Dateien ohne solche Punkte werden nicht geschrieben. Ist dies aus, werden alle Dateien mit allen ihren Punkten geschrieben, und Punkte außerhalb behalten ihre Klasse.</translation>
    </message>
    <message>
        <source>Writes only the points that have the class of the ground. The log says how many points are left out.</source>
        <translation>Schreibt nur die Punkte, die die Klasse des Bodens haben. Das Protokoll sagt, wie viele Punkte wegbleiben.</translation>
    </message>
    <message>
        <source>X and Y of both ends, in the CRS of the points: X1 Y1 X2 Y2. Empty: straight across the window where the terrains differ most, from west to east or from south to north.</source>
        <translation>X und Y der beiden Enden, im KBS der Punkte: X1 Y1 X2 Y2. Leer: gerade durch das Fenster, wo sich die Gelände am meisten unterscheiden, von West nach Ost oder von Süd nach Nord.</translation>
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
        <source>below water</source>
        <translation>unter Wasser</translation>
    </message>
    <message>
        <source>buildings,roofs,trees,classes,classification,bridges,noise,lasclassify,asprs,ign</source>
        <translation>Gebäude,Dächer,Bäume,Klassen,Klassifikation,Brücken,Rauschen,lasclassify,asprs,ign</translation>
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
        <source>contours,workflow</source>
        <translation>Höhenlinien,Isolinien,Arbeitsablauf</translation>
    </message>
    <message>
        <source>cut off by openings</source>
        <translation>durch Öffnungen abgeschnitten</translation>
    </message>
    <message>
        <source>degrees</source>
        <translation>Grad</translation>
    </message>
    <message>
        <source>deliverables,archaeology,forestry,flood,drone</source>
        <translation>Lieferung,Archäologie,Forst,Hochwasser,Drohne</translation>
    </message>
    <message>
        <source>densification</source>
        <translation>Verdichtung</translation>
    </message>
    <message>
        <source>download,remote,url,web,http,copc,clip,cloud storage</source>
        <translation>herunterladen,entfernt,url,web,http,copc,ausschneiden,cloud-speicher</translation>
    </message>
    <message>
        <source>finer cells off surface</source>
        <translation>feine Zellen abseits</translation>
    </message>
    <message>
        <source>gentle regions</source>
        <translation>sanfte Bereiche</translation>
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
        <source>groups of low points</source>
        <translation>Gruppen tiefer Punkte</translation>
    </message>
    <message>
        <source>height,extra bytes</source>
        <translation>Höhe,Zusatzdimension</translation>
    </message>
    <message>
        <source>key points</source>
        <translation>Schlüsselpunkte</translation>
    </message>
    <message>
        <source>known ground</source>
        <translation>bekannter Boden</translation>
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
        <source>level with seeds beside</source>
        <translation>auf der Höhe von Startpunkten daneben</translation>
    </message>
    <message>
        <source>lidar,laser scanning,als,uav,drone,las,laz,copc,point cloud</source>
        <translation>Lidar,Laserscanning,Airborne Laserscanning,Drohne,las,laz,copc,Punktwolke</translation>
    </message>
    <message>
        <source>low outliers</source>
        <translation>tiefe Ausreißer</translation>
    </message>
    <message>
        <source>lowest points, undisputed</source>
        <translation>tiefste Punkte, unstrittig</translation>
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
        <source>m2</source>
        <translation>m2</translation>
    </message>
    <message>
        <source>narrow pits</source>
        <translation>schmale Gruben</translation>
    </message>
    <message>
        <source>no key point</source>
        <translation>kein Schlüsselpunkt</translation>
    </message>
    <message>
        <source>none near surface</source>
        <translation>keiner nahe Oberfläche</translation>
    </message>
    <message>
        <source>on one grid only</source>
        <translation>nur in einem Gitter</translation>
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
        <source>pits in blocks</source>
        <translation>Gruben in Blöcken</translation>
    </message>
    <message>
        <source>plants or outliers</source>
        <translation>Pflanzen oder Ausreißer</translation>
    </message>
    <message>
        <source>points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>points near the surface</source>
        <translation>Punkte nahe der Oberfläche</translation>
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
        <source>quality</source>
        <translation>Qualität</translation>
    </message>
    <message>
        <source>quality,qc,density,pulse density,voids,swath,strips,overlap,usgs,lbs,linz,ign,specification,lasoverlap,lasgrid</source>
        <translation>qualität,qualitätskontrolle,qs,dichte,pulsdichte,lücken,flugstreifen,streifen,überlappung,usgs,linz,ign,spezifikation,abnahme</translation>
    </message>
    <message>
        <source>raised objects</source>
        <translation>erhöhte Objekte</translation>
    </message>
    <message>
        <source>relief</source>
        <translation>Relief</translation>
    </message>
    <message>
        <source>rims of low objects</source>
        <translation>Ränder niedriger Objekte</translation>
    </message>
    <message>
        <source>seeds</source>
        <translation>Startpunkte</translation>
    </message>
    <message>
        <source>seeds of finer cells</source>
        <translation>Startpunkte feinerer Zellen</translation>
    </message>
    <message>
        <source>shrubs</source>
        <translation>Sträucher</translation>
    </message>
    <message>
        <source>single low points</source>
        <translation>einzelne tiefe Punkte</translation>
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
        <source>steep rises</source>
        <translation>steile Anstiege</translation>
    </message>
    <message>
        <source>tall objects</source>
        <translation>hohe Objekte</translation>
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
        <source>wide low groups</source>
        <translation>breite tiefe Gruppen</translation>
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
        <source>{} is not on this computer: give the extent to download.</source>
        <translation>{} ist nicht auf diesem Rechner: Geben Sie die Ausdehnung an, die heruntergeladen werden soll.</translation>
    </message>
    <message>
        <source>{} lists {} point clouds that have points there, and this algorithm reads one. Choose 'Point cloud to terrain', or download them first.</source>
        <translation>{} nennt {} Punktwolken, die dort Punkte haben, und dieser Algorithmus liest nur eine. Wählen Sie „Von der Punktwolke zum Gelände“, oder laden Sie sie zuerst herunter.</translation>
    </message>
    <message>
        <source>{} were removed from {}.</source>
        <translation>{} wurden aus {} entfernt.</translation>
    </message>
</context>
</TS>
