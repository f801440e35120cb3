"""Every kind of number that a page shows, each defined once: term, unit, formula, source."""

from dataclasses import dataclass

THEORY, PAPER = "theory, Eq. ", "Popov et al. 2014, Eq. "


@dataclass(frozen=True)
class Term:
    """One kind of number.

    id : of the anchor, which stays as it is while names change
    name : as people call it
    unit : SI, "1" of a ratio, empty of what is no number or has several
    text : definition, with the sign where there is one
    formula : in symbols, empty where words say it
    source : the equation it comes from, in docs/theory.md or in the paper
    columns : names of the columns of tables that hold it
    numbers : how the names of the numbers of a judgement that are it begin
    """

    id: str
    name: str
    unit: str
    text: str
    formula: str = ""
    source: str = ""
    columns: tuple[str, ...] = ()
    numbers: tuple[str, ...] = ()

    @property
    def anchor(self) -> str:
        """On a page."""
        return f"def-{self.id}"


# fmt: off
JUDGED = (
    Term("friction-ratio-slow", "1D / 3D friction of the smooth body, slow", "1",
         "Friction coefficient in one dimension over that in three, of the smooth body at the load or depth "
         "of the scene and the least speed solved. It tends to 2 as the speed tends to zero.",
         "μ_1D / μ_3D → 2 as v τ / a → 0", f"{THEORY}8", numbers=("1D / 3D friction of the smooth body",)),
    Term("friction-ratio-own", "1D / 3D friction at the scene's own point", "1",
         "Friction coefficient in one dimension over that in three, means over profiles and over surfaces, at"
         " the load or depth and the speed of the scene.",
         "⟨μ_1D⟩ / ⟨μ_3D⟩", f"{THEORY}2", numbers=("1D / 3D friction at the scene's own point",)),
    Term("force-deviation-smooth", "force at the same depth, smooth: deviation", "1",
         "Normal force in one dimension over that in three at the same depth, less one, of the smooth body at"
         " rest, at the depth where it is largest. Positive where one dimension carries more.",
         "F_1D(d) / F_3D(d) − 1", f"{THEORY}6", numbers=("force at the same depth, 1D over 3D, smooth",)),
    Term("force-deviation-rough", "force at the same depth, rough: deviation", "1",
         "Normal force in one dimension over that in three at the same depth, less one, of the rough body at "
         "rest, means over profiles and over surfaces, at the depth where it is most significant.",
         "⟨F_1D(d)⟩ / ⟨F_3D(d)⟩ − 1", f"{THEORY}6", numbers=("force at the same depth, 1D over 3D, rough",)),
    Term("misfit-predicted", "misfit of the curves shifted as Eq. 23 predicts", "1",
         "Root mean square by which points miss one common curve of ln μ against ln F_N, once the curve of "
         "each speed is shifted along ln F_N by ln p(v).",
         "rms [ln μ − ln Q(F_N p(v))], p ~ v^(−β (n+1)/n)", f"{PAPER}23",
         numbers=("misfit of the curves shifted",)),
    Term("collapse", "collapse by horizontal shifts", "1",
         "Misfit of the curves shifted as predicted, and at best: with the shifts that bring them closest "
         "while neighbours overlap. The exponent is that of exp(shift) as a power of the speed.",
         "min over b_v of rms [ln μ − ln Q(ln F_N + b_v)]", f"{PAPER}23", ("log_shift",),
         ("collapse by horizontal shifts",)),
    Term("pixel-halved", "change of the 3D answer with the pixel halved", "1",
         "Relative change of the answer in three dimensions from the grid of the scene to one with twice the "
         "points a side, on the same surface: an estimate of the error of discretisation, no bound.",
         "|y(Δ) / y(Δ/2) − 1|", numbers=("change of the 3D",)),
    Term("friction-spread", "spread of the two estimates of 3D friction", "1",
         "Friction by traction less friction by energy lost, over the friction force, mean over surfaces.",
         "|F_traction − F_loss| / |F_x|", f"{THEORY}5d", ("friction_spread",), ("spread of the two estimates",)),
)
POINTS = (
    Term("curve", "curve", "",
         "What a point belongs to: own, the scene as it stands; force-depth; speed and load, of friction; "
         "smooth, the smooth body from slow to fast; coarse and refined, one surface on two grids.",
         columns=("kind",)),
    Term("solver", "solver", "",
         "MDR, 1D: the method of dimensionality reduction. BEM, 3D: boundary elements on a half-space. exact:"
         " a closed form.",
         columns=("solver", "dimension")),
    Term("body", "body", "", "Rough, or smooth: the same body without its roughness.",
         columns=("smooth", "body")),
    Term("speed", "speed", "m/s",
         "At which the elastomer flows along +x in the frame of the indenter; of an indentation, its rate.", "v",
         f"{THEORY}1", ("speed",)),
    Term("load", "load", "N", "Prescribed normal force, positive in compression.", "F_N", f"{THEORY}2",
         ("load", "prescribed_load")),
    Term("depth-prescribed", "depth prescribed", "m", "Of the macroscopic tip below the undeformed surface.", "d",
         f"{THEORY}1", ("prescribed_depth",)),
    Term("points", "points", "1", "Of the solver's grid: along the line in 1D, along a side of the square in 3D.",
         columns=("points",)),
    Term("normal-force", "normal force", "N", "Integral of the pressure over the contact, mean over surfaces.",
         "F_N = ∫ p dA", f"{THEORY}2", ("normal_force",)),
    Term("depth", "depth", "m",
         "Of the macroscopic tip below the undeformed surface, mean over surfaces; negative where only "
         "asperities touch.",
         "d", f"{THEORY}1", ("depth_reached", "depth")),
    Term("friction-force", "friction force", "N",
         "Force that opposes sliding, mean over surfaces: energy lost in the elastomer per length slid.",
         "F_x = −∫ p ∂z/∂x dA", f"{THEORY}2", ("friction_force",)),
    Term("friction-coefficient", "friction coefficient", "1",
         "Friction force over normal force, mean over surfaces.", "μ = F_x / F_N", f"{THEORY}2",
         ("friction_coefficient",)),
    Term("rms-slope", "rms slope", "1",
         "Of the roughness: in 1D by finite differences on the grid, in 3D of the full gradient, from the "
         "spectrum.",
         "h′ = ⟨|∇h|²⟩^½", columns=("rms_slope",)),
    Term("pixel", "pixel", "m", "Distance of neighbouring points of the grid, mean over surfaces.", "Δ",
         columns=("pixel",)),
    Term("points-across", "points across the contact", "1",
         "Width of the contact over the pixel, mean over surfaces.", columns=("points_across_contact",)),
    Term("residual", "residual", "1",
         "What is left of the conditions of contact, relative to the depth; the worst of the surfaces.", "",
         f"{THEORY}1", ("residual",)),
    Term("seconds", "seconds", "s",
         "Processor time of all solves behind a point or a case, those of earlier runs included.",
         columns=("seconds", "processor_seconds")),
    Term("failures", "failures", "1", "Solves that ended with an error and are left out of the means.",
         columns=("failures",)),
    Term("surfaces", "surfaces", "1",
         "Drawn from one spectrum, over which a mean is taken: profiles in 1D, surfaces in 3D; a smooth body "
         "has one.",
         columns=("surfaces", "asked_surfaces")),
    Term("standard-error", "standard error", "",
         "Of a mean over surfaces: their standard deviation over the root of their number; not known of fewer"
         " than two.",
         "s / √n"),
    Term("contact", "real contact", "",
         "Where pressure is not zero: a length [m] in 1D, an area [m²] in 3D, two different quantities.",
         columns=("contact",)),
    Term("depth-over-height", "d / h₀", "1",
         "Depth of the smooth relaxed contact over the rms height of the roughness.", "d / h₀",
         columns=("depth_over_height",)),
    Term("height-over-depth", "h₀ / d", "1", "rms height of the roughness over the depth of the contact.",
         "h₀ / d", columns=("height_over_depth",)),
    Term("shortest-in-contact", "a q_s", "1",
         "Radius of the smooth relaxed contact times the highest wave number of the roughness.", "a q_s",
         columns=("shortest_in_contact",)),
    Term("pressure-over-slope", "p / (E* h′)", "1",
         "Mean pressure over modulus times rms slope; far above 1 the contact is full in 3D.",
         "F_N / (π a² E* h′)", columns=("pressure_over_slope",)),
    Term("memory-over-contact", "v τ / a", "1",
         "Length slid in the mean lag τ of the solid over the radius of the contact.", "v τ / a",
         columns=("memory_over_contact",)),
    Term("memory-over-shortest", "v τ q_s", "1", "Length slid in the mean lag τ times the highest wave number.",
         "v τ q_s", columns=("memory_over_shortest",)),
    Term("contact-fraction", "real over nominal contact", "1",
         "Nominal is the smooth relaxed contact: its area in 3D, its width in 1D.",
         columns=("contact_fraction",)),
    Term("contact-over-period", "2a / L", "1", "Width of the smooth relaxed contact over the longest wave.",
         "2 a / L", columns=("contact_over_period",)),
    Term("macro-over-rough", "macroscopic over rough slope", "1",
         "rms slope of the macroscopic profile over the contact, over that of the roughness.", "r",
         columns=("macro_over_rough",)),
)
VERDICTS = (
    Term("claimed", "claimed", "",
         "The number that the paper states or implies, ± how far from it still counts as it.",
         columns=("expected", "tolerance")),
    Term("found", "found", "",
         "The number measured, with its interval of 95 % in brackets: from the scatter of surfaces, in "
         "studies wider at both ends by the error of the grid.",
         columns=("value", "low", "high")),
    Term("scatter", "scatter", "",
         "Interval of 95 % from the scatter of surfaces alone, by leaving out one surface, or a group of "
         "them, at all points at once.",
         columns=("statistical_low", "statistical_high")),
    Term("grid-error", "error of the grid", "",
         "Change of the number from half the points a side to all, on the same surfaces.",
         columns=("grid_error",)),
    Term("verdict", "verdict", "",
         "holds: the whole interval lies within the tolerance around the number claimed; fails: none of it "
         "does; undecided: else, or where an error is unknown.",
         columns=("verdict",)),
    Term("effect", "effect", "1", "How far the number found is from that claimed, in tolerances.",
         "(value − expected) / tolerance", columns=("effect",)),
    Term("xi", "ξ", "1", "The one variable of the law; friction over its plateau in the limit of low speed.",
         "ξ = (v τ s / √2) (8 G₀ / F_N)^(n/(n+1)) ((n+1) / (c n))^(1/(n+1))", f"{PAPER}18", ("xi",)),
    Term("mu-tilde", "μ̃", "1", "Friction over that of the plateau, s the rms slope of the roughness.",
         "μ̃ = μ / (√2 s)", f"{PAPER}14", ("normalised_friction",)),
    Term("alpha", "α", "1", "Exponent of the law that joins low speed and plateau.", "μ̃ = (1 + ξ^−α)^(−1/α)",
         f"{PAPER}19", ("alpha",)),
)
COSTS = (
    Term("relative-error", "relative error", "1",
         "Of a quantity against a closed form, or against a far finer solution whose own error is stated.",
         "|y / y_true − 1|", columns=("relative_error",)),
    Term("reference-error", "error of the reference", "1",
         "Relative; what is at or below it is only known to be as good as that.", columns=("reference_error",)),
    Term("processor-time", "processor time of a solve", "s",
         "Of one thread, from the scene to the result: the least of several repeats, each alone in a process "
         "that has loaded compiled code.",
         columns=("processor",)),
    Term("wall", "time on the wall", "s", "Of a solve, by the clock.", columns=("wall",)),
    Term("memory", "memory", "bytes", "By how much a solve raises the peak of its process.", columns=("memory",)),
    Term("applications", "applications", "1", "Of the operator, in equivalents of the finest grid.",
         columns=("applications",)),
    Term("order", "order", "1", "Power of the setting with which the error falls.", columns=("order",)),
)
STABILITY = (
    Term("check-found", "found by the check", "",
         "The number of the check that came nearest to its bound; of a refusal, what the message says.",
         columns=("found",)),
    Term("check-allowed", "allowed by the law", "",
         "What it must not exceed; the law says where that comes from.", columns=("allowed",)),
    Term("check-verdict", "held, refused, broken", "",
         "held: no check exceeds its bound; refused as it should: what cannot be answered is refused by name;"
         " BROKEN: a check exceeds its bound, or the case raised."),
)
# fmt: on

TERMS = {term.id: term for term in (*JUDGED, *POINTS, *VERDICTS, *COSTS, *STABILITY)}
