"""Effects of a scene as every solver has them: friction in the interface, and the heat that friction makes.

Heat is settled at the temperature at which a contact makes just the heat that keeps it there.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import isfinite, isinf, log, nan, sqrt
from typing import Protocol

from ..indenter import Axisymmetric
from ..motion import Program, Slide
from ..plan import Plan
from ..protocol import SolveError
from ..result import Result
from ..scene import Scene, temperature_rise
from ..terms import Solve, Term

RELATIVE, LEAST = 1e-6, 1e-9  # to which both sides agree: of the rise, and [K]
# Left between both sides where the temperature is known to that; more is a jump, at which they do not agree.
JUMP = 1e-3
MOST_TRIALS = 100
LEAP = 10.0  # times the difference of both sides, at most


class Trial(Protocol):
    """A contact that is warmer than the scene by so much [K], and the rise [K] that its friction then makes."""

    warmer: float
    rise: float


def settled(attempt: Callable[[float], Trial]) -> Trial:
    """The trial at the least x >= 0 with rise(x) = x, where a contact that warms up from 0 stays.

    The rise must not be negative, and grow ever faster, then ever slower, and then fall, as far as it does each:
    then no lower solution is passed by. Until a trial makes less heat than keeps it warm, each is as warm as the
    one before makes it, which is never too warm while the rise grows. Where it grows ever faster a secant is not
    either, and goes farther; past the place where both sides are closest, any step is safe. The first trial that
    is too warm lies beyond the solution, and no other is between it and the one before. Raises SolveError where
    there is none.
    """
    low, high, warmer = 0.0, None, 0.0
    tried: list[tuple[float, float]] = []
    while len(tried) < MOST_TRIALS:
        trial = attempt(warmer)
        excess, agreed = trial.rise - warmer, RELATIVE * abs(trial.rise) + LEAST
        _check(trial, agreed)
        tried.append((warmer, excess))
        if abs(excess) <= agreed:
            return trial
        low, high = (warmer, high) if excess > 0 else (low, warmer)
        if high is None:
            warmer = _ahead(tried)
        elif high - low > RELATIVE * low + LEAST:
            warmer = _between(low, high, tried)
        elif abs(excess) <= JUMP * trial.rise:
            return trial
        else:
            raise SolveError(
                f"friction jumps where it heats the contact by {warmer:g} K, so that no temperature agrees with "
                "the heat; leave heating.feedback out"
            )
    reached = f"above {low:g} K" if high is None else f"between {low:g} and {high:g} K"
    raise SolveError(
        f"no rise of temperature found that agrees with the heat in {MOST_TRIALS} solves: it lies {reached}; "
        "leave heating.feedback out"
    )


def _check(trial, agreed):
    """Raise SolveError for a rise that cannot warm anything."""
    if not isfinite(trial.rise) or trial.rise < -agreed:
        raise SolveError(
            f"heating by {trial.rise:g} K of a contact warmer by {trial.warmer:g} K: feedback takes friction and "
            "depth that are not negative, and a finite estimate; leave heating.feedback out"
        )


def _ahead(tried: Sequence[tuple[float, float]]) -> float:
    """Next trial, as warm as the last one makes it; farther, to the end of the secant, while the rise grows."""
    x, excess = tried[-1]
    if len(tried) == 1:
        return x + excess
    before, more = tried[-2]
    falls = (more - excess) / (x - before)
    return x + excess / min(max(falls, 1 / LEAP), 1.0)


def _between(low: float, high: float, tried: Sequence[tuple[float, float]]) -> float:
    """Next trial by the last two; by halves, or by halves of decades, where that leaves the bracket."""
    guess = _expected(*tried[-2:])
    if low < guess < high:
        return guess
    least = max(low, LEAST)
    return sqrt(least) * sqrt(high) if high > 4 * least else (low + high) / 2


def _expected(before: tuple[float, float], last: tuple[float, float]) -> float:
    """x = rise(x) from two trials: of an exponential where the rise falls, as times do, else of a line."""
    (a, first), (b, second) = before, last
    if min(first + a, second + b) > 0:
        rate = (log(first + a) - log(second + b)) / (b - a)
        if rate > 0:
            # Only feedback of heat needs it.
            from scipy.special import wrightomega

            return float(wrightomega(log(rate) + log(second + b) + rate * b)) / rate
    return b - second * (b - a) / (second - first) if second != first else nan


class Rubbed(Term):
    """Coulomb's friction where no point of contact is left to stick; see `Coulomb`."""

    def refusals(self, scene: Scene) -> list[str]:
        if isinstance(scene.motion, Program):
            return [
                "interface = Coulomb: a history of partial slip is not simulated, and motion = Program takes no "
                "friction in the interface; use Slide or Shear, or leave interface out"
            ]
        return []

    def rubbed(self, result: Result) -> Result:
        """The answer, of sliding, with what the interface adds; any other as it is."""
        if not isinstance(result.scene.motion, Slide):
            return result
        friction = self.part.coefficient * result.normal_force
        total = result.friction_force + friction
        parts = {"friction_in_elastomer": result.friction_force, "friction_in_interface": friction}
        if "friction_error" in result.measures:  # friction of the interface has no error
            parts["friction_error"] = result.measures["friction_error"] * result.friction_force / total
        return replace(result, friction_force=total, measures={**result.measures, **parts})


SOLVES = 5  # until temperature and heat agree; 3 to 10 are usual


class Heated(Term):
    """Frictional heating; see `Heating` for what it adds to a result."""

    def refusals(self, scene: Scene) -> list[str]:
        reasons = []
        if not isinstance(scene.indenter, Axisymmetric):
            reasons.append(
                "it is estimated from the depth of a body of revolution, which a "
                f"{type(scene.indenter).__name__} is not: leave heating out"
            )
        if scene.layer is not None:
            reasons.append("it is estimated from the depth in a half-space: leave layer or heating out")
        if isinstance(scene.motion, Program):
            reasons.append("it is estimated of steady sliding, not of a Program: take Slide, or leave heating out")
        rough = scene.roughness is not None and not scene.roughness.flat
        if self.part.feedback == "flash" and rough and isinf(scene.solid.glassy_modulus):
            reasons.append(
                f"a {type(scene.elastomer).__name__} has no glassy modulus, and asperities would be infinitely hot"
                ': take feedback = "average", or an elastomer with a glassy modulus'
            )
        return [f"heating = Heating: {reason}" for reason in reasons]

    def around(self, solve: Solve) -> Solve:
        return self._estimated(solve) if self.part.feedback is None else self._fed_back(solve)

    def planned(self, plan: Plan, scene: Scene) -> Plan:
        """Plan of the solves that feedback usually takes."""
        if self.part.feedback is None:
            return plan
        again = f"the {SOLVES} solves that feedback usually takes"
        return replace(
            plan,
            method=f"{plan.method}; again, until it is as warm as its friction makes it",
            operator_applications=plan.operator_applications.times(SOLVES, again),
        )

    def _estimated(self, solve):
        def answered(scene):
            result = solve(replace(scene, heating=None))
            return _completed(result, scene, self._estimates(result))

        return answered

    def _fed_back(self, solve):
        def answered(scene):
            spent = []

            def attempt(warmer):
                result = solve(_warmer(scene, warmer))
                spent.append((result.operator_applications, result.seconds))
                return _Trial(warmer, result, self._estimates(result), f"{self.part.feedback}_heating")

            trial = settled(attempt)
            applications, seconds = map(sum, zip(*spent, strict=True))
            measures = {
                **trial.estimates,
                "temperature": trial.result.scene.temperature.temperature,
                "heating_solves": float(len(spent)),
            }
            result = replace(trial.result, operator_applications=applications, seconds=seconds)
            return _completed(result, scene, measures)

        return answered

    def _estimates(self, result):
        """Estimates of the heating of a solved contact, name -> rise of temperature [K]."""
        solid, speed = result.scene.solid, result.scene.motion.speed
        height = result.measures.get("rms_height", 0.0)
        stiffer = 1 / (2 * (1 - solid.poisson_ratio))  # E*/4 over G

        def rise(modulus, length):
            friction = result.friction_coefficient
            if 0 in (friction, length, speed):
                return 0.0
            return temperature_rise(friction, stiffer * modulus, length, speed, self.part.conductivity)

        return {
            "average_heating": rise(solid.static_modulus, result.depth) if result.depth >= 0 else nan,
            "flash_heating": rise(solid.glassy_modulus, height),
        }


@dataclass(frozen=True)
class _Trial:
    """Trial of `settling`, with the answer behind it."""

    warmer: float
    result: Result
    estimates: dict[str, float]
    acting: str

    @property
    def rise(self) -> float:
        return self.estimates[self.acting]


def _warmer(scene, rise):
    """The scene without heating, warmer by so much [K]. Raises SolveError where its law ends."""
    law = scene.temperature
    try:
        law = replace(law, temperature=law.temperature + rise)
    except ValueError as error:
        raise SolveError(f"friction heats the contact by {rise:g} K, where {law!r} has no shift") from error
    return replace(scene, temperature=law, heating=None)


def _completed(result, scene, measures):
    """The result as an answer to the scene."""
    return replace(result, scene=scene, measures={**result.measures, **measures})
