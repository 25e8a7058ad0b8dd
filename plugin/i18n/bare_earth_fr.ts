<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="fr" sourcelanguage="en">
<context>
    <name>BareEarth</name>
    <message>
        <source>.las, .laz and .copc.laz files, virtual point clouds (.vpc), or text files (.txt) with one path in each line. May stay empty if a folder is given.</source>
        <translation>Fichiers .las, .laz et .copc.laz, nuages de points virtuels (.vpc), ou fichiers texte (.txt) avec un chemin par ligne. Peut rester vide si un dossier est donné.</translation>
    </message>
    <message>
        <source>0 to 1</source>
        <translation>0 à 1</translation>
    </message>
    <message>
        <source>1 is level</source>
        <translation>1 est plat</translation>
    </message>
    <message>
        <source>1 to 255</source>
        <translation>1 à 255</translation>
    </message>
    <message>
        <source>1 where ground points are far away</source>
        <translation>1 où les points du sol sont loin</translation>
    </message>
    <message>
        <source>&lt;b&gt;Values of the presets&lt;/b&gt;</source>
        <translation>&lt;b&gt;Valeurs des préréglages&lt;/b&gt;</translation>
    </message>
    <message>
        <source>&lt;b&gt;Values of the presets&lt;/b&gt; for fields that are left empty</source>
        <translation>&lt;b&gt;Valeurs des préréglages&lt;/b&gt; pour les champs laissés vides</translation>
    </message>
    <message>
        <source>A building has a plane of at least this area. Smaller planes are found only within 5 m of a larger one. If this is half as large, tops of conifers become buildings.</source>
        <translation>Un bâtiment a un plan d'au moins cette surface. Les plans plus petits ne sont trouvés qu'à moins de 5 m d'un plus grand. Si cette valeur est deux fois plus petite, des cimes de conifères deviennent des bâtiments.</translation>
    </message>
    <message>
        <source>A class of their own</source>
        <translation>Une classe à part</translation>
    </message>
    <message>
        <source>A delivery leaves out rivers that are narrower on average. Empty: 30 m for a survey, 5 m for a flood model.</source>
        <translation>Une livraison omet les rivières plus étroites en moyenne. Vide : 30 m pour un levé, 5 m pour un modèle d'inondation.</translation>
    </message>
    <message>
        <source>A delivery leaves out smaller water. Empty: 8,000 m² for a survey, 1,000 m² for a flood model.</source>
        <translation>Une livraison omet les eaux plus petites. Vide : 8 000 m² pour un levé, 1 000 m² pour un modèle d'inondation.</translation>
    </message>
    <message>
        <source>A download of more is refused before it begins. The error says how large it is.</source>
        <translation>Un téléchargement plus grand est refusé avant de commencer. Le message d’erreur indique sa taille.</translation>
    </message>
    <message>
        <source>A layer, a file, or an address (https://…)</source>
        <translation>Une couche, un fichier ou une adresse (https://…)</translation>
    </message>
    <message>
        <source>A list of the classified files, which QGIS 3.32 and newer shows as one layer. Without a name it is classified.vpc in their folder.</source>
        <translation>Une liste des fichiers classés, que QGIS 3.32 et plus récent affiche comme une seule couche. Sans nom, c'est classified.vpc dans leur dossier.</translation>
    </message>
    <message>
        <source>A point becomes high noise if it hangs at least this far above all others within about 10 m. Used only if high outliers are put into class 18.</source>
        <translation>Un point devient du bruit haut s'il flotte au moins à cette hauteur au-dessus de tous les autres à moins d'environ 10 m. Ne sert que si les points aberrants hauts vont dans la classe 18.</translation>
    </message>
    <message>
        <source>A point becomes low noise if it lies farther below the ground than this. On slopes, the rise of the ground over 1 m is added. Points with ground all round them that lie 0.4 m and more below it become low noise too. Used only if low outliers are put into class 7.</source>
        <translation>Un point devient du bruit bas s'il se trouve plus loin que ceci sous le sol. En pente s'ajoute la montée du sol sur 1 m. Les points entourés de sol qui se trouvent 0,4 m ou plus au-dessous deviennent aussi du bruit bas. Ne sert que si les points aberrants bas vont dans la classe 7.</translation>
    </message>
    <message>
        <source>A point cloud layer, a .las, .laz or .copc.laz file, a virtual point cloud (.vpc), or a text file (.txt) with one path in each line. May stay empty if a folder is given. Also a remote point cloud (COPC, EPT, VPC), or its address (https://...): what the extent needs of it is downloaded first.</source>
        <translation>Une couche de nuage de points, un fichier .las, .laz ou .copc.laz, un nuage de points virtuel (.vpc), ou un fichier texte (.txt) avec un chemin par ligne. Peut rester vide si un dossier est donné. Ou bien un nuage distant (COPC, EPT, VPC) ou son adresse (https://...) : ce que l'emprise en demande est d'abord téléchargé.</translation>
    </message>
    <message>
        <source>A point cloud layer, or a .las, .laz or .copc.laz file. Also a remote point cloud (COPC, EPT, VPC), or its address (https://...): what the extent needs of it is downloaded first.</source>
        <translation>Une couche de nuage de points, ou un fichier .las, .laz ou .copc.laz. Ou bien un nuage distant (COPC, EPT, VPC) ou son adresse (https://...) : ce que l'emprise en demande est d'abord téléchargé.</translation>
    </message>
    <message>
        <source>A point cloud layer, or a .las, .laz or .copc.laz file; also a virtual point cloud (.vpc) or a folder. Also a remote point cloud (COPC, EPT, VPC), or its address (https://...): what the extent needs of it is downloaded first.</source>
        <translation>Une couche de nuage de points, ou un fichier .las, .laz ou .copc.laz ; aussi un nuage de points virtuel (.vpc) ou un dossier. Ou bien un nuage distant (COPC, EPT, VPC) ou son adresse (https://...) : ce que l'emprise en demande est d'abord téléchargé.</translation>
    </message>
    <message>
        <source>A point cloud layer, or the address (https://...) of a COPC file, of the ept.json of an EPT data set, of a virtual point cloud or of a STAC item. Only what lies in the extent is downloaded.</source>
        <translation>Une couche de nuage de points, ou l’adresse (https://...) d’un fichier COPC, du ept.json d’un jeu EPT, d’un nuage de points virtuel ou d’un élément STAC. Seul ce qui se trouve dans l’emprise est téléchargé.</translation>
    </message>
    <message>
        <source>A point is not ground if it stands above a neighbour at a steeper slope than this. In all presets but Whitebox, the slope of the terrain around the point is added to it. Empty: from the preset, 15 deg in most, 45 deg in Whitebox.</source>
        <translation>Un point n'est pas du sol s'il se trouve au-dessus d'un voisin avec une pente plus forte que celle-ci. Dans tous les préréglages sauf Whitebox, la pente du terrain autour du point s'y ajoute. Vide : d'après le préréglage, 15 degrés dans la plupart, 45 degrés dans Whitebox.</translation>
    </message>
    <message>
        <source>A point is not ground only if it stands at least this high above a neighbour. Empty: from the preset, 0.5 m in most, 1 m in Whitebox.</source>
        <translation>Un point n'est écarté du sol que s'il dépasse un voisin d'au moins cette hauteur. Vide : d'après le préréglage, 0,5 m dans la plupart, 1 m dans Whitebox.</translation>
    </message>
    <message>
        <source>A point that is closer to its triangle than this joins the TIN whatever its angle. Near a corner, noise alone makes a large angle.</source>
        <translation>Un point plus proche de son triangle que ceci entre dans le TIN quel que soit son angle. Près d'un sommet, le bruit seul donne déjà un grand angle.</translation>
    </message>
    <message>
        <source>A point with fewer neighbours within the search radius is compared with this many nearest points. Only for the preset Whitebox.</source>
        <translation>Un point qui a moins de voisins dans le rayon de recherche est comparé à ce nombre de points les plus proches. Pour le préréglage Whitebox seulement.</translation>
    </message>
    <message>
        <source>A raster file with a band of heights.</source>
        <translation>Un fichier raster avec une bande d'altitudes.</translation>
    </message>
    <message>
        <source>A raster that tells why a place is ground or not: the rule of the filter that decided the cell. Its legend names the rules. Presets that decide points, not cells, cannot make it.</source>
        <translation>Un raster qui dit pourquoi un endroit est sol ou non : la règle du filtre qui a décidé de la cellule. Sa légende nomme les règles. Les préréglages qui décident des points, et non des cellules, ne peuvent pas le créer.</translation>
    </message>
    <message>
        <source>A raw .las, .laz or .copc.laz file.</source>
        <translation>Un fichier brut .las, .laz ou .copc.laz.</translation>
    </message>
    <message>
        <source>A surface model: a raster file with a band of heights.</source>
        <translation>Un modèle numérique de surface : un fichier raster avec une bande d'altitudes.</translation>
    </message>
    <message>
        <source>A web page with the figures, and a map of where the errors are.</source>
        <translation>Une page web avec les chiffres, et une carte de l'emplacement des erreurs.</translation>
    </message>
    <message>
        <source>A web page with the figures, the statement, and a map of the errors.</source>
        <translation>Une page web avec les chiffres, la déclaration et une carte des erreurs.</translation>
    </message>
    <message>
        <source>A web page, which the Results Viewer opens.</source>
        <translation>Une page web, qui s'ouvre depuis le visualiseur de résultats.</translation>
    </message>
    <message>
        <source>About how much memory a run may use. A file that needs more is read twice, and its points wait in a temporary file in the output folder. With many files, fewer are worked on at the same time. The result does not depend on it. Empty: half of the free memory.</source>
        <translation>La mémoire qu'un traitement peut prendre, environ. Un fichier qui en demande plus est lu deux fois, et ses points attendent dans un fichier temporaire du dossier de sortie. Avec de nombreux fichiers, moins de fichiers sont traités en même temps. Le résultat n'en dépend pas. Vide : la moitié de la mémoire libre.</translation>
    </message>
    <message>
        <source>Accuracy class</source>
        <translation>Classe de précision</translation>
    </message>
    <message>
        <source>Add the height above ground</source>
        <translation>Ajouter la hauteur au-dessus du sol</translation>
    </message>
    <message>
        <source>Added to both ground tolerances on a slope of 45 degrees. On gentler slopes less is added, in proportion.</source>
        <translation>S'ajoute aux deux tolérances du sol sur une pente de 45 degrés. Sur des pentes plus douces, moins est ajouté, en proportion.</translation>
    </message>
    <message>
        <source>Added to the ground tolerance on a slope of 45 degrees, if points are a metre apart. Less is added, in proportion, on gentler slopes and if points are closer.</source>
        <translation>S'ajoute à la tolérance du sol sur une pente de 45 degrés, si les points sont distants d'un mètre. Moins est ajouté, en proportion, sur des pentes plus douces et si les points sont plus serrés.</translation>
    </message>
    <message>
        <source>Adds the extra dimension BareEarthClass with the class that this run gives to each point. A later run on the output finds the classes that were changed by hand since, and keeps them, whatever its settings. It then remembers the classes again.</source>
        <translation>Ajoute la dimension supplémentaire BareEarthClass avec la classe que ce traitement donne à chaque point. Un traitement ultérieur de la sortie trouve les classes qui ont été changées à la main depuis, et les garde, quels que soient ses réglages. Il mémorise ensuite à nouveau les classes.</translation>
    </message>
    <message>
        <source>Adds the extra dimension HeightAboveGround, the height of each point above the ground, in the vertical unit of the CRS.</source>
        <translation>Ajoute la dimension supplémentaire HeightAboveGround, la hauteur de chaque point au-dessus du sol, dans l'unité verticale du SCR.</translation>
    </message>
    <message>
        <source>Adds the height above ground to every point of a classified point cloud: its height above the triangulation (TIN) of the ground points or, outside of it, above the nearest ground point. Heights are in the vertical unit of the CRS. They become an extra dimension, HeightAboveGround, or replace z; nothing else in the file changes.
With a terrain model, heights are measured above that raster, and the points need no classes.</source>
        <translation>Ajoute à chaque point d'un nuage de points classé sa hauteur au-dessus du sol : au-dessus de la triangulation (TIN) des points sol ou, en dehors, au-dessus du point sol le plus proche. Les hauteurs sont dans l'unité verticale du SCR. Elles deviennent une dimension supplémentaire, HeightAboveGround, ou remplacent z ; rien d'autre ne change dans le fichier.
Avec un modèle de terrain, les hauteurs sont mesurées au-dessus de ce raster, et les points n'ont pas besoin de classes.</translation>
    </message>
    <message>
        <source>Adds the height of every point above the ground points of a point cloud.</source>
        <translation>Ajoute la hauteur de chaque point au-dessus des points sol d'un nuage de points.</translation>
    </message>
    <message>
        <source>All .las, .laz and .copc.laz files in this folder are used, too. All files together are one survey, without seams.</source>
        <translation>Tous les fichiers .las, .laz et .copc.laz de ce dossier sont pris aussi. Tous les fichiers ensemble forment un seul levé, sans raccords visibles.</translation>
    </message>
    <message>
        <source>All files</source>
        <translation>Tous les fichiers</translation>
    </message>
    <message>
        <source>All in one</source>
        <translation>Chaîne complète</translation>
    </message>
    <message>
        <source>All outputs that a job hands over, in one folder, with a page that lists them. Only with your own choice of outputs are the fields of single outputs used.</source>
        <translation>Tout ce qu'une mission remet, dans un dossier, avec une page qui en fait la liste. Les champs des sorties ne servent que si vous choisissez les sorties vous-même.</translation>
    </message>
    <message>
        <source>All rasters get the grid of this raster: CRS, cell size, position of the cells, and extent. It must be in the CRS of the points, with square cells and north up. It replaces the cell size.</source>
        <translation>Tous les rasters reçoivent la grille de ce raster : SCR, taille de cellule, position des cellules et emprise. Il doit être dans le SCR des points, avec des cellules carrées et le nord en haut. Il remplace la taille de cellule.</translation>
    </message>
    <message>
        <source>All returns</source>
        <translation>Tous les retours</translation>
    </message>
    <message>
        <source>An extra dimension leaves everything else as it is. If the height replaces z, programs that cannot show extra dimensions show it too, but the terrain is flat.</source>
        <translation>Une dimension supplémentaire laisse tout le reste en l'état. Si la hauteur remplace z, les logiciels qui ne connaissent pas les dimensions supplémentaires la montrent aussi, mais le terrain est plat.</translation>
    </message>
    <message>
        <source>Angle of the light above the horizon.</source>
        <translation>Angle de la lumière au-dessus de l'horizon.</translation>
    </message>
    <message>
        <source>Archaeological topography</source>
        <translation>Topographie archéologique</translation>
    </message>
    <message>
        <source>Archaeological topography (VAT)</source>
        <translation>Topographie archéologique (VAT)</translation>
    </message>
    <message>
        <source>Archaeology</source>
        <translation>Archéologie</translation>
    </message>
    <message>
        <source>Area [m²]</source>
        <translation>Surface [m²]</translation>
    </message>
    <message>
        <source>As the CRS states</source>
        <translation>Celle du SCR</translation>
    </message>
    <message>
        <source>As the filter classifies them</source>
        <translation>Comme le filtre les classe</translation>
    </message>
    <message>
        <source>As the input</source>
        <translation>Comme l'entrée</translation>
    </message>
    <message>
        <source>Assess a ground classification</source>
        <translation>Évaluer une classification du sol</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatique</translation>
    </message>
    <message>
        <source>Automatic (many scales, follows the terrain)</source>
        <translation>Automatique (plusieurs échelles, suit le terrain)</translation>
    </message>
    <message>
        <source>Automatic: for the pictures, heights are smoothed as much as they are noisy, so that low plants in a forest do not speckle them. Banks, ditches and walls stay sharp, and so does open ground. The terrain model does not change.</source>
        <translation>Automatique : pour les images, les altitudes sont lissées autant qu'elles sont bruitées, afin que les plantes basses d'une forêt ne les mouchettent pas. Les talus, les fossés et les murs restent nets, le sol découvert aussi. Le modèle de terrain ne change pas.</translation>
    </message>
    <message>
        <source>Band</source>
        <translation>Bande</translation>
    </message>
    <message>
        <source>Bare Earth: LAZ support</source>
        <translation>Bare Earth : prise en charge LAZ</translation>
    </message>
    <message>
        <source>Bathymetric bottom</source>
        <translation>Fond bathymétrique</translation>
    </message>
    <message>
        <source>Boundary</source>
        <translation>Limite</translation>
    </message>
    <message>
        <source>Breaklines</source>
        <translation>Lignes de rupture</translation>
    </message>
    <message>
        <source>Bridges</source>
        <translation>Ponts</translation>
    </message>
    <message>
        <source>Brightness</source>
        <translation>Luminosité</translation>
    </message>
    <message>
        <source>COPC, which QGIS shows at once</source>
        <translation>COPC, que QGIS affiche aussitôt</translation>
    </message>
    <message>
        <source>CRS of the points</source>
        <translation>SCR des points</translation>
    </message>
    <message>
        <source>Cancelled.</source>
        <translation>Annulé.</translation>
    </message>
    <message>
        <source>Canopy height</source>
        <translation>Hauteur de canopée</translation>
    </message>
    <message>
        <source>Canopy height (CHM)</source>
        <translation>Hauteur de canopée (MHC)</translation>
    </message>
    <message>
        <source>Cell size</source>
        <translation>Taille de cellule</translation>
    </message>
    <message>
        <source>Cell size [m]</source>
        <translation>Taille de cellule [m]</translation>
    </message>
    <message>
        <source>Cell size of the error map</source>
        <translation>Taille de cellule de la carte des erreurs</translation>
    </message>
    <message>
        <source>Cell size of the terrain model</source>
        <translation>Taille de cellule du modèle de terrain</translation>
    </message>
    <message>
        <source>Cell size of the water</source>
        <translation>Taille de cellule de l'eau</translation>
    </message>
    <message>
        <source>Cells of objects</source>
        <translation>Cellules d'objets</translation>
    </message>
    <message>
        <source>Cells that are farther from a ground point are voids of the ground.</source>
        <translation>Les cellules plus éloignées d'un point du sol sont des vides du sol.</translation>
    </message>
    <message>
        <source>Cells with a height</source>
        <translation>Cellules avec une altitude</translation>
    </message>
    <message>
        <source>Certain</source>
        <translation>Certain</translation>
    </message>
    <message>
        <source>Check against checkpoints</source>
        <translation>Vérifier avec des points de contrôle</translation>
    </message>
    <message>
        <source>Checkpoints</source>
        <translation>Points de contrôle</translation>
    </message>
    <message>
        <source>Checkpoints in triangles with a longer edge lie in a void of the ground, such as a building, and are not counted.</source>
        <translation>Les points de contrôle dans des triangles dont un côté est plus long se trouvent dans une lacune du sol, par exemple un bâtiment, et ne comptent pas.</translation>
    </message>
    <message>
        <source>Checkpoints where the raster of confidence has less are not counted.</source>
        <translation>Les points de contrôle où le raster de fiabilité a une valeur plus basse ne comptent pas.</translation>
    </message>
    <message>
        <source>Choose a file: {}.</source>
        <translation>Choisissez un fichier : {}.</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Choisir un dossier</translation>
    </message>
    <message>
        <source>Choose a folder for the delivery.</source>
        <translation>Choisissez un dossier pour la livraison.</translation>
    </message>
    <message>
        <source>Choose a point cloud, or a folder of them.</source>
        <translation>Choisissez un nuage de points, ou un dossier de nuages de points.</translation>
    </message>
    <message>
        <source>Choose a point cloud.</source>
        <translation>Choisissez un nuage de points.</translation>
    </message>
    <message>
        <source>Choose at least one raster to make.</source>
        <translation>Choisissez au moins un raster à produire.</translation>
    </message>
    <message>
        <source>Choose point clouds, or a folder of them.</source>
        <translation>Choisissez des nuages de points, ou un dossier de nuages de points.</translation>
    </message>
    <message>
        <source>City, large halls</source>
        <translation>Grande ville, grandes halles</translation>
    </message>
    <message>
        <source>Class</source>
        <translation>Classe</translation>
    </message>
    <message>
        <source>Class of bridges</source>
        <translation>Classe des ponts</translation>
    </message>
    <message>
        <source>Class of ignored ground</source>
        <translation>Classe du sol ignoré</translation>
    </message>
    <message>
        <source>Class of key points</source>
        <translation>Classe des points clés</translation>
    </message>
    <message>
        <source>Class of other points</source>
        <translation>Classe des autres points</translation>
    </message>
    <message>
        <source>Class of the corrections</source>
        <translation>Classe des corrections</translation>
    </message>
    <message>
        <source>Class of the ground</source>
        <translation>Classe du sol</translation>
    </message>
    <message>
        <source>Class of water</source>
        <translation>Classe de l'eau</translation>
    </message>
    <message>
        <source>Classes</source>
        <translation>Classes</translation>
    </message>
    <message>
        <source>Classes above the ground</source>
        <translation>Classes au-dessus du sol</translation>
    </message>
    <message>
        <source>Classes of known ground</source>
        <translation>Classes de sol connu</translation>
    </message>
    <message>
        <source>Classes of the points that are ground. Add 8 if model key points have that class, 10 and 11 for rails and roads that lie on the ground, and 9 if water counts as ground. Withheld points are not used.</source>
        <translation>Classes des points qui sont du sol. Ajoutez 8 si les points clés du modèle ont cette classe, 10 et 11 pour les rails et les routes posés sur le sol, et 9 si l'eau compte comme sol. Les points retenus (withheld) ne sont pas utilisés.</translation>
    </message>
    <message>
        <source>Classes of the reference that are ground. Add 9 if water counts as ground.</source>
        <translation>Classes de la référence qui sont du sol. Ajoutez 9 si l'eau compte comme sol.</translation>
    </message>
    <message>
        <source>Classes of the surface model</source>
        <translation>Classes du modèle de surface</translation>
    </message>
    <message>
        <source>Classes to classify</source>
        <translation>Classes à classer</translation>
    </message>
    <message>
        <source>Classified point cloud</source>
        <translation>Nuage de points classé</translation>
    </message>
    <message>
        <source>Classified points only</source>
        <translation>Points classés seulement</translation>
    </message>
    <message>
        <source>Classified tiles</source>
        <translation>Dalles classées</translation>
    </message>
    <message>
        <source>Classifies the ground points of many files as if they were one file, and writes each file under its name into the output folder. A virtual point cloud (.vpc) lists the results.</source>
        <translation>Classe les points sol de nombreux fichiers comme s'ils n'en formaient qu'un, et écrit chaque fichier sous son nom dans le dossier de sortie. Un nuage de points virtuel (.vpc) énumère les résultats.</translation>
    </message>
    <message>
        <source>Classifies the points above the ground as well: low, medium and high vegetation (3, 4, 5) by height above ground, buildings (6), bridges (17) and high noise (18).</source>
        <translation>Classe aussi les points au-dessus du sol : végétation basse, moyenne et haute (3, 4, 5) selon la hauteur au-dessus du sol, bâtiments (6), ponts (17) et bruit haut (18).</translation>
    </message>
    <message>
        <source>Classifies the points above the ground of a classified point cloud: low, medium and high vegetation (3, 4, 5) by height above ground, buildings (6), bridges (17) and high noise (18). Buildings are found by planes that laser pulses meet once; without return numbers the planes alone decide, and smooth crowns can become buildings.
Only points of class 0 and 1 change, unless you ask for more. Nothing else in the file changes. Lengths are metres, whatever the unit of the CRS.</source>
        <translation>Classe les points au-dessus du sol d'un nuage de points classé : végétation basse, moyenne et haute (3, 4, 5) selon la hauteur au-dessus du sol, bâtiments (6), ponts (17) et bruit haut (18). Les bâtiments sont reconnus à des plans qu'une impulsion laser ne rencontre qu'une fois ; sans numéros de retour, seuls les plans décident, et des houppiers lisses peuvent devenir des bâtiments.
Seuls les points des classes 0 et 1 changent, sauf demande contraire. Rien d'autre ne change dans le fichier. Les longueurs sont en mètres, quelle que soit l'unité du SCR.</translation>
    </message>
    <message>
        <source>Classifies the points in a window with each of the settings, and makes a web page, which opens from the Results Viewer. It shows the terrain of each setting, a profile, the share of ground, where the settings differ, and how to run each of them on all points. No point cloud is written. Of a COPC file only the window is read, which takes seconds; a LAS or LAZ file is read as a whole.</source>
        <translation>Classe les points d'une fenêtre avec chacun des réglages, et produit une page web, qui s'ouvre depuis le visualiseur de résultats. Elle montre le terrain de chaque réglage, un profil, la part du sol, les endroits où les réglages diffèrent, et comment appliquer chacun d'eux à tous les points. Aucun nuage de points n'est écrit. D'un fichier COPC, seule la fenêtre est lue, en quelques secondes ; un fichier LAS ou LAZ est lu en entier.</translation>
    </message>
    <message>
        <source>Classify above ground</source>
        <translation>Classer au-dessus du sol</translation>
    </message>
    <message>
        <source>Classify ground (TIN densification)</source>
        <translation>Classer le sol (densification de TIN)</translation>
    </message>
    <message>
        <source>Classify ground (grid minimum)</source>
        <translation>Classer le sol (minimum de grille)</translation>
    </message>
    <message>
        <source>Classify ground (many files)</source>
        <translation>Classer le sol (nombreux fichiers)</translation>
    </message>
    <message>
        <source>Classify ground (slope filter)</source>
        <translation>Classer le sol (filtre de pente)</translation>
    </message>
    <message>
        <source>Classify model key points</source>
        <translation>Classer les points clés du modèle</translation>
    </message>
    <message>
        <source>Classify vegetation and buildings anew</source>
        <translation>Reclasser la végétation et les bâtiments</translation>
    </message>
    <message>
        <source>Classify water</source>
        <translation>Classer l'eau</translation>
    </message>
    <message>
        <source>Closed lines that are shorter are left out: they show single plants and noise.</source>
        <translation>Les lignes fermées plus courtes sont laissées de côté : elles montrent des plantes isolées et du bruit.</translation>
    </message>
    <message>
        <source>Compare settings on a window</source>
        <translation>Comparer des réglages dans une fenêtre</translation>
    </message>
    <message>
        <source>Compares a classified point cloud with a reference: type I and II error, kappa.</source>
        <translation>Compare un nuage de points classé avec une référence : erreurs de type I et II, kappa.</translation>
    </message>
    <message>
        <source>Compares ground points and a terrain model with points surveyed on the ground.</source>
        <translation>Compare les points de sol et un modèle de terrain à des points levés au sol.</translation>
    </message>
    <message>
        <source>Compares heights above a surface that follows the terrain (white top-hat), not elevations, so that ground on slopes is not lost.</source>
        <translation>Compare les hauteurs au-dessus d'une surface qui suit le terrain (chapeau haut-de-forme blanc), et non les altitudes, pour ne pas perdre le sol en pente.</translation>
    </message>
    <message>
        <source>Compares the ground of a classified point cloud with a reference that holds the same points, or a part of them. Type I error: the share of the reference's ground that was rejected. Type II error: the share of all other points that was accepted as ground. The report is a web page with a map.</source>
        <translation>Compare le sol d'un nuage de points classé avec une référence qui contient les mêmes points, ou une partie d'entre eux. Erreur de type I : la part du sol de la référence qui a été rejetée. Erreur de type II : la part de tous les autres points qui a été acceptée comme sol. Le rapport est une page web avec une carte.</translation>
    </message>
    <message>
        <source>Compares the triangulation (TIN) of the ground points of a classified point cloud, and a terrain model, with checkpoints: points that were surveyed on the ground. It gives the figures and the statement of the ASPRS Positional Accuracy Standards, edition 2, on land without vegetation (NVA) and with it (VVA). Nothing is shifted.
Without checkpoints, it can leave out a share of the ground points and measure how well the others predict them.</source>
        <translation>Compare la triangulation (TIN) des points de sol d'un nuage classé, et un modèle de terrain, à des points de contrôle : des points levés au sol. Le résultat comprend les chiffres et la déclaration des ASPRS Positional Accuracy Standards, édition 2, sans végétation (NVA) et avec végétation (VVA). Rien n'est décalé.
Sans points de contrôle, une part des points de sol peut être mise de côté pour mesurer comment les autres la prédisent.</translation>
    </message>
    <message>
        <source>Comparison of settings</source>
        <translation>Comparaison de réglages</translation>
    </message>
    <message>
        <source>Compressed point clouds (.laz, .copc.laz) need the Python package lazrs, which few builds of QGIS have. Here you can get it from the Python Package Index (0.6 MB) or, without internet, from a wheel file of lazrs for {}. It is stored in your profile; QGIS itself does not change.</source>
        <translation>Les nuages de points compressés (.laz, .copc.laz) demandent le paquet Python lazrs, que peu de versions de QGIS contiennent. Vous pouvez l'obtenir ici depuis le Python Package Index (0,6 Mo) ou, sans internet, depuis un fichier wheel de lazrs pour {}. Il est enregistré dans votre profil ; QGIS lui-même ne change pas.</translation>
    </message>
    <message>
        <source>Confidence</source>
        <translation>Fiabilité</translation>
    </message>
    <message>
        <source>Confidence of the terrain model</source>
        <translation>Fiabilité du modèle de terrain</translation>
    </message>
    <message>
        <source>Confidence of the terrain model, 0 to 1. Checkpoints where it is low are not counted.</source>
        <translation>Fiabilité du modèle de terrain, de 0 à 1. Les points de contrôle où elle est basse ne comptent pas.</translation>
    </message>
    <message>
        <source>Context round the window</source>
        <translation>Contexte autour de la fenêtre</translation>
    </message>
    <message>
        <source>Continue an earlier run</source>
        <translation>Continuer un traitement précédent</translation>
    </message>
    <message>
        <source>Contour interval</source>
        <translation>Équidistance des courbes de niveau</translation>
    </message>
    <message>
        <source>Contour lines</source>
        <translation>Courbes de niveau</translation>
    </message>
    <message>
        <source>Corrections</source>
        <translation>Corrections</translation>
    </message>
    <message>
        <source>Counted checkpoints</source>
        <translation>Points de contrôle comptés</translation>
    </message>
    <message>
        <source>Cuts each raster of many files into one GeoTIFF for each file. They get the names of the files, in a folder with the name of the raster. A virtual raster (.vrt) beside this folder shows them as one.</source>
        <translation>Découpe chaque raster de plusieurs fichiers en un GeoTIFF par fichier. Ils portent les noms des fichiers, dans un dossier au nom du raster. Un raster virtuel (.vrt) à côté de ce dossier les montre comme un seul.</translation>
    </message>
    <message>
        <source>Deciding rules</source>
        <translation>Règles décisives</translation>
    </message>
    <message>
        <source>Decks of bridges, found by their cross-sections. Otherwise they become buildings or vegetation. Points that have class 17 already keep it.</source>
        <translation>Tabliers de ponts, reconnus à leurs coupes en travers. Sinon, ils deviennent des bâtiments ou de la végétation. Les points qui ont déjà la classe 17 la gardent.</translation>
    </message>
    <message>
        <source>Delivery</source>
        <translation>Livraison</translation>
    </message>
    <message>
        <source>Density of first returns</source>
        <translation>Densité des premiers retours</translation>
    </message>
    <message>
        <source>Density of ground points</source>
        <translation>Densité des points du sol</translation>
    </message>
    <message>
        <source>Density of low vegetation</source>
        <translation>Densité de la végétation basse</translation>
    </message>
    <message>
        <source>Depth of low outliers</source>
        <translation>Profondeur des points aberrants bas</translation>
    </message>
    <message>
        <source>Derived water surface</source>
        <translation>Surface de l'eau dérivée</translation>
    </message>
    <message>
        <source>Difference between strips</source>
        <translation>Écart entre bandes</translation>
    </message>
    <message>
        <source>Differences between strips</source>
        <translation>Écarts entre bandes</translation>
    </message>
    <message>
        <source>Differences between strips [m]</source>
        <translation>Écarts entre bandes de vol [m]</translation>
    </message>
    <message>
        <source>Direction from which the light comes, clockwise from north. Four lights have their own directions.</source>
        <translation>Direction d'où vient la lumière, dans le sens horaire depuis le nord. Quatre lumières ont leurs propres directions.</translation>
    </message>
    <message>
        <source>Distance between points. If it is larger than that of the cloud, only the upper levels of its octree are downloaded, whose points are about so far apart.</source>
        <translation>Distance entre les points. Si elle est plus grande que celle du nuage, seuls les niveaux supérieurs de son octree sont téléchargés, dont les points sont à peu près à cette distance.</translation>
    </message>
    <message>
        <source>Distance of voids</source>
        <translation>Distance des vides</translation>
    </message>
    <message>
        <source>Documentation</source>
        <translation>Documentation</translation>
    </message>
    <message>
        <source>Done; no restart is needed.</source>
        <translation>Terminé ; il n'est pas nécessaire de redémarrer.</translation>
    </message>
    <message>
        <source>Doubtful</source>
        <translation>Douteux</translation>
    </message>
    <message>
        <source>Download part of a remote point cloud</source>
        <translation>Télécharger une partie d’un nuage de points distant</translation>
    </message>
    <message>
        <source>Downloaded point cloud</source>
        <translation>Nuage de points téléchargé</translation>
    </message>
    <message>
        <source>Downloads the points of a remote point cloud (COPC, EPT, or the one in a virtual point cloud or STAC item that has points there) that lie in an extent or a boundary: only the parts that are needed, as they are, with all of their dimensions. The log tells how much that is before it begins. If it is stopped, the same run goes on where it was.</source>
        <translation>Télécharge les points d’un nuage de points distant (COPC, EPT, ou celui d’un nuage virtuel ou d’un élément STAC qui a des points à cet endroit) qui se trouvent dans une emprise ou une limite : seulement les parties qui sont nécessaires, telles quelles, avec toutes leurs dimensions. Le journal indique la taille avant de commencer. Si l’exécution est interrompue, la même exécution reprend là où elle en était.</translation>
    </message>
    <message>
        <source>Downloads the points of a remote point cloud that lie in an area.</source>
        <translation>Télécharge les points d’un nuage de points distant qui se trouvent dans une zone.</translation>
    </message>
    <message>
        <source>Drone site</source>
        <translation>Site relevé par drone</translation>
    </message>
    <message>
        <source>Drone survey, construction or mining site</source>
        <translation>Relevé par drone, chantier ou carrière</translation>
    </message>
    <message>
        <source>Elevation raster</source>
        <translation>Raster d'altitudes</translation>
    </message>
    <message>
        <source>Error map</source>
        <translation>Carte des erreurs</translation>
    </message>
    <message>
        <source>Error of the checkpoints</source>
        <translation>Erreur des points de contrôle</translation>
    </message>
    <message>
        <source>Errors</source>
        <translation>Erreurs</translation>
    </message>
    <message>
        <source>Errors at checkpoints</source>
        <translation>Erreurs aux points de contrôle</translation>
    </message>
    <message>
        <source>Every {}</source>
        <translation>Tous les {}</translation>
    </message>
    <message>
        <source>Extent</source>
        <translation>Emprise</translation>
    </message>
    <message>
        <source>Extent of a remote point cloud</source>
        <translation>Emprise d'un nuage de points distant</translation>
    </message>
    <message>
        <source>Extent of the rasters</source>
        <translation>Emprise des rasters</translation>
    </message>
    <message>
        <source>Extra dimension HeightAboveGround</source>
        <translation>Dimension supplémentaire HeightAboveGround</translation>
    </message>
    <message>
        <source>Files keep their names; only the ending follows the format.</source>
        <translation>Les fichiers gardent leurs noms ; seule l'extension suit le format.</translation>
    </message>
    <message>
        <source>Fill pits of the canopy</source>
        <translation>Combler les trous de la canopée</translation>
    </message>
    <message>
        <source>Final height</source>
        <translation>Hauteur finale</translation>
    </message>
    <message>
        <source>Find bridges (17)</source>
        <translation>Trouver les ponts (17)</translation>
    </message>
    <message>
        <source>Find buildings (6)</source>
        <translation>Trouver les bâtiments (6)</translation>
    </message>
    <message>
        <source>Find high noise (18)</source>
        <translation>Trouver le bruit haut (18)</translation>
    </message>
    <message>
        <source>Find water</source>
        <translation>Trouver l'eau</translation>
    </message>
    <message>
        <source>Finds lakes and rivers as polygons with their levels, and as breaklines.</source>
        <translation>Trouve les lacs et les rivières sous forme de polygones avec leurs niveaux, et de lignes de rupture.</translation>
    </message>
    <message>
        <source>Finds the few ground points of a classified point cloud that a terrain model needs. Of all other ground points, none lies farther above or below the triangulation (TIN) of these key points than the tolerances. Key points get a class of their own, or the key-point flag; nothing else in the file changes.
Lengths are metres, whatever the unit of the CRS.</source>
        <translation>Trouve les quelques points sol d'un nuage de points classé dont un modèle de terrain a besoin. Parmi tous les autres points sol, aucun n'est plus haut ou plus bas par rapport à la triangulation (TIN) de ces points clés que les tolérances. Les points clés reçoivent une classe à part, ou l'indicateur de point clé ; rien d'autre ne change dans le fichier.
Les longueurs sont en mètres, quelle que soit l'unité du SCR.</translation>
    </message>
    <message>
        <source>Finds the few ground points that make as good a terrain model as all of them.</source>
        <translation>Trouve les quelques points sol qui donnent un aussi bon modèle de terrain que tous ensemble.</translation>
    </message>
    <message>
        <source>Finds the ground by two methods, and says where they differ.</source>
        <translation>Trouve le sol par deux méthodes, et dit où elles diffèrent.</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud (TIN densification), adds the height above it to every point, and makes rasters of terrain and canopy height.</source>
        <translation>Trouve le sol d'un nuage de points lidar brut (densification de TIN), ajoute à chaque point la hauteur au-dessus de lui, et produit des rasters du terrain et de la hauteur de canopée.</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud (TIN densification), makes terrain model and hillshade of it, and contour lines of the terrain model (GDAL).</source>
        <translation>Trouve le sol d'un nuage de points lidar brut (densification de TIN), en fait un modèle de terrain et un ombrage, et des courbes de niveau du modèle de terrain (GDAL).</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud and makes maps of it. Each output is optional. A delivery makes all that a job hands over, in one folder: for a survey, archaeology, forestry, floods or a drone site. Lengths are metres.</source>
        <translation>Trouve le sol d'un nuage de points lidar brut et en fait des cartes. Chaque sortie est facultative. Une livraison fait tout ce qu'une mission remet, dans un dossier : pour un levé, l'archéologie, la forêt, les inondations ou un site relevé par drone. Les longueurs sont en mètres.</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud by TIN densification and by the slope filter, and compares the two: a hillshade of each, and a report with TIN densification as the reference. Where both agree, the result is more certain; check the places where they differ.</source>
        <translation>Trouve le sol d'un nuage de points lidar brut par densification de TIN et par le filtre de pente, et compare les deux : un ombrage de chacun, et un rapport avec la densification de TIN comme référence. Là où les deux concordent, le résultat est plus sûr ; vérifiez les endroits où elles diffèrent.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud by rules on the lowest points of cells.</source>
        <translation>Trouve les points sol d'un nuage de points lidar par des règles sur les points les plus bas de cellules.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud by the slopes between neighbouring points.</source>
        <translation>Trouve les points sol d'un nuage de points lidar par les pentes entre points voisins.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud, and makes a terrain model of them.</source>
        <translation>Trouve les points sol d'un nuage de points lidar, et en fait un modèle de terrain.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar by progressive TIN densification, and writes a point cloud with the new classes; nothing else in it changes. The filter starts from a sparse triangulation (TIN) of points that are surely ground. Round by round it adds points that lie close to the TIN.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Trouve les points sol d'un lidar aéroporté ou de drone par densification progressive de TIN, et écrit un nuage de points avec les nouvelles classes ; rien d'autre n'y change. Le filtre part d'une triangulation lâche (TIN) de points qui sont sûrement du sol. Tour après tour, il ajoute des points proches du TIN.
Les longueurs sont en mètres et les angles en degrés, quelle que soit l'unité du SCR. Le modèle de terrain et son ombrage sont des GeoTIFF.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar by slopes, and writes a point cloud with the new classes; nothing else in it changes. A point is not ground if it stands higher above a neighbour than terrain can. The preset Automatic compares points on many scales and follows the terrain; the preset Whitebox repeats WhiteboxTools' LidarGroundPointFilter.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Trouve les points sol d'un lidar aéroporté ou de drone par les pentes, et écrit un nuage de points avec les nouvelles classes ; rien d'autre n'y change. Un point n'est pas du sol s'il dépasse un voisin plus qu'un terrain ne le peut. Le préréglage Automatique compare les points à plusieurs échelles et suit le terrain ; le préréglage Whitebox reproduit LidarGroundPointFilter de WhiteboxTools.
Les longueurs sont en mètres et les angles en degrés, quelle que soit l'unité du SCR. Le modèle de terrain et son ombrage sont des GeoTIFF.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar on a grid of lowest points, and writes a point cloud with the new classes; nothing else in it changes. Steps between neighbouring cells are the rims of objects. What such rims enclose is removed, tall objects first. The method is fast, and needs only heights, no return numbers.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Trouve les points sol d'un lidar aéroporté ou de drone sur une grille de points les plus bas, et écrit un nuage de points avec les nouvelles classes ; rien d'autre n'y change. Les marches entre cellules voisines sont les bords d'objets. Ce que ces bords entourent est enlevé, les objets hauts en premier. La méthode est rapide et ne demande que des altitudes, pas de numéros de retour.
Les longueurs sont en mètres et les angles en degrés, quelle que soit l'unité du SCR. Le modèle de terrain et son ombrage sont des GeoTIFF.</translation>
    </message>
    <message>
        <source>Finds the ground points of the many files of a survey, without seams between them.</source>
        <translation>Trouve les points sol des nombreux fichiers d'un levé, sans raccords visibles entre eux.</translation>
    </message>
    <message>
        <source>Finds vegetation, buildings and bridges in a point cloud whose ground is known.</source>
        <translation>Trouve la végétation, les bâtiments et les ponts dans un nuage de points dont le sol est connu.</translation>
    </message>
    <message>
        <source>Finds water in a classified point cloud: where hardly any last return is, and the ground along the shore is level or falls steadily, or where points have class 9. Gaps between strips, roofs and woods are told from it. Each polygon has the level, the spread of the shore, and a grade of certainty. The terrain model takes the polygons as water.</source>
        <translation>Trouve l'eau dans un nuage de points classé : là où il n'y a presque pas de derniers retours et où le sol le long de la rive est horizontal ou descend régulièrement, ou là où les points ont la classe 9. Les lacunes entre les bandes, les toits et les forêts en sont distingués. Chaque polygone a le niveau, la dispersion de la rive et un degré de certitude. Le modèle de terrain prend les polygones comme eau.</translation>
    </message>
    <message>
        <source>First and single returns</source>
        <translation>Premiers retours et retours uniques</translation>
    </message>
    <message>
        <source>First returns</source>
        <translation>Premiers retours</translation>
    </message>
    <message>
        <source>First returns hit the tops of trees and buildings. Take all returns if the return numbers of the file are wrong.</source>
        <translation>Les premiers retours touchent le haut des arbres et des bâtiments. Prenez tous les retours si les numéros de retour du fichier sont faux.</translation>
    </message>
    <message>
        <source>First returns per m²</source>
        <translation>Premiers retours par m²</translation>
    </message>
    <message>
        <source>Flat land, fields</source>
        <translation>Terrain plat, champs</translation>
    </message>
    <message>
        <source>Flood model</source>
        <translation>Modèle d'inondation</translation>
    </message>
    <message>
        <source>Folder of point clouds</source>
        <translation>Dossier de nuages de points</translation>
    </message>
    <message>
        <source>Folder of the classified point clouds</source>
        <translation>Dossier des nuages de points classés</translation>
    </message>
    <message>
        <source>Folder of the delivery</source>
        <translation>Dossier de la livraison</translation>
    </message>
    <message>
        <source>Folder of the rasters</source>
        <translation>Dossier des rasters</translation>
    </message>
    <message>
        <source>Follow lists to other servers</source>
        <translation>Suivre les listes vers d’autres serveurs</translation>
    </message>
    <message>
        <source>For the lines, each height is averaged with its surroundings up to about this distance, so that they do not show noise. The terrain model does not change. 0: as the terrain model is.</source>
        <translation>Pour les lignes, chaque altitude est moyennée avec son voisinage jusqu'à environ cette distance, afin qu'elles ne montrent pas de bruit. Le modèle de terrain ne change pas. 0 : comme le modèle de terrain.</translation>
    </message>
    <message>
        <source>Forestry</source>
        <translation>Forêt</translation>
    </message>
    <message>
        <source>Format of the output</source>
        <translation>Format de sortie</translation>
    </message>
    <message>
        <source>Four lights, from southwest to north</source>
        <translation>Quatre lumières, du sud-ouest au nord</translation>
    </message>
    <message>
        <source>From a raw point cloud to heights above ground, of points and as a raster.</source>
        <translation>Du nuage de points brut aux hauteurs au-dessus du sol, des points et en raster.</translation>
    </message>
    <message>
        <source>From a raw point cloud to terrain model, hillshade and contour lines.</source>
        <translation>Du nuage de points brut au modèle de terrain, à l'ombrage et aux courbes de niveau.</translation>
    </message>
    <message>
        <source>From a wheel file…</source>
        <translation>Depuis un fichier wheel…</translation>
    </message>
    <message>
        <source>GB</source>
        <translation>Go</translation>
    </message>
    <message>
        <source>Gaps inside the survey are filled by triangles. A triangle with a longer edge than this has no data, for example over water. Empty: all gaps inside are filled. Beyond the outline of the points no raster has data in any case.</source>
        <translation>Les vides à l'intérieur du levé sont comblés par des triangles. Un triangle dont un côté est plus long que ceci reste sans donnée, par exemple sur l'eau. Vide : tous les vides à l'intérieur sont comblés. Au-delà du contour des points, aucun raster n'a de données, dans tous les cas.</translation>
    </message>
    <message>
        <source>Get lazrs</source>
        <translation>Obtenir lazrs</translation>
    </message>
    <message>
        <source>Gigabytes that may be downloaded of a remote point cloud. The log tells how many it takes before the download begins; more are refused.</source>
        <translation>Gigaoctets qui peuvent être téléchargés d'un nuage de points distant. Le journal dit combien il en faut avant le téléchargement ; au-delà, c'est refusé.</translation>
    </message>
    <message>
        <source>Give an extent or a boundary, not both, for an address.</source>
        <translation>Pour une adresse, indiquez une emprise ou une limite, pas les deux.</translation>
    </message>
    <message>
        <source>Given</source>
        <translation>Fournie</translation>
    </message>
    <message>
        <source>Gives class 9 to ground points in water, and class 20 to those beside its shore.</source>
        <translation>Donne la classe 9 aux points de sol dans l'eau, et la classe 20 à ceux qui longent la rive.</translation>
    </message>
    <message>
        <source>Go on if tiles of an EPT data set are missing on the server. A warning counts them.</source>
        <translation>Continuer si des tuiles d’un jeu EPT manquent sur le serveur. Un avertissement les compte.</translation>
    </message>
    <message>
        <source>Grid minimum</source>
        <translation>Minimum de grille</translation>
    </message>
    <message>
        <source>Grid minimum, Automatic</source>
        <translation>Minimum de grille, Automatique</translation>
    </message>
    <message>
        <source>Grid minimum, City, large halls</source>
        <translation>Minimum de grille, Grande ville, grandes halles</translation>
    </message>
    <message>
        <source>Grid minimum, Drone survey, construction or mining site</source>
        <translation>Minimum de grille, Relevé par drone, chantier ou carrière</translation>
    </message>
    <message>
        <source>Grid minimum, Flat land, fields</source>
        <translation>Minimum de grille, Terrain plat, champs</translation>
    </message>
    <message>
        <source>Grid minimum, Hilly land, forest</source>
        <translation>Minimum de grille, Terrain vallonné, forêt</translation>
    </message>
    <message>
        <source>Grid minimum, Steep or rugged terrain</source>
        <translation>Minimum de grille, Terrain raide ou accidenté</translation>
    </message>
    <message>
        <source>Grid minimum, The paper's values</source>
        <translation>Minimum de grille, Valeurs de l'article</translation>
    </message>
    <message>
        <source>Grid minimum, Town</source>
        <translation>Minimum de grille, Ville</translation>
    </message>
    <message>
        <source>Grid size</source>
        <translation>Pas de la grille</translation>
    </message>
    <message>
        <source>Ground classes</source>
        <translation>Classes de sol</translation>
    </message>
    <message>
        <source>Ground classes of the reference</source>
        <translation>Classes de sol de la référence</translation>
    </message>
    <message>
        <source>Ground classification</source>
        <translation>Classification du sol</translation>
    </message>
    <message>
        <source>Ground points</source>
        <translation>Points sol</translation>
    </message>
    <message>
        <source>Ground points in polygons of water become water (9), and those within a distance of the shore ignored ground (20), as the Lidar Base Specification asks for. Nothing else in the file changes: points with other classes keep them.</source>
        <translation>Les points de sol dans les polygones d'eau deviennent de l'eau (9), et ceux à une certaine distance de la rive du sol ignoré (20), comme le demande la Lidar Base Specification. Rien d'autre ne change dans le fichier : les points des autres classes les gardent.</translation>
    </message>
    <message>
        <source>Ground points outside of the water, up to this far from its shore, become ignored ground: there the breakline alone decides the terrain. The Lidar Base Specification asks for one nominal point spacing: 0.7 m for QL2, 0.35 m for QL1. 0: none.</source>
        <translation>Les points de sol hors de l'eau, jusqu'à cette distance de la rive, deviennent du sol ignoré : là, seule la ligne de rupture décide du terrain. La Lidar Base Specification demande un espacement nominal des points : 0,7 m pour QL2, 0,35 m pour QL1. 0 : aucun.</translation>
    </message>
    <message>
        <source>Ground points per m²</source>
        <translation>Points du sol par m²</translation>
    </message>
    <message>
        <source>Ground tolerance</source>
        <translation>Tolérance du sol</translation>
    </message>
    <message>
        <source>Ground tolerance above</source>
        <translation>Tolérance du sol vers le haut</translation>
    </message>
    <message>
        <source>Ground tolerance below</source>
        <translation>Tolérance du sol vers le bas</translation>
    </message>
    <message>
        <source>Ground tolerance on slopes</source>
        <translation>Tolérance du sol en pente</translation>
    </message>
    <message>
        <source>Ground: {}</source>
        <translation>Sol : {}</translation>
    </message>
    <message>
        <source>HTML files (*.html)</source>
        <translation>Fichiers HTML (*.html)</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Altitude</translation>
    </message>
    <message>
        <source>Height above ground</source>
        <translation>Hauteur au-dessus du sol</translation>
    </message>
    <message>
        <source>Height at which high vegetation begins</source>
        <translation>Hauteur à laquelle commence la végétation haute</translation>
    </message>
    <message>
        <source>Height at which low vegetation begins</source>
        <translation>Hauteur à laquelle commence la végétation basse</translation>
    </message>
    <message>
        <source>Height at which medium vegetation begins</source>
        <translation>Hauteur à laquelle commence la végétation moyenne</translation>
    </message>
    <message>
        <source>Height of high outliers</source>
        <translation>Hauteur des points aberrants hauts</translation>
    </message>
    <message>
        <source>Height of the checkpoints</source>
        <translation>Altitude des points de contrôle</translation>
    </message>
    <message>
        <source>Height threshold</source>
        <translation>Seuil de hauteur</translation>
    </message>
    <message>
        <source>Height thresholds</source>
        <translation>Seuils de hauteur</translation>
    </message>
    <message>
        <source>Heights above ground</source>
        <translation>Hauteurs au-dessus du sol</translation>
    </message>
    <message>
        <source>Heights are measured above this raster, and not above the ground points. It must have the CRS of the points. Empty: above the ground points.</source>
        <translation>Les hauteurs sont mesurées au-dessus de ce raster, et non au-dessus des points sol. Il doit avoir le SCR des points. Vide : au-dessus des points sol.</translation>
    </message>
    <message>
        <source>Heights of the bare ground.</source>
        <translation>Altitudes du sol nu.</translation>
    </message>
    <message>
        <source>Heights of vegetation</source>
        <translation>Hauteurs de la végétation</translation>
    </message>
    <message>
        <source>Highest height</source>
        <translation>Hauteur la plus grande</translation>
    </message>
    <message>
        <source>Hillshade</source>
        <translation>Ombrage</translation>
    </message>
    <message>
        <source>Hillshade altitude</source>
        <translation>Hauteur de la lumière de l'ombrage</translation>
    </message>
    <message>
        <source>Hillshade azimuth</source>
        <translation>Azimut de l'ombrage</translation>
    </message>
    <message>
        <source>Hillshade, TIN densification</source>
        <translation>Ombrage, densification de TIN</translation>
    </message>
    <message>
        <source>Hillshade, slope filter</source>
        <translation>Ombrage, filtre de pente</translation>
    </message>
    <message>
        <source>Hilly land, forest</source>
        <translation>Terrain vallonné, forêt</translation>
    </message>
    <message>
        <source>How far a ground point may lie above the TIN of the key points. Choose about the accuracy of the heights, or half the contour interval that you want.</source>
        <translation>La hauteur maximale d'un point sol au-dessus du TIN des points clés. Choisissez environ la précision des altitudes, ou la moitié de l'équidistance voulue des courbes de niveau.</translation>
    </message>
    <message>
        <source>How far a ground point may lie below the TIN of the key points.</source>
        <translation>La profondeur maximale d'un point sol sous le TIN des points clés.</translation>
    </message>
    <message>
        <source>How many threads compute at the same time. The result does not depend on it. Empty: as many as there are processors.</source>
        <translation>Le nombre de fils d'exécution qui calculent en même temps. Le résultat n'en dépend pas. Vide : autant qu'il y a de processeurs.</translation>
    </message>
    <message>
        <source>IGN LiDAR HD</source>
        <translation>IGN LiDAR HD</translation>
    </message>
    <message>
        <source>If this is off, only points of class 0 and 1 change. If it is on, points of class 3 to 6 are decided anew as well. All others keep their class, such as water (9) and wires.</source>
        <translation>Si ceci est désactivé, seuls les points des classes 0 et 1 changent. Sinon, les points des classes 3 à 6 sont aussi décidés à nouveau. Tous les autres gardent leur classe, comme l'eau (9) et les câbles.</translation>
    </message>
    <message>
        <source>Ignored classes of the reference</source>
        <translation>Classes ignorées de la référence</translation>
    </message>
    <message>
        <source>Ignored ground</source>
        <translation>Sol ignoré</translation>
    </message>
    <message>
        <source>Ignored ground beside the shore</source>
        <translation>Sol ignoré le long de la rive</translation>
    </message>
    <message>
        <source>In a CRS in feet, a size of 3 in units of the CRS gives cells of exactly 3 feet that begin at whole multiples of 3 feet.</source>
        <translation>Dans un SCR en pieds, une taille de 3 en unités du SCR donne des cellules d'exactement 3 pieds, qui commencent aux multiples entiers de 3 pieds.</translation>
    </message>
    <message>
        <source>In each cell of this size that has ground points, at least the lowest one is a key point, however flat the ground is.</source>
        <translation>Dans chaque cellule de cette taille qui a des points sol, au moins le plus bas est un point clé, aussi plat que soit le sol.</translation>
    </message>
    <message>
        <source>In level terrain, points down to this depth below the final surface are ground. The surface goes through the lowest points, but is smoother than they are.</source>
        <translation>En terrain plat, les points jusqu'à cette profondeur sous la surface finale sont du sol. La surface passe par les points les plus bas, mais elle est plus lisse qu'eux.</translation>
    </message>
    <message>
        <source>In level terrain, points up to this height above the final surface are ground. A larger value takes in grass and low bushes.</source>
        <translation>En terrain plat, les points jusqu'à cette hauteur au-dessus de la surface finale sont du sol. Une valeur plus grande prend aussi l'herbe et les buissons bas.</translation>
    </message>
    <message>
        <source>In level terrain, points up to this height above the surface of the ground are ground. Empty: from the preset.</source>
        <translation>En terrain plat, les points jusqu'à cette hauteur au-dessus de la surface du sol sont du sol. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>In level terrain, points up to this height above the surface through the ground are ground. Not used with the preset Whitebox.</source>
        <translation>En terrain plat, les points jusqu'à cette hauteur au-dessus de la surface passant par le sol sont du sol. Pas pour le préréglage Whitebox.</translation>
    </message>
    <message>
        <source>In scripts</source>
        <translation>Dans les scripts</translation>
    </message>
    <message>
        <source>In triangles whose longest edge is shorter than this, the iteration angle is reduced in proportion. So the TIN does not climb low vegetation step by step. Empty: the angle is never reduced.</source>
        <translation>Dans les triangles dont le plus long côté est plus court que ceci, l'angle d'itération est réduit en proportion. Ainsi, le TIN ne gravit pas pas à pas la végétation basse. Vide : l'angle n'est jamais réduit.</translation>
    </message>
    <message>
        <source>Include subfolders</source>
        <translation>Inclure les sous-dossiers</translation>
    </message>
    <message>
        <source>International foot</source>
        <translation>Pied international</translation>
    </message>
    <message>
        <source>Iteration angle</source>
        <translation>Angle d'itération</translation>
    </message>
    <message>
        <source>Iteration distance</source>
        <translation>Distance d'itération</translation>
    </message>
    <message>
        <source>Kappa [%]</source>
        <translation>Kappa [%]</translation>
    </message>
    <message>
        <source>Keep; old ground that is not ground now becomes 1</source>
        <translation>Garder ; l'ancien sol qui n'est plus du sol devient 1</translation>
    </message>
    <message>
        <source>Keeps the tiles that an earlier run finished, if they were made from the same files with the same parameters. All other tiles are classified again.</source>
        <translation>Garde les dalles terminées par un traitement précédent, si elles viennent des mêmes fichiers avec les mêmes paramètres. Toutes les autres dalles sont reclassées.</translation>
    </message>
    <message>
        <source>Key points</source>
        <translation>Points clés</translation>
    </message>
    <message>
        <source>Key points: grid size</source>
        <translation>Points clés : pas de la grille</translation>
    </message>
    <message>
        <source>Key points: tolerance above</source>
        <translation>Points clés : tolérance vers le haut</translation>
    </message>
    <message>
        <source>Key points: tolerance below</source>
        <translation>Points clés : tolérance vers le bas</translation>
    </message>
    <message>
        <source>Kinds of relief</source>
        <translation>Types de relief</translation>
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
        <translation>Prise en charge LAZ</translation>
    </message>
    <message>
        <source>LAZ support…</source>
        <translation>Prise en charge LAZ…</translation>
    </message>
    <message>
        <source>LINZ, New Zealand National Aerial LiDAR Base Specification (PGF version)</source>
        <translation>LINZ, New Zealand National Aerial LiDAR Base Specification (version PGF)</translation>
    </message>
    <message>
        <source>Lakes</source>
        <translation>Lacs</translation>
    </message>
    <message>
        <source>Land cover of the checkpoints</source>
        <translation>Occupation du sol des points de contrôle</translation>
    </message>
    <message>
        <source>Largest angle between a triangle and the line from one of its corners to a new point. A larger angle follows rugged ground better, a smaller one keeps low objects out: 4 deg in flat terrain, 10 deg and more in steep terrain. Empty: from the preset.</source>
        <translation>Le plus grand angle entre un triangle et la ligne d'un de ses sommets à un nouveau point. Un angle plus grand suit mieux un terrain accidenté, un plus petit écarte les objets bas : 4 degrés en terrain plat, 10 degrés et plus en terrain raide. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Largest distance of a new point from its triangle. Empty: from the preset.</source>
        <translation>La plus grande distance d'un nouveau point à son triangle. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Last and single returns (return number = number of returns)</source>
        <translation>Derniers retours et retours uniques (numéro du retour = nombre de retours)</translation>
    </message>
    <message>
        <source>Last returns reach the ground. Take all returns if the return numbers of the file are wrong.</source>
        <translation>Les derniers retours atteignent le sol. Prenez tous les retours si les numéros de retour du fichier sont faux.</translation>
    </message>
    <message>
        <source>Least area of a roof</source>
        <translation>Surface minimale d'un toit</translation>
    </message>
    <message>
        <source>Least confidence</source>
        <translation>Fiabilité minimale</translation>
    </message>
    <message>
        <source>Least height of a roof</source>
        <translation>Hauteur minimale d'un toit</translation>
    </message>
    <message>
        <source>Leave out</source>
        <translation>Laisser de côté</translation>
    </message>
    <message>
        <source>Leave out; they keep their class</source>
        <translation>Laisser de côté ; ils gardent leur classe</translation>
    </message>
    <message>
        <source>Leaves out so large a share of the ground points of a delivery, and states how well the others predict them. Empty: this is not measured.</source>
        <translation>Met de côté cette part des points de sol d'une livraison et indique comment les autres la prédisent. Vide : ce n'est pas mesuré.</translation>
    </message>
    <message>
        <source>Leaves out so large a share of the ground points, such as 0.02, and measures how well the others predict them, on open land, under trees and on steep land. This needs no checkpoints, but it does not tell how right the heights are.</source>
        <translation>Met de côté cette part des points de sol, par exemple 0,02, et mesure comment les autres la prédisent : en terrain ouvert, sous les arbres et dans les pentes. Aucun point de contrôle n'est nécessaire, mais cela ne dit pas si les altitudes sont justes.</translation>
    </message>
    <message>
        <source>LiDAR360's values</source>
        <translation>Valeurs de LiDAR360</translation>
    </message>
    <message>
        <source>Light of the hillshade</source>
        <translation>Lumière de l'ombrage</translation>
    </message>
    <message>
        <source>Likely</source>
        <translation>Probable</translation>
    </message>
    <message>
        <source>Limit</source>
        <translation>Maximum</translation>
    </message>
    <message>
        <source>Limit of the download [GB]</source>
        <translation>Limite du téléchargement [Go]</translation>
    </message>
    <message>
        <source>Line of the profile</source>
        <translation>Ligne du profil</translation>
    </message>
    <message>
        <source>Lines along which the level of the water polygons falls. They may be drawn in either direction.</source>
        <translation>Lignes le long desquelles descend le niveau des polygones d'eau. Elles peuvent être dessinées dans un sens ou dans l'autre.</translation>
    </message>
    <message>
        <source>Lines of equal height of the terrain model, with the field ELEV.</source>
        <translation>Lignes d'égale altitude du modèle de terrain, avec le champ ELEV.</translation>
    </message>
    <message>
        <source>Lines of equal height of the terrain model, with the field ELEV. They are smoothed, so that they do not show noise. Every fifth line has its height as a label.</source>
        <translation>Lignes d'égale altitude du modèle de terrain, avec le champ ELEV. Elles sont lissées, afin de ne pas montrer de bruit. Une ligne sur cinq porte son altitude comme étiquette.</translation>
    </message>
    <message>
        <source>Lines that no triangle of the terrain crosses: edges of walls, dykes and terraces. A line with z has this height. Without z, each side of the line has the height of the nearest ground point on that side.</source>
        <translation>Lignes qu'aucun triangle du terrain ne traverse : bords de murs, de digues et de terrasses. Une ligne avec z a cette altitude. Sans z, chaque côté de la ligne a l'altitude du point sol le plus proche de ce côté.</translation>
    </message>
    <message>
        <source>Local dominance</source>
        <translation>Dominance locale</translation>
    </message>
    <message>
        <source>Local relief</source>
        <translation>Relief local</translation>
    </message>
    <message>
        <source>Local relief, openness, sky view and the like compare a place with its surroundings up to this distance. Choose about the width of the features that you want to see; larger landforms disappear.</source>
        <translation>Le relief local, l'ouverture, la vue du ciel et autres comparent chaque lieu à ses environs jusqu'à cette distance. Choisissez à peu près la largeur des formes à voir ; les formes plus grandes disparaissent.</translation>
    </message>
    <message>
        <source>Longest edge of a triangle</source>
        <translation>Plus long côté d'un triangle</translation>
    </message>
    <message>
        <source>Lowest height</source>
        <translation>Hauteur la plus petite</translation>
    </message>
    <message>
        <source>Made by Bare Earth with these settings:</source>
        <translation>Produit par Bare Earth avec ces réglages :</translation>
    </message>
    <message>
        <source>Makes a map of the terrain of a raw point cloud: classes, models, contours.</source>
        <translation>Produit une carte du terrain à partir d'un nuage de points brut : classes, modèles, courbes de niveau.</translation>
    </message>
    <message>
        <source>Makes a terrain model from a surface model, if there is no point cloud. Removes what stands above the terrain around it, has steep edges on all sides and is not wider than the maximum object size. Fills the gaps smoothly. Hills and slopes stay.
The output has the same grid, CRS and unit. Lengths are metres, whatever the unit of the CRS.</source>
        <translation>Fait d'un modèle numérique de surface un modèle de terrain, s'il n'y a pas de nuage de points. Enlève ce qui dépasse le terrain alentour, a des bords raides de tous côtés et n'est pas plus large que la taille maximale des objets. Comble les vides en douceur. Les collines et les versants restent.
La sortie a la même grille, le même SCR et la même unité. Les longueurs sont en mètres, quelle que soit l'unité du SCR.</translation>
    </message>
    <message>
        <source>Makes pictures of the relief of any elevation raster, on the same grid: sky-view factor, openness, local dominance, local relief, slope, hillshade, archaeological topography (VAT) and red relief. They show small features that a hillshade of one light hides.
For walls and banks make the terrain model in cells of 0.25 to 0.5 m.</source>
        <translation>Produit des images du relief de tout raster d'altitude, sur la même grille : facteur de vue du ciel, ouverture, dominance locale, relief local, pente, ombrage, topographie archéologique (VAT) et relief rouge. Elles montrent de petites formes qu'un ombrage à une seule lumière cache.
Pour les murs et les talus, produisez le modèle de terrain avec des cellules de 0,25 à 0,5 m.</translation>
    </message>
    <message>
        <source>Makes rasters (GeoTIFF) of a classified point cloud: the terrain, interpolated on the triangulation (TIN) of the ground points; the surface, the highest point of each cell without noise; canopy height, the difference of the two; and a hillshade of the terrain. All lie on the same grid. Heights are in the vertical unit of the CRS.</source>
        <translation>Produit des rasters (GeoTIFF) à partir d'un nuage de points classé : le terrain, interpolé sur la triangulation (TIN) des points sol ; la surface, le point le plus haut de chaque cellule sans le bruit ; la hauteur de canopée, la différence des deux ; et un ombrage du terrain. Tous ont la même grille. Les altitudes sont dans l'unité verticale du SCR.</translation>
    </message>
    <message>
        <source>Makes terrain model, surface model, canopy height and hillshade of a point cloud.</source>
        <translation>Produit le MNT, le MNS, la hauteur de canopée et l'ombrage d'un nuage de points.</translation>
    </message>
    <message>
        <source>Mark key points by</source>
        <translation>Marquer les points clés par</translation>
    </message>
    <message>
        <source>Mark model key points</source>
        <translation>Marquer les points clés du modèle</translation>
    </message>
    <message>
        <source>Marks the ground points of a delivery that a terrain model needs, by the key-point flag of LAS.</source>
        <translation>Marque les points de sol d'une livraison dont un modèle de terrain a besoin, par l'indicateur de point clé de LAS.</translation>
    </message>
    <message>
        <source>Maximum building size</source>
        <translation>Taille maximale des bâtiments</translation>
    </message>
    <message>
        <source>Maximum edge</source>
        <translation>Côté maximal</translation>
    </message>
    <message>
        <source>Maximum object size</source>
        <translation>Taille maximale des objets</translation>
    </message>
    <message>
        <source>Maximum surface height</source>
        <translation>Hauteur maximale de la surface</translation>
    </message>
    <message>
        <source>Maximum terrain angle</source>
        <translation>Pente maximale du terrain</translation>
    </message>
    <message>
        <source>Mean difference [m]</source>
        <translation>Écart moyen [m]</translation>
    </message>
    <message>
        <source>Measures a classified survey, of one file or many: densities of first returns and of ground points, voids, low vegetation, overlap of flight strips and differences between them, classes and file formats. It compares the figures with a specification, and makes a web page, which opens from the Results Viewer, and rasters.</source>
        <translation>Mesure un levé classé, d'un fichier ou de plusieurs : densités des premiers retours et des points du sol, vides, végétation basse, recouvrement des bandes de vol et écarts entre elles, classes et formats de fichier. Compare les chiffres à une spécification, et crée une page web, qui s'ouvre depuis la visionneuse de résultats, et des rasters.</translation>
    </message>
    <message>
        <source>Measures densities, voids and strips, and compares them with a specification.</source>
        <translation>Mesure densités, vides et bandes de vol, et les compare à une spécification.</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Mémoire</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Méthode</translation>
    </message>
    <message>
        <source>Methods, each with a preset. All others are compared with the first one.</source>
        <translation>Méthodes, chacune avec un préréglage. Toutes les autres sont comparées à la première.</translation>
    </message>
    <message>
        <source>Metre</source>
        <translation>Mètre</translation>
    </message>
    <message>
        <source>Metres</source>
        <translation>Mètres</translation>
    </message>
    <message>
        <source>Minimum number of neighbours</source>
        <translation>Nombre minimal de voisins</translation>
    </message>
    <message>
        <source>Model key point</source>
        <translation>Point clé du modèle</translation>
    </message>
    <message>
        <source>Models</source>
        <translation>Modèles</translation>
    </message>
    <message>
        <source>Multi-scale relief</source>
        <translation>Relief multi-échelle</translation>
    </message>
    <message>
        <source>Name of the checkpoints</source>
        <translation>Nom des points de contrôle</translation>
    </message>
    <message>
        <source>Negative openness</source>
        <translation>Ouverture négative</translation>
    </message>
    <message>
        <source>No Python interpreter was found beside this QGIS, so pip cannot be run: choose a wheel file instead.</source>
        <translation>Aucun interpréteur Python n'a été trouvé à côté de ce QGIS, pip ne peut donc pas s'exécuter : choisissez plutôt un fichier wheel.</translation>
    </message>
    <message>
        <source>No ground here</source>
        <translation>Pas de sol ici</translation>
    </message>
    <message>
        <source>No ground near</source>
        <translation>Pas de sol à proximité</translation>
    </message>
    <message>
        <source>No specification</source>
        <translation>Aucune spécification</translation>
    </message>
    <message>
        <source>No-data value of the rasters</source>
        <translation>Valeur nodata des rasters</translation>
    </message>
    <message>
        <source>Noise distance</source>
        <translation>Distance de bruit</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Aucun</translation>
    </message>
    <message>
        <source>None: what is not ground has no further class</source>
        <translation>Aucune : ce qui n'est pas le sol n'a pas d'autre classe</translation>
    </message>
    <message>
        <source>Not counted</source>
        <translation>Non comptés</translation>
    </message>
    <message>
        <source>Not ground</source>
        <translation>Pas du sol</translation>
    </message>
    <message>
        <source>Not ground, except with a classic preset</source>
        <translation>Pas du sol, sauf avec un préréglage classique</translation>
    </message>
    <message>
        <source>Not ground: {}</source>
        <translation>Non-sol : {}</translation>
    </message>
    <message>
        <source>Not installed yet: .laz and .copc.laz files cannot be read or written.</source>
        <translation>Pas encore installé : les fichiers .laz et .copc.laz ne peuvent être ni lus ni écrits.</translation>
    </message>
    <message>
        <source>Number of strips</source>
        <translation>Nombre de bandes</translation>
    </message>
    <message>
        <source>Number of the raster's band that holds the heights.</source>
        <translation>Numéro de la bande du raster qui contient les altitudes.</translation>
    </message>
    <message>
        <source>Objects have edges steeper than this on all sides. What rises more gently on some side is a hill. The slopes of the terrain below do not count.</source>
        <translation>Les objets ont de tous côtés des bords plus raides que ceci. Ce qui monte plus doucement d'un côté est une colline. Les pentes du terrain en dessous ne comptent pas.</translation>
    </message>
    <message>
        <source>One light</source>
        <translation>Une lumière</translation>
    </message>
    <message>
        <source>One light shows best the landforms that lie across it, but slopes that face away are dark. Four lights show landforms of any direction.</source>
        <translation>Une seule lumière montre le mieux les formes du terrain qui lui sont perpendiculaires, mais les versants qui s'en détournent sont sombres. Quatre lumières montrent les formes du terrain de toute direction.</translation>
    </message>
    <message>
        <source>One pass for each threshold, the largest first. If two neighbouring cells differ by more than the threshold, the higher one is the rim of an object. Empty: from the preset.</source>
        <translation>Un passage pour chaque seuil, en partant du plus grand. Si deux cellules voisines diffèrent de plus que le seuil, la plus haute est le bord d'un objet. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>One raster for each file</source>
        <translation>Un raster par fichier</translation>
    </message>
    <message>
        <source>Only key points</source>
        <translation>Points clés seulement</translation>
    </message>
    <message>
        <source>Only points in these polygons are classified, and rasters end at them; with an extent, only what lies in both. Points outside keep their class, but those nearby help to judge. Empty: all points.</source>
        <translation>Seuls les points dans ces polygones sont classés, et les rasters s'y arrêtent ; avec une emprise, seul compte ce qui est dans les deux. Les points à l'extérieur gardent leur classe, mais ceux qui sont proches aident à juger. Vide : tous les points.</translation>
    </message>
    <message>
        <source>Only points in these polygons are downloaded; with an extent, only points in both. Empty: all points.</source>
        <translation>Seuls les points dans ces polygones sont téléchargés ; avec une emprise, seulement les points dans les deux. Vide : tous les points.</translation>
    </message>
    <message>
        <source>Only points in these polygons are mapped and written; with an extent, only points in both. Points nearby help to judge. Empty: all points.</source>
        <translation>Seuls les points dans ces polygones sont cartographiés et écrits ; avec une emprise, seuls les points dans les deux. Les points proches aident à juger. Vide : tous les points.</translation>
    </message>
    <message>
        <source>Only points in this rectangle are classified, and rasters end at it. Points outside keep their class, but those nearby help to judge. Empty: all points.</source>
        <translation>Seuls les points dans ce rectangle sont classés, et les rasters s'y arrêtent. Les points à l'extérieur gardent leur classe, mais ceux qui sont proches aident à juger. Vide : tous les points.</translation>
    </message>
    <message>
        <source>Only points in this rectangle are downloaded. Empty: all points.</source>
        <translation>Seuls les points dans ce rectangle sont téléchargés. Vide : tous les points.</translation>
    </message>
    <message>
        <source>Only points in this rectangle are mapped and written. Points nearby help to judge. Empty: all points.</source>
        <translation>Seuls les points dans ce rectangle sont cartographiés et écrits. Les points proches aident à juger. Vide : tous les points.</translation>
    </message>
    <message>
        <source>Only points of these classes make the surface, such as 41 for a water surface, or 2 and 6 for terrain with buildings. Empty: all classes but low and high noise (7 and 18) and what lies in water (43 to 45); if the bottom of waters (40) is ground, their surfaces (41 and 42) are left out, too.</source>
        <translation>Seuls les points de ces classes forment la surface, par exemple 41 pour une surface d'eau, ou 2 et 6 pour le terrain avec les bâtiments. Vide : toutes les classes sauf le bruit bas et haut (7 et 18) et ce qui se trouve dans l'eau (43 à 45) ; si le fond des eaux (40) est du sol, leurs surfaces (41 et 42) sont aussi laissées de côté.</translation>
    </message>
    <message>
        <source>Only points of these classes take part and may change their class. Empty: 0 to 6, 8, 12 and the class of the ground. Points of other classes, such as water (9) and bridge decks (17), keep their class. Rails and roads (10 and 11) keep theirs too, but take part. all: all classes but low and high noise (7 and 18).</source>
        <translation>Seuls les points de ces classes participent et peuvent changer de classe. Vide : 0 à 6, 8, 12 et la classe du sol. Les points d'autres classes, comme l'eau (9) et les tabliers de ponts (17), gardent leur classe. Les rails et les routes (10 et 11) gardent aussi la leur, mais participent. all : toutes les classes sauf le bruit bas et haut (7 et 18).</translation>
    </message>
    <message>
        <source>Only the points that a terrain model needs become ground. Of all other ground points, none lies farther from the TIN of these key points than the two tolerances below.</source>
        <translation>Seuls les points dont un modèle de terrain a besoin deviennent du sol. Parmi tous les autres points sol, aucun n'est plus loin du TIN de ces points clés que les deux tolérances ci-dessous.</translation>
    </message>
    <message>
        <source>Overhead structure</source>
        <translation>Structure aérienne</translation>
    </message>
    <message>
        <source>Overlap</source>
        <translation>Recouvrement</translation>
    </message>
    <message>
        <source>Overlap of strips</source>
        <translation>Recouvrement des bandes</translation>
    </message>
    <message>
        <source>Overview of the classes</source>
        <translation>Vue d'ensemble des classes</translation>
    </message>
    <message>
        <source>Overview of the virtual point cloud</source>
        <translation>Vue d'ensemble du nuage de points virtuel</translation>
    </message>
    <message>
        <source>Own choice of outputs</source>
        <translation>Sorties à votre choix</translation>
    </message>
    <message>
        <source>Page about the quality</source>
        <translation>Page sur la qualité</translation>
    </message>
    <message>
        <source>Page of the delivery</source>
        <translation>Page de la livraison</translation>
    </message>
    <message>
        <source>Parts of rivers</source>
        <translation>Tronçons de rivière</translation>
    </message>
    <message>
        <source>Point cloud</source>
        <translation>Nuage de points</translation>
    </message>
    <message>
        <source>Point cloud to terrain</source>
        <translation>Du nuage de points au terrain</translation>
    </message>
    <message>
        <source>Point cloud with all classes</source>
        <translation>Nuage de points avec toutes les classes</translation>
    </message>
    <message>
        <source>Point cloud with heights</source>
        <translation>Nuage de points avec hauteurs</translation>
    </message>
    <message>
        <source>Point cloud with key points</source>
        <translation>Nuage de points avec points clés</translation>
    </message>
    <message>
        <source>Point cloud with water</source>
        <translation>Nuage de points avec l'eau</translation>
    </message>
    <message>
        <source>Point clouds</source>
        <translation>Nuages de points</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Points</translation>
    </message>
    <message>
        <source>Points 0.2 to 2 m above the ground</source>
        <translation>Points de 0,2 à 2 m au-dessus du sol</translation>
    </message>
    <message>
        <source>Points are compared with their neighbours up to this distance. Choose at least half the shorter side of the largest building. Empty: from the preset, 18 m in the automatic one (more if points are sparse), 2 m in Whitebox.</source>
        <translation>Les points sont comparés à leurs voisins jusqu'à cette distance. Choisissez au moins la moitié du petit côté du plus grand bâtiment. Vide : d'après le préréglage, 18 m dans l'automatique (plus si la densité de points est faible), 2 m dans Whitebox.</translation>
    </message>
    <message>
        <source>Points below this height above ground, and points below the ground, become class 1.</source>
        <translation>Les points sous cette hauteur au-dessus du sol, et les points sous le sol, reçoivent la classe 1.</translation>
    </message>
    <message>
        <source>Points in the area</source>
        <translation>Points dans la zone</translation>
    </message>
    <message>
        <source>Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in older files. If strips do not fit together, leave them out of ground and surface.</source>
        <translation>Points dans le recouvrement de bandes de vol, d'après leur indicateur en LAS 1.4, ou la classe 12 dans les fichiers plus anciens. Si les bandes ne concordent pas, laissez ces points de côté pour le sol et la surface.</translation>
    </message>
    <message>
        <source>Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in older files. If strips do not fit together, leave them out: ground, and rasters made in the same run, then come from one strip everywhere.</source>
        <translation>Points dans le recouvrement de bandes de vol, d'après leur indicateur en LAS 1.4, ou la classe 12 dans les fichiers plus anciens. Si les bandes ne concordent pas, laissez ces points de côté : le sol, et les rasters du même traitement, viennent alors partout d'une seule bande.</translation>
    </message>
    <message>
        <source>Points of overlap</source>
        <translation>Points de recouvrement</translation>
    </message>
    <message>
        <source>Points of the surface</source>
        <translation>Points de la surface</translation>
    </message>
    <message>
        <source>Points of these classes are certain ground, whatever their return: the filter does not judge them, and TIN densification starts from them. They get the class of the ground, unless their class is not among the classes to classify. Empty: none.</source>
        <translation>Les points de ces classes sont du sol à coup sûr, quel que soit leur retour : le filtre ne les juge pas, et la densification de TIN part d'eux. Ils reçoivent la classe du sol, sauf si leur classe n'est pas parmi celles à classer. Vide : aucune.</translation>
    </message>
    <message>
        <source>Points of these classes of the reference are not counted, for example noise (7, 18). Empty: all points are counted.</source>
        <translation>Les points de ces classes de la référence ne sont pas comptés, par exemple le bruit (7, 18). Vide : tous les points sont comptés.</translation>
    </message>
    <message>
        <source>Points that became ignored ground</source>
        <translation>Points devenus du sol ignoré</translation>
    </message>
    <message>
        <source>Points that became water</source>
        <translation>Points devenus de l'eau</translation>
    </message>
    <message>
        <source>Points that took part</source>
        <translation>Points qui ont participé</translation>
    </message>
    <message>
        <source>Points that took part and hang far above all others of their place, alone or in small groups (birds, clouds, faults of the sensor) become high noise, class 18. Wires, masts and trees do not. Surface and canopy models never use such points, whether this is on or off.</source>
        <translation>Les points qui ont participé et flottent bien au-dessus de tous les autres du lieu, seuls ou en petits groupes (oiseaux, nuages, défauts du capteur) deviennent du bruit haut, classe 18. Les câbles, les mâts et les arbres non. Les modèles de surface et de hauteur de canopée n'utilisent jamais de tels points, avec ou sans cette option.</translation>
    </message>
    <message>
        <source>Points that took part and lie far below the ground (multipath, faults of the sensor) become low noise, class 7. If this is off, they are treated as other points.</source>
        <translation>Les points qui ont participé et se trouvent bien au-dessous du sol (trajets multiples, défauts du capteur) deviennent du bruit bas, classe 7. Sans cette option, ils sont traités comme les autres points.</translation>
    </message>
    <message>
        <source>Points that were surveyed on the ground, of any CRS, or a table (.csv) in the CRS of the point cloud. May stay empty if points are held out.</source>
        <translation>Des points levés au sol, dans n'importe quel SCR, ou un tableau (.csv) dans le SCR du nuage. Peut rester vide si des points sont mis de côté.</translation>
    </message>
    <message>
        <source>Points up to this distance outside the window are read too, but not shown. A larger value is slower, and gives classes closer to those of the whole file near the edges of the window and beside large buildings. Empty: as far as the methods look, at most 50 m.</source>
        <translation>Les points jusqu'à cette distance hors de la fenêtre sont lus aussi, mais pas montrés. Une valeur plus grande est plus lente, et donne près des bords de la fenêtre et à côté de grands bâtiments des classes plus proches de celles du fichier entier. Vide : aussi loin que les méthodes regardent, au plus 50 m.</translation>
    </message>
    <message>
        <source>Points with a new class</source>
        <translation>Points dont la classe est nouvelle</translation>
    </message>
    <message>
        <source>Polygons in which the terrain uses no ground points, such as bridges and roofs. The classes of the points do not change.</source>
        <translation>Polygones où le terrain n'utilise aucun point sol, comme les ponts et les toits. Les classes des points ne changent pas.</translation>
    </message>
    <message>
        <source>Polygons in which you know the class. It replaces the result of the filter. If it is the class of the ground, points of the chosen returns are ground. Any other class is given to all points, and the filter does not use them. Where polygons overlap, the last one counts.</source>
        <translation>Polygones dont vous connaissez la classe. Elle remplace le résultat du filtre. Si c'est la classe du sol, les points des retours choisis sont du sol. Toute autre classe est donnée à tous les points, et le filtre ne les utilise pas. Là où des polygones se recouvrent, le dernier compte.</translation>
    </message>
    <message>
        <source>Polygons of water, with islands as holes. Empty: the water is found first, as 'Find water' does with its default values.</source>
        <translation>Polygones d'eau, avec les îles comme trous. Vide : l'eau est d'abord trouvée, comme le fait « Trouver l'eau » avec ses valeurs par défaut.</translation>
    </message>
    <message>
        <source>Polygons of water. Each is flattened to one level, that of the ground along its border.</source>
        <translation>Polygones d'eau. Chacun est aplani à un seul niveau, celui du sol le long de son bord.</translation>
    </message>
    <message>
        <source>Polygons with the level (LEVEL), the spread of the shore in metres (SPREAD) and a grade of certainty (GRADE).</source>
        <translation>Polygones avec le niveau (LEVEL), la dispersion de la rive en mètres (SPREAD) et un degré de certitude (GRADE).</translation>
    </message>
    <message>
        <source>Positive openness</source>
        <translation>Ouverture positive</translation>
    </message>
    <message>
        <source>Preset</source>
        <translation>Préréglage</translation>
    </message>
    <message>
        <source>Products</source>
        <translation>Produits</translation>
    </message>
    <message>
        <source>Put high outliers into class 18</source>
        <translation>Mettre les points aberrants hauts dans la classe 18</translation>
    </message>
    <message>
        <source>Put low outliers into class 7</source>
        <translation>Mettre les points aberrants bas dans la classe 7</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualité</translation>
    </message>
    <message>
        <source>Quality of a survey</source>
        <translation>Qualité d'un levé</translation>
    </message>
    <message>
        <source>RMSE of held-out points [m]</source>
        <translation>RMSE des points mis de côté [m]</translation>
    </message>
    <message>
        <source>RMSE of the heights of the checkpoints themselves, as their survey states it. The standard adds it to that of the data: square root of the sum of the squares.</source>
        <translation>RMSE des altitudes des points de contrôle eux-mêmes, selon leur levé. La norme l'ajoute à celle des données : racine de la somme des carrés.</translation>
    </message>
    <message>
        <source>RMSE with vegetation [m]</source>
        <translation>RMSE avec végétation [m]</translation>
    </message>
    <message>
        <source>RMSE without vegetation [m]</source>
        <translation>RMSE sans végétation [m]</translation>
    </message>
    <message>
        <source>Radius of the relief</source>
        <translation>Rayon du relief</translation>
    </message>
    <message>
        <source>Raster with the grid to use</source>
        <translation>Raster dont la grille est à utiliser</translation>
    </message>
    <message>
        <source>Ready. Compressed point clouds (.laz) need one more package, which is installed only once.</source>
        <translation>Prêt. Les nuages de points compressés (.laz) demandent un paquet de plus, qui n'est installé qu'une seule fois.</translation>
    </message>
    <message>
        <source>Ready. The package lazrs is in {}</source>
        <translation>Prêt. Le paquet lazrs est dans {}</translation>
    </message>
    <message>
        <source>Ready. This QGIS has the package lazrs.</source>
        <translation>Prêt. Ce QGIS a le paquet lazrs.</translation>
    </message>
    <message>
        <source>Red relief</source>
        <translation>Relief rouge</translation>
    </message>
    <message>
        <source>Red relief image map</source>
        <translation>Carte en relief rouge</translation>
    </message>
    <message>
        <source>Reduce iteration angle when edges are shorter than</source>
        <translation>Réduire l'angle d'itération quand les côtés sont plus courts que</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Référence</translation>
    </message>
    <message>
        <source>Reference points only</source>
        <translation>Points de la référence seulement</translation>
    </message>
    <message>
        <source>Relief of a terrain model</source>
        <translation>Relief d'un modèle de terrain</translation>
    </message>
    <message>
        <source>Remember the classes</source>
        <translation>Mémoriser les classes</translation>
    </message>
    <message>
        <source>Remote point cloud</source>
        <translation>Nuage de points distant</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Supprimer</translation>
    </message>
    <message>
        <source>Remove downloaded point clouds</source>
        <translation>Supprimer les nuages de points téléchargés</translation>
    </message>
    <message>
        <source>Remove off-terrain objects</source>
        <translation>Enlever les objets au-dessus du terrain</translation>
    </message>
    <message>
        <source>Removed.</source>
        <translation>Supprimé.</translation>
    </message>
    <message>
        <source>Removed. Files that are in use are removed when QGIS starts next.</source>
        <translation>Supprimé. Les fichiers en cours d'utilisation seront supprimés au prochain démarrage de QGIS.</translation>
    </message>
    <message>
        <source>Removes buildings, trees and other steep-sided objects from an elevation raster.</source>
        <translation>Enlève d'un raster d'altitudes les bâtiments, les arbres et les autres objets aux flancs raides.</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Rapport</translation>
    </message>
    <message>
        <source>Resolution</source>
        <translation>Résolution</translation>
    </message>
    <message>
        <source>Returns</source>
        <translation>Retours</translation>
    </message>
    <message>
        <source>Returns of the surface model</source>
        <translation>Retours du modèle de surface</translation>
    </message>
    <message>
        <source>Rivers</source>
        <translation>Rivières</translation>
    </message>
    <message>
        <source>Rivers that are narrower on average are left out. The Lidar Base Specification asks for 30 m (100 ft) and more.</source>
        <translation>Les rivières plus étroites en moyenne sont omises. La Lidar Base Specification demande 30 m (100 ft) et plus.</translation>
    </message>
    <message>
        <source>Roofs are at least this high above the ground. Lower ones are cars and hedges too.</source>
        <translation>Les toits sont au moins à cette hauteur au-dessus du sol. Plus bas, il y a aussi des voitures et des haies.</translation>
    </message>
    <message>
        <source>Roofs are planes of some size that a laser pulse meets once. Walls below their edges, and chimneys and dormers, belong to them.</source>
        <translation>Les toits sont des plans d'une certaine taille qu'une impulsion laser ne rencontre qu'une fois. Les murs sous leurs bords, les cheminées et les lucarnes en font partie.</translation>
    </message>
    <message>
        <source>Rule that decided each cell</source>
        <translation>Règle qui a décidé de chaque cellule</translation>
    </message>
    <message>
        <source>Search radius</source>
        <translation>Rayon de recherche</translation>
    </message>
    <message>
        <source>Searches each folder with all its subfolders.</source>
        <translation>Cherche dans chaque dossier et tous ses sous-dossiers.</translation>
    </message>
    <message>
        <source>Set to 1 (unclassified)</source>
        <translation>Mettre à 1 (non classé)</translation>
    </message>
    <message>
        <source>Sets the fields that are left empty, to values that suit most land (automatic) or a kind of terrain. The log says which values were used.</source>
        <translation>Fixe les valeurs des champs vides : ce qui convient à la plupart des terrains (automatique) ou à un type de terrain. Le journal dit quelles valeurs ont servi.</translation>
    </message>
    <message>
        <source>Sets the fields that are left empty. Automatic and the kinds of terrain remove buildings as well as shrubs. Whitebox is the classic filter with the values of WhiteboxTools: within its radius of 2 m it cannot find a building.</source>
        <translation>Fixe les valeurs des champs vides. Automatique et les types de terrain enlèvent les bâtiments comme les buissons. Whitebox est le filtre classique avec les valeurs de WhiteboxTools : dans son rayon de 2 m, il ne peut pas trouver de bâtiment.</translation>
    </message>
    <message>
        <source>Sets the fields that are left empty: from the points (automatic), or to values that suit a kind of terrain. The log says which values were used.</source>
        <translation>Fixe les valeurs des champs vides : d'après les points (automatique), ou selon un type de terrain. Le journal dit quelles valeurs ont servi.</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Réglages</translation>
    </message>
    <message>
        <source>Share of ground points to hold out</source>
        <translation>Part des points de sol à mettre de côté</translation>
    </message>
    <message>
        <source>Share of wrong points</source>
        <translation>Part des points erronés</translation>
    </message>
    <message>
        <source>Shores, islands and the middles of rivers as lines with heights.</source>
        <translation>Rives, îles et milieux des rivières sous forme de lignes avec altitudes.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building or other object. Nothing that is narrower and stands out from its surroundings can be a seed of the ground. A value that is too large takes longer and loses sharp hilltops. Empty: from the preset.</source>
        <translation>Petit côté du plus grand bâtiment ou autre objet. Rien de plus étroit qui ressort de son entourage ne peut être un point de départ du sol. Une valeur trop grande prend plus de temps et perd des sommets pointus. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building. A larger value takes longer, and may remove steep hilltops as objects.</source>
        <translation>Petit côté du plus grand bâtiment. Une valeur plus grande prend plus de temps, et peut enlever des sommets raides comme objets.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building. Anything wider is terrain. Empty: from the preset.</source>
        <translation>Petit côté du plus grand bâtiment. Ce qui est plus large est du terrain. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building. Buildings wider than two search radii are found by the drop on all their sides. Empty: from the preset, or two search radii if the search radius is given. Not used with the preset Whitebox.</source>
        <translation>Petit côté du plus grand bâtiment. Les bâtiments plus larges que deux rayons de recherche sont trouvés à la chute de tous leurs côtés. Vide : d'après le préréglage, ou deux rayons de recherche si celui-ci est donné. Pas pour le préréglage Whitebox.</translation>
    </message>
    <message>
        <source>Shortest closed contour line</source>
        <translation>Courbe de niveau fermée la plus courte</translation>
    </message>
    <message>
        <source>Shows mounds, walls, ditches and old paths: sky view, openness, local relief, VAT.</source>
        <translation>Montre tertres, murs, fossés et anciens chemins : vue du ciel, ouverture, relief local, VAT.</translation>
    </message>
    <message>
        <source>Side of a cell of the error map. The map in the report has its own cell size.</source>
        <translation>Côté d'une cellule de la carte des erreurs. La carte du rapport a sa propre taille de cellule.</translation>
    </message>
    <message>
        <source>Side of a cell of the rasters. Choose about the distance between ground points.</source>
        <translation>Côté d'une cellule des rasters. Choisissez environ la distance entre points sol.</translation>
    </message>
    <message>
        <source>Side of a cell of the terrain model and of its hillshade. Choose about the distance between ground points; smaller cells only make the file larger.</source>
        <translation>Côté d'une cellule du modèle de terrain et de son ombrage. Choisissez environ la distance entre points sol ; des cellules plus petites ne font qu'agrandir le fichier.</translation>
    </message>
    <message>
        <source>Side of a cell of the terrain model and of its hillshade. Empty: 1 m, and for a delivery as fine as the ground points allow, or as the specification states.</source>
        <translation>Côté d'une maille du modèle de terrain et de son ombrage. Vide : 1 m et, pour une livraison, aussi fin que les points du sol le permettent, ou comme la spécification l'indique.</translation>
    </message>
    <message>
        <source>Side of the cells in which points are counted. Empty: twice the distance between points, at least 1 m, and up to 5 m if a large survey would have too many cells.</source>
        <translation>Côté des cellules dans lesquelles les points sont comptés. Vide : deux fois la distance entre les points, au moins 1 m, et jusqu'à 5 m si un grand levé avait trop de cellules.</translation>
    </message>
    <message>
        <source>Side of the cells of densities and voids. Strips and maximum heights have cells of twice this size.</source>
        <translation>Côté des cellules des densités et des vides. Les bandes de vol et les hauteurs maximales ont des cellules deux fois plus grandes.</translation>
    </message>
    <message>
        <source>Side of the cells whose lowest points are compared. Not used with the preset Whitebox. Empty: the usual distance between points, at least 1 m (0.5 m in the preset for sites).</source>
        <translation>Côté des cellules dont les points les plus bas sont comparés. Pas pour le préréglage Whitebox. Vide : la distance habituelle entre les points, au moins 1 m (0,5 m dans le préréglage pour les chantiers).</translation>
    </message>
    <message>
        <source>Side of the cells whose lowest points may become vertices of the TIN; at least the usual distance between points. Smaller cells keep narrow banks and sharp edges, but under trees also more plants. Empty: from the preset.</source>
        <translation>Côté des cellules dont les points les plus bas peuvent devenir des sommets du TIN ; au moins la distance habituelle entre les points. Des cellules plus petites gardent les talus étroits et les arêtes vives, mais aussi plus de plantes sous les arbres. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Side of the square cells whose lowest points are compared. Smaller cells follow finer terrain if they hold at least one point, but have more rims at low plants. Empty: from the preset, or larger if points are too sparse for it.</source>
        <translation>Côté des cellules carrées dont les points les plus bas sont comparés. Des cellules plus petites suivent un terrain plus fin si elles contiennent au moins un point, mais ont plus de bords aux plantes basses. Vide : d'après le préréglage, ou plus grandes si les points sont trop épars pour cela.</translation>
    </message>
    <message>
        <source>Skip missing tiles</source>
        <translation>Ignorer les tuiles manquantes</translation>
    </message>
    <message>
        <source>Sky-view factor</source>
        <translation>Facteur de vue du ciel</translation>
    </message>
    <message>
        <source>Slope</source>
        <translation>Pente</translation>
    </message>
    <message>
        <source>Slope filter</source>
        <translation>Filtre de pente</translation>
    </message>
    <message>
        <source>Slope filter, Automatic (many scales, follows the terrain)</source>
        <translation>Filtre de pente, Automatique (plusieurs échelles, suit le terrain)</translation>
    </message>
    <message>
        <source>Slope filter, City, large halls</source>
        <translation>Filtre de pente, Grande ville, grandes halles</translation>
    </message>
    <message>
        <source>Slope filter, Drone survey, construction or mining site</source>
        <translation>Filtre de pente, Relevé par drone, chantier ou carrière</translation>
    </message>
    <message>
        <source>Slope filter, Flat land, fields</source>
        <translation>Filtre de pente, Terrain plat, champs</translation>
    </message>
    <message>
        <source>Slope filter, Hilly land, forest</source>
        <translation>Filtre de pente, Terrain vallonné, forêt</translation>
    </message>
    <message>
        <source>Slope filter, Steep or rugged terrain</source>
        <translation>Filtre de pente, Terrain raide ou accidenté</translation>
    </message>
    <message>
        <source>Slope filter, Town</source>
        <translation>Filtre de pente, Ville</translation>
    </message>
    <message>
        <source>Slope filter, Whitebox (one scale, 2 m, 45 deg, 1 m)</source>
        <translation>Filtre de pente, Whitebox (une échelle, 2 m, 45 degrés, 1 m)</translation>
    </message>
    <message>
        <source>Slope normalisation</source>
        <translation>Normalisation de la pente</translation>
    </message>
    <message>
        <source>Slope threshold</source>
        <translation>Seuil de pente</translation>
    </message>
    <message>
        <source>Small groups of points that hang at least 10 m above all others of their place: birds, clouds.</source>
        <translation>Petits groupes de points suspendus à au moins 10 m au-dessus de tous les autres du lieu : oiseaux, nuages.</translation>
    </message>
    <message>
        <source>Smaller water is left out. The Lidar Base Specification asks for lakes of 8,000 m² (2 acres) and more.</source>
        <translation>Les eaux plus petites sont omises. La Lidar Base Specification demande les lacs de 8 000 m² (2 acres) et plus.</translation>
    </message>
    <message>
        <source>Smallest area</source>
        <translation>Surface minimale</translation>
    </message>
    <message>
        <source>Smallest water</source>
        <translation>Plus petite étendue d'eau</translation>
    </message>
    <message>
        <source>Smallest width of a river</source>
        <translation>Largeur minimale d'une rivière</translation>
    </message>
    <message>
        <source>Smoothing of pictures of the relief</source>
        <translation>Lissage des images du relief</translation>
    </message>
    <message>
        <source>Smoothing of the contour lines</source>
        <translation>Lissage des courbes de niveau</translation>
    </message>
    <message>
        <source>Snow</source>
        <translation>Neige</translation>
    </message>
    <message>
        <source>Specification</source>
        <translation>Spécification</translation>
    </message>
    <message>
        <source>Steep or rugged terrain</source>
        <translation>Terrain raide ou accidenté</translation>
    </message>
    <message>
        <source>Steepest slope of the ground. In steeper triangles, the mirror image of a point beyond the nearest vertex is judged in its place.</source>
        <translation>La plus forte pente du sol. Dans des triangles plus raides, c'est l'image miroir d'un point, au-delà du sommet le plus proche, qui est jugée à sa place.</translation>
    </message>
    <message>
        <source>Stop triangulation when edges are shorter than</source>
        <translation>Arrêter la triangulation quand les côtés sont plus courts que</translation>
    </message>
    <message>
        <source>Submerged object</source>
        <translation>Objet immergé</translation>
    </message>
    <message>
        <source>Surface minus terrain: the height of trees, and of buildings too. Empty where no ground point lies within 50 m (or 20 cells), and in gaps of the surface.</source>
        <translation>Surface moins terrain : la hauteur des arbres, et aussi des bâtiments. Vide là où aucun point sol ne se trouve à moins de 50 m (ou 20 cellules), et dans les vides de la surface.</translation>
    </message>
    <message>
        <source>Surface model</source>
        <translation>Modèle de surface</translation>
    </message>
    <message>
        <source>Surface model (DSM)</source>
        <translation>Modèle numérique de surface (MNS)</translation>
    </message>
    <message>
        <source>Survey</source>
        <translation>Levé</translation>
    </message>
    <message>
        <source>TIN densification</source>
        <translation>Densification de TIN</translation>
    </message>
    <message>
        <source>TIN densification, Automatic</source>
        <translation>Densification de TIN, Automatique</translation>
    </message>
    <message>
        <source>TIN densification, City, large halls</source>
        <translation>Densification de TIN, Grande ville, grandes halles</translation>
    </message>
    <message>
        <source>TIN densification, Drone survey, construction or mining site</source>
        <translation>Densification de TIN, Relevé par drone, chantier ou carrière</translation>
    </message>
    <message>
        <source>TIN densification, Flat land, fields</source>
        <translation>Densification de TIN, Terrain plat, champs</translation>
    </message>
    <message>
        <source>TIN densification, Hilly land, forest</source>
        <translation>Densification de TIN, Terrain vallonné, forêt</translation>
    </message>
    <message>
        <source>TIN densification, LiDAR360's values</source>
        <translation>Densification de TIN, Valeurs de LiDAR360</translation>
    </message>
    <message>
        <source>TIN densification, Steep or rugged terrain</source>
        <translation>Densification de TIN, Terrain raide ou accidenté</translation>
    </message>
    <message>
        <source>TIN densification, Town</source>
        <translation>Densification de TIN, Ville</translation>
    </message>
    <message>
        <source>Take part as others do</source>
        <translation>Participer comme les autres</translation>
    </message>
    <message>
        <source>Temporal exclusion</source>
        <translation>Exclusion temporelle</translation>
    </message>
    <message>
        <source>Terrain model</source>
        <translation>Modèle de terrain</translation>
    </message>
    <message>
        <source>Terrain model (DTM)</source>
        <translation>Modèle numérique de terrain (MNT)</translation>
    </message>
    <message>
        <source>Terrain with buildings</source>
        <translation>Terrain avec bâtiments</translation>
    </message>
    <message>
        <source>Terrain, hillshade and contours</source>
        <translation>Terrain, ombrage et courbes de niveau</translation>
    </message>
    <message>
        <source>Terrain, surface and canopy height models</source>
        <translation>Modèles de terrain, de surface et de hauteur de canopée</translation>
    </message>
    <message>
        <source>The CRS of the points, for files that state none or a wrong one. It replaces what files state: it decides the units of lengths and heights, and rasters and layers get it. Written point clouds keep the records that the files have. Empty: what the files state.</source>
        <translation>Le SCR des points, pour les fichiers qui n'en indiquent aucun ou un faux. Il remplace ce que les fichiers indiquent : il décide des unités des longueurs et des altitudes, et les rasters et les couches le reçoivent. Les nuages de points écrits gardent les indications des fichiers. Vide : ce que les fichiers indiquent.</translation>
    </message>
    <message>
        <source>The Python of this QGIS has no pip. In Debian and Ubuntu run sudo apt-get install python3-pip, elsewhere install pip for it, and try again; or choose a wheel file.</source>
        <translation>Le Python de ce QGIS n'a pas pip. Sous Debian et Ubuntu, exécutez sudo apt-get install python3-pip, ailleurs installez pip pour lui, puis réessayez ; ou choisissez un fichier wheel.</translation>
    </message>
    <message>
        <source>The attribute of these polygons that holds their class: 2 for ground, 1 for unclassified.</source>
        <translation>L'attribut de ces polygones qui contient leur classe : 2 pour le sol, 1 pour non classé.</translation>
    </message>
    <message>
        <source>The attribute with the heights, in the unit of the heights of the points. Empty: z of the points, or an attribute with a usual name, such as H or elevation.</source>
        <translation>L'attribut qui contient les altitudes, dans l'unité des altitudes du nuage. Vide : z des points, ou un attribut au nom courant, comme H ou altitude.</translation>
    </message>
    <message>
        <source>The attribute with the land cover, such as forest or NVA. Points on vegetated land are reported apart, and those of type Control are left out. Empty: an attribute with a usual name, such as class.</source>
        <translation>L'attribut avec l'occupation du sol, par exemple forest ou NVA. Les points sur terrain végétalisé sont présentés à part, ceux de type Control sont écartés. Vide : un attribut au nom usuel, tel que class.</translation>
    </message>
    <message>
        <source>The attribute with the names. Empty: an attribute with a usual name, such as id, or else numbers from 1 on.</source>
        <translation>L'attribut des noms. Vide : un attribut au nom courant, comme id, sinon des numéros à partir de 1.</translation>
    </message>
    <message>
        <source>The checkpoints with their errors (ERROR, in metres): ground minus checkpoint.</source>
        <translation>Les points de contrôle avec leurs erreurs (ERROR, en mètres) : sol moins point de contrôle.</translation>
    </message>
    <message>
        <source>The class of bridge decks that are not ground. In the LAS specification it is 17, and every point format can hold it. Empty: the class of other points.</source>
        <translation>La classe des tabliers de ponts qui ne sont pas du sol. Dans la spécification LAS, c'est 17, et tout format de point peut la contenir. Vide : la classe des autres points.</translation>
    </message>
    <message>
        <source>The class of bridge decks. They are found by cross-sections that fall to lower ground on both sides; ramps, dams and embankments stay ground. A classic preset (Whitebox, LiDAR360's, the paper's) works as the original does, and does not look for bridges.</source>
        <translation>La classe des tabliers de ponts. On les trouve par des profils en travers qui tombent vers un sol plus bas des deux côtés ; les rampes, les digues et les remblais restent du sol. Un préréglage classique (Whitebox, LiDAR360, l'article) travaille comme l'original, et ne cherche pas de ponts.</translation>
    </message>
    <message>
        <source>The class of points that are not ground. Points that were never classified (0) become 1 in both cases. Noise, withheld points, and classes that are not classified stay as they are.</source>
        <translation>La classe des points qui ne sont pas du sol. Les points jamais classés (0) deviennent 1 dans les deux cas. Le bruit, les points retenus (withheld) et les classes qui ne sont pas à classer restent tels quels.</translation>
    </message>
    <message>
        <source>The class that ground points beside the shore get. Points that have it already keep it, also in the water, unless it is one of the ground classes.</source>
        <translation>La classe que reçoivent les points de sol qui longent la rive. Les points qui l'ont déjà la gardent, même dans l'eau, sauf si elle est l'une des classes de sol.</translation>
    </message>
    <message>
        <source>The class that ground points get; 2 is ground in the LAS specification. Point formats 0 to 5 hold classes up to 31.</source>
        <translation>La classe que reçoivent les points sol ; 2 est le sol dans la spécification LAS. Les formats de point 0 à 5 contiennent des classes jusqu'à 31.</translation>
    </message>
    <message>
        <source>The class that ground points in the water get. Point formats 0 to 5 hold classes up to 31.</source>
        <translation>La classe que reçoivent les points de sol dans l'eau. Les formats de points 0 à 5 contiennent des classes jusqu'à 31.</translation>
    </message>
    <message>
        <source>The class that key points get. Points that already have it count as ground; those that are not needed get the first of the ground classes. Point formats 0 to 5 hold classes up to 31.</source>
        <translation>La classe que reçoivent les points clés. Les points qui l'ont déjà comptent comme sol ; ceux qui ne sont pas nécessaires reçoivent la première des classes de sol. Les formats de point 0 à 5 contiennent des classes jusqu'à 31.</translation>
    </message>
    <message>
        <source>The confidence is not a file. Export it as GeoTIFF first.</source>
        <translation>La fiabilité n'est pas un fichier. Exportez-la d'abord en GeoTIFF.</translation>
    </message>
    <message>
        <source>The corrections have no attribute {}. Choose the one to use.</source>
        <translation>Les corrections n'ont pas d'attribut {}. Choisissez celui à utiliser.</translation>
    </message>
    <message>
        <source>The elevation raster is not a file. Export it as GeoTIFF first.</source>
        <translation>Le raster d'altitudes n'est pas un fichier. Exportez-le d'abord en GeoTIFF.</translation>
    </message>
    <message>
        <source>The folder for all outputs of a delivery: an empty or new one, or that of an earlier delivery, which is replaced.</source>
        <translation>Le dossier de toutes les sorties d'une livraison : un dossier vide ou nouveau, ou celui d'une livraison antérieure, qui est remplacée.</translation>
    </message>
    <message>
        <source>The folder for the classified files. Each keeps its name.</source>
        <translation>Le dossier des fichiers classés. Chacun garde son nom.</translation>
    </message>
    <message>
        <source>The folder for the rasters (GeoTIFF). They are named after what they show, such as vat.tif and sky-view.tif.</source>
        <translation>Le dossier des rasters (GeoTIFF). Ils portent le nom de ce qu'ils montrent, par exemple vat.tif et sky-view.tif.</translation>
    </message>
    <message>
        <source>The folder for the rasters of densities, voids and strips, which are shown as layers.</source>
        <translation>Le dossier des rasters de densités, de vides et de bandes, qui sont affichés comme couches.</translation>
    </message>
    <message>
        <source>The ground filter. TIN densification is the most accurate.</source>
        <translation>Le filtre du sol. La densification de TIN est la plus précise.</translation>
    </message>
    <message>
        <source>The height between contour lines, in the unit of the heights.</source>
        <translation>La différence d'altitude entre les courbes de niveau, dans l'unité des altitudes.</translation>
    </message>
    <message>
        <source>The height between contour lines, in the vertical unit of the CRS: metres, or feet if the heights are feet. Empty: 1, 2 or 5 times a power of ten, so that there are about 20 lines. Every fifth line is an index contour.</source>
        <translation>La différence d'altitude entre les courbes de niveau, dans l'unité verticale du SCR : mètres, ou pieds si les altitudes sont en pieds. Vide : 1, 2 ou 5 fois une puissance de dix, de sorte qu'il y ait environ 20 courbes. Une courbe sur cinq est une courbe maîtresse.</translation>
    </message>
    <message>
        <source>The heights of this raster are compared with the checkpoints as well.</source>
        <translation>Les altitudes de ce raster sont aussi comparées aux points de contrôle.</translation>
    </message>
    <message>
        <source>The highest point of each cell, noise left out.</source>
        <translation>Le point le plus haut de chaque cellule, sans le bruit.</translation>
    </message>
    <message>
        <source>The key-point flag of LAS; the class stays</source>
        <translation>L'indicateur de point clé de LAS ; la classe reste</translation>
    </message>
    <message>
        <source>The kind of land. automatic: judged by the points.</source>
        <translation>Le type de terrain. automatic : jugé d'après les points.</translation>
    </message>
    <message>
        <source>The last pass removes whatever stands this far above the ground beside it: bushes, cars, walls. A larger value keeps more of rough ground. Empty: from the preset.</source>
        <translation>Le dernier passage enlève tout ce qui dépasse d'autant le sol voisin : buissons, voitures, murs. Une valeur plus grande épargne le sol rugueux. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>The layer "{}" cannot be read.</source>
        <translation>La couche « {} » ne peut pas être lue.</translation>
    </message>
    <message>
        <source>The layer "{}" holds no line. Choose one that does.</source>
        <translation>La couche « {} » ne contient aucune ligne. Choisissez-en une qui en contient.</translation>
    </message>
    <message>
        <source>The layer "{}" holds no point. Choose one that does.</source>
        <translation>La couche « {} » ne contient aucun point. Choisissez-en une qui en contient.</translation>
    </message>
    <message>
        <source>The layer "{}" holds no polygon. Choose one that does.</source>
        <translation>La couche « {} » ne contient aucun polygone. Choisissez-en une qui en contient.</translation>
    </message>
    <message>
        <source>The layer "{}" is being edited. Save or discard the edits first.</source>
        <translation>La couche « {} » est en cours d'édition. Enregistrez ou annulez d'abord les modifications.</translation>
    </message>
    <message>
        <source>The paper's values</source>
        <translation>Valeurs de l'article</translation>
    </message>
    <message>
        <source>The point cloud to check. Its class 2 counts as ground, all other classes do not.</source>
        <translation>Le nuage de points à vérifier. Sa classe 2 compte comme sol, toutes les autres classes non.</translation>
    </message>
    <message>
        <source>The points of a remote point cloud that lie in this rectangle are downloaded, and are all that is used. Only for point clouds that are not on this computer.</source>
        <translation>Les points d'un nuage distant qui se trouvent dans ce rectangle sont téléchargés, et eux seuls sont utilisés. Seulement pour les nuages de points qui ne sont pas sur cet ordinateur.</translation>
    </message>
    <message>
        <source>The points, with all of their dimensions, as .copc.laz or .laz.</source>
        <translation>Les points avec toutes leurs dimensions, en .copc.laz ou .laz.</translation>
    </message>
    <message>
        <source>The probability, 0 to 1, that the terrain model is right: low under dense trees, across gaps and at breaks.</source>
        <translation>La probabilité, de 0 à 1, que le modèle de terrain soit juste : faible sous des arbres denses, au-dessus des vides et aux ruptures.</translation>
    </message>
    <message>
        <source>The raster with the grid to use is not a file. Export it as GeoTIFF first.</source>
        <translation>Le raster dont la grille est à utiliser n'est pas un fichier. Exportez-le d'abord en GeoTIFF.</translation>
    </message>
    <message>
        <source>The rasters cover this rectangle, widened to whole cells, which stay where they are. All points are used. Empty: where the points are.</source>
        <translation>Les rasters couvrent ce rectangle, élargi à des cellules entières, qui restent à leur place. Tous les points sont utilisés. Vide : là où sont les points.</translation>
    </message>
    <message>
        <source>The rasters end at this rectangle. Points outside still help along its border. Empty: the rasters cover all points.</source>
        <translation>Les rasters s'arrêtent à ce rectangle. Les points à l'extérieur aident encore le long de son bord. Vide : les rasters couvrent tous les points.</translation>
    </message>
    <message>
        <source>The rasters have data only in these polygons; with an extent, only in both. Points outside still help along the border. Empty: the rasters cover all points.</source>
        <translation>Les rasters n'ont de données que dans ces polygones ; avec une emprise, que dans les deux. Les points à l'extérieur aident encore le long du bord. Vide : les rasters couvrent tous les points.</translation>
    </message>
    <message>
        <source>The removed lazrs is still in use: restart QGIS and try again.</source>
        <translation>Le lazrs supprimé est encore utilisé : redémarrez QGIS et réessayez.</translation>
    </message>
    <message>
        <source>The same points with their heights above ground.</source>
        <translation>Les mêmes points avec leur hauteur au-dessus du sol.</translation>
    </message>
    <message>
        <source>The same points with their new classes.</source>
        <translation>Les mêmes points avec leurs nouvelles classes.</translation>
    </message>
    <message>
        <source>The same points, or some of them, with their true classes.</source>
        <translation>Les mêmes points, ou certains d'entre eux, avec leurs vraies classes.</translation>
    </message>
    <message>
        <source>The same points, with the classes above the ground.</source>
        <translation>Les mêmes points, avec les classes au-dessus du sol.</translation>
    </message>
    <message>
        <source>The same points, with the classes of water and of ignored ground.</source>
        <translation>Les mêmes points, avec les classes de l'eau et du sol ignoré.</translation>
    </message>
    <message>
        <source>The same points, with the key points marked.</source>
        <translation>Les mêmes points, avec les points clés marqués.</translation>
    </message>
    <message>
        <source>The same raster, with the terrain in place of the objects.</source>
        <translation>Le même raster, avec le terrain à la place des objets.</translation>
    </message>
    <message>
        <source>The same without QGIS:</source>
        <translation>La même chose sans QGIS :</translation>
    </message>
    <message>
        <source>The share of wrong points in each cell of a raster, 0 to 1.</source>
        <translation>La part de points faux dans chaque cellule d'un raster, de 0 à 1.</translation>
    </message>
    <message>
        <source>The specification with which a delivery is compared. It also sets the cell size of the delivery for surveys, and the classes that it asks for.</source>
        <translation>La spécification à laquelle une livraison est comparée. Elle fixe aussi la taille de cellule de la livraison pour les levés, et les classes qu'elle demande.</translation>
    </message>
    <message>
        <source>The specification with which the survey is compared.</source>
        <translation>La spécification à laquelle le levé est comparé.</translation>
    </message>
    <message>
        <source>The terrain model is not a file. Export it as GeoTIFF first.</source>
        <translation>Le modèle de terrain n'est pas un fichier. Exportez-le d'abord en GeoTIFF.</translation>
    </message>
    <message>
        <source>The terrain model minus a smoothed one. Mounds, ditches and old paths stand out.</source>
        <translation>Le modèle de terrain moins un modèle lissé. Les buttes, les fossés et les anciens chemins ressortent.</translation>
    </message>
    <message>
        <source>The terrain model, lit by one light or by four.</source>
        <translation>Le modèle de terrain, éclairé par une lumière ou par quatre.</translation>
    </message>
    <message>
        <source>The unit of the heights of points that are transformed to UTM, if their CRS does not state it.</source>
        <translation>L'unité des altitudes des points transformés en UTM, si leur SCR ne l'indique pas.</translation>
    </message>
    <message>
        <source>The usual one of the delivery</source>
        <translation>Celle habituelle de la livraison</translation>
    </message>
    <message>
        <source>The value of cells without data. Choose one that no height has. Empty: NaN. The hillshade has 0.</source>
        <translation>La valeur des cellules sans donnée. Choisissez-en une qu'aucune altitude n'a. Vide : NaN. L'ombrage a 0.</translation>
    </message>
    <message>
        <source>The values of the method for a kind of terrain. For other values, use the command line or the algorithm of the method.</source>
        <translation>Les valeurs de la méthode pour un type de terrain. Pour d'autres valeurs, utilisez la ligne de commande ou l'algorithme de la méthode.</translation>
    </message>
    <message>
        <source>The vertical accuracy class that the data are to meet, as RMSE: 0.1 for the 10 cm class. It is tested by the checkpoints on land without vegetation. Empty: the figures are only reported.</source>
        <translation>La classe de précision altimétrique que les données doivent respecter, en RMSE : 0,1 pour la classe 10 cm. Elle est testée aux points de contrôle sans végétation. Vide : les chiffres sont seulement indiqués.</translation>
    </message>
    <message>
        <source>The window to classify, such as the map's extent: at most 1,000 m wide, and quick up to about 250 x 250 m. It is transformed to the CRS of the points. Empty: 250 x 250 m in the middle of the points; the log says where.</source>
        <translation>La fenêtre à classer, par exemple l'emprise de la carte ; au plus 1 000 m de large, et rapide jusqu'à environ 250 x 250 m. Elle est transformée dans le SCR des points. Vide : 250 x 250 m au milieu des points ; le journal dit où.</translation>
    </message>
    <message>
        <source>This QGIS cannot load the installed lazrs: {}.</source>
        <translation>Ce QGIS ne peut pas charger le lazrs installé : {}.</translation>
    </message>
    <message>
        <source>This QGIS has no scipy. On Windows, install python3-scipy with the OSGeo4W setup. Elsewhere, install the scipy of the system, or a newer QGIS.</source>
        <translation>Ce QGIS n'a pas scipy. Sous Windows, installez python3-scipy avec l'installateur OSGeo4W. Ailleurs, installez le scipy du système, ou un QGIS plus récent.</translation>
    </message>
    <message>
        <source>This share of the rise of the ground from point to point, over at most a metre, is added to the ground tolerance. In the paper's preset it is a share of the rise over one cell. Empty: from the preset.</source>
        <translation>Cette part de la montée du sol d'un point à l'autre, sur un mètre au plus, s'ajoute à la tolérance du sol. Dans le préréglage de l'article, c'est une part de la montée sur une cellule. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Threads</source>
        <translation>Fils d'exécution</translation>
    </message>
    <message>
        <source>Tiles</source>
        <translation>Dalles</translation>
    </message>
    <message>
        <source>Tiles kept</source>
        <translation>Dalles gardées</translation>
    </message>
    <message>
        <source>Tolerance above</source>
        <translation>Tolérance vers le haut</translation>
    </message>
    <message>
        <source>Tolerance below</source>
        <translation>Tolérance vers le bas</translation>
    </message>
    <message>
        <source>Total error [%]</source>
        <translation>Erreur totale [%]</translation>
    </message>
    <message>
        <source>Town</source>
        <translation>Ville</translation>
    </message>
    <message>
        <source>Transform Web Mercator to UTM</source>
        <translation>Transformer Web Mercator en UTM</translation>
    </message>
    <message>
        <source>Triangles whose longest edge is shorter than this take no more points. Empty: all triangles can take points.</source>
        <translation>Les triangles dont le plus long côté est plus court que ceci ne prennent plus de points. Vide : tous les triangles peuvent prendre des points.</translation>
    </message>
    <message>
        <source>Tries methods and presets on a part of a point cloud, and shows them side by side.</source>
        <translation>Essaie des méthodes et des préréglages sur une partie d'un nuage de points, et les montre côte à côte.</translation>
    </message>
    <message>
        <source>Two methods compared</source>
        <translation>Deux méthodes comparées</translation>
    </message>
    <message>
        <source>Type I error [%]</source>
        <translation>Erreur de type I [%]</translation>
    </message>
    <message>
        <source>Type II error [%]</source>
        <translation>Erreur de type II [%]</translation>
    </message>
    <message>
        <source>US survey foot</source>
        <translation>Pied d'arpentage américain</translation>
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
        <translation>Unité de la taille de cellule</translation>
    </message>
    <message>
        <source>Unit of the heights</source>
        <translation>Unité des altitudes</translation>
    </message>
    <message>
        <source>Units of the CRS, such as its feet</source>
        <translation>Unités du SCR, par exemple ses pieds</translation>
    </message>
    <message>
        <source>Up to LAS 1.3, and in most programs, key points have a class. LAS 1.4 has a flag for them, so that they keep the class of the ground.</source>
        <translation>Jusqu'à LAS 1.3, et dans la plupart des logiciels, les points clés ont une classe. LAS 1.4 a un indicateur pour eux, de sorte qu'ils gardent la classe du sol.</translation>
    </message>
    <message>
        <source>Use as others</source>
        <translation>Utiliser comme les autres</translation>
    </message>
    <message>
        <source>Used only with limits of your own.</source>
        <translation>Utilisé seulement avec vos propres limites.</translation>
    </message>
    <message>
        <source>Vegetated land covers</source>
        <translation>Occupations du sol avec végétation</translation>
    </message>
    <message>
        <source>Vegetation by limits of your own</source>
        <translation>Végétation selon vos propres limites</translation>
    </message>
    <message>
        <source>Vegetation low below 0.5 m, medium to 1.5 m, high above (IGN)</source>
        <translation>Végétation basse sous 0,5 m, moyenne jusqu'à 1,5 m, haute au-dessus (IGN)</translation>
    </message>
    <message>
        <source>Vegetation low below 0.5 m, medium to 2 m, high above</source>
        <translation>Végétation basse sous 0,5 m, moyenne jusqu'à 2 m, haute au-dessus</translation>
    </message>
    <message>
        <source>Virtual point cloud</source>
        <translation>Nuage de points virtuel</translation>
    </message>
    <message>
        <source>Voids of the ground</source>
        <translation>Vides du sol</translation>
    </message>
    <message>
        <source>Water</source>
        <translation>Eau</translation>
    </message>
    <message>
        <source>Water column</source>
        <translation>Colonne d'eau</translation>
    </message>
    <message>
        <source>Water surface</source>
        <translation>Surface de l'eau</translation>
    </message>
    <message>
        <source>What is no building, no bridge and no noise becomes low (3), medium (4) or high (5) vegetation by its height above ground. The LAS specification has these classes, but no limits: 0.5 and 2 m are usual. IGN's LiDAR HD has 0.5 and 1.5 m.</source>
        <translation>Ce qui n'est ni bâtiment, ni pont, ni bruit devient végétation basse (3), moyenne (4) ou haute (5) selon sa hauteur au-dessus du sol. La spécification LAS a ces classes, mais pas de limites : 0,5 et 2 m sont usuels. Le LiDAR HD de l'IGN a 0,5 et 1,5 m.</translation>
    </message>
    <message>
        <source>What to make, a raster for each. Archaeological topography (VAT) shows the most in one picture.</source>
        <translation>Ce qu'il faut produire, un raster pour chaque type. La topographie archéologique (VAT) en montre le plus en une seule image.</translation>
    </message>
    <message>
        <source>Wheel file of lazrs</source>
        <translation>Fichier wheel de lazrs</translation>
    </message>
    <message>
        <source>Wheel files (*.whl)</source>
        <translation>Fichiers wheel (*.whl)</translation>
    </message>
    <message>
        <source>Where a pulse passed between the branches, the canopy height has pits. This raises cells that lie over 2 m below the mean of their neighbours to the median of them, as crowns and trees are easier to find without pits. The surface model keeps them.</source>
        <translation>Là où une impulsion est passée entre les branches, la hauteur de canopée a des trous. Ceci relève les cellules situées à plus de 2 m sous la moyenne de leurs voisines à la médiane de celles-ci, car les houppiers et les arbres sont plus faciles à trouver sans trous. Le modèle de surface garde les trous.</translation>
    </message>
    <message>
        <source>Where they differ</source>
        <translation>Où elles diffèrent</translation>
    </message>
    <message>
        <source>Whether a virtual point cloud or a STAC item may name files on servers that you did not name. Without it, they are named and nothing is downloaded. With it, the Planetary Computer is asked for signatures of its files.</source>
        <translation>Si un nuage de points virtuel ou un élément STAC peut nommer des fichiers sur des serveurs que vous n’avez pas nommés. Sinon, ils sont nommés et rien n’est téléchargé. Avec cette option, les signatures de ses fichiers sont aussi demandées au Planetary Computer.</translation>
    </message>
    <message>
        <source>Whether points in Web Mercator, such as those of 3DEP, are transformed to the zone of UTM (WGS 84) of the area, and their heights to metres. Nothing can be measured in Web Mercator.</source>
        <translation>Indique si les points en Web Mercator, comme ceux de 3DEP, sont transformés dans le fuseau UTM (WGS 84) de la zone, et leurs altitudes en mètres. Rien ne peut être mesuré en Web Mercator.</translation>
    </message>
    <message>
        <source>Whitebox (one scale, 2 m, 45 deg, 1 m)</source>
        <translation>Whitebox (une échelle, 2 m, 45 degrés, 1 m)</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>Fenêtre</translation>
    </message>
    <message>
        <source>Without objects</source>
        <translation>Sans objets</translation>
    </message>
    <message>
        <source>Words separated by commas: a land cover with one of them is vegetated, and no other. Empty: words such as forest, crops and brush in several languages.</source>
        <translation>Mots séparés par des virgules : une occupation du sol qui en contient un est végétalisée, aucune autre ne l'est. Vide : des mots tels que forêt, cultures et broussailles, en plusieurs langues.</translation>
    </message>
    <message>
        <source>Working…</source>
        <translation>En cours…</translation>
    </message>
    <message>
        <source>Write ground points only</source>
        <translation>N'écrire que les points sol</translation>
    </message>
    <message>
        <source>Write points of the area only</source>
        <translation>N'écrire que les points de la zone</translation>
    </message>
    <message>
        <source>Write the heights as</source>
        <translation>Écrire les hauteurs comme</translation>
    </message>
    <message>
        <source>Writes a few points of all tiles into a further COPC file beside the virtual point cloud, if the tiles are COPC. QGIS 3.42 and newer shows them at small scales.</source>
        <translation>Écrit quelques points de toutes les dalles dans un fichier COPC de plus à côté du nuage de points virtuel, si les dalles sont en COPC. QGIS 3.42 et plus récent les affiche aux petites échelles.</translation>
    </message>
    <message>
        <source>Writes only the points inside the extent and the boundary, and makes the rasters from them. Files without such points are not written. If this is off, all files are written with all their points, and points outside keep their class.</source>
        <translation>N'écrit que les points à l'intérieur de l'emprise et de la limite, et en fait les rasters. Les fichiers sans de tels points ne sont pas écrits. Sans cette option, tous les fichiers sont écrits avec tous leurs points, et les points à l'extérieur gardent leur classe.</translation>
    </message>
    <message>
        <source>Writes only the points that have the class of the ground. The log says how many points are left out.</source>
        <translation>N'écrit que les points qui ont la classe du sol. Le journal dit combien de points sont laissés de côté.</translation>
    </message>
    <message>
        <source>X and Y of both ends, in the CRS of the points: X1 Y1 X2 Y2. Empty: straight across the window where the terrains differ most, from west to east or from south to north.</source>
        <translation>X et Y des deux bouts, dans le SCR des points : X1 Y1 X2 Y2. Vide : droit à travers la fenêtre là où les terrains diffèrent le plus, d'ouest en est ou du sud au nord.</translation>
    </message>
    <message>
        <source>Z, in place of the elevation</source>
        <translation>Z, à la place de l'altitude</translation>
    </message>
    <message>
        <source>bare earth,surface,buildings,trees,vegetation,off-terrain objects,oto,whitebox,lindsay,top-hat</source>
        <translation>sol nu,surface,bâtiments,arbres,végétation,sursol,objets,oto,whitebox,lindsay,top-hat</translation>
    </message>
    <message>
        <source>below water</source>
        <translation>sous l'eau</translation>
    </message>
    <message>
        <source>buildings,roofs,trees,classes,classification,bridges,noise,lasclassify,asprs,ign</source>
        <translation>bâtiments,toits,arbres,classes,classification,ponts,bruit,lasclassify,asprs,ign</translation>
    </message>
    <message>
        <source>checkpoints,check points,control points,gcp,accuracy,quality,rmse,rmsez,vertical accuracy,nva,vva,asprs,validation,lascontrol,hold-out</source>
        <translation>points de contrôle,points d'appui,gcp,précision,qualité,rmse,rmsez,précision altimétrique,nva,vva,asprs,validation,lascontrol</translation>
    </message>
    <message>
        <source>chm,ndsm,canopy,vegetation,vegetation height,normalize,normalise,hag,lasheight</source>
        <translation>mhc,chm,canopée,modèle de hauteur de canopée,végétation,hauteur de végétation,normaliser</translation>
    </message>
    <message>
        <source>classified files</source>
        <translation>fichiers classés</translation>
    </message>
    <message>
        <source>contours,workflow</source>
        <translation>courbes de niveau,chaîne de traitement</translation>
    </message>
    <message>
        <source>cut off by openings</source>
        <translation>coupé par des ouvertures</translation>
    </message>
    <message>
        <source>degrees</source>
        <translation>degrés</translation>
    </message>
    <message>
        <source>deliverables,archaeology,forestry,flood,drone</source>
        <translation>livrables,archéologie,forêt,inondation,drone</translation>
    </message>
    <message>
        <source>densification</source>
        <translation>densification</translation>
    </message>
    <message>
        <source>download,remote,url,web,http,copc,clip,cloud storage</source>
        <translation>télécharger,distant,url,web,http,copc,découper,stockage cloud</translation>
    </message>
    <message>
        <source>finer cells off surface</source>
        <translation>cellules fines à l'écart</translation>
    </message>
    <message>
        <source>gentle regions</source>
        <translation>zones douces</translation>
    </message>
    <message>
        <source>grid,raster,rasterize,interpolate</source>
        <translation>grille,raster,rastériser,interpoler</translation>
    </message>
    <message>
        <source>ground,accuracy,quality,error,validation,kappa,confusion matrix,reference</source>
        <translation>sol,exactitude,précision,qualité,erreur,validation,kappa,matrice de confusion,référence</translation>
    </message>
    <message>
        <source>ground,bare earth,ground filter,ground classification,classify ground,extract ground,ground points,noise,outliers,vegetation removal,smrf,pmf,csf,mcc,lasground,classifyground</source>
        <translation>sol,sol nu,points sol,filtre du sol,filtrage,classification du sol,classification,classer,bruit,points aberrants,enlever la végétation</translation>
    </message>
    <message>
        <source>ground,thin,thinning,generalize,keypoints,contours</source>
        <translation>sol,éclaircir,généraliser,points clés,courbes de niveau</translation>
    </message>
    <message>
        <source>groups of low points</source>
        <translation>groupes de points bas</translation>
    </message>
    <message>
        <source>height,extra bytes</source>
        <translation>hauteur,dimension supplémentaire</translation>
    </message>
    <message>
        <source>key points</source>
        <translation>points clés</translation>
    </message>
    <message>
        <source>known ground</source>
        <translation>sol connu</translation>
    </message>
    <message>
        <source>lake,river,pond,shore,breaklines,hydro-flattening,class 9,class 20,ignored ground,usgs,lbs,classes,classification</source>
        <translation>lac,rivière,étang,rive,lignes de rupture,eau,classe 9,classe 20,sol ignoré,classes,classification</translation>
    </message>
    <message>
        <source>lake,river,pond,shore,shoreline,hydro-flattening,hydroflatten,breaklines</source>
        <translation>lac,rivière,étang,rive,rivage,eau,lignes de rupture</translation>
    </message>
    <message>
        <source>lazrs could not be installed: {}</source>
        <translation>lazrs n'a pas pu être installé : {}</translation>
    </message>
    <message>
        <source>lazrs could not be stored: {}.</source>
        <translation>lazrs n'a pas pu être enregistré : {}.</translation>
    </message>
    <message>
        <source>level with seeds beside</source>
        <translation>au niveau de points de départ voisins</translation>
    </message>
    <message>
        <source>lidar,laser scanning,als,uav,drone,las,laz,copc,point cloud</source>
        <translation>lidar,laser aéroporté,drone,las,laz,copc,nuage de points</translation>
    </message>
    <message>
        <source>low outliers</source>
        <translation>points aberrants bas</translation>
    </message>
    <message>
        <source>lowest points, undisputed</source>
        <translation>points bas incontestés</translation>
    </message>
    <message>
        <source>lowest,minimum</source>
        <translation>plus bas,minimum</translation>
    </message>
    <message>
        <source>m</source>
        <translation>m</translation>
    </message>
    <message>
        <source>m or ft</source>
        <translation>m ou ft</translation>
    </message>
    <message>
        <source>m2</source>
        <translation>m2</translation>
    </message>
    <message>
        <source>narrow pits</source>
        <translation>fosses étroites</translation>
    </message>
    <message>
        <source>no key point</source>
        <translation>aucun point clé</translation>
    </message>
    <message>
        <source>none near surface</source>
        <translation>aucun près de la surface</translation>
    </message>
    <message>
        <source>on one grid only</source>
        <translation>sur une seule grille</translation>
    </message>
    <message>
        <source>pip cannot work through the SOCKS proxy of QGIS's settings: choose a wheel file.</source>
        <translation>pip ne peut pas passer par le proxy SOCKS des préférences de QGIS : choisissez un fichier wheel.</translation>
    </message>
    <message>
        <source>pip gave no reason</source>
        <translation>pip n'a donné aucune raison</translation>
    </message>
    <message>
        <source>pits in blocks</source>
        <translation>fosses dans des blocs</translation>
    </message>
    <message>
        <source>plants or outliers</source>
        <translation>plantes ou points aberrants</translation>
    </message>
    <message>
        <source>points</source>
        <translation>points</translation>
    </message>
    <message>
        <source>points near the surface</source>
        <translation>points près de la surface</translation>
    </message>
    <message>
        <source>preview,try,test,preset,parameters,compare,profile</source>
        <translation>aperçu,essayer,tester,préréglage,paramètres,comparer,profil</translation>
    </message>
    <message>
        <source>ptd,axelsson,densification</source>
        <translation>ptd,axelsson,densification</translation>
    </message>
    <message>
        <source>quality</source>
        <translation>qualité</translation>
    </message>
    <message>
        <source>quality,qc,density,pulse density,voids,swath,strips,overlap,usgs,lbs,linz,ign,specification,lasoverlap,lasgrid</source>
        <translation>qualité,contrôle,cq,densité,impulsions,vides,bandes,recouvrement,usgs,linz,ign,spécification,recette</translation>
    </message>
    <message>
        <source>raised objects</source>
        <translation>objets surélevés</translation>
    </message>
    <message>
        <source>relief</source>
        <translation>relief</translation>
    </message>
    <message>
        <source>rims of low objects</source>
        <translation>bords d'objets bas</translation>
    </message>
    <message>
        <source>seeds</source>
        <translation>points de départ</translation>
    </message>
    <message>
        <source>seeds of finer cells</source>
        <translation>points de départ de cellules plus fines</translation>
    </message>
    <message>
        <source>shrubs</source>
        <translation>arbustes</translation>
    </message>
    <message>
        <source>single low points</source>
        <translation>points bas isolés</translation>
    </message>
    <message>
        <source>sky-view factor,svf,openness,local dominance,local relief model,lrm,vat,red relief,rrim,slope,archaeology,rvt,relief visualization toolbox,visualization</source>
        <translation>facteur de vue du ciel,svf,ouverture,dominance locale,modèle de relief local,lrm,vat,relief rouge,rrim,pente,archéologie,rvt,relief visualization toolbox,visualisation</translation>
    </message>
    <message>
        <source>slope,vosselman,whitebox,top-hat</source>
        <translation>pente,vosselman,whitebox,top-hat</translation>
    </message>
    <message>
        <source>steep rises</source>
        <translation>montées raides</translation>
    </message>
    <message>
        <source>tall objects</source>
        <translation>objets hauts</translation>
    </message>
    <message>
        <source>terrain</source>
        <translation>terrain</translation>
    </message>
    <message>
        <source>terrain and surface</source>
        <translation>terrain et surface</translation>
    </message>
    <message>
        <source>terrain,terrain model,elevation model,dtm,dem,dsm,hillshade,relief</source>
        <translation>terrain,modèle de terrain,modèle d'altitude,mnt,mns,mne,dtm,dem,dsm,ombrage,relief</translation>
    </message>
    <message>
        <source>the certificate of the package index was not accepted.</source>
        <translation>le certificat de l'index des paquets n'a pas été accepté.</translation>
    </message>
    <message>
        <source>the disk is full.</source>
        <translation>le disque est plein.</translation>
    </message>
    <message>
        <source>the package index has none for {}.</source>
        <translation>l'index des paquets n'en a aucun pour {}.</translation>
    </message>
    <message>
        <source>the package index was not reached: check the connection, and the proxy in Settings &gt; Options &gt; Network, or choose a wheel file.</source>
        <translation>l'index des paquets n'a pas été atteint : vérifiez la connexion, et le proxy dans Préférences &gt; Options &gt; Réseau, ou choisissez un fichier wheel.</translation>
    </message>
    <message>
        <source>the proxy wants a name and password: give them in Settings &gt; Options &gt; Network.</source>
        <translation>le proxy demande un nom et un mot de passe : indiquez-les dans Préférences &gt; Options &gt; Réseau.</translation>
    </message>
    <message>
        <source>tin,triangulation</source>
        <translation>tin,triangulation</translation>
    </message>
    <message>
        <source>vpc,tiles,batch,survey,folder,many files</source>
        <translation>vpc,dalles,lot,levé,dossier,nombreux fichiers</translation>
    </message>
    <message>
        <source>wide low groups</source>
        <translation>larges groupes bas</translation>
    </message>
    <message>
        <source>you have no permission to write into the folder of the profile.</source>
        <translation>vous n'avez pas la permission d'écrire dans le dossier du profil.</translation>
    </message>
    <message>
        <source>{file} could not be unzipped: {error}.</source>
        <translation>{file} n'a pas pu être décompressé : {error}.</translation>
    </message>
    <message>
        <source>{file} holds {held}; a wheel of {package} is needed.</source>
        <translation>{file} contient {held} ; il faut un wheel de {package}.</translation>
    </message>
    <message>
        <source>{file} holds {member}, which does not belong in a wheel of {package}. Download it again.</source>
        <translation>{file} contient {member}, qui n'a pas sa place dans un wheel de {package}. Téléchargez-le à nouveau.</translation>
    </message>
    <message>
        <source>{file} is for another Python or system ({tag}); this QGIS needs one for {needed}.</source>
        <translation>{file} est pour un autre Python ou système ({tag}) ; ce QGIS en demande un pour {needed}.</translation>
    </message>
    <message>
        <source>{file} is larger than any wheel of {package}.</source>
        <translation>{file} est plus grand que tout wheel de {package}.</translation>
    </message>
    <message>
        <source>{label} must be a number, not {value}.</source>
        <translation>{label} doit être un nombre, pas {value}.</translation>
    </message>
    <message>
        <source>{} and others</source>
        <translation>{} et d'autres</translation>
    </message>
    <message>
        <source>{} and {}</source>
        <translation>{} et {}</translation>
    </message>
    <message>
        <source>{} does not exist. Check the path.</source>
        <translation>{} n'existe pas. Vérifiez le chemin.</translation>
    </message>
    <message>
        <source>{} files (*.{})</source>
        <translation>Fichiers {} (*.{})</translation>
    </message>
    <message>
        <source>{} is damaged: a file differs from its list. Download it again.</source>
        <translation>{} est endommagé : un fichier diffère de sa liste. Téléchargez-le à nouveau.</translation>
    </message>
    <message>
        <source>{} is no known CRS. Choose one from the list.</source>
        <translation>{} n'est pas un SCR connu. Choisissez-en un dans la liste.</translation>
    </message>
    <message>
        <source>{} is not a file. Export it as GeoTIFF first.</source>
        <translation>{} n'est pas un fichier. Exportez d'abord le raster en GeoTIFF.</translation>
    </message>
    <message>
        <source>{} is not a folder. Check the path.</source>
        <translation>{} n'est pas un dossier. Vérifiez le chemin.</translation>
    </message>
    <message>
        <source>{} is not a point cloud. Choose a point cloud layer, or a .las or .laz file.</source>
        <translation>{} n'est pas un nuage de points. Choisissez une couche de nuage de points, ou un fichier .las ou .laz.</translation>
    </message>
    <message>
        <source>{} is not a raster. Choose a GeoTIFF.</source>
        <translation>{} n'est pas un raster. Choisissez un GeoTIFF.</translation>
    </message>
    <message>
        <source>{} is not a wheel, or is damaged. Download it again.</source>
        <translation>{} n'est pas un wheel, ou il est endommagé. Téléchargez-le à nouveau.</translation>
    </message>
    <message>
        <source>{} is not a wheel: choose a file with the ending .whl.</source>
        <translation>{} n'est pas un wheel : choisissez un fichier qui se termine par .whl.</translation>
    </message>
    <message>
        <source>{} is not on this computer: give the extent to download.</source>
        <translation>{} n'est pas sur cet ordinateur : indiquez l'emprise à télécharger.</translation>
    </message>
    <message>
        <source>{} lists {} point clouds that have points there, and this algorithm reads one. Choose 'Point cloud to terrain', or download them first.</source>
        <translation>{} nomme {} nuages de points qui ont des points à cet endroit, et cet algorithme n'en lit qu'un. Choisissez « Du nuage de points au terrain », ou téléchargez-les d'abord.</translation>
    </message>
    <message>
        <source>{} were removed from {}.</source>
        <translation>{} ont été supprimés de {}.</translation>
    </message>
</context>
</TS>
