"""What the paper says of its experiment, as claims that curves of three dimensions decide."""

from math import nan

from ...statistics import eq23
from ...statistics.finding import Claim
from .setup import GLASSY, LOADS, MEASURED, POWER, RELAXED, SHIFT, SPEEDS

SCATTER = 0.02  # of ln mu: that of means of six measurements which scatter by 5 % each
OPEN = {"solid": "the solid", "hurst": "the exponent H", "shortest": "the shortest wave", "longest": "the longest"}
AS_ASSUMED, EVERY = "as the paper assumes", "all that is plausible"
OVER = "The interval is the range over all that the paper does not state; the number is the median."


def _claim(id: str, sentence: str, expected: float = nan, tolerance: float = nan, meaning: str = "") -> Claim:
    return Claim(f"experiment.{id}", sentence, expected, tolerance, f"{meaning} {OVER}".strip(), dimension="3D")


_MISFIT = "rms of ln mu about the common curve. Means of six measurements that scatter by 5 % each tell 2 %."
_SLOPE = "Slope of this one of two straight lines at the middle speed; Eq. 25 has 0 to -2/3."
_LINES = "rms of ln mu at the middle speed."
_CUBIC = "rms of ln mu about the lines over that about a cubic; none where they differ in slope by less than 0.02."
_BREAK = "Force at which they meet over F*; on a half-space, over that of 10 mm."
_WIDTH = "Diameter of the contact over the thickness at the middle speed; on a half-space, over 10 mm."
_LIGHT, _HEAVY = (f"Under {each} loads friction falls with the load, as in Eq. 25" for each in ("light", "heavy"))
_EXPONENT = "The shift along the force goes with the speed to the power -3 beta/2"
_BALL = "Share of the smooth ball in friction at the {} load"
_STATED = (
    ("unshifted", "The curves are one before any shift", 0.0, SCATTER, _MISFIT),
    ("collapse", "Shifted along the force, the curves are one", 0.0, SCATTER, _MISFIT),
    ("along-friction", "Shifted along friction, the curves are one", 0.0, SCATTER, _MISFIT),
    ("predicted", "Shifted along the force as the paper has it, the curves are one", 0.0, SCATTER, _MISFIT),
    ("same", "Misfit along friction less that along the force is too small to be measured", 0.0, SCATTER, _MISFIT),
    ("exponent", _EXPONENT, SHIFT, eq23.TOLERANCE * -SHIFT, "Curves that part or lie flat have none."),
    ("one-line", "A curve is one straight line", 0.0, SCATTER, _LINES),
    ("two-lines", "A curve is two straight lines", 0.0, SCATTER, _LINES),
    ("over-cubic", "Two straight lines follow a curve better than a smooth one", 0.0, 1.0, _CUBIC),
    ("slope-light", _LIGHT, -1 / 3, 1 / 3, _SLOPE),
    ("slope-heavy", _HEAVY, -1 / 3, 1 / 3, _SLOPE),
    ("break", "The two lines meet at F* = (2/3) G_0 D^3/R", 1.0, 0.25, _BREAK),
    ("width", "At F* the contact is as wide as the layer is thick", 1.0, 0.05, _WIDTH),
    ("level", "Friction comes to 0.5", MEASURED, MEASURED / 2, "Greatest friction at the middle speed."),
    ("ball-light", _BALL.format("least")),
    ("ball-heavy", _BALL.format("greatest")),
    ("pressed", "Least mean pressure over the rms pressure of all waves in full contact"),
)
# By the column of the numbers that decide them.
CLAIMS = {each[0]: _claim(*each) for each in _STATED}
ABOUT = f"""The smooth ball is solved on the layer at {len(LOADS)} loads of {LOADS[0]:g} to {LOADS[-1]:g} N and
{len(SPEEDS)} speeds of {1e3 * SPEEDS[0]:g} to {1e3 * SPEEDS[-1]:g} mm/s. Its roughness is too fine for any grid:
its friction follows from the pressure field by the law of three dimensions, without the waves on which the contact
rides.

**Stated by the paper**: radii, thicknesses, G_0 = {RELAXED / 1e6:g} MPa, G_inf = {GLASSY / 1e9:g} GPa,
beta = {POWER:g}, rms roughness of 0.1 um. **Not stated, and varied**: Hurst exponent, shortest and longest wave,
and where the loss begins.

**The solids.** A loss that is a power of 0.1 at every frequency rises from 3 MPa to 1.5 GPa over 27 decades: in
the band that is sampled G_inf is not reached. In these solids the modulus at the frequency of the
contact, about 1 rad/s, is 1.03, 1.1 or 1.3 of that at rest (the paper's assumption), or 2 and 4 times that. Or the
loss begins at 0.3, 30 or 3000 rad/s, rises with the power 0.1, and ends at 1e10 rad/s with the modulus G_inf."""
