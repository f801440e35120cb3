"""Friction of surfaces far finer than a grid: contacts solved with every wave, and without their finest ones.

python docs/measure/extended.py solve learned|more|further|tested   solves the contacts that
docs/results/extended-SET.csv does not have yet, one by one, and adds the rows of each
python docs/measure/extended.py   fits the intervals to all sets but the last, and writes how often they hold of it
into docs/results/law.md; compare/trustmap/outside.csv has these, compare/models/law/extended.csv those of all sets

Contacts are drawn until each stratum has its number of those that a grid can show: with all waves on a grid of at
most 4096^2 points, with a grid error of at most 1 %, and with at least one cut on a grid of 96^2 points or more.
"""

import sys
from collections import namedtuple
from itertools import count
from math import ceil, inf

import design
import numpy as np
import pandas
from pandas import DataFrame, Series, read_csv
from planes import HELD_OUT, RANGES, off, planes
from scipy.optimize import minimize
from scipy.stats import t as student
from tables import RESULTS, errors_of, fill, share_of, table

from bem3d import BEM
from compare.models.law.extended import UNCERTAINTY, scales, under, without
from compare.models.law.nominal import mean_gap
from compare.models.law.parts import LawParts, coefficients
from compare.models.law.smooth import SmoothContact
from compare.trustmap.friction_law import TESTED
from scene import Prony, Refused, Scene, SelfAffine, Slide, SolveError, Spectrum, Table, Tabulated
from scene.scales import elastic_contact

# Seed of each set, and contacts of each stratum in it.
SETS = {"learned": (62_100, 18), "more": (62_200, 24), "further": (62_300, 24), "tested": (62_400, 24)}
# Strata by p/p_rms with all waves, declared beforehand: the lightest contacts, light ones, partial and nearly full
# ones.
STRATA = {"lightest": (1e-4, 5e-3), "light": (5e-3, 0.05), "partial": (0.05, 0.5), "nearly full": (0.5, 20.0)}
HURSTS, WAVES, HEIGHTS = (0.2, 0.95), (25.0, 110.0), (3e-3, 0.5)
PERIODS = 1.0, 6.0  # longest wave over the radius
POWERS = 3.0, 10.0
FAST, OFTEN = 10.0, 0.4  # v tau over the shortest wave, and share of the contacts that are above
TABLES = 0.4  # share of the Prony series that are given as a table of moduli
MEASURED = 0.2  # share of spectra that are no power law, as a table of densities
# Points to the shortest wave: of all waves in a light contact, and in others; of the waves that are kept.
FINE, USUAL, CUT = 16.0, 12.0, 8.0
POINTS = (128, 160, 192, 256, 320, 384, 512, 640, 768, 1024, 1280, 1536, 2048, 2560, 3072, 4096)
CUTS = 2, 4, 8, 16, 32  # shortest wave that is kept, over the shortest of all
CONTACT = ["set", "number"]
NAMES = ["one", "rough", "added", "few", "light"]  # of the coefficients of an interval
FREEDOMS = 4  # of Student's distribution of errors
LEAST_CUT = 96  # points a side of the coarsest grid
NEARLY = 0.8  # share of the points to the shortest wave that suffices
TRUE = 0.01  # greatest grid error of what counts as true


# A rough scene of a set, its stratum, and x = p/p_rms with all waves.
Contact = namedtuple("Contact", "set number stratum x scene")


def named(contact):
    """Columns of a contact in its table."""
    return dict(zip(Contact._fields[:-1], contact, strict=False))


def candidates(name):
    """Contacts of the strata, without end."""
    seed, _ = SETS[name]
    draw = np.random.default_rng(seed)
    for number in count(1):
        scene = drawn(draw, 1000 * number + seed)
        try:
            x = LawParts.of(scene).x
        except (SolveError, Refused):
            continue
        stratum = next((key for key, (low, high) in STRATA.items() if low <= x < high), None)
        if stratum and scene.roughness.rms_height < elastic_contact(scene).depth:
            yield Contact(name, number, stratum, x, scene)


def drawn(draw, seed):
    """A scene of the population."""
    u = draw.random(18)
    wave = design.RADIUS / design.between(WAVES, u[0])
    place = design.within(u[1], design.SPEEDS, (FAST, design.SPEEDS[1])) if u[2] < OFTEN else u[1]
    solid = design.solid_at(*u[3:8], min(place, 1.0) * design.SLIDING, wave)
    if isinstance(solid, Prony) and u[17] < TABLES:
        solid = table_of(solid)
    body = u[16]
    shape = design.CONES / 2 if body < 0.3 else (design.CONES + design.ROUND) / 2 if body < 0.65 else 0.9
    indenter = design.body(shape, design.within(u[8], design.EXPONENTS, POWERS))
    rough = SelfAffine(
        hurst=HURSTS[0] + u[9] * (HURSTS[1] - HURSTS[0]),
        rms_height=design.DEPTH * design.between(HEIGHTS, u[10]),
        longest=(longest := design.RADIUS * design.between(PERIODS, u[11])),
        rolloff=design.between((longest / 8, longest), u[12]) if u[13] < 0.5 else None,
        shortest=wave,
        seed=seed,
    )
    if u[14] < MEASURED:
        rough = measured(rough, draw)
    stiffness = 2 * indenter.exponent / (indenter.exponent + 1) * solid.indentation_modulus
    load, depth = (stiffness * design.DEPTH * design.RADIUS, None) if u[15] < 0.75 else (None, design.DEPTH)
    return Scene(indenter, solid, Slide(speed=design.SPEED, load=load, depth=depth), rough)


def measured(rough, draw):
    """A table of densities about those of a power law, as an instrument shows them."""
    q = np.geomspace(rough.q_min, rough.q_max(0.0), 30)
    density = np.asarray(rough.density_2d(q * (1 - 1e-9 * (q >= q[-1])), rough.q_max(0.0)))
    density[0] = density[1] if density[0] == 0 else density[0]
    bumps = np.exp(0.4 * np.convolve(draw.standard_normal(34), np.ones(5) / 5**0.5, "valid"))
    return Spectrum(q=tuple(q), C2D=tuple(density * bumps), convention="persson", seed=rough.seed)


def table_of(solid):
    """The moduli of a solid as a rheometer shows them."""
    frequency = np.geomspace(0.03 / max(solid.relaxation_times), 30 / min(solid.relaxation_times), 40)
    moduli = solid.complex_modulus(frequency)
    return Tabulated(
        table=Table(tuple(frequency), tuple(moduli.real), tuple(moduli.imag)),
        frequency_unit="rad/s",
        kind="shear",
        equilibrium_modulus=solid.equilibrium_modulus,
    )


def row(contact, factor, shortest, points):
    """Numbers of one solve, its law, and the law of all waves under the load that it found."""
    scene = contact.scene if factor == 1 else without(contact.scene, shortest)
    numbers = named(contact) | {"factor": factor, "points": points, "shortest": shortest}
    try:
        found = BEM(points=points).solve(scene)
    except (SolveError, Refused) as error:
        return numbers | {"reason": str(error)}
    numbers |= {
        "extent": found.settings["extent"],
        "friction": found.friction_coefficient,
        "depth": found.depth,
        "error": found.measures["friction_error"],
        "pixels": found.measures["points_per_shortest_wave"],
        "area": found.measures["contact_area"],
        "rms_height": scene.roughness.rms_height,
    }
    try:
        own, whole = (LawParts.of(under(each, found.normal_force)) for each in (scene, contact.scene))
    except SolveError as error:
        return numbers | {"reason": f"law: {error}"}
    return numbers | {
        "law": own.friction_coefficient,
        "law_rough": own.rough,
        "whole": whole.friction_coefficient,
    }


def solved(contact):
    """Rows of a contact: with every wave, on a grid fine enough for them, and at each cut."""
    rough, pixels = contact.scene.roughness, FINE if contact.x < STRATA["light"][1] else USUAL
    numbers = named(contact) | {"factor": 1}
    coarse, extent = without(contact.scene, min(16 * rough.shortest, rough.longest / 2.01)), inf
    for points in (64, 128, 256):
        try:
            extent = BEM(points=points).solve(coarse).settings["extent"]
            break
        except (SolveError, Refused):
            continue
    while True:
        needed = pixels * extent / rough.shortest
        if not LEAST_CUT * CUTS[0] <= needed <= POINTS[-1]:
            return [numbers | {"reason": f"needs {needed:.0f} points"}]
        whole = row(contact, 1, rough.shortest, next(each for each in POINTS if each >= needed))
        if whole.get("pixels", inf) >= NEARLY * pixels or whole["extent"] <= extent:
            break
        extent = whole["extent"]  # of the contact with all waves, which is wider
    if not (whole.get("whole", 0.0) > 0 and whole["error"] <= TRUE):
        return [whole | {"reason": whole.get("reason", f"grid error {whole['error']:.2g}")}]
    rows = [whole]
    for factor in CUTS:
        length = factor * rough.shortest
        fewer = 2 * ceil(CUT * whole["extent"] / length / 2)
        if fewer >= LEAST_CUT and length <= rough.longest / 2:
            rows.append(row(contact, factor, length, fewer))
    return rows


def solve(name):
    """Solve the contacts of a set that are not solved yet."""
    path = RESULTS / f"extended-{name}.csv"
    rows = read_csv(path).to_dict("records") if path.exists() else []
    done = {each["number"]: each for each in rows if each["factor"] == 1}
    wanted = dict.fromkeys(STRATA, SETS[name][1])
    for contact in candidates(name):
        if not any(wanted.values()):
            break
        if not wanted[contact.stratum]:
            continue
        if contact.number not in done:
            found = solved(contact)
            rows += found
            DataFrame(rows).to_csv(path, index=False)
            done[contact.number] = found[0]
            print(*contact[:3], len(found), "solves", flush=True)
        wanted[contact.stratum] -= pandas.isna(done[contact.number].get("reason"))


def errors(name):
    """Logarithms of answer over truth, of each cut and of the law alone, and the gap of the depth."""
    rows = read_csv(RESULTS / f"extended-{name}.csv")
    rows = rows[rows["reason"].isna()]
    true = rows[rows["factor"] == 1].set_index("number")
    cut = rows[rows["factor"] > 1].join(true[["friction", "whole", "law_rough"]].add_prefix("true_"), on="number")
    added = (cut["whole"] - cut["law"]).clip(lower=0)
    total = cut["friction"] + added
    cut["extended"] = np.log(total / cut["true_friction"])
    cut["bare"] = np.log(cut["true_whole"] / cut["true_friction"])
    rough = cut["true_law_rough"] / cut["true_whole"]
    numbers = scales(added / total, cut["area"] / cut["shortest"] ** 2, cut["x"], rough)
    return cut.assign(one=1.0, **numbers).merge(gaps(name, true), on="number", how="left")


def gaps(name, true):
    """Gap between the rough body and the smooth one, less the mean gap of a plane, over the rms height."""
    found = []
    for contact in candidates(name):
        if contact.number > true.index.max():
            break
        if contact.number in true.index and contact.scene.motion.pressed_by == "load":
            own, smooth = true.loc[contact.number], SmoothContact.of(contact.scene).depth
            gap = (smooth - own["depth"]) / own["rms_height"] - mean_gap(contact.x)
            found.append({"number": contact.number, "gap": gap})
    return DataFrame(found)


def interval(quantity, body, least, most, logs):
    """Half an interval of 95 % of one more number with a mean of zero, like these, in a range of p/p_rms."""
    known = np.asarray(logs.dropna())
    half = student.ppf(0.975, known.size) * np.sqrt(np.mean(np.square(known)) * (1 + 1 / known.size))
    return dict(quantity=quantity, body=body, least=least, most=most, contacts=known.size, half=half)


def likeliest(learned):
    """Coefficients of the logarithm of half an interval of `extended`, of most likelihood."""

    def unlikely(values):
        half = np.exp(learned[NAMES].to_numpy() @ values)
        return -student.logpdf(learned["extended"], FREEDOMS, scale=half / student.ppf(0.975, FREEDOMS)).sum()

    return Series(minimize(unlikely, [-4.0, 1.0, 0.3, 0.3, 1.0]).x, NAMES)


def fitted(learned):
    """The likeliest coefficients, widened until all cuts hold of 95 % of the contacts, each left out in turn."""
    missed = []
    for _, own in learned.groupby(CONTACT):
        half = np.exp(own[NAMES] @ likeliest(learned.drop(own.index)))
        missed.append((own["extended"].abs() / half).max())
    found = likeliest(learned)
    found["one"] += np.log(np.quantile(missed, 0.95))
    return found


def outside(learned):
    """Rows of compare/trustmap/outside.csv."""
    alone = learned.drop_duplicates(CONTACT)
    for stratum, (least, most) in STRATA.items():
        yield interval("friction", "body", least, most, alone.loc[alone["stratum"] == stratum, "bare"])
    yield interval("depth", "body", STRATA["lightest"][0], STRATA["nearly full"][1], alone["gap"])
    found = planes()
    found["off"] = off(found, [*coefficients().values()])
    for (least, most), _ in RANGES:
        own = found["x"].between(least, most) & (found["plane"] % HELD_OUT == 0)
        yield interval("friction", "plane", least, most, found.loc[own, "off"])


def rows_of(tested, values, alone):
    """Errors and coverage by stratum, of contacts that nothing was fitted to."""
    half = np.exp(tested[NAMES] @ values)
    tested = tested.assign(held=np.abs(tested["extended"]) <= half, half=half)
    bare = alone[alone["quantity"] + alone["body"] == "frictionbody"].set_index("least")["half"]
    for stratum in [*STRATA, "all"]:
        own = tested if stratum == "all" else tested[tested["stratum"] == stratum]
        first = own.drop_duplicates("number")
        widest = first["stratum"].map({key: bare[least] for key, (least, _) in STRATA.items()})
        cells = [errors_of(first["bare"]), share_of(np.abs(first["bare"]) <= widest)]
        cells += [errors_of(own.loc[own["factor"] == factor, "extended"]) for factor in CUTS[:3]]
        half = f"{100 * np.expm1(own['half'].median()):.2g} %"
        yield stratum, str(len(first)), *cells, half, share_of(own["held"])


def main():
    if sys.argv[1:]:
        return solve(sys.argv[2])
    *learned, tested = map(errors, SETS)
    learned = pandas.concat(learned, ignore_index=True)
    values, alone = fitted(learned), DataFrame(outside(learned))
    # Those in use have learned from all contacts; those before, from contacts that they are not tested on.
    used = fitted(pandas.concat([learned, tested], ignore_index=True))
    DataFrame(used.items(), columns=["times", "value"]).to_csv(UNCERTAINTY, index=False, float_format="%.4g")
    alone.to_csv(TESTED, index=False, float_format="%.4g")
    heading = "p/p_rms|contacts|law alone|held|cut at 2|at 4|at 8 times|± (95 %)|held"
    fill(RESULTS / "law.md", {"extended": table(heading, rows_of(tested, values, alone))})


if __name__ == "__main__":
    main()
