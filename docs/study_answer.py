"""What the studies come to in a few sentences, with the numbers of the run."""

from collections.abc import Mapping

from compare.studies import tableau
from compare.studies.claims import EXACT
from compare.studies.judgement import JudgedStudy

ONE, PREDICTED = "onto one curve", "shifted by p(v)"
FALLS, LEVEL, SMOOTH, DEEP = "falls with the load", "the level of friction", "smooth, at the slowest", "h0 at most"


def answer(judged: Mapping[str, JudgedStudy]) -> str:
    """A list in Markdown.

    judged : by the name of the study
    """
    collapse, regime, depth = (_Numbers(judged[name]) for name in ("collapse", "regime", "depth"))
    points = [
        "Smooth bodies: force and depth agree with closed forms in both dimensionalities. Friction at low speed "
        f"is {collapse.number('sphere', SMOOTH, '1D/3D')} times as high in 1D.",
        "Rough bodies at rest: forces at the same depth agree where the rms height is at most a tenth of the "
        f"depth, within {depth.percent('sphere-rest', DEEP, '1D/3D')} on the sphere and "
        f"{depth.percent('cone-rest', DEEP, '1D/3D')} on the cone. At shallower depths single surfaces differ so "
        "much that these numbers of draws leave it undecided.",
        "Both solvers meet the exact limit of low speed of their own dimensionality, on the rough sphere by a "
        f"factor of {collapse.number('sphere', EXACT, '1D')} in 1D and of "
        f"{collapse.number('sphere', EXACT, '3D')} in 3D: what fails below are laws, not solvers.",
        "**Eq. 23 in 3D.** Shifted along the load alone, friction of the rough sphere misses one curve by "
        f"{collapse.percent('sphere', ONE, '3D')}; along friction too, by {collapse.beside('sphere', 'BEM')}. Of "
        f"the rough cone: {collapse.percent('cone', ONE, '3D')}, with curves that hardly overlap. With the shifts "
        f"that the theory gives they miss by {collapse.percent('sphere', PREDICTED, '3D')} and "
        f"{collapse.percent('cone', PREDICTED, '3D')}.",
        "**Eq. 23 in 1D.** Friction of the rough cone misses one curve by "
        f"{collapse.percent('cone', ONE, '1D')}, of the rough sphere by {collapse.percent('sphere', ONE, '1D')}: "
        "its own slope, which the laws leave out, is not small against that of the roughness here.",
        "At low speed friction should fall as F_N^(−2/3) under a sphere and F_N^(−1/2) under a cone. Exponents "
        f"of the sphere: {collapse.number('sphere', FALLS, '1D')} in 1D, "
        f"{collapse.number('sphere', FALLS, '3D')} in 3D; of the cone: {collapse.number('cone', FALLS, '1D')} and "
        f"{collapse.number('cone', FALLS, '3D')}.",
        "**In the regime of the paper**, roughness small against the depth and steep against the body, 1D obeys: "
        f"the exponents are {regime.number('sphere-slow', FALLS, '1D')} and "
        f"{regime.number('cone-slow', FALLS, '1D')}. In 3D contact is partial there, and friction hardly depends "
        f"on the load: {regime.number('sphere-slow', FALLS, '3D')} and "
        f"{regime.number('cone-slow', FALLS, '3D')}. At low speed it is "
        f"{regime.number('sphere-slow', LEVEL, '3D')} and {regime.number('cone-slow', LEVEL, '3D')} times that of "
        "the law.",
    ]
    return "## The answer\n\n" + "\n".join(f"- {point}" for point in points) + "\n"


class _Numbers:
    """Numbers of one study, with their intervals."""

    def __init__(self, judged: JudgedStudy):
        self.judged, self.columns = judged, {column.name: column for column in tableau.columns(judged)}

    def number(self, series, part, dimension):
        """Of the claim that has these words in it."""
        finding = self._find(series, part, dimension)
        low, high = finding.interval
        return f"{finding.value:.2f} ({low:.2f} to {high:.2f})"

    def percent(self, series, part, dimension):
        """Of a size, which is not negative."""
        finding = self._find(series, part, dimension)
        low, high = finding.interval
        return f"{100 * finding.value:.1f} % ({100 * max(low, 0.0):.1f} to {100 * high:.1f} %)"

    def beside(self, series, solver):
        """Misfit once shifted along load and friction."""
        each = next(each for each in self.judged.series if each.solved.series.name == series)
        return f"{100 * each.shiftings[solver].both.misfit.value:.1f} %"

    def _find(self, series, part, dimension):
        asked = (each for each in self.columns[series].findings if each.dimension == dimension)
        return next(each for each in asked if part in each.claim)
