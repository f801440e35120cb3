"""Names of columns in one spelling: signs, languages and hyphens apart."""

import re
from functools import lru_cache
from unicodedata import combining, normalize

_MARKS = str.maketrans(',;|"[]()/\t', " " * 10)
# Kinds of primes are one; of formulas in LaTeX the letters stay.
_SIGNS = str.maketrans("’‘′`´″”“", "'" * 5 + '"' * 3, "$\\{}")
# Words of tables in German and French, without accents.
ENGLISH = {
    **dict.fromkeys(("frequenz", "pruffrequenz", "messfrequenz"), "frequency"),
    **dict.fromkeys(("kreisfrequenz", "winkelfrequenz", "frequence angulaire", "pulsation"), "angular frequency"),
    **dict.fromkeys(("speichermodul", "module de conservation", "module de stockage"), "storage modulus"),
    **dict.fromkeys(("verlustmodul", "module de perte"), "loss modulus"),
    **dict.fromkeys(("komplexer modul", "module complexe"), "complex modulus"),
    **dict.fromkeys(("relaxationsmodul", "module de relaxation"), "relaxation modulus"),
    **dict.fromkeys(("kriechnachgiebigkeit", "kriechkomplianz", "complaisance de fluage"), "creep compliance"),
    **dict.fromkeys(("verlustfaktor", "facteur de perte"), "loss factor"),
    **dict.fromkeys(("phasenwinkel", "phasenverschiebung", "angle de phase", "dephasage"), "phase angle"),
    **dict.fromkeys(("temperatur", "probentemperatur", "pruftemperatur", "prueftemperatur"), "temperature"),
    **dict.fromkeys(("zeit", "temps"), "time"),
    **dict.fromkeys(("normalkraft", "force normale"), "normal force"),
    **dict.fromkeys(("reibkraft", "reibungskraft", "tangentialkraft"), "friction force"),
    **dict.fromkeys(("force de frottement", "force tangentielle"), "friction force"),
    **dict.fromkeys(
        ("reibwert", "reibzahl", "reibungszahl", "reibbeiwert", "reibungsbeiwert"), "friction coefficient"
    ),
    **dict.fromkeys(
        ("reibungskoeffizient", "reibkoeffizient", "coefficient de frottement"), "friction coefficient"
    ),
    **dict.fromkeys(("geschwindigkeit", "vitesse"), "speed"),
    **dict.fromkeys(("gleitgeschwindigkeit", "relativgeschwindigkeit", "vitesse de glissement"), "sliding speed"),
    **dict.fromkeys(("last", "normallast", "charge", "charge normale"), "load"),
    **{"kraft": "force", "drehzahl": "rotational speed", "verschiebungsfaktor": "shift factor"},
}
_FOREIGN = re.compile(rf"\b(?:{'|'.join(sorted(ENGLISH, key=len, reverse=True))})\b", re.IGNORECASE)


@lru_cache(maxsize=1024)
def spelt(name: str) -> str:
    """A name in one spelling and in English; letters stay as large as they are."""
    name = normalize("NFKC", name.translate(_SIGNS)).translate(_SIGNS).replace("''", '"')
    name = "".join(each for each in normalize("NFKD", name) if not combining(each))
    name = " ".join(name.replace("_", " ").replace("-", " ").strip(" .:").split())
    return _FOREIGN.sub(lambda word: ENGLISH[word[0].lower()], name)


def speaks_of(text: str, name: str) -> bool:
    """Whether a text has a name among its words."""
    words = f" {' '.join(spelt(text).casefold().translate(_MARKS).split())} "
    return f" {spelt(name).casefold()} " in words
