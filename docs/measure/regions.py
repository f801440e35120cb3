"""Regions of the trust map in words, each a condition on groups: where errors and advice are stated."""

from math import log

from compare.trustmap.regions import FLOWS, ROUGHNESS, SHAPES, WIDENED, Condition

BODIES: dict[str, Condition] = {
    "cone": SHAPES["cone"],
    "sphere": SHAPES["sphere"],
    "other powers": lambda g: (g["shape"] != 1) & (g["shape"] != 0.5),
}
SPEEDS: dict[str, Condition] = {
    "at rest": lambda g: ~g["slides"],
    "slow": lambda g: g["slides"] & FLOWS["slow"](g),
    "fast": lambda g: g["slides"] & FLOWS["fast"](g),
}
SOLIDS: dict[str, Condition] = {
    "Kelvin-like, E_g > 10^4 E_r": lambda g: g["stiffening"] > log(1e4),
    "E_g 10^2 to 10^4 E_r": lambda g: (g["stiffening"] <= log(1e4)) & (g["stiffening"] > log(1e2)),
    "E_g up to 10^2 E_r": lambda g: g["stiffening"] <= log(1e2),
}
WAVES: dict[str, Condition] = {
    "less than 2 waves on the radius": lambda g: g["sliding_waves"] < log(2),
    "2 to 6 waves": lambda g: (g["sliding_waves"] >= log(2)) & (g["sliding_waves"] < log(6)),
    "more than 6 waves": lambda g: g["sliding_waves"] >= log(6),
}
SURFACES: dict[str, Condition] = {
    "spectrum": lambda g: (g["side"] == 0) & (g["gaussian"] == 0),
    "as measured": lambda g: (g["side"] > 0) | (g["gaussian"] > 0),
}
REGIONS = {"body": SHAPES, "speed": SPEEDS, "roughness": ROUGHNESS, "solid": SOLIDS, "waves": WAVES}
COVERED = WIDENED | {"speed": SPEEDS}  # what coverage is stated by
