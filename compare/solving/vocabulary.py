"""Vocabulary of the judge: unit and definition of every variable of a Dataset and every column of a table."""

import re
from collections.abc import Mapping
from dataclasses import replace
from inspect import cleandoc

from scene import Scene
from scene.vocabulary import FIELDS, MEASURES, NUMBERS, Entry

# Words of the judge: a line is "name : text [unit]", without a unit that is not there.
_WORDS = """
Of Datasets: coordinates, and what scene.vocabulary has under another name.
level : Which grid of the model: fine, as its settings say, coarse, with half the points a side, or coarser still.
points : Points of the grid along a side. [1]
speed : Speed of sliding that was prescribed, or rate of pressing in; 0 is rest. [m/s]
depth : Depth that was prescribed, above zero into the elastomer. [m]
surface : Seed of the rough surface or profile. [1]
seed : Seed of the rough surface. [1]
stratum : Finest grid on which a rough surface is solved, by its number; the next coarser one has it too. [1]
control_variates : Numbers of the rough surface below the smooth body whose mean over all surfaces is 0. [1]
status : Whether a contact was solved, here or on a finer grid, has no contact, failed, or was not asked for.
reason : Why a solve failed; empty where it did not.

Of solids.
omega : Angular frequency. [rad/s]
storage : Storage modulus G' in shear. [Pa]
loss : Loss modulus G'' in shear. [Pa]
compliance : Creep compliance J(t) in shear. [1/Pa]

Of findings.
claim : Name of the claim, which never changes.
sentence : The claim in words.
meaning : How the number is measured, and what a deviation from it says.
where : Case, series or diagram in which it was measured.
model : 1D: method of dimensionality reduction. 3D: boundary elements on a half-space. 1D/3D: their ratio. 1D
    corrected: over the ratio that the trust map predicts. Other models have their label.
verdict : holds: the whole interval of 95 % lies within the tolerance around the number; fails: none of it does;
    undecided: else, or where an error is unknown; reported: a number without a claim. Of a law or a stored value
    the verdict is whether the number is within its bound.
value : Number measured, in brackets its interval of 95 %: scatter of surfaces, wider at both ends by the error of
    the grid.
low : Lower end of the interval of 95 %: scatter of surfaces, widened by the error of the grid.
high : Upper end of the interval of 95 %: scatter of surfaces, widened by the error of the grid.
unit : Unit of the number; 1 of a ratio.
expected : Number that is tested against.
tolerance : How far from that number still counts as it.
grid : Error of discretisation, by which the interval is wider at both ends.
surfaces : Number of rough surfaces or profiles behind a number or a mean; 0 of smooth bodies. [1]
regime : Range of the dimensionless groups in which a number was measured.

Of the trust map: ratios of 1D over 3D, predicted and measured.
advice : How to treat the 1D answer: use it as it is, multiply it by the inverse of the ratio, or solve in 3D;
    none beyond every linear theory.
surface_low : Lower end of the interval of 95 % of the ratio of the mean in 1D over one surface in 3D; none where
    one surface says nothing. [1]
surface_high : Upper end of the interval of 95 % of the ratio of the mean in 1D over one surface in 3D; none
    where one surface says nothing. [1]

Of points, and of curves through them.
shortest : Shortest wave of the roughness that is kept. [m]
smooth : Coefficient of friction of the smooth body at the same speed and load or depth. [1]
solver : MDR: the method of dimensionality reduction, 1D. CorrectedMDR: that over the ratio of the trust map. BEM:
    boundary elements, 3D. exact: closed form. Another name: a model that did not come with the package.
body : Rough, or smooth: the same body without its roughness.
curve : Curve that a point belongs to.
friction : Coefficient of friction: mean friction force over mean normal force. [1]
friction_coefficient : Coefficient of friction: mean friction force over mean normal force. [1]

Of what accuracy costs.
scatter : Scatter of single surfaces about the mean, relative. [1]
least : Lower end of an interval.
most : Upper end of an interval.
label : Model in words.
settings : Points of the grid, or several grids, as intervals take them.
best_known : Least relative error that is known to be reached. [1]
scale : Number that errors are relative to, in the unit of the answer.
quantity : Friction, depth or force, whose error is measured.
bias : Relative error that more surfaces do not take away. [1]
setup : Processor time of the trust map, before the first surface. [s]
failed : Solves that ended with an error. [1]
failures : Solves that ended with an error and are left out of the means. [1]
drag : Friction over real contact, over that under the least load. [1]
contact_law : Real contact over that under the least load, by the paper. [1]
drag_law : Friction over real contact, likewise. [1]
slope_law : Rms slope of what touches, likewise. [1]
contact : Real contact, where pressure is not zero: a length [m] in 1D, an area [m²] in 3D.
friction_spread : Friction by traction less friction by energy lost, over the friction force, mean over surfaces.
    [1]
log_shift : Shift of a curve along ln F_N that brings it onto the common curve. [1]
log_lift : Shift of a curve along ln mu that, with the shift along ln F_N, brings it onto the common curve. [1]
log_time_shift : Shift ln a_T of a temperature along ln v that brings its friction onto the reference. [1]
reduced_speed : Speed times a_T, the shift of its temperature. [m/s]
shifted_force : Normal force times the shift of its curve. [N]
shifted_friction : Friction coefficient times the shift of its curve along friction. [1]
curves : Set of curves that are shifted onto one.
power : Power of the speed: fitted to the shifts, expected, or predicted by a law.
exponent : Exponent of a power of the speed. [1]
load_exponent : Exponent of the power of the speed by which curves are shifted along the load. [1]
friction_exponent : Exponent of the power of the speed by which curves are shifted along friction. [1]
misfit : Rms of ln mu about one curve, without what scatter adds. [1]
decided : Whether the shifts mean anything: not where curves do not collapse, nor where they part.
shifted_as : Whether a figure shows curves shifted as fitted, or as expected.
holds : Whether every condition of the laws holds at a point.

Of measured maps.
q : Wave number; of a ring, the mean of its waves. [rad/m]
density_2d : Two-sided spectral density C_2D, mean over directions. [m^4]
density_1d : Two-sided spectral density C_1D of the line scans along x, mean over the rows. [m^3]
density_1d_mapped : Spectral density by the rule of the MDR. [m^3]
waves : Waves of a map in a ring of wave numbers, a wave and its opposite counted as one. [1]
in_band : Whether a wave number lies in the band in which the power law was fitted.
ratio : Number in one dimension over the number in three, or over the number of the reference. [1]
kind : Line that is no model: a theory, Eq. 19, the smooth body, or its limit at low speed.
claimed : Whether the law claims a point: where roughness is small against depth.
friction_ratio : Coefficient of friction in one dimension over that in three, as the trust map predicts it. [1]
depth_ratio : Depth in one dimension over that in three, as the trust map predicts it. [1]
force_ratio : Normal force in one dimension over that in three, as the trust map predicts it. [1]
deviation : Friction over the common curve, or a number over the number of the reference, less one. [1]
indenter : Height of the rigid indenter above the undeformed surface. [m]
surface : Height of the surface of the elastomer above the undeformed one. [m]
touching : Whether indenter and elastomer touch.
line_force_1d : Force per length of the springs, mean over a pixel along x. [N/m]
line_force_3d : Pressure integrated over y, mean over a pixel along x. [N/m]

Of series of contacts, and of the figures of a study.
closed_form : Depth [m] or force [N] of the smooth body in closed form.
difference : Model against the reference: of forces their ratio less one [1], of depths their difference [m].
rate : Rate of pressing in. [m/s]
measured_share : Friction that roughness adds, over that in full contact. [1]
contact_fraction : Real over nominal contact: of the area π a² in 3D, of the length 2a in 1D. [1]
contact_over_period : Diameter of the smooth relaxed contact over the period of the roughness. [1]
fails : Number of findings that fail. [1]
undecided : Number of findings that are undecided. [1]
series : Title of the series.
shape : Shape of the bodies.

Dimensionless groups.
xi : Variable of the law; friction over its plateau in the limit of low speed. [1]
normalised_friction : Friction over friction on the plateau, s the rms slope of the roughness. [1]
alpha : Exponent of the law that joins low speed and plateau. [1]

Of cost and accuracy.
reference_error : Relative error of the reference; what is at or below it is only known to be as good as that. [1]
processor : Processor time of a single thread from the scene to the result: the least of several repeats, each
    alone in a process that has loaded compiled code. [s]
wall : Least time of repeated solves by the clock. [s]
memory : By how much a solve raises the peak memory of its process. [byte]
repeats : How often the solve was repeated. [1]

Of the paper.
study : Parameter that is varied while all others are held.
step : Number of the value of the parameter. [1]
parameter : Value of the parameter that is varied, in its SI unit; angles in radians.
hurst : Hurst exponent of the roughness. [1]
slope : Slope of the line, the exponent of ξ. [1]
plateau : μ̃ at the greatest ξ over Eq. 19 there. [1]
loss_exponent : Power β of the frequency with which the loss modulus grows. [1]
relaxation_time : Time τ of the elastomer. [s]
smooth_depth : Depth of the smooth contact at rest. [m]
angle : Angle of the side of the cone against the plane. [rad]
radius : Radius of the sphere. [m]
modulus : Static shear modulus of the elastomer. [Pa]
profiles : Number of rough profiles over which a mean is taken. [1]
count : Number of contacts behind a mean. [1]

Of accuracy and cost.
setting : Number that is refined along the ladder: points, or steps in time. [1]
steps : Number of settings of a ladder, or of steps in time. [1]
extent : Side of the grid over the width of the contact. [1]
reference : Solution that errors are measured against.
"""


def documented(docstring: str | None) -> tuple[str, dict[str, str]]:
    """First paragraph of a docstring, and what it says of each field in lines of the form "name : text"."""
    text = cleandoc(docstring or "")
    about, fields = re.split(r"\n\s*\n", text)[0], dict[str, str]()
    for names, meaning in re.findall(r"^([a-z_0-9]+(?:, [a-z_0-9]+)*) : (.+(?:\n    .*)*)", text, re.MULTILINE):
        fields |= dict.fromkeys(names.split(", "), " ".join(meaning.split()))
    return " ".join(about.split()), fields


def _stated(line: str) -> Entry:
    text, unit = re.fullmatch(r"(.*?)(?: \[([^\]]*)\])?", line).groups("")
    return Entry(unit, text)


LABELS: Mapping[str, Entry] = {
    **{name: _stated(line) for name, line in documented(_WORDS)[1].items()},
    "load": Entry("N", "Normal force that was prescribed.", along_line="N/m"),
    "force": Entry("N", "Mean normal force.", along_line="N/m"),
    "depth_reached": NUMBERS["depth"],
}

# What an ending adds to the meaning of a name.
ENDINGS = {
    "_mean": "Mean over draws. ",
    "_low": "Lower end of the interval of 95 %, scatter of surfaces and error of the grid. ",
    "_high": "Upper end of the interval of 95 %, scatter of surfaces and error of the grid. ",
    "_surface": "Of a single surface, not of the mean. ",
    "_corrected": "Corrected by the trust map. ",
    "_least": "Lower end of the interval of 95 %. ",
    "_most": "Upper end of the interval of 95 %. ",
    "_1d": "In one dimension (MDR). ",
    "_3d": "In three dimensions (BEM). ",
}


def stem(name: str) -> str:
    """Name that an entry is found under: without its ending where the whole has none, and a model in brackets."""
    name = name.partition(" (")[0]
    for ending in ENDINGS:
        if name.endswith(ending) and _entry(name) is None:
            return stem(name.removesuffix(ending))
    return name


def entry(name: str) -> Entry | None:
    """Entry of a name, of the judge first and then of the solvers; None of a name that explains itself."""
    whose = stem(name)
    found = _entry(whose)
    if found is None or whose == name:
        return found
    prefix = "".join(text for ending, text in ENDINGS.items() if ending in name.removeprefix(whose))
    return replace(found, text=prefix + found.text)


def _entry(name):
    return LABELS.get(name) or NUMBERS.get(name) or MEASURES.get(name) or FIELDS.get(name)


def head(name: str) -> str:
    """Name of a column in words, with its unit."""
    found, plain = entry(name), name.replace("_", " ")
    return plain if found is None or found.unit in ("", "1") else f"{plain} [{found.unit_in_words}]"


def attributes(name: str, scene: Scene | None = None) -> dict[str, str]:
    """Attributes of a variable of a Dataset: units, long name and definition."""
    return (entry(name) or Entry("", "")).attributes(name, "" if scene is None else scene.indenter.type)
