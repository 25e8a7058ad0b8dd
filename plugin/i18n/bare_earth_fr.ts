<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="fr" sourcelanguage="en">
<context>
    <name>BareEarth</name>
    <message>
        <source>"{}" can't be written: the answer is not saved. Export it as GeoPackage.</source>
        <translation>« {} » ne peut pas être écrite : la réponse n'est pas enregistrée. Exportez-la en GeoPackage.</translation>
    </message>
    <message>
        <source>"{}" is from the run "{}", and "{}" from "{}": choose both from one run.</source>
        <translation>« {} » vient du calcul « {} », et « {} » de « {} » : choisissez les deux dans un même calcul.</translation>
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
        <source>1 to 7</source>
        <translation>1 à 7</translation>
    </message>
    <message>
        <source>1 where ground points are far away</source>
        <translation>1 où les points du sol sont loin</translation>
    </message>
    <message>
        <source>A class of their own</source>
        <translation>Une classe à part</translation>
    </message>
    <message>
        <source>A layer, a file, or an address (https://…)</source>
        <translation>Une couche, un fichier ou une adresse (https://…)</translation>
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
        <source>Adds the height of every point above the ground points of a point cloud.</source>
        <translation>Ajoute la hauteur de chaque point au-dessus des points sol d'un nuage de points.</translation>
    </message>
    <message>
        <source>Alignment</source>
        <translation>Alignement</translation>
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
        <source>All places are answered or skipped.</source>
        <translation>Tous les endroits ont une réponse ou ont été passés.</translation>
    </message>
    <message>
        <source>All returns</source>
        <translation>Tous les retours</translation>
    </message>
    <message>
        <source>Another file…</source>
        <translation>Autre fichier…</translation>
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
        <source>Area of canopy after, m2</source>
        <translation>Surface de canopée après, m2</translation>
    </message>
    <message>
        <source>Area of canopy before, m2</source>
        <translation>Surface de canopée avant, m2</translation>
    </message>
    <message>
        <source>As ground, this place would rise by up to {} m; its expected error is {} m. Press G again if that is right.</source>
        <translation>Classé en sol, cet endroit monterait de {} m au plus ; son erreur attendue est de {} m. Appuyez encore sur G si c'est juste.</translation>
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
        <source>Band</source>
        <translation>Bande</translation>
    </message>
    <message>
        <source>Bare Earth: LAZ support</source>
        <translation>Bare Earth : prise en charge LAZ</translation>
    </message>
    <message>
        <source>Bare Earth: Review</source>
        <translation>Bare Earth : vérification</translation>
    </message>
    <message>
        <source>Bare Earth: points of the places to review</source>
        <translation>Bare Earth : points des endroits à vérifier</translation>
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
        <source>Canopy change</source>
        <translation>Changement de la canopée</translation>
    </message>
    <message>
        <source>Canopy gained, m2</source>
        <translation>Canopée gagnée, m2</translation>
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
        <source>Canopy height from two rasters</source>
        <translation>Hauteur de canopée à partir de deux rasters</translation>
    </message>
    <message>
        <source>Canopy lost, m2</source>
        <translation>Canopée perdue, m2</translation>
    </message>
    <message>
        <source>Cause</source>
        <translation>Cause</translation>
    </message>
    <message>
        <source>Cause of the expected error</source>
        <translation>Cause de l'erreur attendue</translation>
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
        <source>Cells with a height</source>
        <translation>Cellules avec une altitude</translation>
    </message>
    <message>
        <source>Certain</source>
        <translation>Certain</translation>
    </message>
    <message>
        <source>Change between two surveys</source>
        <translation>Changement entre deux levés</translation>
    </message>
    <message>
        <source>Change of the canopy</source>
        <translation>Changement de la hauteur de canopée</translation>
    </message>
    <message>
        <source>Change of the ground</source>
        <translation>Changement du sol</translation>
    </message>
    <message>
        <source>Changes nothing, and is left out next time.</source>
        <translation>Ne change rien et ne reviendra pas.</translation>
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
        <source>Choose the classified points above to see them here.</source>
        <translation>Choisissez ci-dessus les points classés pour les voir ici.</translation>
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
        <source>Classified points</source>
        <translation>Points classés</translation>
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
        <source>Classifies a raw point cloud, and makes everything that a job hands over.</source>
        <translation>Classe un nuage de points brut et produit tout ce qu'un projet livre.</translation>
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
        <source>Clip point clouds</source>
        <translation>Découper des nuages de points</translation>
    </message>
    <message>
        <source>Clipped point cloud</source>
        <translation>Nuage de points découpé</translation>
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
        <source>Comparison of settings</source>
        <translation>Comparaison de réglages</translation>
    </message>
    <message>
        <source>Compressed point clouds (.laz, .copc.laz) need the Python package lazrs, which few builds of QGIS have. Here you can get it from the Python Package Index (0.6 MB) or, without internet, from a wheel file of lazrs for {}. It is stored in your profile; QGIS itself does not change.</source>
        <translation>Les nuages de points compressés (.laz, .copc.laz) demandent le paquet Python lazrs, que peu de versions de QGIS contiennent. Vous pouvez l'obtenir ici depuis le Python Package Index (0,6 Mo) ou, sans internet, depuis un fichier wheel de lazrs pour {}. Il est enregistré dans votre profil ; QGIS lui-même ne change pas.</translation>
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
        <source>Correct and run again</source>
        <translation>Corriger et relancer</translation>
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
        <source>Depression</source>
        <translation>Dépression</translation>
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
        <source>Detection limit</source>
        <translation>Limite de détection</translation>
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
        <source>Downloads the points of a remote point cloud that lie in an area.</source>
        <translation>Télécharge les points d’un nuage de points distant qui se trouvent dans une zone.</translation>
    </message>
    <message>
        <source>Draws contour lines of an elevation raster.</source>
        <translation>Trace les courbes de niveau d'un raster d'altitudes.</translation>
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
        <source>Error of the volume down, m3</source>
        <translation>Erreur du volume en baisse, m3</translation>
    </message>
    <message>
        <source>Error of the volume up, m3</source>
        <translation>Erreur du volume en hausse, m3</translation>
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
        <source>Expected RMSE, m</source>
        <translation>RMSE attendu, m</translation>
    </message>
    <message>
        <source>Expected error</source>
        <translation>Erreur attendue</translation>
    </message>
    <message>
        <source>Expected error (95 %)</source>
        <translation>Erreur attendue (95 %)</translation>
    </message>
    <message>
        <source>Expected error of the new DTM</source>
        <translation>Erreur attendue du nouveau MNT</translation>
    </message>
    <message>
        <source>Expected error of the old DTM</source>
        <translation>Erreur attendue de l’ancien MNT</translation>
    </message>
    <message>
        <source>Expected error up to {} m on {} m²</source>
        <translation>Erreur attendue jusqu'à {} m sur {} m²</translation>
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
        <source>Factor of the expected error</source>
        <translation>Facteur de l'erreur attendue</translation>
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
        <source>Find the ground of point clouds</source>
        <translation>Chercher le sol des nuages de points</translation>
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
        <source>Finds the few ground points that make as good a terrain model as all of them.</source>
        <translation>Trouve les quelques points sol qui donnent un aussi bon modèle de terrain que tous ensemble.</translation>
    </message>
    <message>
        <source>Finds the ground by two methods, and says where they differ.</source>
        <translation>Trouve le sol par deux méthodes, et dit où elles diffèrent.</translation>
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
        <source>Finds the ground points of the many files of a survey, without seams between them.</source>
        <translation>Trouve les points sol des nombreux fichiers d'un levé, sans raccords visibles entre eux.</translation>
    </message>
    <message>
        <source>Finds vegetation, buildings and bridges in a point cloud whose ground is known.</source>
        <translation>Trouve la végétation, les bâtiments et les ponts dans un nuage de points dont le sol est connu.</translation>
    </message>
    <message>
        <source>Finds where a terrain model may be wrong: what to look at first, and why.</source>
        <translation>Trouve où un modèle de terrain peut être faux : ce qu'il faut regarder d'abord, et pourquoi.</translation>
    </message>
    <message>
        <source>Finds where canopy was lost and gained between two surveys, and how it grew.</source>
        <translation>Trouve où la canopée a été perdue et gagnée entre deux levés, et combien elle a poussé.</translation>
    </message>
    <message>
        <source>Finds where the ground changed between two surveys, how much, and how surely.</source>
        <translation>Trouve où le sol a changé entre deux levés, de combien et avec quelle certitude.</translation>
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
        <source>From the delivery</source>
        <translation>Selon la livraison</translation>
    </message>
    <message>
        <source>GB</source>
        <translation>Go</translation>
    </message>
    <message>
        <source>Get lazrs</source>
        <translation>Obtenir lazrs</translation>
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
        <source>Greatest height</source>
        <translation>Hauteur maximale</translation>
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
        <source>Ground</source>
        <translation>Sol</translation>
    </message>
    <message>
        <source>Ground (G)</source>
        <translation>Sol (G)</translation>
    </message>
    <message>
        <source>Ground and height above ground</source>
        <translation>Sol et hauteur au-dessus du sol</translation>
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
        <source>IGN LiDAR HD</source>
        <translation>IGN LiDAR HD</translation>
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
        <source>In the next run, no point here is ground.</source>
        <translation>Au prochain calcul, aucun point n'est sol ici.</translation>
    </message>
    <message>
        <source>In the next run, the ground around is continued through the place.</source>
        <translation>Au prochain calcul, le sol alentour est prolongé à travers cet endroit.</translation>
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
        <source>Keep small knolls and pits</source>
        <translation>Garder les petites buttes et cuvettes</translation>
    </message>
    <message>
        <source>Keep; old ground that is not ground now becomes 1</source>
        <translation>Garder ; l'ancien sol qui n'est plus du sol devient 1</translation>
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
        <source>Last and single returns (return number = number of returns)</source>
        <translation>Derniers retours et retours uniques (numéro du retour = nombre de retours)</translation>
    </message>
    <message>
        <source>Least area</source>
        <translation>Surface minimale</translation>
    </message>
    <message>
        <source>Least area of a roof</source>
        <translation>Surface minimale d'un toit</translation>
    </message>
    <message>
        <source>Least expected error</source>
        <translation>Erreur attendue minimale</translation>
    </message>
    <message>
        <source>Least height of a roof</source>
        <translation>Hauteur minimale d'un toit</translation>
    </message>
    <message>
        <source>Least height of canopy</source>
        <translation>Hauteur minimale de la canopée</translation>
    </message>
    <message>
        <source>Least low confidence area</source>
        <translation>Surface minimale de ces zones</translation>
    </message>
    <message>
        <source>Least width</source>
        <translation>Largeur minimale</translation>
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
        <source>Local dominance</source>
        <translation>Dominance locale</translation>
    </message>
    <message>
        <source>Local relief</source>
        <translation>Relief local</translation>
    </message>
    <message>
        <source>Longest edge of a triangle</source>
        <translation>Plus long côté d'un triangle</translation>
    </message>
    <message>
        <source>Low confidence areas</source>
        <translation>Zones de faible confiance</translation>
    </message>
    <message>
        <source>Low noise</source>
        <translation>Bruit bas</translation>
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
        <source>Makes terrain model, surface model, canopy height and hillshade of a point cloud.</source>
        <translation>Produit le MNT, le MNS, la hauteur de canopée et l'ombrage d'un nuage de points.</translation>
    </message>
    <message>
        <source>Makes the canopy height of a surface model and a terrain model, two rasters.</source>
        <translation>Calcule la hauteur de canopée d'un modèle de surface et d'un modèle de terrain, deux rasters.</translation>
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
        <source>Mean growth where canopy stays, m</source>
        <translation>Croissance moyenne où la canopée reste, m</translation>
    </message>
    <message>
        <source>Measures densities, voids and strips, and compares them with a specification.</source>
        <translation>Mesure densités, vides et bandes de vol, et les compare à une spécification.</translation>
    </message>
    <message>
        <source>Meets the accuracy class (1 or 0)</source>
        <translation>Respecte la classe de précision (1 ou 0)</translation>
    </message>
    <message>
        <source>Meets the specification (1 or 0)</source>
        <translation>Respecte la spécification (1 ou 0)</translation>
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
        <source>Most places</source>
        <translation>Nombre maximal d'endroits</translation>
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
        <source>New canopy height (CHM)</source>
        <translation>Nouvelle hauteur de canopée (MHC)</translation>
    </message>
    <message>
        <source>New survey</source>
        <translation>Nouveau levé</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Suivant</translation>
    </message>
    <message>
        <source>No</source>
        <translation>Non</translation>
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
        <source>No places to review</source>
        <translation>Aucun endroit à vérifier</translation>
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
        <source>Not ground (N)</source>
        <translation>Pas du sol (N)</translation>
    </message>
    <message>
        <source>Not ground, except with a classic preset</source>
        <translation>Pas du sol, sauf avec un préréglage classique</translation>
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
        <source>Old canopy height (CHM)</source>
        <translation>Ancienne hauteur de canopée (MHC)</translation>
    </message>
    <message>
        <source>Old survey</source>
        <translation>Ancien levé</translation>
    </message>
    <message>
        <source>One light</source>
        <translation>Une lumière</translation>
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
        <source>Own choice of outputs</source>
        <translation>Sorties à votre choix</translation>
    </message>
    <message>
        <source>Page</source>
        <translation>Page</translation>
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
        <source>Place {}</source>
        <translation>Endroit {}</translation>
    </message>
    <message>
        <source>Place {} of {}</source>
        <translation>Endroit {} sur {}</translation>
    </message>
    <message>
        <source>Places</source>
        <translation>Endroits</translation>
    </message>
    <message>
        <source>Places of change</source>
        <translation>Lieux de changement</translation>
    </message>
    <message>
        <source>Places to review</source>
        <translation>Endroits à vérifier</translation>
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
        <source>Point cloud to terrain…</source>
        <translation>Du nuage de points au terrain…</translation>
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
        <source>Point clouds (*.las *.laz *.vpc)</source>
        <translation>Nuages de points (*.las *.laz *.vpc)</translation>
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
        <source>Points are being read: it is not known yet how far this place would rise as ground. Press G again to answer without that.</source>
        <translation>Lecture des points en cours : on ne sait pas encore de combien cet endroit monterait. Appuyez encore sur G pour répondre sans cela.</translation>
    </message>
    <message>
        <source>Points in the area</source>
        <translation>Points dans la zone</translation>
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
        <source>Points with a new class</source>
        <translation>Points dont la classe est nouvelle</translation>
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
        <source>Previous</source>
        <translation>Précédent</translation>
    </message>
    <message>
        <source>Probably no earth</source>
        <translation>Probablement pas de la terre</translation>
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
        <source>Reading the points…</source>
        <translation>Lecture des points…</translation>
    </message>
    <message>
        <source>Ready. Point clouds in .laz need one more package.</source>
        <translation>Prêt. Les nuages de points .laz demandent un paquet de plus.</translation>
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
        <source>Review</source>
        <translation>Vérification</translation>
    </message>
    <message>
        <source>Right as it is</source>
        <translation>Juste tel quel</translation>
    </message>
    <message>
        <source>Right as it is (R)</source>
        <translation>Juste tel quel (R)</translation>
    </message>
    <message>
        <source>Risen</source>
        <translation>Plus haut</translation>
    </message>
    <message>
        <source>Rivers</source>
        <translation>Rivières</translation>
    </message>
    <message>
        <source>Run a tool with the expected error of the terrain, then Places to review; or choose a layer of places.</source>
        <translation>Lancez un outil avec l'erreur attendue du terrain, puis « Endroits à vérifier » ; ou choisissez une couche d'endroits.</translation>
    </message>
    <message>
        <source>Search radius</source>
        <translation>Rayon de recherche</translation>
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
        <source>Share of ground points to hold out</source>
        <translation>Part des points de sol à mettre de côté</translation>
    </message>
    <message>
        <source>Share of low confidence areas</source>
        <translation>Part des zones de faible confiance</translation>
    </message>
    <message>
        <source>Share of wrong points</source>
        <translation>Part des points erronés</translation>
    </message>
    <message>
        <source>Shift and tilt</source>
        <translation>Décalage et inclinaison</translation>
    </message>
    <message>
        <source>Shift only</source>
        <translation>Décalage seul</translation>
    </message>
    <message>
        <source>Shift that would remove the mean difference [m]</source>
        <translation>Décalage qui annulerait l’écart moyen [m]</translation>
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
        <source>Skip (S)</source>
        <translation>Passer (S)</translation>
    </message>
    <message>
        <source>Skip missing tiles</source>
        <translation>Ignorer les tuiles manquantes</translation>
    </message>
    <message>
        <source>Skipped</source>
        <translation>Passé</translation>
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
        <source>Stop triangulation when edges are shorter than</source>
        <translation>Arrêter la triangulation quand les côtés sont plus courts que</translation>
    </message>
    <message>
        <source>Submerged object</source>
        <translation>Objet immergé</translation>
    </message>
    <message>
        <source>Sunk</source>
        <translation>Plus bas</translation>
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
        <source>Tables</source>
        <translation>Tables</translation>
    </message>
    <message>
        <source>Take off the horizontal shift</source>
        <translation>Retirer le décalage horizontal</translation>
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
        <source>Terrain model of the run before</source>
        <translation>Modèle de terrain du calcul précédent</translation>
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
        <source>The Python of this QGIS has no pip. In Debian and Ubuntu run sudo apt-get install python3-pip, elsewhere install pip for it, and try again; or choose a wheel file.</source>
        <translation>Le Python de ce QGIS n'a pas pip. Sous Debian et Ubuntu, exécutez sudo apt-get install python3-pip, ailleurs installez pip pour lui, puis réessayez ; ou choisissez un fichier wheel.</translation>
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
        <source>The expected error is not a file. Export it as GeoTIFF first.</source>
        <translation>L'erreur attendue n'est pas un fichier. Exportez-la d'abord en GeoTIFF.</translation>
    </message>
    <message>
        <source>The key-point flag of LAS; the class stays</source>
        <translation>L'indicateur de point clé de LAS ; la classe reste</translation>
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
        <source>The place stays for another time.</source>
        <translation>L'endroit reste pour une autre fois.</translation>
    </message>
    <message>
        <source>The raster with the grid to use is not a file. Export it as GeoTIFF first.</source>
        <translation>Le raster dont la grille est à utiliser n'est pas un fichier. Exportez-le d'abord en GeoTIFF.</translation>
    </message>
    <message>
        <source>The removed lazrs is still in use: restart QGIS and try again.</source>
        <translation>Le lazrs supprimé est encore utilisé : redémarrez QGIS et réessayez.</translation>
    </message>
    <message>
        <source>The same without QGIS:</source>
        <translation>La même chose sans QGIS :</translation>
    </message>
    <message>
        <source>The terrain changed on {} m², by {} m on average and {} at most.</source>
        <translation>Le terrain a changé sur {} m², de {} m en moyenne et de {} au plus.</translation>
    </message>
    <message>
        <source>The terrain has not changed.</source>
        <translation>Le terrain n'a pas changé.</translation>
    </message>
    <message>
        <source>The terrain model is not a file. Export it as GeoTIFF first.</source>
        <translation>Le modèle de terrain n'est pas un fichier. Exportez-le d'abord en GeoTIFF.</translation>
    </message>
    <message>
        <source>The usual one of the delivery</source>
        <translation>Celle habituelle de la livraison</translation>
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
        <source>To review</source>
        <translation>À vérifier</translation>
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
        <source>Undo</source>
        <translation>Annuler</translation>
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
        <source>Use as others</source>
        <translation>Utiliser comme les autres</translation>
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
        <source>Verdict</source>
        <translation>Verdict</translation>
    </message>
    <message>
        <source>Vertical shift taken off, m</source>
        <translation>Décalage vertical retiré, m</translation>
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
        <source>Volume down, m3</source>
        <translation>Volume en baisse, m3</translation>
    </message>
    <message>
        <source>Volume up, m3</source>
        <translation>Volume en hausse, m3</translation>
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
        <source>What changed is not known: one of the two runs has no terrain model.</source>
        <translation>On ne sait pas ce qui a changé : un des deux calculs n'a pas de modèle de terrain.</translation>
    </message>
    <message>
        <source>What changed is not known: the new terrain model has other cells.</source>
        <translation>On ne sait pas ce qui a changé : le nouveau modèle de terrain a d'autres cellules.</translation>
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
        <source>Writes the points of an area as they are, and nothing else.</source>
        <translation>Écrit les points d'une zone tels quels, et rien d'autre.</translation>
    </message>
    <message>
        <source>Yes</source>
        <translation>Oui</translation>
    </message>
    <message>
        <source>Z, in place of the elevation</source>
        <translation>Z, à la place de l'altitude</translation>
    </message>
    <message>
        <source>a gap of {width} without ground</source>
        <translation>un vide de {width} sans sol</translation>
    </message>
    <message>
        <source>a gap of {width} without ground, beside a step or a slope</source>
        <translation>un vide de {width} sans sol, à côté d'une marche ou d'une pente</translation>
    </message>
    <message>
        <source>a large expected error</source>
        <translation>une grande erreur attendue</translation>
    </message>
    <message>
        <source>bare earth,surface,buildings,trees,vegetation,off-terrain objects,oto,whitebox,lindsay,top-hat</source>
        <translation>sol nu,surface,bâtiments,arbres,végétation,sursol,objets,oto,whitebox,lindsay,top-hat</translation>
    </message>
    <message>
        <source>beside water or the border of the survey</source>
        <translation>à côté de l'eau ou au bord du levé</translation>
    </message>
    <message>
        <source>buildings,roofs,trees,classes,classification,bridges,noise,lasclassify,asprs,ign</source>
        <translation>bâtiments,toits,arbres,classes,classification,ponts,bruit,lasclassify,asprs,ign</translation>
    </message>
    <message>
        <source>canopy</source>
        <translation>canopée</translation>
    </message>
    <message>
        <source>canopy change</source>
        <translation>changement de la canopée</translation>
    </message>
    <message>
        <source>change</source>
        <translation>changement</translation>
    </message>
    <message>
        <source>change,difference,dod,volume,erosion,landslide,detection,m3c2</source>
        <translation>changement,différence,volume,érosion,glissement,détection,déblai,M3C2</translation>
    </message>
    <message>
        <source>change,difference,forest,growth,loss,logging,windthrow,gaps,cover</source>
        <translation>changement,différence,forêt,croissance,perte,coupe,chablis,trouées,couvert</translation>
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
        <source>clip,crop,cut,extent,boundary,polygon,subset,las2las,pdal crop</source>
        <translation>découper,extraire,clip,emprise,limite,polygone,partie,las2las,pdal crop</translation>
    </message>
    <message>
        <source>contours</source>
        <translation>courbes de niveau</translation>
    </message>
    <message>
        <source>contours,isolines,contour map,depression,knoll,dxf,cad,ocad</source>
        <translation>courbes de niveau,isolignes,carte,dépression,butte,dxf,cad,ocad</translation>
    </message>
    <message>
        <source>contours,workflow</source>
        <translation>courbes de niveau,chaîne de traitement</translation>
    </message>
    <message>
        <source>degrees</source>
        <translation>degrés</translation>
    </message>
    <message>
        <source>deliverables,archaeology,forestry,flood,drone,stockpile</source>
        <translation>livrables,archéologie,forêt,inondation,drone,stock de matériaux</translation>
    </message>
    <message>
        <source>download,remote,url,web,http,clip,cloud storage,reproject,utm</source>
        <translation>télécharger,distant,url,web,http,découper,stockage cloud,reprojeter,utm</translation>
    </message>
    <message>
        <source>dsm,dtm,canopy height model,difference,subtract,raster calculator</source>
        <translation>mns,mnt,mnh,modèle de hauteur de canopée,différence,calculatrice raster</translation>
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
        <source>hardly any ground under plants or on roofs</source>
        <translation>presque pas de sol sous les plantes ou sur les toits</translation>
    </message>
    <message>
        <source>height,extra bytes</source>
        <translation>hauteur,dimension supplémentaire</translation>
    </message>
    <message>
        <source>heights times {}</source>
        <translation>hauteurs fois {}</translation>
    </message>
    <message>
        <source>key points</source>
        <translation>points clés</translation>
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
        <source>lidar,laser scanning,als,uav,drone,las,laz,copc,ept,point cloud</source>
        <translation>lidar,laser aéroporté,drone,las,laz,copc,ept,nuage de points</translation>
    </message>
    <message>
        <source>low plants: the ground may be up to {error} too high</source>
        <translation>plantes basses : le sol est peut-être trop haut, de {error} au plus</translation>
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
        <source>no change</source>
        <translation>aucun changement</translation>
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
        <source>place</source>
        <translation>endroit</translation>
    </message>
    <message>
        <source>places to review</source>
        <translation>endroits à vérifier</translation>
    </message>
    <message>
        <source>plants or ground: low points were not taken for ground, up to {error} off</source>
        <translation>plantes ou sol : des points bas n'ont pas été pris pour du sol, jusqu'à {error} d'écart</translation>
    </message>
    <message>
        <source>points</source>
        <translation>points</translation>
    </message>
    <message>
        <source>preview,try,test,preset,parameters,compare</source>
        <translation>aperçu,essayer,tester,préréglage,paramètres,comparer</translation>
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
        <source>quality,qc,density,pulse density,voids,low confidence,swath,strips,overlap,usgs,lbs,linz,ign,specification,lasoverlap,lasgrid</source>
        <translation>qualité,qc,densité,lacunes,faible confiance,bandes,recouvrement,usgs,lbs,linz,ign,spécification,lasoverlap,lasgrid</translation>
    </message>
    <message>
        <source>relief</source>
        <translation>relief</translation>
    </message>
    <message>
        <source>review,error,uncertainty,confidence,quality</source>
        <translation>vérifier,erreur,incertitude,confiance,qualité</translation>
    </message>
    <message>
        <source>rough ground: a step, rocks or plants that were kept as ground</source>
        <translation>sol accidenté : une marche, des rochers ou des plantes gardés comme sol</translation>
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
        <source>steep ground</source>
        <translation>sol en forte pente</translation>
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
        <source>terrain from {} to {}</source>
        <translation>terrain de {} à {}</translation>
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
        <source>where it may be</source>
        <translation>où il peut être</translation>
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
        <source>{rise} of relief</source>
        <translation>{rise} de dénivelé</translation>
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
        <source>{} is not on this computer. Choose a file.</source>
        <translation>{} n'est pas sur cet ordinateur. Choisissez un fichier.</translation>
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
        <source>{} m² by {} m, at most {} m</source>
        <translation>{} m² de {} m, au plus {} m</translation>
    </message>
    <message>
        <source>{} of {} answered</source>
        <translation>{} sur {} avec réponse</translation>
    </message>
    <message>
        <source>{} points higher or lower</source>
        <translation>{} points plus haut ou plus bas</translation>
    </message>
    <message>
        <source>{} were removed from {}.</source>
        <translation>{} ont été supprimés de {}.</translation>
    </message>
</context>
</TS>
