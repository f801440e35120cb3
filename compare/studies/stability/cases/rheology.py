"""Solids with far too much stiffness, too many modes, modes that coincide, and tables that are not clean."""

from functools import partial

import numpy as np

from scene import (
    Elastic,
    Fractional,
    KelvinChain,
    Prony,
    Slide,
    StandardLinearSolid,
    Table,
    Tabulated,
)
from scene.scales import elastic_contact

from ....models.exact import mean_lag, slow_friction_1d
from .conditions import conditions
from .hardcase import Check, Group, deviation, invalid
from .laws import FORCES, asked, energy_is_lost, equal, in_contact, on_a_foundation, refused
from .ordinary import DEPTH, KELVIN, MODULUS, PACE, SPHERE, TIME, at_paces, resting, sliding
from .solvers import TOLERANCE, dense, line

MANY = Prony(
    equilibrium_modulus=MODULUS,
    moduli=tuple(MODULUS * 10.0 ** (k % 5 - 2) for k in range(30)),
    relaxation_times=tuple(float(t) for t in np.geomspace(1e-12, 1e3, 30)),
)
CASES = case = Group("rheology")


FIVE = (1e6, 2e6, 3e6, 2e6, 1e6)  # moduli [Pa] of modes
ONE_MODE = StandardLinearSolid(MODULUS, MODULUS + sum(FIVE), TIME)


def _same(solids, allowed, in_3d=dense):
    """Pairs of solids, by name, have the same forces in a flow."""
    rows = {
        f"{name}, v tau/a = {pace:g}": (sliding(pace, one), sliding(pace, other))
        for name, (one, other) in solids.items()
        for pace in (0.1, 10.0)
    }
    return equal(rows, allowed, line, in_3d, of=FORCES)


def _measured():
    omega = np.geomspace(1e-2, 1e4, 25)
    modulus = Prony(MODULUS, (1e6, 2e6, 5e5), (1.0, 1e-2, 1e-3)).complex_modulus(omega)
    return omega, modulus.real, modulus.imag


def _tabulated(omega, storage, loss, **settings):
    columns = zip(("frequency", "storage", "loss"), (omega, storage, loss), strict=True)
    table = Table(**{name: tuple(float(value) for value in column) for name, column in columns})
    return Tabulated(table=table, frequency_unit="rad/s", kind="shear", **settings)


def _apart(one, other):
    omega = np.geomspace(1e-1, 1e3, 50)
    known = other.complex_modulus(omega)
    return np.max(np.abs(one.complex_modulus(omega) - known) / np.abs(known))


case.add(
    "glass-over-rubber-1e6-1d",
    "Glassy over rubbery modulus 1e6 and 1e12: a wake of up to 1e12 relaxation times, a force of as much.",
    "Closed forms of the foundation for sphere and cone, within 20/N of the grid.",
    on_a_foundation(
        {f"{ratio:g}": StandardLinearSolid(MODULUS, ratio * MODULUS, TIME) for ratio in (1e6, 1e12)},
        (1e-6, 1e-3, 1.0, 100.0),
    ),
)
case.add(
    "glass-over-rubber-1e6-3d",
    "The same in three dimensions: a memory of 1e6 contacts for a share of compliance of all but 1e-6.",
    "Conditions of contact, computed anew, within twice the tolerance.",
    in_contact(at_paces(1e-9, 1e-3, 1.0, 1e9, elastomer=StandardLinearSolid(MODULUS, 1e6 * MODULUS, TIME))),
)


@case(
    "The glassy modulus exceeds the rubbery one by 1e-10: friction comes from the last six digits.",
    "Friction of the limit of low speed to 1e-3 in 1D; force of the elastic body within the tolerance and "
    "friction below 1e-9 of it in 3D.",
)
def barely_relaxing(size):
    solid = StandardLinearSolid(MODULUS, MODULUS * (1 + 1e-10), TIME)
    found = line(size).solve(sliding(1e-4, solid))
    static, lag = elastic_contact(resting(elastomer=solid)), mean_lag(solid)
    shape = SPHERE.mdr_coefficient, SPHERE.exponent
    known = slow_friction_1d(1e-4 * PACE, static.radius, lag, solid.indentation_modulus, *shape)
    # The difference of two moduli keeps six digits.
    yield deviation("1D: friction at low speed", found.friction_force, known, 1e-3)
    yield from equal((sliding(1.0, solid), resting()), 3 * TOLERANCE, dense)(size)
    moving = dense(size).solve(sliding(1.0, solid))
    yield Check("3D: friction coefficient", abs(moving.friction_coefficient), 1e-9)


@case(
    "Thirty Maxwell modes from 1e-12 to 1e3 s, of moduli four decades apart.",
    "Modulus times compliance is 1 to 1e-12; friction by traction is the energy lost to 1e-8 in 1D; "
    "conditions of contact in 3D, computed anew.",
)
def thirty_modes_over_fifteen_decades(size):
    omega = np.geomspace(1e-6, 1e15, 400)
    storage = MANY.complex_modulus(omega)
    instantaneous, compliances, times = MANY.retardation()
    creep = instantaneous + (1 / (1 + 1j * omega[:, None] * times)) @ compliances
    yield Check("modulus times compliance, less 1", np.abs(storage * creep - 1).max(), 1e-12)
    for speed in (1e-9, 1.0, 1e9):
        scene = resting(elastomer=MANY, motion=Slide(speed=speed, depth=DEPTH))
        yield energy_is_lost(f"1D, {speed:g} m/s: ", line(size).solve(scene), 1e-8)
        yield from conditions(dense(size, points=16).solve(scene), 2 * TOLERANCE, f"3D, {speed:g} m/s")


case.add(
    "equal-times",
    "Five modes of one and the same relaxation time.",
    "Forces and friction of the solid with their sum, to 1e-12, rounding.",
    _same({"equal": (Prony(MODULUS, FIVE, (TIME,) * 5), ONE_MODE)}, 1e-12),
)


@case(
    "Modes whose times differ by 1e-15, 1e-12 and 1e-8 of themselves, in relaxation and in retardation.",
    "Forces and friction of the solid with one mode to ten times that difference and 1e-9, contact's tolerance.",
)
def nearly_equal_times(size):
    for apart in (1e-15, 1e-12, 1e-8):
        times = tuple(TIME * (1 + k * apart) for k in range(5))
        merged = StandardLinearSolid(MODULUS, MODULUS + sum(FIVE), times[2])
        chain, one = KelvinChain(1e-7, (1e-7, 2e-7, 1e-7), times[:3]), KelvinChain(1e-7, (4e-7,), times[1:2])
        solids = {"Prony": (Prony(MODULUS, FIVE, times), merged), "chain": (chain, one)}
        yield from _same(solids, 10 * apart + 1e-9)(size)


MODES = np.array((MANY.moduli, MANY.relaxation_times))[:, np.random.default_rng(1).permutation(30)]
SHUFFLED = Prony(MODULUS, tuple(MODES[0].tolist()), tuple(MODES[1].tolist()))
case.add(
    "modes-in-any-order",
    "Thirty modes, shuffled.",
    "Forces and friction are the same to the last bit.",
    _same({"shuffled": (MANY, SHUFFLED)}, 0.0, partial(dense, points=16)),
)
HAUNTED = {f"{faint:g} Pa": Prony(MODULUS, (9e6, faint, faint), (TIME, 1e-9, 1e9)) for faint in (1e-30, 1e-150)}
case.add(
    "all-but-absent-modes",
    "Modes of 1e-30 and of 1e-150 Pa beside one of 1e7 Pa.",
    "Forces and friction as without them, to 1e-6: contact is solved to 1e-7.",
    _same({what: (solid, ONE_MODE) for what, solid in HAUNTED.items()}, 1e-6),
)
case.add(
    "chain-without-glass",
    "A chain of Kelvin elements without instantaneous compliance, one of them all but rigid.",
    "Forces and friction of the Kelvin body, to 1e-6: contact is solved to 1e-7.",
    _same({"chain": (KelvinChain(0.0, (1 / MODULUS, 1e-300), (TIME, TIME / 3)), KELVIN)}, 1e-6),
)


@case(
    "A power law over thirty decades, and exponents next to 0 and to 1.",
    "The series keeps its stated tolerance; friction by traction is the energy lost to 1e-8.",
)
def fractional_at_its_ends(size):
    for exponent, decades in ((0.5, 30), (1e-3, 6), (0.999, 6)):
        solid = Fractional(
            modulus=MODULUS,
            relaxation_time=TIME,
            exponent=exponent,
            lowest_frequency=10.0 ** (-decades / 2),
            highest_frequency=10.0 ** (decades / 2),
        )
        yield Check(f"exponent {exponent:g}, {decades} decades: error of the series", solid.error, solid.tolerance)
        answer = line(size).solve(resting(elastomer=solid, motion=Slide(speed=1.0, depth=DEPTH)))
        yield energy_is_lost(f"exponent {exponent:g}: ", answer, 1e-8)


@case(
    "Poisson's ratio next to -1, and at 1/2.",
    "Force in proportion to 1/(1 - nu) within the tolerance of contact; -1 and more than 1/2 are refused by name.",
)
def poissons_ratio_at_its_ends(size):
    solids = {f"Poisson's ratio {ratio:g}": Elastic(MODULUS, ratio) for ratio in (-0.999999, 0.0, 0.5)}
    for what, solver, solid in asked(size, solids, (line, dense)):
        force = solver.solve(resting(elastomer=solid)).normal_force
        known = solver.solve(resting()).normal_force * 0.5 / (1 - solid.poisson_ratio)
        yield deviation(f"{what}: force", force, known, 3 * TOLERANCE)
    for ratio in (-1.0, 0.5000001):
        words = f"poisson_ratio | {ratio:g}"
        yield invalid(f"Poisson's ratio {ratio:g}", words, Elastic, MODULUS, poisson_ratio=ratio)


@case(
    "Rows of a table in any order, and each of them twice.",
    "Shuffled the same solid to the last bit, with every row twice to 1e-6, of the fit.",
)
def table_unsorted_and_doubled(size):
    rows = np.array(_measured())
    clean = _tabulated(*rows)
    shuffled = _tabulated(*rows[:, np.random.default_rng(4).permutation(25)])
    yield Check("modulus of the shuffled table", _apart(shuffled, clean), 0.0)
    twice = _tabulated(*np.concatenate([rows, rows], axis=1))
    yield Check("modulus with every row twice", _apart(twice, clean), 1e-6)
    yield from _same({"shuffled table": (shuffled, clean)}, 0.0)(size)


@case(
    "A scatter of 5 %, after which G' falls between some rows.",
    "The misfit is at most 1.5 times the scatter, and the modulus within 15 %, three of its standard "
    "deviations, of that without it.",
)
def table_with_noise(size):
    omega, storage, loss = _measured()
    noise = 1 + 0.05 * np.random.default_rng(6).standard_normal((2, 25))
    noisy = _tabulated(omega, storage * noise[0], loss * noise[1])
    yield Check("rms misfit over the scatter", noisy.rms_error / 0.05, 1.5)
    yield Check("modulus against that without noise", _apart(noisy, _tabulated(omega, storage, loss)), 0.15)
    answer = line(size).solve(sliding(1.0, noisy))
    yield energy_is_lost("", answer, 1e-8)


@case(
    "Tables that fall, belong to no passive solid, are too short, or hold zeros and NaN.",
    "Refused: each error names the column or the table, and what is allowed.",
)
def tables_of_no_solid(size):
    omega, storage, loss = _measured()
    scattered = storage * np.exp(np.random.default_rng(8).standard_normal(25))
    few, hole = (omega[:3], storage[:3], loss[:3]), np.append(storage[1:], np.nan)
    once, none = ([1.0] * 10, [1e6] * 10, [1e5] * 10), np.append(loss[1:], 0.0)
    falls, units, noise = (
        f"Table | tolerance = 0.1 | {why}" for why in ("does not fall", "check units", "scatter")
    )
    yield invalid("G' that falls", falls, _tabulated, omega, storage[::-1], loss)
    yield invalid("G'' of another solid", units, _tabulated, omega, storage, 1e3 * loss)
    yield invalid("noise of a factor 3", noise, _tabulated, omega, scattered, loss)
    yield invalid("three frequencies", "3 frequencies | at least 4", _tabulated, *few)
    yield invalid("one frequency ten times", "1 frequencies | at least 4", _tabulated, *once)
    yield invalid("a loss of zero", "loss | greater than 0", _tabulated, omega, storage, none)
    yield invalid("NaN in a row", "storage | finite number", _tabulated, omega, hole, loss)
    yield invalid("columns of unlike length", "25, 24, 25 | equally many", _tabulated, omega, storage[1:], loss)


@case("A Maxwell fluid has no modulus at rest.", "Refused: the error names equilibrium_modulus.")
def table_of_a_fluid(size):
    omega = np.geomspace(1e-2, 1e2, 20)
    maxwell = 1e6 * 1j * omega / (1 + 1j * omega)
    words = "modulus at rest | equilibrium_modulus"
    yield invalid("a Maxwell fluid", words, _tabulated, omega, maxwell.real, maxwell.imag)


DECADES_APART = StandardLinearSolid(1e-300, 1e300, TIME), Prony(1e-200, (1e200,), (TIME,))
case.add(
    "moduli-300-decades-apart",
    "Moduli whose quotients leave the range of numbers.",
    "Refused: the error asks for the units.",
    refused("units | moduli", {f"{solid}": sliding(1.0, solid) for solid in DECADES_APART}, line, dense),
)
