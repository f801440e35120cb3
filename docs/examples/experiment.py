"""The paper's experiment in three dimensions: a ball slides on a layer, and its friction curves are shifted.

python docs/examples/experiment.py   prints the numbers of results/paper.md, and draws its figure

The smooth ball is solved on the layer. Its roughness is too fine for any grid; its friction is from the law of
three dimensions, the integral of F_full S(p / p_rms) over the contact, p the pressure of the smooth ball.
"""

from math import pi, sqrt

import numpy as np
from matplotlib.figure import Figure

from bem3d import BEM
from compare.models.law.bands import Bands, FullContact
from compare.models.law.parts import Share
from compare.statistics.collapse import collapse
from compare.statistics.frictioncurves import SimulatedCurves
from scene import Fractional, Layer, Scene, SelfAffine, Slide, Sphere

# As the paper states it: radius and thickness [m], modulus at rest [Pa], power of the loss.
RADIUS, THICKNESS, MODULUS, POWER = 0.05, 0.01, 3e6, 0.1
LOADS, SPEEDS = np.geomspace(1.0, 100.0, 9), np.geomspace(3e-3, 20e-3, 5)  # [N], [m/s]
CROSSOVER = 2 / 3 * MODULUS * THICKNESS**3 / RADIUS  # F* [N], at which Hertz has the contact as wide as the layer
# Not stated by the paper, and chosen: the modulus at contact is 1.3 times that at rest; Hurst exponent and waves.
SOLID = Fractional(
    modulus=MODULUS,
    relaxation_time=0.3 ** (1 / POWER),
    exponent=POWER,
    lowest_frequency=1e-3,
    highest_frequency=1e7,
    tolerance=1e-2,
)
ROUGH = {
    "rough": SelfAffine(rms_height=1e-7, hurst=0.5, longest=2e-4, shortest=1e-7),
    "nearly smooth": SelfAffine(rms_height=1e-7, hurst=1.0, longest=1e-3, shortest=1e-4),
}


def ball(load: float, speed: float, thickness: float | None = THICKNESS) -> Scene:
    """The smooth ball that slides on a layer, without a thickness on a half-space."""
    layer = None if thickness is None else Layer(thickness=thickness)
    return Scene(Sphere(RADIUS), SOLID, Slide(speed=speed, load=load), layer=layer)


def friction(scene: Scene, roughness: list[SelfAffine], points: int = 64) -> list[float]:
    """Friction coefficient of the smooth ball, then the part that each roughness adds."""
    found = BEM(points=points).solve(scene)
    pressure = found.fields["pressure"][found.fields["pressure"] > 0]
    parts = [found.friction_force]
    for each in roughness:
        waves = Bands.of(each).beneath(sqrt(found.measures["contact_area"] / pi))
        full = FullContact.of(waves, scene.solid, scene.motion.speed)
        share = float(Share.of(full)(pressure / float(full.pressure[-1])).sum())
        parts.append(float(full.friction.sum()) * share * found.measures["pixel"] ** 2)
    return [part / scene.motion.load for part in parts]


def two_lines(x: np.ndarray, y: np.ndarray) -> tuple[float, float, float, float]:
    """Best continuous pair of straight lines: where they meet, slopes before and behind it, and the rms left."""

    def fit(place):
        basis = np.stack([np.ones_like(x), np.minimum(x - place, 0.0), np.maximum(x - place, 0.0)], axis=1)
        numbers = np.linalg.lstsq(basis, y, rcond=None)[0]
        return place, *numbers[1:], np.sqrt(np.mean((y - basis @ numbers) ** 2))

    return min(map(fit, np.linspace(x[1], x[-2], 401)), key=lambda each: each[-1])


def numbers(mu: np.ndarray) -> dict[str, float]:
    """What curves of friction (speeds, loads) come to: misfits are rms distances in ln mu."""
    middle = len(SPEEDS) // 2
    found = collapse(SimulatedCurves(SPEEDS, np.broadcast_to(LOADS, mu.shape), mu * LOADS))
    predicted = found.misfit_at(-1.5 * POWER * np.log(SPEEDS / SPEEDS[middle]))
    x, y = np.log(LOADS), np.log(mu[middle])
    place, light, heavy, left = two_lines(x, y)
    return {
        "misfit before any shift [%]": 100 * found.unshifted.misfit.value,
        "misfit, shifted along the force at best [%]": 100 * found.horizontal.misfit.value,
        "misfit, shifted along friction at best [%]": 100 * found.vertical.misfit.value,
        "misfit, shifted along the force by the paper's power [%]": 100 * predicted.value,
        "misfit of two straight lines [%]": 100 * left,
        "slope of the first line": light,
        "slope of the second": heavy,
        "force at which they meet over F*": float(np.exp(place)) / CROSSOVER,
        "greatest friction": float(mu[middle].max()),
    }


def curves(thickness: float | None) -> dict[str, np.ndarray]:
    """Friction (speeds, loads) of the ball with each roughness."""
    balls = [[ball(load, speed, thickness) for load in LOADS] for speed in SPEEDS]
    parts = np.array([[friction(each, [*ROUGH.values()]) for each in row] for row in balls])
    return {name: parts[..., 0] + parts[..., 1 + k] for k, name in enumerate(ROUGH)}


def figure(found: dict[str, np.ndarray]) -> Figure:
    """Friction in thousandths against force at each speed, a panel for each ball; dotted: F*."""
    drawing = Figure(figsize=(7.0, 4.8), layout="constrained")
    for axes, (title, mu) in zip(drawing.subplots(2, 2).flat, found.items(), strict=True):
        for speed, curve in zip(SPEEDS, mu, strict=True):
            axes.loglog(LOADS, 1e3 * curve, label=f"{1e3 * speed:.3g} mm/s")
        axes.axvline(CROSSOVER, linestyle=":", color="grey")
        axes.set(title=title, xlabel="force [N]", ylabel="friction [10⁻³]")
        for set_numbers in (axes.yaxis.set_major_formatter, axes.yaxis.set_minor_formatter):
            set_numbers("{x:.3g}")
    drawing.axes[1].legend(fontsize="small", loc="upper left", frameon=False)
    return drawing


def main() -> None:
    """Solve the ball on the layer and on a half-space, print what its curves come to, and draw them."""
    on = {"layer": THICKNESS, "half-space": None}
    solved = {f"{where}, {name}": mu for where, at in on.items() for name, mu in curves(at).items()}
    for title, mu in solved.items():
        print(title, *(f"{name}: {value:.2g}" for name, value in numbers(mu).items()), sep="\n  ")
    figure(solved).savefig("experiment.png", dpi=200)


if __name__ == "__main__":
    main()
