<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="fr" sourcelanguage="en">
<context>
    <name>BareEarth</name>
    <message>
        <source>0 to 1</source>
        <translation>0 à 1</translation>
    </message>
    <message>
        <source>1 to 255</source>
        <translation>1 à 255</translation>
    </message>
    <message>
        <source>&lt;b&gt;Values of the presets&lt;/b&gt;, where they differ and a field is left empty</source>
        <translation>&lt;b&gt;Valeurs des préréglages&lt;/b&gt;, là où elles diffèrent et où un champ reste vide</translation>
    </message>
    <message>
        <source>A class of their own</source>
        <translation>Une classe à part</translation>
    </message>
    <message>
        <source>A list of the classified files, which QGIS shows as one layer from 3.32 on. Without a name it goes into their folder.</source>
        <translation>Une liste des fichiers classés, que QGIS affiche comme une seule couche à partir de la 3.32. Sans nom, elle va dans leur dossier.</translation>
    </message>
    <message>
        <source>A point cloud layer, a .las, .laz or .copc.laz file, a virtual point cloud (.vpc), or a text file (.txt) with a path a line. May be empty if a folder is given.</source>
        <translation>Une couche de nuage de points, un fichier .las, .laz ou .copc.laz, un nuage de points virtuel (.vpc), ou un fichier texte (.txt) avec un chemin par ligne. Peut rester vide si un dossier est donné.</translation>
    </message>
    <message>
        <source>A point cloud layer, or a .las, .laz or .copc.laz file.</source>
        <translation>Une couche de nuage de points, ou un fichier .las, .laz ou .copc.laz.</translation>
    </message>
    <message>
        <source>A point cloud layer, or a .las, .laz or .copc.laz file; also a virtual point cloud (.vpc) or a folder.</source>
        <translation>Une couche de nuage de points, ou un fichier .las, .laz ou .copc.laz ; aussi un nuage de points virtuel (.vpc) ou un dossier.</translation>
    </message>
    <message>
        <source>A point is not ground if it stands above a neighbour at a steeper slope than this; in the automatic preset, steeper by this than the terrain round it. Empty: 15 deg, or 45 deg in the preset Whitebox.</source>
        <translation>Un point n'est pas du sol s'il se trouve au-dessus d'un voisin avec une pente plus forte que celle-ci ; dans le préréglage automatique, plus forte d'autant que celle du terrain alentour. Vide : 15 degrés, ou 45 degrés dans le préréglage Whitebox.</translation>
    </message>
    <message>
        <source>A point this close to its triangle is a vertex whatever its angle: near a corner the angle of mere noise is large.</source>
        <translation>Un point aussi proche de son triangle devient un sommet quel que soit son angle : près d'un sommet, l'angle du simple bruit est déjà grand.</translation>
    </message>
    <message>
        <source>A point with fewer neighbours within the search radius is compared with this many nearest ones. For the preset Whitebox only.</source>
        <translation>Un point qui a moins de voisins dans le rayon de recherche est comparé à ce nombre de points les plus proches. Pour le préréglage Whitebox seulement.</translation>
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
        <source>A web page, which the Results Viewer opens.</source>
        <translation>Une page web, qui s'ouvre depuis le visualiseur de résultats.</translation>
    </message>
    <message>
        <source>About how much a run may take. A file that needs more is read twice, with its points in a temporary file in the folder of the output meanwhile; of many files, fewer blocks are in work at the same time. The result does not depend on it.</source>
        <translation>La mémoire qu'un traitement peut prendre, environ. Un fichier qui en demande plus est lu deux fois, ses points étant entre-temps dans un fichier temporaire du dossier de sortie ; avec de nombreux fichiers, moins de blocs sont traités en même temps. Le résultat n'en dépend pas.</translation>
    </message>
    <message>
        <source>Add the height above ground</source>
        <translation>Ajouter la hauteur au-dessus du sol</translation>
    </message>
    <message>
        <source>Adds the extra dimension BareEarthClass, the class that this run gives. A later run on the file sees by it which classes were changed by hand since, and keeps them, whatever its settings; it remembers the classes again.</source>
        <translation>Ajoute la dimension supplémentaire BareEarthClass, la classe que donne ce traitement. Un traitement ultérieur du fichier y voit quelles classes ont été changées à la main depuis, et les garde, quels que soient ses réglages ; il mémorise à nouveau les classes.</translation>
    </message>
    <message>
        <source>Adds the extra dimension HeightAboveGround: how high each point stands above the ground, in the vertical unit of the CRS.</source>
        <translation>Ajoute la dimension supplémentaire HeightAboveGround : la hauteur de chaque point au-dessus du sol, dans l'unité verticale du SCR.</translation>
    </message>
    <message>
        <source>Adds the height of every point above the ground points of a point cloud.</source>
        <translation>Ajoute la hauteur de chaque point au-dessus des points sol d'un nuage de points.</translation>
    </message>
    <message>
        <source>All .las, .laz and .copc.laz files in it are taken, too. Many files are one survey, without seams.</source>
        <translation>Tous les fichiers .las, .laz et .copc.laz qu'il contient sont pris aussi. De nombreux fichiers forment un seul levé, sans raccords visibles.</translation>
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
        <source>All returns</source>
        <translation>Tous les retours</translation>
    </message>
    <message>
        <source>An extra dimension keeps all else as it is. In place of the elevation the heights show in programs that know no extra dimensions, and the terrain is flat.</source>
        <translation>Une dimension supplémentaire laisse tout le reste en l'état. À la place de l'altitude, les hauteurs se voient dans les logiciels qui ne connaissent pas les dimensions supplémentaires, et le terrain est plat.</translation>
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
        <source>Automatic finds buildings as well as shrubs; the kinds of terrain do so with other values for what is left empty. Whitebox is the classic filter with the values of WhiteboxTools: its radius of 2 m cannot see a building.</source>
        <translation>Automatique trouve les bâtiments comme les buissons ; les types de terrain aussi, avec d'autres valeurs pour les champs vides. Whitebox est le filtre classique avec les valeurs de WhiteboxTools : son rayon de 2 m ne peut pas voir un bâtiment.</translation>
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
        <source>COPC, which QGIS shows without an index of its own</source>
        <translation>COPC, que QGIS affiche sans index à part</translation>
    </message>
    <message>
        <source>Cancelled.</source>
        <translation>Annulé.</translation>
    </message>
    <message>
        <source>Cancelled; nothing was written.</source>
        <translation>Annulé ; rien n'a été écrit.</translation>
    </message>
    <message>
        <source>Cancelled; the tiles that are finished stay, and a later run can go on with them.</source>
        <translation>Annulé ; les dalles terminées restent, et un traitement ultérieur peut continuer avec elles.</translation>
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
        <source>Cells of objects</source>
        <translation>Cellules d'objets</translation>
    </message>
    <message>
        <source>Cells with a height</source>
        <translation>Cellules avec une altitude</translation>
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
        <source>Chooses, of the ground points of a classified point cloud, the few that a terrain model needs: no other ground point lies farther above or below their triangulation (TIN) than the tolerances. They get a class of their own, or the key-point flag; nothing else in the file changes.
Lengths are metres, whatever the unit of the CRS.</source>
        <translation>Choisit, parmi les points sol d'un nuage de points classé, les quelques points dont un modèle de terrain a besoin : aucun autre point sol n'est plus haut ou plus bas par rapport à leur triangulation (TIN) que les tolérances. Ils reçoivent une classe à part, ou l'indicateur de point clé ; rien d'autre ne change dans le fichier.
Les longueurs sont en mètres, quelle que soit l'unité du SCR.</translation>
    </message>
    <message>
        <source>Chosen automatically: {text}</source>
        <translation>Choisi automatiquement : {text}</translation>
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
        <source>Class {number} ({name}): {count:,} points ({share:.1%})</source>
        <translation>Classe {number} ({name}) : {count:,} points ({share:.1%})</translation>
    </message>
    <message>
        <source>Classes of known ground</source>
        <translation>Classes de sol connu</translation>
    </message>
    <message>
        <source>Classes of the points that are ground. Add 8 where model key points have that class, and 9 where water counts as ground. Withheld points are left out.</source>
        <translation>Classes des points qui sont du sol. Ajoutez 8 si les points clés du modèle ont cette classe, et 9 si l'eau compte comme sol. Les points retenus (withheld) sont laissés de côté.</translation>
    </message>
    <message>
        <source>Classes of the reference that are ground; add 9 where water counts as ground.</source>
        <translation>Classes de la référence qui sont du sol ; ajoutez 9 si l'eau compte comme sol.</translation>
    </message>
    <message>
        <source>Classes to classify anew</source>
        <translation>Classes à reclasser</translation>
    </message>
    <message>
        <source>Classified point cloud</source>
        <translation>Nuage de points classé</translation>
    </message>
    <message>
        <source>Classified tiles</source>
        <translation>Dalles classées</translation>
    </message>
    <message>
        <source>Classifies the ground points of many files, each as if all were one, and writes each anew under its name. A virtual point cloud (.vpc) lists the results.</source>
        <translation>Classe les points sol de nombreux fichiers, chacun comme si tous n'en formaient qu'un, et réécrit chacun sous son nom. Un nuage de points virtuel (.vpc) énumère les résultats.</translation>
    </message>
    <message>
        <source>Classifies the points in a window with each of the settings, without writing any point cloud, and makes a web page, opened from the Results Viewer: the terrain of each, a profile, the share of ground, where they differ, and how to run each on all points. Of COPC only the window is read, which takes seconds; a LAS or LAZ file is read as a whole.</source>
        <translation>Classe les points d'une fenêtre avec chacun des réglages, sans écrire de nuage de points, et produit une page web, qui s'ouvre depuis le visualiseur de résultats : le terrain de chacun, un profil, la part du sol, les endroits où ils diffèrent, et comment appliquer chacun à tous les points. D'un COPC, seule la fenêtre est lue, en quelques secondes ; un fichier LAS ou LAZ est lu en entier.</translation>
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
        <source>Compare heights above a surface that follows the terrain (white top-hat) instead of heights, so that sloping ground is not lost.</source>
        <translation>Compare les hauteurs au-dessus d'une surface qui suit le terrain (chapeau haut-de-forme blanc) au lieu des altitudes, pour ne pas perdre le sol en pente.</translation>
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
        <source>Compares the ground of a classified point cloud with a reference that holds the same points. Type I error: the share of the reference's ground that was rejected; type II: of all other points, the share that was accepted. The report is a web page with a map.</source>
        <translation>Compare le sol d'un nuage de points classé avec une référence qui contient les mêmes points. Erreur de type I : la part du sol de la référence qui a été rejetée ; de type II : la part de tous les autres points qui a été acceptée. Le rapport est une page web avec une carte.</translation>
    </message>
    <message>
        <source>Comparison of settings</source>
        <translation>Comparaison de réglages</translation>
    </message>
    <message>
        <source>Compressed point clouds (.laz, .copc.laz) need the package lazrs, which few builds of QGIS have. Here you get it from the Python Package Index (0.6 MB), or, without the internet, from a wheel file of lazrs for {}. It goes into your profile; QGIS itself is left as it is.</source>
        <translation>Les nuages de points compressés (.laz, .copc.laz) demandent le paquet lazrs, que peu de versions de QGIS contiennent. Vous l'obtenez ici depuis le Python Package Index (0,6 Mo) ou, sans internet, depuis un fichier wheel de lazrs pour {}. Il va dans votre profil ; QGIS lui-même reste tel quel.</translation>
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
        <source>Context round the window</source>
        <translation>Contexte autour de la fenêtre</translation>
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
        <source>Depth of low outliers</source>
        <translation>Profondeur des points aberrants bas</translation>
    </message>
    <message>
        <source>Did you mean {name}?</source>
        <translation>Vouliez-vous dire {name} ?</translation>
    </message>
    <message>
        <source>Difference in height of neighbouring lines, in the unit of the heights.</source>
        <translation>Différence d'altitude entre courbes voisines, dans l'unité des altitudes.</translation>
    </message>
    <message>
        <source>Done; no restart is needed.</source>
        <translation>Terminé ; il n'est pas nécessaire de redémarrer.</translation>
    </message>
    <message>
        <source>Each {:g}</source>
        <translation>Tous les {:g}</translation>
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
        <source>Every cell of this size that has ground points keeps at least one, its lowest, however flat the ground is.</source>
        <translation>Chaque cellule de cette taille qui a des points sol en garde au moins un, le plus bas, aussi plat que soit le sol.</translation>
    </message>
    <message>
        <source>Extent</source>
        <translation>Emprise</translation>
    </message>
    <message>
        <source>Extra dimension HeightAboveGround</source>
        <translation>Dimension supplémentaire HeightAboveGround</translation>
    </message>
    <message>
        <source>Files .las, .laz and .copc.laz, virtual point clouds (.vpc), or text files (.txt) with a path a line. May be empty if a folder is given.</source>
        <translation>Fichiers .las, .laz et .copc.laz, nuages de points virtuels (.vpc), ou fichiers texte (.txt) avec un chemin par ligne. Peut rester vide si un dossier est donné.</translation>
    </message>
    <message>
        <source>Final height</source>
        <translation>Hauteur finale</translation>
    </message>
    <message>
        <source>Finds the few ground points whose triangulation is as good as that of all of them.</source>
        <translation>Trouve les quelques points sol dont la triangulation vaut celle de tous les points sol.</translation>
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
        <source>Finds the ground of a raw lidar point cloud and makes maps of it, of which any may be left out. Local relief shows small features. Lengths are metres.</source>
        <translation>Trouve le sol d'un nuage de points lidar brut et en produit des cartes, dont chacune peut être omise. Le relief local montre les petites formes. Les longueurs sont en mètres.</translation>
    </message>
    <message>
        <source>Finds the ground of a raw lidar point cloud by TIN densification and by the slope filter, and compares the two: a hillshade of each, and a report in which TIN densification stands as the reference. Where both agree, most can be trusted; where they differ, look.</source>
        <translation>Trouve le sol d'un nuage de points lidar brut par densification de TIN et par le filtre de pente, et compare les deux : un ombrage de chacun, et un rapport où la densification de TIN tient lieu de référence. Là où les deux concordent, on peut se fier à presque tout ; là où elles diffèrent, regardez.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud by rules on the lowest points of cells.</source>
        <translation>Trouve les points sol d'un nuage de points lidar par des règles sur les points les plus bas de cellules.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud by the slopes between neighbours.</source>
        <translation>Trouve les points sol d'un nuage de points lidar par les pentes entre voisins.</translation>
    </message>
    <message>
        <source>Finds the ground points of a lidar point cloud, and makes a terrain model of them.</source>
        <translation>Trouve les points sol d'un nuage de points lidar, et en fait un modèle de terrain.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar by progressive TIN densification, and writes the point cloud anew with their class; nothing else in it changes. It starts from a sparse triangulation of points that are surely ground and adds, round by round, the points that lie close to it.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Trouve les points sol d'un lidar aéroporté ou de drone par densification progressive de TIN, et réécrit le nuage de points avec leur classe ; rien d'autre n'y change. La méthode part d'une triangulation lâche de points qui sont sûrement du sol et ajoute, tour après tour, les points qui en sont proches.
Les longueurs sont en mètres et les angles en degrés, quelle que soit l'unité du SCR. Le modèle de terrain et son ombrage sont des GeoTIFF.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar by slopes, and writes the point cloud anew with their class; nothing else in it changes. A point that stands above a neighbour by more than the terrain can is not ground. The preset Automatic compares on many scales and follows the terrain; the preset Whitebox repeats WhiteboxTools' LidarGroundPointFilter.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Trouve les points sol d'un lidar aéroporté ou de drone par les pentes, et réécrit le nuage de points avec leur classe ; rien d'autre n'y change. Un point qui dépasse un voisin plus que le terrain ne le peut n'est pas du sol. Le préréglage Automatique compare à plusieurs échelles et suit le terrain ; le préréglage Whitebox reproduit LidarGroundPointFilter de WhiteboxTools.
Les longueurs sont en mètres et les angles en degrés, quelle que soit l'unité du SCR. Le modèle de terrain et son ombrage sont des GeoTIFF.</translation>
    </message>
    <message>
        <source>Finds the ground points of airborne or drone lidar on a grid of lowest points, and writes the point cloud anew with their class; nothing else in it changes. Steps between neighbouring cells are the rims of objects; what such rims enclose is removed, the tall objects first. It needs heights only, no returns, and is fast.
Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are GeoTIFFs.</source>
        <translation>Trouve les points sol d'un lidar aéroporté ou de drone sur une grille de points les plus bas, et réécrit le nuage de points avec leur classe ; rien d'autre n'y change. Les marches entre cellules voisines sont les bords d'objets ; ce que ces bords entourent est enlevé, les objets hauts en premier. La méthode ne demande que des altitudes, pas de retours, et elle est rapide.
Les longueurs sont en mètres et les angles en degrés, quelle que soit l'unité du SCR. Le modèle de terrain et son ombrage sont des GeoTIFF.</translation>
    </message>
    <message>
        <source>Finds the ground points of the many files of a survey, without seams between them.</source>
        <translation>Trouve les points sol des nombreux fichiers d'un levé, sans raccords visibles entre eux.</translation>
    </message>
    <message>
        <source>First and single returns</source>
        <translation>Premiers retours et retours uniques</translation>
    </message>
    <message>
        <source>Flat land, fields</source>
        <translation>Terrain plat, champs</translation>
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
        <source>Gaps between points are interpolated by triangles; those with a longer edge have no data instead, as water should. Empty: all gaps are interpolated, as far as the convex hull of the points.</source>
        <translation>Les vides entre les points sont interpolés par des triangles ; ceux dont un côté est plus long restent sans donnée, comme il convient à l'eau. Vide : tous les vides sont interpolés, jusqu'à l'enveloppe convexe des points.</translation>
    </message>
    <message>
        <source>Get lazrs</source>
        <translation>Obtenir lazrs</translation>
    </message>
    <message>
        <source>Go on where a run before ended</source>
        <translation>Reprendre là où un traitement s'est arrêté</translation>
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
        <source>Ground, if the method takes them for it</source>
        <translation>Sol, si la méthode les prend pour tel</translation>
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
        <source>Height threshold</source>
        <translation>Seuil de hauteur</translation>
    </message>
    <message>
        <source>Height thresholds</source>
        <translation>Seuils de hauteur</translation>
    </message>
    <message>
        <source>Heights above ground are {low:.2f} to {high:.2f} {unit}.</source>
        <translation>Les hauteurs au-dessus du sol vont de {low:.2f} à {high:.2f} {unit}.</translation>
    </message>
    <message>
        <source>Heights of the bare ground.</source>
        <translation>Altitudes du sol nu.</translation>
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
        <source>How far a ground point may lie above the TIN of the key points. About the accuracy of the heights, or half the interval of the contour lines to be made.</source>
        <translation>La hauteur maximale d'un point sol au-dessus du TIN des points clés. Environ la précision des altitudes, ou la moitié de l'équidistance des courbes de niveau à tracer.</translation>
    </message>
    <message>
        <source>How far a ground point may lie below the TIN of the key points.</source>
        <translation>La profondeur maximale d'un point sol sous le TIN des points clés.</translation>
    </message>
    <message>
        <source>How far a point is compared with its neighbours, the largest distance in the automatic preset: at least half the shorter side of the largest building. Empty: 18 m (more if points are sparse), or 2 m in the preset Whitebox.</source>
        <translation>Jusqu'où un point est comparé à ses voisins, la plus grande distance dans le préréglage automatique : au moins la moitié du petit côté du plus grand bâtiment. Vide : 18 m (plus si la densité de points est faible), ou 2 m dans le préréglage Whitebox.</translation>
    </message>
    <message>
        <source>How far below the ground a point must lie to become low noise, in level terrain; on slopes the rise of the ground over 1 m is added. Only where low outliers are put into class 7.</source>
        <translation>La profondeur sous le sol à partir de laquelle un point devient du bruit bas, en terrain plat ; en pente s'ajoute la montée du sol sur 1 m. Seulement si les points aberrants bas vont dans la classe 7.</translation>
    </message>
    <message>
        <source>How far the surroundings reach that a place is compared with. About as wide as the features to be seen; larger landforms vanish.</source>
        <translation>Jusqu'où va le voisinage auquel un lieu est comparé. Environ la largeur des formes à voir ; les formes plus grandes disparaissent.</translation>
    </message>
    <message>
        <source>How high the light stands above the horizon.</source>
        <translation>La hauteur de la lumière au-dessus de l'horizon.</translation>
    </message>
    <message>
        <source>How many threads compute at the same time. The result does not depend on it.</source>
        <translation>Le nombre de fils d'exécution qui calculent en même temps. Le résultat n'en dépend pas.</translation>
    </message>
    <message>
        <source>Ignored classes of the reference</source>
        <translation>Classes ignorées de la référence</translation>
    </message>
    <message>
        <source>In the command line some layers are missing: save each in the CRS of the points as GeoJSON, and add {}.</source>
        <translation>Dans la ligne de commande, certaines couches manquent : enregistrez chacune en GeoJSON dans le SCR des points, et ajoutez {}.</translation>
    </message>
    <message>
        <source>In the command line the boundary is missing: save it in the CRS of the points as boundary.geojson, and add --boundary boundary.geojson.</source>
        <translation>Dans la ligne de commande, la limite manque : enregistrez-la dans le SCR des points comme boundary.geojson, et ajoutez --boundary boundary.geojson.</translation>
    </message>
    <message>
        <source>In the command line the corrections are missing: save them in the CRS of the points as corrections.geojson, their class as the attribute "{}", and add --corrections corrections.geojson.</source>
        <translation>Dans la ligne de commande, les corrections manquent : enregistrez-les dans le SCR des points comme corrections.geojson, leur classe comme attribut « {} », et ajoutez --corrections corrections.geojson.</translation>
    </message>
    <message>
        <source>In the last pass whatever stands this far above the ground beside it is removed: bushes, cars, walls. Larger spares rough ground. Empty: from the preset.</source>
        <translation>Au dernier passage, tout ce qui dépasse d'autant le sol voisin est enlevé : buissons, voitures, murs. Une valeur plus grande épargne le sol rugueux. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>In triangles whose longest edge is shorter the iteration angle is reduced in proportion, so that low vegetation is not climbed step by step. Empty: never.</source>
        <translation>Dans les triangles dont le plus long côté est plus court, l'angle d'itération est réduit en proportion, pour que la végétation basse ne soit pas gravie pas à pas. Vide : jamais.</translation>
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
        <source>Its class 2 counts as ground, all others do not.</source>
        <translation>Sa classe 2 compte comme sol, toutes les autres non.</translation>
    </message>
    <message>
        <source>Kappa [%]</source>
        <translation>Kappa [%]</translation>
    </message>
    <message>
        <source>Keep, but old ground that is not confirmed becomes 1</source>
        <translation>Garder, mais l'ancien sol qui n'est pas confirmé devient 1</translation>
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
        <source>Largest angle between a triangle and the line from one of its corners to a new point. Larger follows rugged ground better, smaller keeps low objects out: 4 in flat, 10 and more in steep terrain. Empty: from the preset.</source>
        <translation>Le plus grand angle entre un triangle et la ligne d'un de ses sommets à un nouveau point. Plus grand, il suit mieux un terrain accidenté ; plus petit, il écarte les objets bas : 4 en terrain plat, 10 et plus en terrain raide. Vide : d'après le préréglage.</translation>
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
        <source>Leaves all points out of the output that are not of the class of the ground. The log says how many.</source>
        <translation>Laisse hors de la sortie tous les points qui n'ont pas la classe du sol. Le journal dit combien.</translation>
    </message>
    <message>
        <source>Leaves all points out of the output that lie outside of the extent and the boundary, and out of the rasters. Files of a survey that have none in the area are not written.</source>
        <translation>Laisse hors de la sortie et des rasters tous les points en dehors de l'emprise et de la limite. Les fichiers d'un levé qui n'en ont aucun dans la zone ne sont pas écrits.</translation>
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
        <source>Line of the profile</source>
        <translation>Ligne du profil</translation>
    </message>
    <message>
        <source>Lines along which the water in such polygons falls, drawn in either direction.</source>
        <translation>Lignes le long desquelles l'eau descend dans ces polygones, dessinées dans un sens ou dans l'autre.</translation>
    </message>
    <message>
        <source>Lines of equal height of the terrain model, with the field ELEV.</source>
        <translation>Lignes d'égale altitude du modèle de terrain, avec le champ ELEV.</translation>
    </message>
    <message>
        <source>Lines that no triangle of the terrain crosses: edges of walls, dykes and terraces. A line with z has that height; without z, each side of it has the height of the nearest ground point there.</source>
        <translation>Lignes qu'aucun triangle du terrain ne traverse : bords de murs, de digues et de terrasses. Une ligne avec z a cette altitude ; sans z, chacun de ses côtés a l'altitude du point sol le plus proche à cet endroit.</translation>
    </message>
    <message>
        <source>Local relief</source>
        <translation>Relief local</translation>
    </message>
    <message>
        <source>Lowest height</source>
        <translation>Hauteur la plus petite</translation>
    </message>
    <message>
        <source>Makes a map of the terrain of a raw point cloud: classes, models, contours.</source>
        <translation>Produit une carte du terrain à partir d'un nuage de points brut : classes, modèles, courbes de niveau.</translation>
    </message>
    <message>
        <source>Makes a terrain model of a surface model where there is no point cloud. What stands above the terrain round it with steep edges on all sides, and is not larger than the largest object, is removed, and the gaps are filled smoothly. Hills and slopes stay.
The output has the same grid, CRS and unit. Lengths are metres, whatever the unit of the CRS.</source>
        <translation>Fait d'un modèle numérique de surface un modèle de terrain là où il n'y a pas de nuage de points. Ce qui dépasse le terrain alentour avec des bords raides de tous côtés, sans être plus grand que le plus grand objet, est enlevé, et les vides sont comblés en douceur. Les collines et les versants restent.
La sortie a la même grille, le même SCR et la même unité. Les longueurs sont en mètres, quelle que soit l'unité du SCR.</translation>
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
        <source>Maximum terrain angle</source>
        <translation>Pente maximale du terrain</translation>
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
        <source>Methods with their presets. The others are compared with the first.</source>
        <translation>Méthodes avec leurs préréglages. Les autres sont comparés au premier.</translation>
    </message>
    <message>
        <source>Minimum number of neighbours</source>
        <translation>Nombre minimal de voisins</translation>
    </message>
    <message>
        <source>Model: heights above ground</source>
        <translation>Modèle : hauteurs au-dessus du sol</translation>
    </message>
    <message>
        <source>Model: terrain, hillshade and contours</source>
        <translation>Modèle : terrain, ombrage et courbes de niveau</translation>
    </message>
    <message>
        <source>Model: two methods compared</source>
        <translation>Modèle : deux méthodes comparées</translation>
    </message>
    <message>
        <source>Models</source>
        <translation>Modèles</translation>
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
        <source>Noise distance</source>
        <translation>Distance de bruit</translation>
    </message>
    <message>
        <source>Not ground</source>
        <translation>Pas du sol</translation>
    </message>
    <message>
        <source>Not ground, but with a classic preset</source>
        <translation>Pas du sol, sauf avec un préréglage classique</translation>
    </message>
    <message>
        <source>Not there yet: .laz and .copc.laz files cannot be read or written.</source>
        <translation>Pas encore là : les fichiers .laz et .copc.laz ne peuvent être ni lus ni écrits.</translation>
    </message>
    <message>
        <source>Number of the raster's band that holds the heights.</source>
        <translation>Numéro de la bande du raster qui contient les altitudes.</translation>
    </message>
    <message>
        <source>Objects have edges steeper than this all round, measured above the terrain that the maximum object size gives; what rises more gently somewhere is a hill.</source>
        <translation>Les objets ont des bords plus raides que ceci de tous côtés, mesurés au-dessus du terrain que donne la taille maximale des objets ; ce qui monte plus doucement quelque part est une colline.</translation>
    </message>
    <message>
        <source>Of the ground, keep only the points that a terrain model needs: those whose TIN lies within the two tolerances below of every other ground point.</source>
        <translation>Ne garder du sol que les points dont un modèle de terrain a besoin : ceux dont le TIN reste dans les deux tolérances ci-dessous autour de chaque autre point sol.</translation>
    </message>
    <message>
        <source>One light</source>
        <translation>Une lumière</translation>
    </message>
    <message>
        <source>One light shows best what lies across it, and leaves slopes that turn away in the dark. Four lights show landforms of any direction.</source>
        <translation>Une seule lumière montre le mieux ce qui lui est perpendiculaire et laisse dans l'ombre les versants qui s'en détournent. Quatre lumières montrent les formes du terrain de toute direction.</translation>
    </message>
    <message>
        <source>One pass for each, from the largest: of two neighbouring cells that differ by more, the higher is the rim of an object. Empty: from the preset.</source>
        <translation>Un passage pour chacun, en partant du plus grand : de deux cellules voisines qui diffèrent davantage, la plus haute est le bord d'un objet. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Only key points</source>
        <translation>Points clés seulement</translation>
    </message>
    <message>
        <source>Only points in these polygons are classified, of an extent too if there is one. The others keep their class, but those near them help to judge. Empty: all points.</source>
        <translation>Seuls les points dans ces polygones sont classés, et dans l'emprise s'il y en a une. Les autres gardent leur classe, mais ceux qui sont proches aident à juger. Vide : tous les points.</translation>
    </message>
    <message>
        <source>Only points in this rectangle are classified. The others keep their class, but those near it help to judge. Empty: all points.</source>
        <translation>Seuls les points dans ce rectangle sont classés. Les autres gardent leur classe, mais ceux qui sont proches aident à juger. Vide : tous les points.</translation>
    </message>
    <message>
        <source>Only points of these classes take part and may change their class; every class but low and high noise (7 and 18) when none is given.</source>
        <translation>Seuls les points de ces classes participent et peuvent changer de classe ; sans indication, toutes les classes sauf le bruit bas et haut (7 et 18).</translation>
    </message>
    <message>
        <source>Only points that stand above a neighbour by at least this much are not ground. Empty: 0.5 m, or 1 m in the preset Whitebox.</source>
        <translation>Seuls les points qui dépassent un voisin d'au moins cette hauteur ne sont pas du sol. Vide : 0,5 m, ou 1 m dans le préréglage Whitebox.</translation>
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
        <source>Point cloud with heights</source>
        <translation>Nuage de points avec hauteurs</translation>
    </message>
    <message>
        <source>Point cloud with key points</source>
        <translation>Nuage de points avec points clés</translation>
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
        <source>Points in the area</source>
        <translation>Points dans la zone</translation>
    </message>
    <message>
        <source>Points no deeper below the final surface are ground, in level terrain: it lies through the lowest points, and is smooth where they are not.</source>
        <translation>Les points qui ne sont pas plus bas sous la surface finale sont du sol, en terrain plat : elle passe par les points les plus bas, et elle est lisse là où ils ne le sont pas.</translation>
    </message>
    <message>
        <source>Points no higher above the final surface are ground, in level terrain. More takes in grass and low bushes.</source>
        <translation>Les points qui ne sont pas plus hauts au-dessus de la surface finale sont du sol, en terrain plat. Une valeur plus grande prend aussi l'herbe et les buissons bas.</translation>
    </message>
    <message>
        <source>Points no higher above the ground's surface are ground, in level terrain. Empty: from the preset.</source>
        <translation>Les points qui ne sont pas plus hauts au-dessus de la surface du sol sont du sol, en terrain plat. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Points no higher above the surface through the ground are ground, in level terrain. Not for the preset Whitebox.</source>
        <translation>Les points qui ne sont pas plus hauts au-dessus de la surface passant par le sol sont du sol, en terrain plat. Pas pour le préréglage Whitebox.</translation>
    </message>
    <message>
        <source>Points of the surface</source>
        <translation>Points de la surface</translation>
    </message>
    <message>
        <source>Points of these classes are ground for certain, whatever their return: they are not judged, and the TIN densification starts from them. They get the class of the ground, too, unless theirs is not among those to classify anew.</source>
        <translation>Les points de ces classes sont du sol à coup sûr, quel que soit leur retour : ils ne sont pas jugés, et la densification de TIN part d'eux. Ils reçoivent aussi la classe du sol, sauf si la leur n'est pas parmi celles à reclasser.</translation>
    </message>
    <message>
        <source>Points of these classes of the reference are left out, noise (7, 18) for example.</source>
        <translation>Les points de ces classes de la référence sont laissés de côté, par exemple le bruit (7, 18).</translation>
    </message>
    <message>
        <source>Points so far round the window are read to judge those in it, but not shown. More is slower, and closer to what the whole file gives near the edges of the window and beside large buildings. Empty: as far as the methods look, at most 50 m.</source>
        <translation>Les points jusqu'à cette distance de la fenêtre sont lus pour juger ceux qu'elle contient, mais pas montrés. Plus grande, elle est plus lente, et plus proche de ce que le fichier entier donne près des bords de la fenêtre et à côté de grands bâtiments. Vide : aussi loin que les méthodes regardent, au plus 50 m.</translation>
    </message>
    <message>
        <source>Points that took part</source>
        <translation>Points qui ont participé</translation>
    </message>
    <message>
        <source>Points that took part and lie far below the ground that was found (multipath, faults of the sensor) become low noise, class 7, instead of what becomes of other points.</source>
        <translation>Les points qui ont participé et se trouvent bien au-dessous du sol trouvé (trajets multiples, défauts du capteur) deviennent du bruit bas, classe 7, au lieu de ce que deviennent les autres points.</translation>
    </message>
    <message>
        <source>Polygons in which no point is ground, such as bridges and roofs.</source>
        <translation>Polygones où aucun point n'est du sol, comme les ponts et les toits.</translation>
    </message>
    <message>
        <source>Polygons in which the class is known: it holds whatever the filter makes of the points. Where it is that of the ground, points of the wanted returns are ground; else all points get it, and the filter does not see them. Where polygons overlap, the last one counts.</source>
        <translation>Polygones où la classe est connue : elle vaut quoi que le filtre fasse des points. Si c'est celle du sol, les points des retours voulus sont du sol ; sinon, tous les points la reçoivent, et le filtre ne les voit pas. Là où des polygones se recouvrent, le dernier compte.</translation>
    </message>
    <message>
        <source>Polygons of water: flattened to one level, that of the ground along their border.</source>
        <translation>Polygones d'eau : aplanis à un seul niveau, celui du sol le long de leur bord.</translation>
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
        <source>Put low outliers into class 7</source>
        <translation>Mettre les points aberrants bas dans la classe 7</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Qualité</translation>
    </message>
    <message>
        <source>Radius of the local relief</source>
        <translation>Rayon du relief local</translation>
    </message>
    <message>
        <source>Ready. Compressed point clouds (.laz) need one package more, once.</source>
        <translation>Prêt. Les nuages de points compressés (.laz) demandent un paquet de plus, une seule fois.</translation>
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
        <source>Reduce iteration angle when edges are shorter than</source>
        <translation>Réduire l'angle d'itération quand les côtés sont plus courts que</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Référence</translation>
    </message>
    <message>
        <source>Remember the classes</source>
        <translation>Mémoriser les classes</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Supprimer</translation>
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
        <source>Removed; the files that are in use go when QGIS starts next.</source>
        <translation>Supprimé ; les fichiers en cours d'utilisation disparaîtront au prochain démarrage de QGIS.</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Rapport</translation>
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
        <source>Search radius</source>
        <translation>Rayon de recherche</translation>
    </message>
    <message>
        <source>Searches a folder with all folders in it, instead of alone.</source>
        <translation>Cherche dans un dossier et dans tous ceux qu'il contient, au lieu de lui seul.</translation>
    </message>
    <message>
        <source>Set to 1 (unclassified)</source>
        <translation>Mettre à 1 (non classé)</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Réglages</translation>
    </message>
    <message>
        <source>Share of the ground's rise from point to point, over a metre at most, that is added to the ground tolerance; in the paper's preset, of its rise over one cell. Empty: from the preset.</source>
        <translation>Part de la montée du sol d'un point à l'autre, sur un mètre au plus, qui s'ajoute à la tolérance du sol ; dans le préréglage de l'article, de sa montée sur une cellule. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Share of wrong points</source>
        <translation>Part des points erronés</translation>
    </message>
    <message>
        <source>Shorter side of the largest building or other object. Whatever is narrower and stands out from its surroundings gives no seed of the ground. Too large costs time and sharp hilltops. Empty: from the preset.</source>
        <translation>Petit côté du plus grand bâtiment ou autre objet. Ce qui est plus étroit et ressort de son entourage ne donne pas de point de départ du sol. Trop grand, il coûte du temps et des sommets pointus. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building, which is found by the drop all round it even if it is wider than two search radii. Empty: 100 m, or two search radii where that is given. Not for the preset Whitebox.</source>
        <translation>Petit côté du plus grand bâtiment, que l'on trouve à la chute tout autour même s'il est plus large que deux rayons de recherche. Vide : 100 m, ou deux rayons de recherche si celui-ci est donné. Pas pour le préréglage Whitebox.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building. Larger costs time, and steep hilltops that are then taken for objects.</source>
        <translation>Petit côté du plus grand bâtiment. Plus grand, il coûte du temps, et des sommets raides qui sont alors pris pour des objets.</translation>
    </message>
    <message>
        <source>Shorter side of the largest building. What is wider is terrain. Empty: from the preset.</source>
        <translation>Petit côté du plus grand bâtiment. Ce qui est plus large est du terrain. Vide : d'après le préréglage.</translation>
    </message>
    <message>
        <source>Side of a cell of the raster that tells the share of wrong points. The map in the report chooses its own.</source>
        <translation>Côté d'une cellule du raster qui donne la part de points faux. La carte du rapport choisit le sien.</translation>
    </message>
    <message>
        <source>Side of a cell of the terrain model and of its hillshade. About the distance between ground points is sensible; smaller cells only make the file larger.</source>
        <translation>Côté d'une cellule du modèle de terrain et de son ombrage. Il est raisonnable de prendre environ la distance entre points sol ; des cellules plus petites ne font qu'agrandir le fichier.</translation>
    </message>
    <message>
        <source>Side of the cells of the rasters, about the distance between ground points.</source>
        <translation>Côté des cellules des rasters, environ la distance entre points sol.</translation>
    </message>
    <message>
        <source>Side of the cells whose lowest points are compared in the automatic preset. Empty: the usual distance between points, at least 1 m.</source>
        <translation>Côté des cellules dont les points les plus bas sont comparés dans le préréglage automatique. Vide : la distance habituelle entre les points, au moins 1 m.</translation>
    </message>
    <message>
        <source>Side of the square cells whose lowest points are compared. Smaller ones follow finer terrain, if they hold a point, and hold more rims of low plants. Empty: from the preset; where such a cell would hold less than a point, more.</source>
        <translation>Côté des cellules carrées dont les points les plus bas sont comparés. Plus petites, elles suivent un terrain plus fin, si elles contiennent un point, et contiennent plus de bords de plantes basses. Vide : d'après le préréglage ; plus, si une telle cellule contenait moins d'un point.</translation>
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
        <source>Steep or rugged terrain</source>
        <translation>Terrain raide ou accidenté</translation>
    </message>
    <message>
        <source>Steepest slope of the ground. On steeper triangles a point is judged by its mirror image beyond the nearest vertex.</source>
        <translation>La plus forte pente du sol. Sur des triangles plus raides, un point est jugé d'après son image miroir au-delà du sommet le plus proche.</translation>
    </message>
    <message>
        <source>Stop triangulation when edges are shorter than</source>
        <translation>Arrêter la triangulation quand les côtés sont plus courts que</translation>
    </message>
    <message>
        <source>Surface minus terrain: the height of trees, and of buildings too.</source>
        <translation>Surface moins terrain : la hauteur des arbres, et aussi des bâtiments.</translation>
    </message>
    <message>
        <source>Surface model (DSM)</source>
        <translation>Modèle numérique de surface (MNS)</translation>
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
        <source>Take the files in folders of folders</source>
        <translation>Prendre les fichiers des sous-dossiers</translation>
    </message>
    <message>
        <source>Takes buildings, trees and other steep-sided objects out of an elevation raster.</source>
        <translation>Enlève d'un raster d'altitudes les bâtiments, les arbres et les autres objets aux flancs raides.</translation>
    </message>
    <message>
        <source>Terrain model (DTM)</source>
        <translation>Modèle numérique de terrain (MNT)</translation>
    </message>
    <message>
        <source>Terrain, surface and canopy height models</source>
        <translation>Modèles de terrain, de surface et de hauteur de canopée</translation>
    </message>
    <message>
        <source>The attribute of these polygons that says their class: 2 is ground, 1 nothing else.</source>
        <translation>L'attribut de ces polygones qui donne leur classe : 2 est le sol, 1 rien de plus.</translation>
    </message>
    <message>
        <source>The boundary holds no polygon. Choose one that does.</source>
        <translation>La limite ne contient aucun polygone. Choisissez-en une qui en contient.</translation>
    </message>
    <message>
        <source>The class that decks of bridges get; 17 in the LAS specification, which point formats 0 to 5 hold as well. Only where bridges are not ground.</source>
        <translation>La classe que reçoivent les tabliers de ponts ; 17 dans la spécification LAS, que les formats de point 0 à 5 peuvent contenir aussi. Seulement si les ponts ne sont pas du sol.</translation>
    </message>
    <message>
        <source>The class that ground points get; 2 is ground in the LAS specification. Point formats 0 to 5 hold classes up to 31.</source>
        <translation>La classe que reçoivent les points sol ; 2 est le sol dans la spécification LAS. Les formats de point 0 à 5 contiennent des classes jusqu'à 31.</translation>
    </message>
    <message>
        <source>The class that key points get. Points that have it already are taken as ground, and get the first of the ground classes again if they are not needed. Point formats 0 to 5 hold classes up to 31.</source>
        <translation>La classe que reçoivent les points clés. Les points qui l'ont déjà comptent comme sol, et reprennent la première des classes de sol s'ils ne sont pas nécessaires. Les formats de point 0 à 5 contiennent des classes jusqu'à 31.</translation>
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
        <source>The ground filter. TIN densification is the most accurate.</source>
        <translation>Le filtre du sol. La densification de TIN est la plus précise.</translation>
    </message>
    <message>
        <source>The height between contour lines, in the vertical unit of the CRS. Empty: what gives about 20 of them.</source>
        <translation>La différence d'altitude entre les courbes de niveau, dans l'unité verticale du SCR. Vide : ce qui en donne environ 20.</translation>
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
        <source>The laser meets the top first. Take all returns where the return numbers of the file are wrong.</source>
        <translation>Le laser rencontre d'abord le haut. Prenez tous les retours si les numéros de retour du fichier sont faux.</translation>
    </message>
    <message>
        <source>The laser reaches the ground last. Take all returns where the return numbers of the file are wrong.</source>
        <translation>Le laser atteint le sol en dernier. Prenez tous les retours si les numéros de retour du fichier sont faux.</translation>
    </message>
    <message>
        <source>The layer "{}" cannot be read.</source>
        <translation>La couche « {} » ne peut pas être lue.</translation>
    </message>
    <message>
        <source>The layer's filter is not applied: all points are read.</source>
        <translation>Le filtre de la couche n'est pas appliqué : tous les points sont lus.</translation>
    </message>
    <message>
        <source>The lazrs that was got cannot be loaded by this QGIS: {}.</source>
        <translation>Le lazrs obtenu ne peut pas être chargé par ce QGIS : {}.</translation>
    </message>
    <message>
        <source>The lazrs that was removed is still in use: start QGIS anew and try again.</source>
        <translation>Le lazrs supprimé est encore utilisé : redémarrez QGIS et réessayez.</translation>
    </message>
    <message>
        <source>The names of the files stay, but for what a format needs.</source>
        <translation>Les noms des fichiers restent, sauf ce qu'exige un format.</translation>
    </message>
    <message>
        <source>The paper's values</source>
        <translation>Valeurs de l'article</translation>
    </message>
    <message>
        <source>The probability, 0 to 1, that the terrain model is right: low under dense trees, across gaps and at breaks.</source>
        <translation>La probabilité, de 0 à 1, que le modèle de terrain soit juste : faible sous des arbres denses, au-dessus des vides et aux ruptures.</translation>
    </message>
    <message>
        <source>The rasters have {:,} x {:,} cells.</source>
        <translation>Les rasters ont {:,} x {:,} cellules.</translation>
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
        <source>The same points with their true classes, in any order.</source>
        <translation>Les mêmes points avec leurs vraies classes, dans un ordre quelconque.</translation>
    </message>
    <message>
        <source>The same points, the key points among them marked.</source>
        <translation>Les mêmes points, les points clés marqués parmi eux.</translation>
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
        <source>The terrain model less a smoothed one: mounds, ditches and old paths stand out.</source>
        <translation>Le modèle de terrain moins un modèle lissé : les buttes, les fossés et les anciens chemins ressortent.</translation>
    </message>
    <message>
        <source>The terrain model, lit by one light or by four.</source>
        <translation>Le modèle de terrain, éclairé par une lumière ou par quatre.</translation>
    </message>
    <message>
        <source>The values of the method, by terrain. Values of one's own can be given on the command line.</source>
        <translation>Les valeurs de la méthode, selon le terrain. On peut donner ses propres valeurs dans la ligne de commande.</translation>
    </message>
    <message>
        <source>The window that is classified, such as the map's extent; at most 1,000 m wide, and quick up to about 250 x 250 m. It is transformed to the CRS of the points.</source>
        <translation>La fenêtre à classer, par exemple l'emprise de la carte ; au plus 1 000 m de large, et rapide jusqu'à environ 250 x 250 m. Elle est transformée dans le SCR des points.</translation>
    </message>
    <message>
        <source>There is no parameter {name}: it is ignored.</source>
        <translation>Il n'y a pas de paramètre {name} : il est ignoré.</translation>
    </message>
    <message>
        <source>There is not enough memory for this file.</source>
        <translation>La mémoire ne suffit pas pour ce fichier.</translation>
    </message>
    <message>
        <source>This Python has neither pip nor ensurepip: install pip for it (in Debian and Ubuntu python3-pip), or choose a wheel file.</source>
        <translation>Ce Python n'a ni pip ni ensurepip : installez pip pour lui (python3-pip dans Debian et Ubuntu), ou choisissez un fichier wheel.</translation>
    </message>
    <message>
        <source>This QGIS cannot show such a file as a layer. It is at {}.</source>
        <translation>Ce QGIS ne peut pas afficher un tel fichier comme couche. Il se trouve ici : {}.</translation>
    </message>
    <message>
        <source>This QGIS cannot show such a file as a layer. It will be at {}.</source>
        <translation>Ce QGIS ne peut pas afficher un tel fichier comme couche. Il se trouvera ici : {}.</translation>
    </message>
    <message>
        <source>This QGIS has no scipy. On Windows, install python3-scipy with the OSGeo4W setup; elsewhere, the scipy of the system or of a newer QGIS.</source>
        <translation>Ce QGIS n'a pas scipy. Sous Windows, installez python3-scipy avec l'installateur OSGeo4W ; ailleurs, le scipy du système ou d'un QGIS plus récent.</translation>
    </message>
    <message>
        <source>This QGIS has no {}.</source>
        <translation>Il manque à ce QGIS : {}.</translation>
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
        <source>Tiles that are done stay, if they were made from the same files with the same parameters. All others are classified anew.</source>
        <translation>Les dalles terminées restent, si elles viennent des mêmes fichiers avec les mêmes paramètres. Toutes les autres sont reclassées.</translation>
    </message>
    <message>
        <source>Time: {seconds:.1f} s</source>
        <translation>Durée : {seconds:.1f} s</translation>
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
        <source>Triangles whose longest edge is shorter take no further point. Empty: never.</source>
        <translation>Les triangles dont le plus long côté est plus court ne prennent plus de point. Vide : jamais.</translation>
    </message>
    <message>
        <source>Tries methods and presets on a part of a point cloud, and shows them side by side.</source>
        <translation>Essaie des méthodes et des préréglages sur une partie d'un nuage de points, et les montre côte à côte.</translation>
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
        <source>Up to LAS 1.3, and for most programs, key points are a class. LAS 1.4 has a flag for them, so that they stay ground.</source>
        <translation>Jusqu'à LAS 1.3, et pour la plupart des logiciels, les points clés sont une classe. LAS 1.4 a un indicateur pour eux, de sorte qu'ils restent du sol.</translation>
    </message>
    <message>
        <source>Virtual point cloud</source>
        <translation>Nuage de points virtuel</translation>
    </message>
    <message>
        <source>Water</source>
        <translation>Eau</translation>
    </message>
    <message>
        <source>What a slope of 45 degrees adds to both ground tolerances, less in proportion on gentler slopes.</source>
        <translation>Ce qu'une pente de 45 degrés ajoute aux deux tolérances du sol, moins en proportion sur des pentes plus douces.</translation>
    </message>
    <message>
        <source>What a slope of 45 degrees adds to the ground tolerance where points are a metre apart. Less in proportion on gentler slopes, and where points are closer.</source>
        <translation>Ce qu'une pente de 45 degrés ajoute à la tolérance du sol là où les points sont distants d'un mètre. Moins en proportion sur des pentes plus douces, et là où les points sont plus serrés.</translation>
    </message>
    <message>
        <source>What becomes of points that are not ground. Points that were never classified (0) become 1 in either case; noise, withheld points and other classes than those to classify anew stay as they are.</source>
        <translation>Ce que deviennent les points qui ne sont pas du sol. Les points jamais classés (0) deviennent 1 dans tous les cas ; le bruit, les points retenus (withheld) et les classes autres que celles à reclasser restent tels quels.</translation>
    </message>
    <message>
        <source>What becomes of the decks of bridges. They are found by cross-sections that fall to lower ground on both sides; ramps, dams and embankments stay ground. A classic preset (Whitebox, LiDAR360's, the paper's) does just what the original does.</source>
        <translation>Ce que deviennent les tabliers de ponts. On les trouve par des profils en travers qui tombent vers un sol plus bas des deux côtés ; les rampes, les digues et les remblais restent du sol. Un préréglage classique (Whitebox, LiDAR360, l'article) fait exactement ce que fait l'original.</translation>
    </message>
    <message>
        <source>What the land is like. automatic: judged by the points.</source>
        <translation>Comment est le terrain. automatic : jugé d'après les points.</translation>
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
        <source>Where one light comes from, clockwise from north; four have their own directions.</source>
        <translation>D'où vient une lumière seule, dans le sens horaire depuis le nord ; les quatre ont leurs propres directions.</translation>
    </message>
    <message>
        <source>Where the classified files go, each under its name.</source>
        <translation>Où vont les fichiers classés, chacun sous son nom.</translation>
    </message>
    <message>
        <source>Where the values come from that are left empty: from the points (automatic), or from what suits a kind of terrain. The log says which values were used.</source>
        <translation>D'où viennent les valeurs des champs vides : des points (automatique), ou de ce qui convient à un type de terrain. Le journal dit quelles valeurs ont servi.</translation>
    </message>
    <message>
        <source>Where the values come from that are left empty: what suits most land (automatic) or a kind of terrain. The log says which values were used.</source>
        <translation>D'où viennent les valeurs des champs vides : de ce qui convient à la plupart des terrains (automatique) ou à un type de terrain. Le journal dit quelles valeurs ont servi.</translation>
    </message>
    <message>
        <source>Where they differ</source>
        <translation>Où elles diffèrent</translation>
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
        <source>Writes a classified point cloud anew with the height of every point above the ground, that is above the triangulation (TIN) of the ground points, or beyond it above the nearest of them. Heights are in the vertical unit of the CRS. They become an extra dimension, HeightAboveGround, or take the place of z; nothing else in the file changes.</source>
        <translation>Réécrit un nuage de points classé avec la hauteur de chaque point au-dessus du sol, c'est-à-dire au-dessus de la triangulation (TIN) des points sol ou, au-delà, au-dessus du plus proche d'entre eux. Les hauteurs sont dans l'unité verticale du SCR. Elles deviennent une dimension supplémentaire, HeightAboveGround, ou prennent la place de z ; rien d'autre ne change dans le fichier.</translation>
    </message>
    <message>
        <source>X and Y of its two ends, in the CRS of the points: X1 Y1 X2 Y2. Empty: straight across the window, from west to east or from south to north, where the terrains differ most.</source>
        <translation>X et Y de ses deux bouts, dans le SCR des points : X1 Y1 X2 Y2. Vide : droit à travers la fenêtre, d'ouest en est ou du sud au nord, là où les terrains diffèrent le plus.</translation>
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
        <source>canopy height</source>
        <translation>hauteur de canopée</translation>
    </message>
    <message>
        <source>chm,ndsm,canopy,vegetation,vegetation height,normalize,normalise,hag,lasheight</source>
        <translation>mhc,chm,canopée,modèle de hauteur de canopée,végétation,hauteur de végétation,normaliser</translation>
    </message>
    <message>
        <source>classes</source>
        <translation>classes</translation>
    </message>
    <message>
        <source>classified files</source>
        <translation>fichiers classés</translation>
    </message>
    <message>
        <source>confidence</source>
        <translation>fiabilité</translation>
    </message>
    <message>
        <source>contour lines</source>
        <translation>courbes de niveau</translation>
    </message>
    <message>
        <source>contours,workflow</source>
        <translation>courbes de niveau,chaîne de traitement</translation>
    </message>
    <message>
        <source>errors</source>
        <translation>erreurs</translation>
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
        <source>height above ground</source>
        <translation>hauteur au-dessus du sol</translation>
    </message>
    <message>
        <source>height,extra bytes</source>
        <translation>hauteur,dimension supplémentaire</translation>
    </message>
    <message>
        <source>hillshade</source>
        <translation>ombrage</translation>
    </message>
    <message>
        <source>key points</source>
        <translation>points clés</translation>
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
        <source>lidar,laser scanning,als,uav,drone,las,laz,copc,point cloud</source>
        <translation>lidar,laser aéroporté,drone,las,laz,copc,nuage de points</translation>
    </message>
    <message>
        <source>local relief</source>
        <translation>relief local</translation>
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
        <source>pip cannot work through the SOCKS proxy of QGIS's settings: choose a wheel file.</source>
        <translation>pip ne peut pas passer par le proxy SOCKS des préférences de QGIS : choisissez un fichier wheel.</translation>
    </message>
    <message>
        <source>pip failed without a word</source>
        <translation>pip a échoué sans un mot</translation>
    </message>
    <message>
        <source>points</source>
        <translation>points</translation>
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
        <source>slope,vosselman,whitebox,top-hat</source>
        <translation>pente,vosselman,whitebox,top-hat</translation>
    </message>
    <message>
        <source>surface model</source>
        <translation>modèle de surface</translation>
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
        <source>terrain model</source>
        <translation>modèle de terrain</translation>
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
        <source>the folder of the profile may not be written to.</source>
        <translation>l'écriture dans le dossier du profil n'est pas permise.</translation>
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
        <source>without objects</source>
        <translation>sans objets</translation>
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
        <source>{file} holds {member}, which has no place in a wheel of {package}. Get it anew.</source>
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
        <source>{ground:,} of {count:,} points are ground ({share:.1%}).</source>
        <translation>{ground:,} points sur {count:,} sont du sol ({share:.1%}).</translation>
    </message>
    <message>
        <source>{ground:,} of {count:,} points in the area are ground ({share:.1%}).</source>
        <translation>{ground:,} points sur {count:,} dans la zone sont du sol ({share:.1%}).</translation>
    </message>
    <message>
        <source>{key:,} of {ground:,} ground points are key points ({share:.1%}).</source>
        <translation>{key:,} points sol sur {ground:,} sont des points clés ({share:.1%}).</translation>
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
        <source>{} is damaged: a file differs from its list. Get it anew.</source>
        <translation>{} est endommagé : un fichier diffère de sa liste. Téléchargez-le à nouveau.</translation>
    </message>
    <message>
        <source>{} is not a file of this computer. Download it as .las or .laz first.</source>
        <translation>{} n'est pas un fichier de cet ordinateur. Téléchargez-le d'abord en .las ou .laz.</translation>
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
        <source>{} is not a wheel, or damaged. Get it anew.</source>
        <translation>{} n'est pas un wheel, ou il est endommagé. Téléchargez-le à nouveau.</translation>
    </message>
    <message>
        <source>{} is not a wheel: choose a file with the ending .whl.</source>
        <translation>{} n'est pas un wheel : choisissez un fichier qui se termine par .whl.</translation>
    </message>
    <message>
        <source>{} must be installed first.</source>
        <translation>À installer d'abord : {}.</translation>
    </message>
</context>
</TS>
