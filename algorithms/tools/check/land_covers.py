"""Which checkpoints lie on vegetated land, by what surveys write in several languages.

ASPRS (2023): Positional Accuracy Standards for Digital Geospatial Data, edition 2, version 1.0:
land without vegetation (NVA) is bare earth, sand, rock, short grass and urban land; vegetated land
(VVA) is tall weeds and crops, brush and forest.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import NamedTuple, Sequence

from ...core.progress import Progress
from .checkpoints import Checkpoints
from .columns import parts_of, words_of

NVA, VVA, CONTROL, UNKNOWN = "NVA", "VVA", "control", ""

# How the standard and its predecessor abbreviate the accuracy on both kinds of land.
_STATED = {"nva": NVA, "fva": NVA, "vva": VVA}
_MOST_NAMES = 10
_UMLAUTS = re.compile("([aou])e")


def _key(word: str) -> str:
    """Return a word in small letters; ae, oe and ue are a, o and u, as ä, ö and ü are."""
    return _UMLAUTS.sub(r"\1", word.lower())


def _keys(text: str) -> frozenset[str]:
    return frozenset(map(_key, words_of(text)))


def _words(text: str) -> list[str]:
    """Return the words in what somebody wrote."""
    return [_key(part) for part in parts_of(text) if part.isalpha()]


# Plants and what is covered by them: English, German, French, Dutch, Spanish, some of others.
# Plurals with s, es or x need no entry.
_VEGETATED = _keys(
    "veg vegetated vegetation vegetative forest forested forestry wood woods woodland wooded woody"
    " tree timber shrub shrubland shrubby scrub scrubland brush brushy brushland bush bushland"
    " undergrowth understory understorey underbrush thicket hedge hedgerow orchard vineyard grove"
    " plantation crop cropland corn maize wheat barley rye oats rice soy soybean cotton sugarcane"
    " cane alfalfa hay canola rapeseed sunflower potato potatoes weed weedy reed reedbed rushes"
    " cattail sedge marsh marshland swamp swampland swampy bog fen mangrove wetland fern bracken"
    " heath heather heathland gorse bamboo palmetto sawgrass sagebrush chaparral mesquite juniper"
    " pine spruce fir oak birch aspen willow evergreen deciduous conifer coniferous hardwood"
    " softwood canopy jungle rainforest tussock flax manuka kanuka bramble blackberry ivy"
    " herbaceous twc blt"
    # German
    " wald waelder forst baum baeume baeumen gehoelz busch buesche gebuesch strauch straeucher"
    " straeuchern gestruepp hecke hecken dickicht unterholz unterwuchs schilf schilfrohr roehricht"
    " ried heide farn farne brombeere brombeeren mais korn weizen raps gerste roggen hafer getreide"
    " rueben zuckerrueben sonnenblumen kartoffeln hopfen weinberg weinberge weingarten reben"
    " obst obstgarten obstwiese streuobst streuobstwiese plantage sumpf moor hochgras stauden"
    " hochstauden bewachsen bewaldet bewuchs laub kiefer kiefern fichte"
    " fichten buche buchen eiche eichen jungwuchs schonung unkraut brennnesseln brennesseln"
    " feldfrucht feldfruechte buschland"
    # French
    " foret bois boise boisee boisement arbre arbuste arbustif arbustive arbore arboree buisson"
    " broussaille fourre taillis futaie haie verger vigne vignoble ble colza tournesol culture"
    " lande maquis garrigue bruyere roseau roseliere friche fougere bosquet vegetal vegetale"
    " vegetalise vegetalisee ripisylve peupleraie pinede sapiniere chenaie hetraie marais marecage"
    # Dutch
    " bos bossen bomen boom struik struiken struikgewas struweel riet rietkraag heg heggen haag"
    " houtwal boomgaard wijngaard gewas gewassen tarwe gerst koolzaad aardappelen bieten onkruid"
    " vegetatie begroeid begroeiing ruigte moeras"
    # Spanish, Italian, Portuguese, Scandinavian
    " bosque arbol arbolado arboleda arbusto matorral maleza selva pinar encinar robledal hayedo"
    " eucaliptal cultivo maiz trigo cebada vinedo vina olivar olivo huerto huerta frutal seto"
    " manglar marisma carrizo carrizal junco juncal helecho vegetacion vegetado sotobosque zarza"
    " bosco alberi arbusti siepe vigneto oliveto frutteto macchia vegetazione canneto floresta"
    " arvore skog"
)
# Land without vegetation, or with low grass.
_OPEN = _keys(
    "bare open earth soil dirt sand sandy gravel gravelly rock rocky stone stony boulder scree"
    " asphalt concrete cement pavement paved paving road street roadway highway freeway avenue"
    " boulevard lane drive track trail path pathway footpath sidewalk walkway driveway parking"
    " carpark runway taxiway tarmac apron helipad deck decking curb kerb gutter manhole urban"
    " developed built building barren hard hardstand grass lawn turf grassland short mown mowed"
    " beach dune desert playa snow ice clay mud mudflat quarry ballast railway railroad rail bridge"
    " plaza square playground court fairway terrain impervious sealed unpaved brick cobble"
    " cobblestone clear cleared airport pier dock ramp stairs levee dike dyke"
    # German
    " weg wege strasse strassen gasse platz pfad bahn bruecke steig beton pflaster schotter kies"
    " fels felsen stein steine rasen gras offen offenes offenland befestigt versiegelt hof halde"
    " deponie duene strand watt siedlung stadt bebaut bordstein gully schacht deckel freiflaeche"
    " gelaende erde deich damm"
    # French
    " nu nue route rue chemin sentier piste chaussee trottoir allee place gravier cailloux rocher"
    " roche sable plage pelouse gazon herbe urbain urbaine bati pont terrasse ouvert ouverte degage"
    " terre quai digue esplanade enrobe bitume"
    # Dutch
    " straat pad stoep plein verharding verhard onverhard tegels klinkers grind zand rots steen"
    " gazon grasland brug stedelijk bebouwd kaal dijk"
    # Spanish, Italian, Portuguese
    " suelo desnudo carretera calle camino sendero pista acera asfalto hormigon grava roca piedra"
    " arena cesped hierba pasto urbano urbana edificado puente terraza abierto despejado tierra"
    " aparcamiento strada sentiero piazza calcestruzzo ghiaia roccia sabbia spiaggia prato ponte"
    " estrada rua caminho"
)
# In these languages the first noun decides: "chemin forestier", "camino del bosque".
_FIRST_DECIDES = _keys(
    "route rue chemin sentier piste chaussee trottoir allee pont terrasse carretera calle camino"
    " sendero pista puente plaza terraza acera strada sentiero ponte rua estrada caminho"
)
_LOW_PLANTS = _keys("grass grasses gras herbe herbes hierba hierbas pasto pastos erba erbe")
_TALL = _keys(
    "tall high long hoch hohe hohes hoher hohen hoog hoge lang langes lange haut haute hautes alto"
    " alta altos altas dense dicht dichtes unmown uncut overgrown thick"
)
# A word that ends so is of this kind: Nadelwald, Waldweg.
_ENDS = (
    (VVA, "wald forst busch gebusch geholz strauch hecke baum baume straucher schilf rohricht moor"
     " heide wuchs plantage brush enbos naaldbos loofbos"),
    (NVA, "weg wege strasse gasse platz pfad bahn brucke steig rasen gras beton schotter kies sand"
     " deich damm straat plein brug pad dijk road street way hof"),
)  # fmt: skip
# These endings say nothing. The word before them does: Maisfeld, Waldboden, cornfield.
_NEUTRAL_ENDS = re.compile(
    "(.{3,})(?:felder|feld|fields|field|flachen|flache|gebiet|bestand|boden|rand|veld|velden|zone)"
)
_WITHOUT = re.compile("(.{3,})(?:less|los|lose|loses|losen|frei|freie|freies)|(?:un|non)(.+)")
# What is named behind one of these is not there.
_NEGATIONS = _keys(
    "non no not without un nicht kein keine keinen ohne sans hors pas sin niet geen zonder senza"
    " sem"
)
# Where something is beside plants or under them, it is vegetated.
_AND = _keys("and und et y e mit avec con met with under unter sous bajo onder beneath")
_BETWEEN = re.compile(r"[,;/+&()|:]|\s[-\u2013]\s")
_OF = _keys("of in im am at an dans en de des du del la d van op through durch")
_FREE = _keys("free frei libre vrij")  # what is named before one of these is not there
_CONTROL = _keys(
    "control controls gcp gcps calibration passpunkt passpunkte paspunt paspunten appui calage"
    " apoyo appoggio adjustment tiepoint"
)
_CHECK = _keys(
    "check checks checked checkpoint checkpoints chk chkpt cp icp qc qa quality verification"
    " validation kontrollpunkt kontrolle pruefpunkt checkpunkt controle controlepunt verificacion"
    " comprobacion chequeo verifica controllo independent"
)
_POINT = _keys(
    "point points pt pts punkt punkte punt punto d de ground photo survey terrestre dgps"
)


class LandCovers(NamedTuple):
    """Tells whether checkpoints lie on vegetated land, by what is written of them."""

    # land covers with one of these are vegetated, others not; empty: the known
    words: tuple[str, ...] = ()

    def kind(self, use: str, cover: str) -> str | None:
        """Return `NVA`, `VVA`, `CONTROL`, `UNKNOWN` for a land cover that is not known, or None if
        nothing is written, by use, such as Check or NVA, and land cover.
        """
        used, named = _words(use), _words(cover)
        if _is_control(used) or (_is_control(named) and {*named} <= _CONTROL | _POINT):
            return CONTROL
        return (self._land(use) if used else None) or self._land(cover)

    def _land(self, text: str) -> str | None:
        """Return the kind of land that a text names."""
        words = _words(text)
        explicit = {_STATED[word] for word in words if word in _STATED}
        if len(explicit) == 1:
            return explicit.pop()
        if not text.strip() or (words and {*words} <= _CHECK | _POINT):
            return None
        if not self.words and not _TALL.isdisjoint(words) and not _LOW_PLANTS.isdisjoint(words):
            return VVA
        kinds = set(map(self._of_part, _parts(text)))
        if VVA in kinds:
            return VVA
        return NVA if NVA in kinds or self.words else UNKNOWN

    def _of_part(self, words: list[str]) -> str:
        """Return the kind of land that a few words name together."""
        kinds = [self._of_word(word) for word in words]
        for place, word in enumerate(words):
            if word in _NEGATIONS and VVA in kinds[place + 1 :]:
                kinds[kinds.index(VVA, place + 1)] = NVA
            if word in _FREE and place and kinds[place - 1] == VVA:
                kinds[place - 1] = NVA
        marked = [place for place, kind in enumerate(kinds) if kind]
        if not marked:
            return UNKNOWN
        first = marked[0]
        between = words[first + 1 : marked[1]] if marked[1:] else []
        is_first = words[first] in _FIRST_DECIDES or not _OF.isdisjoint(between)
        return kinds[first if is_first else marked[-1]]

    def _of_word(self, word: str) -> str:
        """Return the kind of land that a word names."""
        if self.words:
            return VVA if any(_is_same(word, _key(given)) for given in self.words) else UNKNOWN
        for kind, known in ((VVA, _VEGETATED), (NVA, _OPEN)):
            if not known.isdisjoint(_singular(word)):
                return kind
        without = _WITHOUT.fullmatch(word)
        if without and self._of_word(without[1] or without[2]) == VVA:
            return NVA
        for kind, ends in _ENDS:
            if word.endswith(tuple(ends.split())):
                return kind
        neutral = _NEUTRAL_ENDS.fullmatch(word)
        return self._of_word(neutral[1]) if neutral else UNKNOWN


def kinds_of(
    checkpoints: Checkpoints, covers: LandCovers, progress: Progress
) -> tuple[list[str], dict[str, int]]:
    """Return `NVA`, `VVA` or `CONTROL` for each checkpoint, by their names if nothing else is
    written of any, and the land covers that are not known, which are told.
    """
    uses = checkpoints.types or [""] * checkpoints.count
    found = list(map(covers.kind, uses, checkpoints.covers))
    if not any(found) and not any(checkpoints.covers):
        stated = (map(_STATED.get, map(_key, parts_of(name))) for name in checkpoints.names)
        found = [next(filter(None, kinds), None) for kinds in stated]
        if any(found):
            progress.info("The names of the checkpoints say which of them are NVA or VVA.")
    unknown = Counter(
        cover or use for use, cover, kind in zip(uses, checkpoints.covers, found) if kind == UNKNOWN
    )
    bare = found.count(None)
    if bare == len(found):
        progress.info("The checkpoints have no land cover: all count as without vegetation.")
    elif bare:
        progress.info(f"Checkpoints without a land cover, which count as not vegetated: {bare:,}.")
    if unknown:
        names = [f"{name} ({count:,})" for name, count in unknown.most_common(_MOST_NAMES)]
        more = len(unknown) - len(names)
        progress.warning(
            f"Land covers that are not known, which count as not vegetated: {', '.join(names)}"
            f"{f' and {more:,} more' if more else ''}. If some are, say which: --vegetated, in QGIS"
            " 'Vegetated land covers'."
        )
    return [kind or NVA for kind in found], dict(unknown.most_common())


def _parts(text: str) -> list[list[str]]:
    """Return the words of each part of a text: of what is beside or under something else."""
    found: list[list[str]] = []
    for part in _BETWEEN.split(text):
        found.append([])
        for word in _words(part):
            if word in _AND:
                found.append([])
            else:
                found[-1].append(word)
    return list(filter(None, found))


def _singular(word: str) -> tuple[str, ...]:
    """Return a word, and what it may be the plural of."""
    return tuple(word[: len(word) - len(end)] for end in ("", "s", "x", "es") if word.endswith(end))


def _is_same(word: str, wanted: str) -> bool:
    """Return whether a word is one that the user gave, or a compound that ends with it."""
    return (len(wanted) > 3 and word.endswith(wanted)) or wanted in _singular(word)


def _is_control(words: Sequence[str]) -> bool:
    """Return whether words say that a survey was fitted to a point."""
    return not _CONTROL.isdisjoint(words) and _CHECK.isdisjoint(words)
