"""Friction of surfaces far finer than a grid: contacts solved with every wave, and without their finest ones.

python docs/measure/extended.py solve learned|more|further|again|anew|earlier|tested   solves the contacts that
docs/results/extended-SET.csv does not have yet, one by one, and adds the rows of each
python docs/measure/extended.py   fits the correction of the law and the intervals to all sets but the last, into
compare/models/law/extended.csv and outside.csv, and writes how they do on the last into docs/results/law.md

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
from compare.models.law.extended import FITTED, LEARNED, numbers_of_cut, numbers_of_law, octaves, under, without
from compare.models.law.nominal import mean_gap
from compare.models.law.parts import TESTED, LawParts, coefficients
from compare.solving.task import draws_of
from scene import Prony, Refused, Scene, SelfAffine, Slide, SolveError, Spectrum, Table, Tabulated
from scene.scales import elastic_contact

SETS = "learned", "more", "further", "again", "anew", "earlier", "tested"
FIRST, APART, EACH = 62_100, 100, 24  # seed of the first set, and from set to set; contacts of a stratum in one
# Surfaces of a contact of a stratum, solved in pairs with and without the finest waves: the error is that of their
# means. One elsewhere: with many waves in contact, one surface is like another.
SURFACES = {"lightest": 4, "light": 2}
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
# Numbers of the law that its correction is linear in.
CORRECTION = "one", "harder", "faster", "shorter", "spread", "unbounded", "glassy"
STEPS = 5  # octaves below the deepest cut
FOLDS = 20  # of the contacts, each left out once
FREEDOMS = 4  # of Student's distribution of errors
LEAST_CUT = 96  # points a side of the coarsest grid
NEARLY = 0.8  # share of the points to the shortest wave that suffices
TRUE = 0.01  # greatest grid error of what counts as true


# A rough scene of a set, its stratum, x = p/p_rms with all waves, and which of its surfaces it has.
Contact = namedtuple("Contact", "set number stratum x surface scene")


def named(contact):
    """Columns of a contact in its table."""
    return dict(zip(Contact._fields[:-1], contact, strict=False))


def candidates(name):
    """Contacts of the strata, without end."""
    seed = FIRST + APART * SETS.index(name)
    draw = np.random.default_rng(seed)
    for number in count(1):
        scene = drawn(draw, 1000 * number + seed)
        try:
            x = LawParts.of(scene).x
        except (SolveError, Refused):
            continue
        stratum = next((key for key, (low, high) in STRATA.items() if low <= x < high), None)
        if stratum and scene.roughness.rms_height < elastic_contact(scene).depth:
            yield Contact(name, number, stratum, x, 0, scene)


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
    """Numbers of one solve."""
    scene = contact.scene if factor == 1 else without(contact.scene, shortest)
    numbers = named(contact) | {"factor": factor, "points": points, "shortest": shortest}
    try:
        found = BEM(points=points).solve(scene)
    except (SolveError, Refused) as error:
        return numbers | {"reason": str(error)}
    return numbers | {
        "extent": found.settings["extent"],
        "load": found.normal_force,
        "friction": found.friction_coefficient,
        "depth": found.depth,
        "error": found.measures["friction_error"],
        "pixels": found.measures["points_per_shortest_wave"],
        "area": found.measures["contact_area"],
        "rms_height": scene.roughness.rms_height,
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
    if not (whole.get("friction", 0.0) > 0 and whole["error"] <= TRUE):
        return [whole | {"reason": whole.get("reason", f"grid error {whole.get('error', inf):.2g}")}]
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
    wanted = dict.fromkeys(STRATA, EACH)
    for contact in candidates(name):
        if not any(wanted.values()):
            break
        if not wanted[contact.stratum]:
            continue
        if contact.number not in done:
            found = solved(contact)
            surfaces = SURFACES.get(contact.stratum, 1) if len(found) > 1 else 1
            for surface, scene in enumerate(draws_of(contact.scene, surfaces)[1:], 1):
                found += solved(contact._replace(surface=surface, scene=scene))
            rows += found
            DataFrame(rows).to_csv(path, index=False)
            done[contact.number] = found[0]
            print(*contact[:3], len(found), "solves", flush=True)
        wanted[contact.stratum] -= pandas.isna(done[contact.number].get("reason"))


def errors(name):
    """Each cut of the contacts of a set, with what its answer is found from."""
    rows = read_csv(RESULTS / f"extended-{name}.csv")
    rows, found = rows[rows["reason"].isna()], []
    for contact in candidates(name):
        if contact.number > rows["number"].max():
            return pandas.concat(found, ignore_index=True)
        own = rows[rows["number"] == contact.number].groupby(["factor", "set", "stratum"])
        own = own.mean(numeric_only=True)[own.size() == own.size().max()].reset_index(["set", "stratum"])
        if len(own) > 1:
            found.append(cuts_of(contact, own.loc[1], own.loc[2:]))


def cuts_of(contact, true, cuts):
    """Cuts of a contact: the steps of the law below each, errors of the law alone, and numbers of the interval.

    steps : (STEPS, 1 + numbers) for each cut, what the law adds and the numbers of its correction, zeros if none
    gap : between the rough body and the smooth one, over that of a plane, in rms heights
    """
    scene, taken = contact.scene, np.log2(cuts.index).astype(int)
    parts = octaves(under(scene, true["load"]), cuts["shortest"].max())
    whole, waves = parts[-1], cuts["area"] / cuts["shortest"] ** 2
    more = np.diff([each.friction_coefficient for each in parts])
    numbers = [[*numbers_of_law(each, scene.solid).values()] for each in parts[1:]]
    steps, gap = np.column_stack([more, numbers]), np.nan
    if scene.motion.pressed_by == "load":
        gap = (whole.contact.depth - true["depth"]) / true["rms_height"] - mean_gap(contact.x)
    of_cut = [numbers_of_cut(parts[-1 - each], whole, own) for each, own in zip(taken, waves, strict=True)]
    cuts = cuts.assign(
        true=true["friction"],
        bare=np.log(whole.friction_coefficient / true["friction"]),
        gap=gap,
        steps=[np.pad(steps[-each:], ((STEPS - each, 0), (0, 0))) for each in taken],
    )
    return cuts.join(DataFrame(of_cut, cuts.index).add_prefix("half_")).reset_index()


def interval(quantity, body, least, most, logs):
    """Half an interval of 95 % of one more number with a mean of zero, like these, in a range of p/p_rms."""
    known = np.asarray(logs.dropna())
    half = student.ppf(0.975, known.size) * np.sqrt(np.mean(np.square(known)) * (1 + 1 / known.size))
    return dict(quantity=quantity, body=body, least=least, most=most, contacts=known.size, half=half)


def off_by(cuts, values):
    """Logarithm of answer over truth of each cut."""
    steps = np.stack(cuts["steps"])
    excess = np.clip(steps[..., 1:] @ values.filter(like="excess_").to_numpy(), *LEARNED)
    added = np.sum(steps[..., 0] * np.exp(-excess), axis=1)
    return np.log((cuts["friction"] + np.maximum(added, 0)) / cuts["true"])


def half_of(cuts, values):
    """Half the interval of the logarithm of friction of each cut."""
    chosen = values.filter(like="half_")
    return np.exp(cuts[chosen.index] @ chosen)


def likeliest(learned, start):
    """Coefficients of the correction and of the logarithm of half the interval, of most likelihood together."""

    def unlikely(values):
        values = Series(values, start.index)
        scale = half_of(learned, values) / student.ppf(0.975, FREEDOMS)
        return -student.logpdf(off_by(learned, values), FREEDOMS, scale=scale).sum()

    return Series(minimize(unlikely, start).x, start.index)


def fitted(learned):
    """The likeliest coefficients, widened until all cuts hold of 95 % of the contacts left out in turn."""
    half = [name for name in learned if name.startswith("half_")]
    start = Series(0.0, [*(f"excess_{name}" for name in CORRECTION), *half])
    found, missed = likeliest(learned, start), []
    for _, own in learned.groupby(learned["number"] % FOLDS):
        values = likeliest(learned.drop(own.index), found)
        over = off_by(own, values).abs() / half_of(own, values)
        missed += [*over.groupby([own[name] for name in CONTACT]).max()]
    found["half_one"] += np.log(np.quantile(missed, 0.95))
    return found


def outside(learned):
    """Rows of compare/models/law/outside.csv."""
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
    apart, half = off_by(tested, values), half_of(tested, values)
    widest = tested["stratum"].map(dict(zip(STRATA, alone["half"], strict=False)))
    bare_held = tested["bare"].abs() <= widest
    tested = tested.assign(off=apart, half=half, held=apart.abs() <= half, bare_held=bare_held)
    for stratum in [*STRATA, "all"]:
        own = tested if stratum == "all" else tested[tested["stratum"] == stratum]
        first = own.drop_duplicates("number")
        width = f"{100 * np.expm1(own['half'].median()):.2g} %"
        bare = errors_of(first["bare"]), share_of(first["bare_held"])
        yield stratum, str(len(first)), *bare, errors_of(own["off"]), width, share_of(own["held"])


def main():
    if sys.argv[1:]:
        return solve(sys.argv[2])
    *learned, tested = map(errors, SETS)
    learned = pandas.concat(learned, ignore_index=True)
    values, alone = fitted(learned), DataFrame(outside(learned))
    rows = [(*name.split("_"), value) for name, value in values.items()]
    DataFrame(rows, columns=["to", "times", "value"]).to_csv(FITTED, index=False, float_format="%.4g")
    alone.to_csv(TESTED, index=False, float_format="%.4g")
    heading = "p/p_rms|contacts|law alone|held|extended|± (95 %)|held"
    fill(RESULTS / "law.md", {"extended": table(heading, rows_of(tested, values, alone))})


if __name__ == "__main__":
    main()
