"""Solids with far too much stiffness, too many modes, modes that coincide, and tables that are not clean."""

from dataclasses import replace
from itertools import product

import numpy as np

from compare.exact import foundation, mean_lag, slow_friction_1d
from scene import (
    Elastic,
    Fractional,
    Kelvin,
    KelvinChain,
    Prony,
    Slide,
    SolveError,
    StandardLinearSolid,
    Table,
    Tabulated,
)
from scene.scales import elastic_contact

from .conditions import conditions
from .hardcase import Check, Group, alike, deviation, energy_is_lost, invalid, refusal
from .ordinary import CONE, DEPTH, MODULUS, PACE, RADIUS, SPHERE, TIME, TOLERANCE, dense, line, resting, sliding

MANY = Prony(
    equilibrium_modulus=MODULUS,
    moduli=tuple(MODULUS * 10.0 ** (k % 5 - 2) for k in range(30)),
    relaxation_times=tuple(float(t) for t in np.geomspace(1e-12, 1e3, 30)),
)
CASES = case = Group("rheology")


def _same(size, name, one, other, allowed):
    for pace, solver in product((0.1, 10.0), (line(size), dense(size))):
        found, known = (solver.solve(sliding(pace, solid)) for solid in (one, other))
        yield from alike(f"{solver.name}, {name}", found, known, allowed)


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


@case(
    "Glassy over rubbery modulus 1e6 and 1e12: a wake of up to 1e12 relaxation times, a force of as much.",
    "Closed forms of the foundation for sphere and cone, within 20/N of the grid.",
)
def glass_over_rubber_1e6_1d(size):
    for ratio in (1e6, 1e12):
        solid = StandardLinearSolid(MODULUS, ratio * MODULUS, TIME)
        for shape, pace in product((SPHERE, CONE), (1e-6, 1e-3, 1.0, 100.0)):
            depth = shape.mdr_coefficient * RADIUS**shape.exponent
            motion = Slide(speed=pace * PACE, depth=depth)
            found = line(size).solve(resting(indenter=shape, elastomer=solid, motion=motion))
            known = foundation.sliding_forces(shape, solid, motion.speed, depth)
            what = f"{type(shape).__name__}, {ratio:g}, v tau/a = {pace:g}"
            yield deviation(f"{what}: force", found.normal_force, known[0], 20 / size.line)
            yield deviation(f"{what}: friction", found.friction_force, known[1], 20 / size.line)


@case(
    "The same in three dimensions: a memory of 1e6 contacts for a share of compliance of all but 1e-6.",
    "Conditions of contact, computed anew, within twice the tolerance.",
)
def glass_over_rubber_1e6_3d(size):
    solid = StandardLinearSolid(MODULUS, 1e6 * MODULUS, TIME)
    for pace in (1e-9, 1e-3, 1.0, 1e9):
        yield from conditions(dense(size).solve(sliding(pace, solid)), 2 * TOLERANCE, f"v tau/a = {pace:g}")


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
    # Of the difference of two moduli six digits are left.
    yield deviation("1D: friction at low speed", found.friction_force, known, 1e-3)
    still = dense(size).solve(resting(elastomer=Elastic(MODULUS)))
    moving = dense(size).solve(sliding(1.0, solid))
    yield deviation("3D: force against elastic", moving.normal_force, still.normal_force, 3 * TOLERANCE)
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
        answer = line(size).solve(resting(elastomer=MANY, motion=Slide(speed=speed, depth=DEPTH)))
        yield energy_is_lost(f"1D, {speed:g} m/s: ", answer, 1e-8)
        small = Slide(speed=speed, depth=DEPTH)
        space = dense(size, points=16).solve(resting(elastomer=MANY, motion=small))
        yield from conditions(space, 2 * TOLERANCE, f"3D, {speed:g} m/s")


@case(
    "Five modes of one and the same relaxation time.",
    "Forces and friction of the solid with their sum, to 1e-12, rounding.",
)
def equal_times(size):
    split = Prony(MODULUS, (1e6, 2e6, 3e6, 2e6, 1e6), (TIME,) * 5)
    return _same(size, "five equal", split, StandardLinearSolid(MODULUS, MODULUS + 9e6, TIME), 1e-12)


@case(
    "Modes whose times differ by 1e-15, 1e-12 and 1e-8 of themselves, in relaxation and in retardation.",
    "Forces and friction of the solid with one mode to ten times that difference and 1e-9, contact's tolerance.",
)
def nearly_equal_times(size):
    for apart in (1e-15, 1e-12, 1e-8):
        times = tuple(TIME * (1 + k * apart) for k in range(5))
        split = Prony(MODULUS, (1e6, 2e6, 3e6, 2e6, 1e6), times)
        merged = StandardLinearSolid(MODULUS, MODULUS + 9e6, times[2])
        yield from _same(size, f"{apart:g} apart", split, merged, 10 * apart + 1e-9)
        chain = KelvinChain(1e-7, (1e-7, 2e-7, 1e-7), times[:3])
        one = KelvinChain(1e-7, (4e-7,), times[1:2])
        yield from _same(size, f"chain, {apart:g} apart", chain, one, 10 * apart + 1e-9)


@case("Thirty modes, shuffled.", "Forces and friction are the same to the last bit.")
def modes_in_any_order(size):
    shuffled = np.random.default_rng(1).permutation(30)
    other = replace(
        MANY,
        moduli=tuple(MANY.moduli[k] for k in shuffled),
        relaxation_times=tuple(MANY.relaxation_times[k] for k in shuffled),
    )
    return _same(replace(size, dense=16), "shuffled", MANY, other, 0.0)


@case(
    "Modes of 1e-30 and of 1e-150 Pa beside one of 1e7 Pa.",
    "Forces and friction as without them, to 1e-6: contact is solved to 1e-7.",
)
def all_but_absent_modes(size):
    one = StandardLinearSolid(MODULUS, MODULUS + 9e6, TIME)
    for modulus in (1e-30, 1e-150):
        haunted = Prony(MODULUS, (9e6, modulus, modulus), (TIME, 1e-9, 1e9))
        yield from _same(size, f"modes of {modulus:g} Pa", haunted, one, 1e-6)


@case(
    "A chain of Kelvin elements without instantaneous compliance, one of them all but rigid.",
    "Forces and friction of the Kelvin body, to 1e-6: contact is solved to 1e-7.",
)
def chain_without_glass(size):
    chain = KelvinChain(0.0, (1 / MODULUS, 1e-300), (TIME, TIME / 3))
    return _same(size, "no instantaneous compliance", chain, Kelvin(MODULUS, TIME), 1e-6)


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
    for ratio in (-0.999999, 0.0, 0.5):
        solid = Elastic(MODULUS, poisson_ratio=ratio)
        for solver in (line(size), dense(size)):
            force = solver.solve(resting(elastomer=solid)).normal_force
            known = solver.solve(resting()).normal_force * 0.5 / (1 - ratio)
            yield deviation(f"{solver.name}, Poisson's ratio {ratio:g}: force", force, known, 3 * TOLERANCE)
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
    yield from _same(size, "shuffled table", shuffled, clean, 0.0)


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


@case("Moduli whose quotients leave the range of numbers.", "Refused: the error asks for the units.")
def moduli_300_decades_apart(size):
    for solid in (StandardLinearSolid(1e-300, 1e300, TIME), Prony(1e-200, (1e200,), (TIME,))):
        for solver in (line(size), dense(size)):
            yield refusal(
                f"{solver.name}: {solid}", SolveError, "units | moduli", solver.solve, sliding(1.0, solid)
            )
