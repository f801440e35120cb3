"""Vocabulary of every number and every field of a solver: its unit, its axes, and one sentence with the sign."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import reduce


@dataclass(frozen=True)
class Entry:
    """Meaning of a word of a Result.

    unit : SI, "1" of pure numbers and counts, as UDUNITS spells it
    text : one sentence, with sign and convention
    axes : of a field, the words along whose values it lies, slowest first, in 1D less y; empty of a number
    along_line : unit under a Cylinder, where what is extensive is counted per length of the line
    """

    unit: str
    text: str
    axes: tuple[str, ...] = ()
    along_line: str | None = None

    def unit_under(self, indenter: str) -> str:
        """Unit under an indenter of a type as a scene file names it."""
        return self.along_line or self.unit if indenter == "cylinder" else self.unit

    @property
    def unit_in_words(self) -> str:
        """Unit as people write it: m² for m^2."""
        return reduce(lambda unit, power: unit.replace(*power), (("^2", "²"), ("^3", "³"), ("^4", "⁴")), self.unit)

    def attributes(self, name: str, indenter: str = "") -> dict[str, str]:
        """Attributes of a variable of this name by the CF conventions, none of them empty."""
        axis = name.upper() if self.axes == (name,) and name in ("x", "y") else ""
        found = {"units": self.unit_under(indenter), "long_name": name.replace("_", " "), "axis": axis}
        return {word: text for word, text in {**found, "comment": self.text}.items() if text}


def _force(text, axes=()):
    return Entry("N", text, axes, along_line="N/m")


def _energy(text, axes=()):
    return Entry("J", text, axes, along_line="J/m")


def _area(text, axes=()):
    return Entry("m^2", text, axes, along_line="m")


STEPS, LINE, PLANE, INSTANTS = ("time",), ("x",), ("y", "x"), ("frame_time",)

# Numbers that every result has.
NUMBERS: Mapping[str, Entry] = {
    "normal_force": _force("Normal force that presses the indenter, above zero into the elastomer."),
    "depth": Entry(
        "m", "Depth of the macroscopic tip below the undeformed surface, above zero into the elastomer."
    ),
    "friction_force": _force(
        "Tangential force on the indenter, above zero where it opposes motion forwards, which is along -x."
    ),
    "friction_coefficient": Entry("1", "Friction force over normal force."),
    "residual": Entry("1", "Residual of the discrete conditions of contact, relative, as the solver defines it."),
    "operator_applications": Entry("1", "Operator applications of the solve, in equivalents of the finest grid."),
    "seconds": Entry("s", "Processor time of the solve."),
}

# Numbers that some results have, as the scene calls for them.
MEASURES: Mapping[str, Entry] = {
    "average_heating": Entry(
        "K", "Rise in temperature, averaged over the smooth contact, if its friction heats the elastomer alone."
    ),
    "bare_friction": Entry("1", "Coefficient of friction of the law, before the trust map corrects it."),
    "contact_area": _area("Area of real contact: pixels under pressure."),
    "contact_fraction": Entry(
        "1",
        "Share in real contact: in 1D of the span from first to last contact, of a plane of its cell, in a theory "
        "of the smooth contact.",
    ),
    "contact_length": Entry("m", "Length of real contact along the profile."),
    "contact_over_period": Entry("1", "Width of the smooth relaxed contact over the longest wavelength, 2a / L."),
    "contact_points": Entry("1", "Points of the grid under pressure."),
    "curvature_by_pressure": Entry(
        "1/m",
        "Mean of d2z/dx2 of indenter and roughness weighted with the pressure, above zero at a minimum of z.",
    ),
    "flash_heating": Entry("K", "Rise in temperature, averaged over the contact of an asperity."),
    "friction_by_curvature": _force("Friction to first order in the speed, of the pressure's mean curvature."),
    "friction_by_loss": _force("Friction as energy lost per length slid, by the slope of the displacement."),
    "friction_by_traction": _force(
        "Friction as pressure times the slope of the indenter, summed over the contact."
    ),
    "friction_by_work": _force("Friction as the work done on the surface, from pixel to pixel, per length slid."),
    "friction_disagreement": Entry(
        "1", "Difference of estimates of friction over the normal force: an indicator of its error, no bound."
    ),
    "friction_error": Entry(
        "1",
        "Bound of 95 % on the relative error of friction by the grid: against the same model and surface on ever "
        "finer grids. Absent without friction.",
    ),
    "friction_high": Entry("1", "Upper end of the interval of 95 % of the coefficient of friction."),
    "friction_in_elastomer": _force("Part of the friction that the elastomer dissipates."),
    "friction_in_interface": _force("Part of the tangential force that shear of the interface carries."),
    "friction_low": Entry("1", "Lower end of the interval of 95 % of the coefficient of friction."),
    "friction_of_roughness": _force("Part of the friction that the roughness adds to the smooth body."),
    "friction_of_shape": _force("Part of the friction that the smooth body has."),
    "full_contact_friction": _force(
        "Friction that the roughness would have in full contact all over a nominal one."
    ),
    "heating_solves": Entry("1", "Contacts that were solved to find the temperature at which heat is balanced."),
    "height_over_depth": Entry("1", "Rms height of the roughness over the depth of the smooth relaxed contact."),
    "law_ratio": Entry("1", "Friction of the law over friction in three dimensions, by the trust map."),
    "load_on_leading_flanks": Entry("1", "Share of the load where the profile falls along +x."),
    "macro_over_rough": Entry(
        "1", "Rms slope of the smooth profile over its contact, divided by the rms slope of the roughness."
    ),
    "mean_gap": Entry("m", "Mean distance of plane and deformed surface over the cell, never below zero."),
    "mean_pressure": Entry("Pa", "Normal force over the area of the cell."),
    "nominal_radius": Entry(
        "m", "Radius of a disc as wide as the pressure of a rough body, its spots smeared out."
    ),
    "one_sidedness": Entry("1", "Share of the real contact where the profile falls along +x."),
    "outside": Entry("1", "Whether the scene is off the trust map, 1 where it is: the law then has no interval."),
    "pixel": Entry("m", "Spacing of the grid on which the contact was solved."),
    "points_across_contact": Entry("1", "Pixels from the first contact to the last, on the longer side."),
    "points_per_shortest_wave": Entry("1", "Pixels on the shortest wavelength of the roughness."),
    "pressure_ratio": Entry("1", "Mean pressure over the rms pressure of the roughness in full contact."),
    "rms_height": Entry("m", "Rms height of the roughness over its period."),
    "rms_slope": Entry(
        "1", "Rms slope of the roughness over its period: in 1D of finite differences, in 3D of the full gradient."
    ),
    "rms_slope_contact": Entry(
        "1", "Rms slope over the real contact: in 1D of the profile, in 3D of indenter and roughness along x."
    ),
    "spot_radius": Entry("m", "Radius of a disc with the area over rim of the real contact: of spots their size."),
    "rms_slope_spectral": Entry("1", "Rms slope of the rough line over its period, from its spectrum."),
    "rounds": Entry("1", "Rounds in which the set of points in contact was sought."),
    "share_of_full_contact": Entry(
        "1", "Share of its friction in full contact that roughness keeps under the mean nominal pressure."
    ),
    "slip_area": _area("Area of real contact that slips."),
    "slip_length": Entry("m", "Length of real contact that slips."),
    "stick_area": _area("Area of real contact that sticks."),
    "stick_length": Entry("m", "Length of real contact that sticks."),
    "stiffness": Entry("N/m", "Change of the normal force with depth, in a sudden step."),
    "tangential_applications": Entry(
        "1", "Operator applications of the tangential problem, in equivalents of the finest grid."
    ),
    "tangential_displacement": Entry("m", "By which the indenter is drawn along -x after it was pressed in."),
    "tangential_residual": Entry("1", "Residual of the conditions of stick and slip, relative."),
    "tangential_rounds": Entry("1", "Rounds in which the set of points that slip was sought."),
    "temperature": Entry("K", "Absolute temperature of the elastomer at which heat is balanced."),
    "time_steps": Entry("1", "Steps in time of a program."),
    "transform_pairs": Entry(
        "1", "Transforms there and back, those of the preconditioner too, in equivalents of the finest grid."
    ),
}

# On the grid of the solver, or along the steps of a program.
FIELDS: Mapping[str, Entry] = {
    "contact": Entry("1", "Whether the profile touches at a node.", LINE),
    "contact_area": _area("Area of real contact at each step.", STEPS),
    "contact_length": Entry("m", "Length of real contact at the end of each step.", STEPS),
    "depth": Entry("m", "Depth of the macroscopic tip at each step, above zero into the elastomer.", STEPS),
    "displacement": Entry("m", "Displacement of the surface, above zero into the elastomer.", LINE),
    "dissipated": _energy("Energy dissipated since the beginning, at the end of each step.", STEPS),
    "frame_contact": Entry("1", "Whether an element touches, at instants.", (*INSTANTS, *LINE)),
    "frame_depth": Entry("m", "Depth of the macroscopic tip at instants, NaN where nothing presses.", INSTANTS),
    "frame_displacement": Entry(
        "m", "Displacement of the surface at instants, above zero into the elastomer.", (*INSTANTS, *PLANE)
    ),
    "frame_pressure": Entry("Pa", "Normal pressure at instants, never below zero.", (*INSTANTS, *PLANE)),
    "frame_profile": Entry("m", "Height of the mapped profile at instants.", (*INSTANTS, *LINE)),
    "frame_shift": Entry("m", "How far downstream of x and y the points of the grid are at instants.", INSTANTS),
    "frame_time": Entry(
        "s", "Instants at which the contact is kept, from the beginning of the program.", INSTANTS
    ),
    "frame_x": Entry("m", "Place of each element at instants, as x.", (*INSTANTS, *LINE)),
    "friction_by_work": _force("Friction at each step as the work done on the surface per length slid.", STEPS),
    "friction_force": _force(
        "Friction at each step, by traction, above zero where it opposes motion forwards.", STEPS
    ),
    "gap": Entry("m", "Distance of indenter and deformed surface, zero in contact.", PLANE),
    "height": Entry(
        "m", "Height of indenter and roughness above the macroscopic tip, away from the elastomer.", PLANE
    ),
    "line_force": Entry("N/m", "Normal force per length, mean from each node to the next.", LINE),
    "normal_force": _force("Normal force at each step, above zero into the elastomer.", STEPS),
    "path": Entry("m", "How far forwards the indenter is from where it began, at each step.", STEPS),
    "pressure": Entry("Pa", "Normal pressure on the elastomer, never below zero.", PLANE),
    "profile": Entry(
        "m", "Height of the mapped profile above its macroscopic tip, away from the elastomer.", LINE
    ),
    "slip": Entry("m", "Slip of the elastomer past the indenter along +x, zero outside the contact.", LINE),
    "slip_x": Entry("m", "Slip of the elastomer past the indenter along +x, zero outside the contact.", PLANE),
    "slip_y": Entry("m", "Slip of the elastomer past the indenter along +y, zero outside the contact.", PLANE),
    "speed": Entry("m/s", "Speed of the indenter in each step, below zero backwards.", STEPS),
    "stored": _energy("Elastic energy stored at the end of each step.", STEPS),
    "surface_displacement": Entry(
        "m", "Displacement of the surface at the end of a program, above zero into the elastomer.", PLANE
    ),
    "tangential_line_force": Entry("N/m", "Tangential force per length, mean from each node to the next.", LINE),
    "time": Entry("s", "Time at each step, from the beginning of the program.", STEPS),
    "traction_x": Entry("Pa", "Shear traction on the indenter along +x.", PLANE),
    "traction_y": Entry("Pa", "Shear traction on the indenter along +y.", PLANE),
    "work": _energy("Work of the indenter since the beginning, at the end of each step.", STEPS),
    "x": Entry(
        "m",
        "Place along the line of sliding, counted against motion forwards.",
        LINE,
    ),
    "y": Entry("m", "Place across the line of sliding.", ("y",)),
}
