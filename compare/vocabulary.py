"""Vocabulary of the judge: unit and definition of every variable of a Dataset and every column of a table."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from scene import Scene
from scene.vocabulary import FIELDS, MEASURES, NUMBERS, Entry

THEORY, PAPER = "theory, Eq. ", "Popov et al. 2014, Eq. "


@dataclass(frozen=True)
class Term(Entry):
    """Entry with its formula in symbols, and the equation of docs/theory.md or of the paper that it comes from."""

    formula: str = ""
    source: str = ""


# Of Datasets: coordinates, and what scene.vocabulary has under another name.
LABELS: Mapping[str, Entry] = {
    "grid": Entry(
        "", "Which grid of the solver: fine, as the settings say, or coarse, with half the points a side."
    ),
    "points": Entry("1", "Points of the grid along a side."),
    "speed": Entry("m/s", "Speed of sliding that was prescribed, or rate of pressing in; 0 is rest."),
    "load": Entry("N", "Normal force that was prescribed.", along_line="N/m"),
    "depth": Entry("m", "Depth that was prescribed, above zero into the elastomer."),
    "draw": Entry("1", "Seed of the rough surface."),
    "depth_reached": NUMBERS["depth"],
    "status": Entry("", "Whether a contact was solved, has no contact, failed, or was not asked for."),
    "reason": Entry("", "Why a solve failed; empty where it did not."),
    # Of hard cases and of stored quantities.
    "check": Entry("", "What is measured of a hard case and must not exceed its bound."),
    "found": Entry("1", "Number of a check; of a refusal, how many of the words it must say are missing."),
    "allowed": Entry("1", "Bound of a check, from the law of the case."),
    "message": Entry("", "Error that came of what must be refused; in brackets what came instead of one."),
    "quantity": Entry("", "Name of a ratio of two answers to one question."),
    "side": Entry("", "Which of the two answers: numerator or denominator of the ratio."),
    "measured": Entry("", "Number of one answer that a ratio is made of, in its SI unit."),
    "stored": Entry("1", "Ratio as the baseline has it."),
    # Of findings.
    "claim": Entry("", "Name of the claim, which never changes."),
    "sentence": Entry("", "What is claimed."),
    "meaning": Entry("", "How the number is measured, and what a deviation from it says."),
    "where": Entry("", "Case, series or diagram in which it was measured."),
    "dimension": Entry(
        "",
        "1D: method of dimensionality reduction. 3D: boundary elements on a half-space. 1D/3D: their ratio.",
    ),
    "verdict": Entry(
        "",
        "holds: the whole interval of 95 % lies within the tolerance around the number; fails: none of it "
        "does; undecided: else, or where an error is unknown; reported: a number without a claim. Of a law or a "
        "stored value the verdict is whether the number is within its bound.",
    ),
    "value": Entry(
        "",
        "Number measured, in brackets its interval of 95 %: scatter of surfaces, wider at both ends by the error "
        "of the grid.",
    ),
    "low": Entry("", "Lower end of the interval of 95 %: scatter of surfaces, widened by the error of the grid."),
    "high": Entry("", "Upper end of the interval of 95 %: scatter of surfaces, widened by the error of the grid."),
    "unit": Entry("", "Unit of the number; 1 of a ratio."),
    "expected": Entry("", "Number that is claimed."),
    "tolerance": Entry("", "How far from the number claimed still counts as it."),
    "scatter_low": Entry(
        "",
        "Lower end of the interval of 95 % from the scatter of surfaces alone, by leaving out some at a time.",
    ),
    "scatter_high": Entry(
        "",
        "Upper end of the interval of 95 % from the scatter of surfaces alone, by leaving out some at a time.",
    ),
    "grid_error": Entry("", "Error of discretisation, by which the interval is wider at both ends."),
    "grid_method": Entry(
        "", "How the error of the grid is known: change on halving the points, extrapolated, exact, or unknown."
    ),
    "draws": Entry("1", "Number of rough surfaces behind a number; 0 of smooth bodies."),
    "regime": Entry("", "Range of the dimensionless groups in which a number was measured."),
    "plot": Entry("", "Figure that shows it."),
    # Of points, and of curves through them.
    "solver": Entry(
        "", "MDR: the method of dimensionality reduction, 1D. BEM: boundary elements, 3D. exact: closed form."
    ),
    "body": Entry("", "Rough, or smooth: the same body without its roughness."),
    "curve": Entry("", "Curve that a point belongs to."),
    "friction": Term(
        "1",
        "Coefficient of friction: mean friction force over mean normal force.",
        formula="μ = F_x / F_N",
        source=f"{THEORY}2",
    ),
    "friction_coefficient": Entry("1", "Coefficient of friction: mean friction force over mean normal force."),
    "force": Entry("N", "Mean normal force.", along_line="N/m"),
    # Of what accuracy costs: laws of cost, forecasts, surfaces on several grids, and what an error asks for.
    "kind": Entry("", "What is forecast: a held-out cost, or the largest grid that fits."),
    "what": Entry("", "What is forecast, in words."),
    "held": Entry("", "Whether a forecast held: the cost found lies in its interval."),
    "cost": Entry("", "Cost that a law describes: time, memory or operator applications."),
    "variable": Entry("", "Column of the table of steps that holds the cost."),
    "overhead": Entry("", "Part of the cost that does not grow, in its unit."),
    "centre": Entry("1", "Points at which the factor of the law is the cost above its overhead."),
    "scatter": Entry("1", "Relative scatter: of costs about their law, or of one surface about the mean."),
    "lowest": Entry("1", "Fewest points that the law was fitted to."),
    "highest": Entry("1", "Most points that the law was fitted to."),
    "least": Entry("", "Least cost of a ladder without a law, in its unit."),
    "most": Entry("", "Greatest cost of a ladder without a law, in its unit; of an interval, its upper end."),
    "at_most": Entry("1", "Points at which the cost of a ladder without a law is greatest."),
    "along": Entry("", "Setting that grows from step to step."),
    "bytes_a_point": Entry("B", "Memory over the points of the grid."),
    "seconds_an_application": Entry("s", "Processor time over operator applications."),
    "over_limit": Entry("1", "Processor time over that of the Fourier products alone."),
    "stored_bytes": Entry("B", "Size of the file that holds the answer."),
    "wanted": Entry("1", "Relative error that is wanted."),
    "model": Entry("", "Dimensionality that reaches the error in the least time."),
    "settings": Entry("", "Settings that reach the error."),
    "best_known": Entry("1", "Least relative error that was reached."),
    "floor": Entry("1", "Relative error that is left however fine the settings are."),
    "converges": Entry("", "Whether the error falls without end as settings become finer."),
    "truth": Entry("", "Best estimate of the true answer, in its unit."),
    "scale": Entry("", "Number that errors are relative to, in the unit of the answer."),
    "truth_standard_error": Entry("1", "Standard error of the best estimate over surfaces, relative."),
    "truth_freedom": Entry("1", "Degrees of freedom of that standard error."),
    "truth_grid_error": Entry("1", "Error of discretisation of the best estimate, relative."),
    "plan": Entry("", "Sampling plan: points a side, or two grids of which the coarser has most surfaces."),
    "coarser_points": Entry("1", "Points a side of the coarser of two grids; 0 without one."),
    "bias": Entry("1", "Relative error that more surfaces do not take away."),
    "scatter_freedom": Entry("1", "Degrees of freedom of the scatter."),
    "failed": Entry("1", "Solves that ended with an error."),
    "first_surfaces": Entry("1", "Surfaces on the coarser grid of a plan."),
    "cheapest": Entry("", "Whether the plan reaches the error in the least time of all."),
    "reached": Entry("m", "Mean depth that was reached, above zero into the elastomer."),
    "surfaces": Entry("1", "Number of surfaces over which a mean is taken: profiles in 1D, surfaces in 3D."),
    "failures": Entry("1", "Solves that ended with an error and are left out of the means."),
    "contact": Entry("", "Real contact, where pressure is not zero: a length [m] in 1D, an area [m²] in 3D."),
    "friction_spread": Term(
        "1",
        "Friction by traction less friction by energy lost, over the friction force, mean over surfaces.",
        formula="|F_traction − F_loss| / |F_x|",
        source=f"{THEORY}5d",
    ),
    "log_shift": Term(
        "1", "Shift of a curve along ln F_N that brings it onto the common curve.", source=f"{PAPER}23"
    ),
    "log_lift": Entry("1", "Shift of a curve along ln mu, beside that along ln F_N, onto the common curve."),
    "shifted_force": Entry("N", "Normal force times the shift of its curve."),
    "curves": Entry("", "Set of curves that are shifted onto one."),
    "power": Entry("", "Power of the speed: fitted to the shifts, expected, or that of a law."),
    "exponent": Entry("1", "Exponent of a power of the speed."),
    "misfit": Entry("1", "Rms of ln mu about one curve, without what scatter adds."),
    "decided": Entry(
        "", "Whether the shifts mean anything: not where curves do not collapse, nor where they part."
    ),
    "shifted_as": Entry("", "Whether a figure shows curves shifted as fitted, or as expected."),
    "reference_speed": Entry("m/s", "Speed whose curve is not shifted."),
    "degree": Entry("1", "Degree of the common polynomial."),
    "holds": Entry("", "Whether every condition of the laws holds at a point."),
    # Of measured maps.
    "q": Entry("rad/m", "Wave number; of a ring, the mean of its waves."),
    "density_2d": Entry("m⁴", "Two-sided spectral density C_2D, mean over directions."),
    "density_1d": Entry("m³", "Two-sided spectral density C_1D of the line scans along x, mean over the rows."),
    "density_1d_mapped": Term("m³", "Spectral density by the rule of the MDR.", formula="C_1D = π q C_2D"),
    "waves": Entry("1", "Waves of a map in a ring of wave numbers, a wave and its opposite counted as one."),
    "in_band": Entry("", "Whether a wave number lies in the band in which the power law was fitted."),
    "ratio": Entry("1", "Number in one dimension over that in three."),
    "deviation": Entry("1", "Number in one dimension over that in three, less one."),
    "v_tau_over_a": Entry("1", "Speed times retardation time over the radius of the smooth relaxed contact."),
    "friction_over_slope": Entry("1", "Friction over the slope of the body at the edge of the contact."),
    "friction_over_slope_low_speed": Entry(
        "1", "Friction over the slope of the body at the edge of the contact, to first order in the speed."
    ),
    "eq_19": Entry("1", "Coefficient of friction of Eq. 19 at the same load and speed, in one dimension."),
    "indenter": Entry("m", "Height of the rigid indenter above the undeformed surface."),
    "surface": Entry("m", "Height of the surface of the elastomer above the undeformed one."),
    "touching": Entry("", "Whether indenter and elastomer touch."),
    # Of series of contacts, and of the figures of a study.
    "off_curve": Entry("1", "ln of friction less that of the common curve at the shifted force."),
    "rms": Entry("1", "rms of ln of friction about the common curve, with scatter of surfaces."),
    "points_left_out": Entry(
        "1", "Points that were not fitted, as fewer than half of the surfaces have an answer."
    ),
    "surfaces_left_out": Entry("1", "Surfaces that were not fitted, as a solve failed at some point that is."),
    "theory": Term("1", "ln of the shift p(v) that the loss at the shortest wave predicts.", source=f"{PAPER}22"),
    "rough": Entry("", "Depth [m] under the load, or force [N] at the depth, of the rough body at rest."),
    "closed_form": Entry("", "Depth [m] or force [N] of the smooth body in closed form."),
    "rough_deviation": Entry(
        "1", "rough less closed_form: of depths over the rms height, of forces over closed_form."
    ),
    "smooth_deviation": Entry(
        "1", "smooth less closed_form: of depths over the rms height, of forces over closed_form."
    ),
    "difference": Entry("1", "1D less 3D: of depths over the closed form, of forces over that in 3D."),
    "rough_difference": Entry("1", "Force on the rough body in 1D over that in 3D, less one."),
    "smooth_difference": Entry("1", "Force on the smooth body in 1D over that in 3D, less one."),
    "stiffness": Entry("N/m", "Difference of forces over difference of depths, between neighbouring contacts."),
    "rate": Entry("m/s", "Rate of pressing in."),
    "smooth_normal_force": Entry("N", "Normal force on the body without its roughness."),
    "low_speed": Entry(
        "1", "Friction of the rough body in the exact limit of low speed, from its contact at rest."
    ),
    "smooth_low_speed": Entry("1", "Friction of the smooth body in the exact limit of low speed."),
    "friction_1d_over_3d": Entry("1", "Coefficient of friction in 1D over that in 3D."),
    "friction_over_plateau": Term(
        "1", "Friction over that of the plateau.", formula="μ / (√2 s)", source=f"{PAPER}14"
    ),
    "contact_fraction": Entry("1", "Real over nominal contact: of the area π a² in 3D, of the length 2a in 1D."),
    "contact_over_period": Entry("1", "Diameter of the smooth relaxed contact over the period of the roughness."),
    "fails": Entry("1", "Number of findings that fail."),
    "undecided": Entry("1", "Number of findings that are undecided."),
    "series": Entry("", "Title of the series."),
    "shape": Entry("", "Shape of the bodies."),
    # Dimensionless groups.
    "depth_over_height": Term(
        "1", "Depth of the smooth relaxed contact over the rms height of the roughness.", formula="d / h₀"
    ),
    "shortest_in_contact": Term(
        "1",
        "Radius of the smooth relaxed contact times the highest wave number of the roughness.",
        formula="a q_s",
    ),
    "pressure_over_slope": Term(
        "1",
        "Mean pressure over modulus times rms slope; far above 1 the contact is full in 3D.",
        formula="F_N / (π a² E* h′)",
    ),
    "memory_over_contact": Term(
        "1", "Length slid in the mean lag τ of the solid over the radius of the contact.", formula="v τ / a"
    ),
    "memory_over_shortest": Term(
        "1", "Length slid in the mean lag τ times the highest wave number.", formula="v τ q_s"
    ),
    "xi": Term(
        "1",
        "Variable of the law; friction over its plateau in the limit of low speed.",
        formula="ξ = (v τ s / √2) (8 G₀ / F_N)^(n/(n+1)) ((n+1) / (c n))^(1/(n+1))",
        source=f"{PAPER}18",
    ),
    "normalised_friction": Term(
        "1",
        "Friction over that of the plateau, s the rms slope of the roughness.",
        formula="μ̃ = μ / (√2 s)",
        source=f"{PAPER}14",
    ),
    "alpha": Term(
        "1",
        "Exponent of the law that joins low speed and plateau.",
        formula="μ̃ = (1 + ξ^−α)^(−1/α)",
        source=f"{PAPER}19",
    ),
    # Of cost and accuracy.
    "relative_error": Term(
        "1",
        "Error of a quantity against a closed form, or against a far finer solution whose own error is stated.",
        formula="|y / y_true − 1|",
    ),
    "reference_error": Entry(
        "1", "Relative error of the reference; what is at or below it is only known to be as good as that."
    ),
    "processor": Entry(
        "s",
        "Processor time of one thread from the scene to the result: the least of several repeats, each alone in a "
        "process that has loaded compiled code.",
    ),
    "wall": Entry("s", "Least time of repeated solves by the clock."),
    "memory": Entry("B", "By how much a solve raises the peak memory of its process."),
    "order": Entry("1", "Power of the setting with which the error falls."),
    "change": Entry("1", "Relative change of a quantity from half the points to all."),
    "padded_product": Entry("s", "Least processor time of one product in Fourier space, padded with zeros."),
    "plain_product": Entry("s", "Least processor time of one product in Fourier space."),
    "promised_seconds": Entry("s", "Processor time that was expected of the settings chosen."),
    "promised_error": Entry("1", "Relative error that was expected of the settings chosen."),
    "repeats": Entry("1", "How often the solve was repeated."),
    # Of the paper.
    "contact_span": Entry("m", "Distance from the first to the last point of real contact."),
    "sweeps": Entry("1", "Sweeps along the profile."),
    "study": Entry("", "Parameter that is varied while all others are held."),
    "step": Entry("1", "Number of the value of the parameter."),
    "parameter": Entry("", "Value of the parameter that is varied, in its SI unit; angles in radians."),
    "hurst": Entry("1", "Hurst exponent of the roughness."),
    "macroscopic_modulus": Term(
        "1", "Modulus on the scale of the contact over the static one.", formula="|G(v/a)|/G₀"
    ),
    "points_fitted": Entry("", "Points that a straight line through the logarithms was fitted to."),
    "slope": Entry("1", "Slope of the line, the exponent of ξ."),
    "factor": Entry("1", "Factor of the power law."),
    "worst": Entry("1", "Largest deviation of μ̃ from ξ, relative."),
    "deviation_from_eq_19": Entry("1", "Deviation of μ̃ from Eq. 19 with α = 1.5, relative."),
    "normalised_friction_of_planes": Entry("1", "μ̃ where every place of the contact is a rough plane."),
    "alpha_of_planes": Entry("1", "Best α where every place of the contact is a rough plane."),
    "farthest_from_best_fit": Entry("1", "Deviation of the farthest point from Eq. 19 with the best α, relative."),
    "plateau": Entry("1", "μ̃ at the greatest ξ over Eq. 19 there."),
    "loss_exponent": Entry("1", "Power β of the frequency with which the loss modulus grows."),
    "relaxation_time": Entry("s", "Time τ of the elastomer."),
    "simulated": Entry("1", "Coefficient of friction, mean over profiles."),
    "smooth": Entry("1", "Coefficient of friction of the smooth body."),
    "shortest_wave": Entry("1", "Coefficient of friction of Eq. 22 with the loss of the shortest wave."),
    "every_wave": Entry(
        "1", "Coefficient of friction of Eq. 22 with the loss of every wave at its own frequency."
    ),
    "every_wave_and_smooth_body": Entry(
        "1", "Friction of Eq. 22 with the loss of every wave and of the smooth body."
    ),
    "smooth_half_width": Entry("m", "Half of the width of the smooth contact at rest."),
    "smooth_depth": Entry("m", "Depth of the smooth contact at rest."),
    "conditions_broken": Entry("", "Conditions of the laws that break."),
    "rubber": Entry("", "Number of the elastomer in the study of loss moduli."),
    "angle": Entry("rad", "Angle of the side of the cone against the plane."),
    "radius": Entry("m", "Radius of the sphere."),
    "modulus": Entry("Pa", "Static shear modulus of the elastomer."),
    "profiles": Entry("1", "Number of rough profiles over which a mean is taken."),
    "count": Entry("1", "Number of contacts behind a mean."),
    "alpha_by_logarithms": Entry("1", "Best α by deviations of the logarithm of μ̃."),
    "alpha_by_differences": Entry("1", "Best α by deviations of μ̃ itself."),
    "alpha_by_chi_square": Entry("1", "Best α by deviations over the scatter of profiles."),
    "alpha_by_worst_point": Entry("1", "Best α by the deviation of the farthest point."),
    "least_modulus": Entry("1", "Least modulus on the scale of the contact over the static one."),
    "greatest_modulus": Entry("1", "Greatest modulus on the scale of the contact over the static one."),
    "exponent_expected": Entry("1", "Power of the speed in the shift of Eq. 23."),
    "exponent_whole": Entry("1", "Power of the speed in the shifts of the whole friction."),
    "exponent_excess": Entry(
        "1", "Power of the speed in the shifts of the friction beyond that of the smooth body."
    ),
    "exponent_of_shortest_wave": Entry("1", "Power of the speed in the shifts of Eq. 22 with the shortest wave."),
    "exponent_of_every_wave": Entry("1", "Power of the speed in the shifts of Eq. 22 with every wave."),
    "exponent_of_every_wave_and_smooth_body": Entry(
        "1", "Power of the speed in the shifts of Eq. 22 with every wave and the smooth body."
    ),
    "collapse_whole": Entry("1", "Misfit of the curves of the whole friction about one curve."),
    "collapse_excess": Entry("1", "Misfit of the curves of the friction beyond that of the smooth body."),
    # Of studies of claims.
    # Of accuracy and cost.
    "ladder": Entry("", "Settings of one solver, each finer than the one before."),
    "setting": Entry("1", "Number that is refined along the ladder: points, or steps in time."),
    "steps": Entry("1", "Number of settings of a ladder, or of steps in time."),
    "constant": Entry("1", "Factor of the power law of the error."),
    "standard_error": Entry("1", "Standard error of the order."),
    "estimate": Entry("1", "Error that the solver itself expects."),
    "precision": Entry("", "Floating-point numbers of the solve: single or double."),
    "extent": Entry("1", "Side of the grid over the width of the contact."),
    "reference": Entry("", "What errors are measured against."),
}

# Columns that explain themselves.
PLAIN = frozenset(
    ("case", "cases", "group", "broken", "solved", "checks", "outcome", "title", "label", "series", "shape")
)
PREFIXES = ("holds: ", "within ", "must hold", "hard because", "refused as it should", "tolerances moved")

# What an ending adds to the meaning of a name.
ENDINGS = {
    "_low": "Lower end of the interval of 95 %, scatter of surfaces and error of the grid. ",
    "_high": "Upper end of the interval of 95 %, scatter of surfaces and error of the grid. ",
    "_error": "Half of the interval of 95 %, scatter of surfaces and error of the grid. ",
    "_deviation": "Standard deviation of one surface. ",
    "_least": "Lower end of the interval of 95 %. ",
    "_most": "Upper end of the interval of 95 %. ",
    "_1d": "In one dimension (MDR). ",
    "_3d": "In three dimensions (BEM). ",
}


def stem(name: str) -> str:
    """Name that an entry is found under: without its ending where the whole has none."""
    for ending in ENDINGS:
        if name.endswith(ending) and _entry(name) is None:
            return stem(name.removesuffix(ending))
    return name


def entry(name: str) -> Term | None:
    """Entry of a name, of the judge first and then of the solvers; None of a name that explains itself."""
    whose = stem(name)
    found = _entry(whose)
    if found is None or whose == name:
        return found
    said = "".join(text for ending, text in ENDINGS.items() if ending in name.removeprefix(whose))
    return replace(found, text=said + found.text)


def _entry(name):
    found = LABELS.get(name) or NUMBERS.get(name) or MEASURES.get(name) or FIELDS.get(name)
    return Term(**vars(found)) if found else None


def head(name: str) -> str:
    """Name of a column in words, with its unit."""
    found, plain = entry(name), name.replace("_", " ")
    return plain if found is None or found.unit in ("", "1") else f"{plain} [{found.unit.replace('^2', '²')}]"


def attributes(name: str, scene: Scene | None = None) -> dict[str, str]:
    """Attributes of a variable of a Dataset: units, long name and definition."""
    found, plain = entry(name), name.replace("_", " ")
    if found is None:
        return {"long_name": plain}
    indenter = "" if scene is None else scene.indenter.type
    said = {"units": found.unit_under(indenter), "long_name": plain, "comment": found.text}
    return {name: text for name, text in said.items() if text}
