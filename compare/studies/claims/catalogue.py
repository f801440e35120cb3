"""The studies that come with the package, each in three sizes."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from bem3d import BEM
from mdr1d import MDR
from scene import Fractional, Indent, Kelvin, Program, Slide, Stage, StandardLinearSolid
from scene.scales import elastic_contact

from ...library.ready import CATALOGUE
from ..paper import parameters
from .contacts import SHORTEST, STEEP, kelvin, resolved
from ...comparison.rough import RoughSeries as Series
from .sizes import Size, between

# Across the knee. In three dimensions friction hardly falls with the load where it is slow: neighbouring speeds
# must lie close for their curves to share a stretch of one curve.
SPEEDS = (7.5e-3, 2.0)
LOADS = (0.2, 20.0)
SHAPES = ("sphere", "cone")
# Glassy over rubbery modulus.
GLASSY = 10.0
HURST = (0.1, 0.3, 0.5, 0.7, 0.9)
# fmt: off
SIZES = {
    "quick": Size(
        range=(0.03, 0.6), speeds=6, values=4, surfaces=3, profiles=12, points=128,
        hurst=HURST[::2], few=3, indentations=2, steps=50,
    ),
    "standard": Size(
        range=SPEEDS, speeds=12, values=8, surfaces=10, profiles=60, points=256,
        hurst=HURST, few=3, indentations=3, steps=100, interval=0.1,
    ),
    "full": Size(
        range=SPEEDS, speeds=20, values=16, surfaces=40, profiles=200, points=512,
        hurst=HURST, few=4, indentations=3, steps=100,
    ),
}
# fmt: on


@dataclass(frozen=True)
class ReadyStudy:
    """A question, and the series that are solved for it.

    title, about : for people
    series : by size
    """

    title: str
    about: str
    series: Callable[[Size], Iterable[Series]]


def _collapse(size: Size) -> Iterator[Series]:
    """Series at prescribed load, and at the depths that the smooth relaxed bodies have under these loads."""
    loads = size.values_of(*LOADS)
    for shape in SHAPES:
        yield _series(size, shape, f"Rough {shape}", kelvin(shape), values=loads)
        yield _at_depths(size.coarser, f"{shape}-depth", f"Rough {shape}, depth prescribed", kelvin(shape), loads)


def _solids(size: Size) -> Iterator[Series]:
    rubber, size = parameters.SOLID, size.coarser
    glassy = StandardLinearSolid(rubber.modulus, GLASSY * rubber.modulus, rubber.relaxation_time / GLASSY)
    loss = Fractional(
        modulus=rubber.modulus,
        relaxation_time=rubber.relaxation_time,
        exponent=0.5,
        lowest_frequency=SPEEDS[0] / 10 / parameters.LENGTH,
        highest_frequency=10 * (2 * np.pi / SHORTEST * SPEEDS[1]),
        tolerance=1e-2,
    )
    # A loss that grows with the root of the frequency is slow at lower speeds.
    slower = replace(size, range=(size.range[0] / 5, size.range[1]))
    for shape in SHAPES:
        for name, solid, own in (("standard linear solid", glassy, size), ("power law", loss, slower)):
            scene = replace(kelvin(shape), elastomer=solid)
            yield _series(own, f"{shape}-{name.replace(' ', '-')}", f"Rough {shape}, {name}", scene)


def _hurst(size: Size) -> Iterator[Series]:
    size = size.coarser.at_most(speeds=8, values=6, surfaces=10).within(0.02, 1.0)
    for shape, hurst in product(SHAPES, size.hurst):
        title = f"Rough {shape}, H = {hurst:g}"
        yield _series(size, f"{shape}-hurst-{hurst:g}", title, kelvin(shape, hurst=hurst))


def _parameters(size: Size) -> Iterator[Series]:
    """One parameter changed at a time, around the contacts of Fig. 1."""
    size = size.coarser.at_most(speeds=size.few, values=size.few, surfaces=6)
    for shape in SHAPES:
        base = kelvin(shape)
        rough, solid = resolved(shape), parameters.SOLID
        changed = {
            "as in Fig. 1": base,
            "half the rms height": replace(base, roughness=replace(rough, rms_height=rough.rms_height / 2)),
            "twice the rms height": replace(base, roughness=replace(rough, rms_height=2 * rough.rms_height)),
            "twice the shortest wave": replace(base, roughness=replace(rough, shortest=2 * SHORTEST)),
            "half the shortest wave": replace(base, roughness=replace(rough, shortest=SHORTEST / 2)),
            "a third of the relaxation time": replace(base, elastomer=_slower(solid, 1 / 3)),
            "three times the relaxation time": replace(base, elastomer=_slower(solid, 3.0)),
        }
        for what, scene in changed.items():
            # As many pixels a wave for all.
            finer = replace(size, points=round(size.points * max(1.0, SHORTEST / _shortest(scene))))
            yield _series(finer, f"{shape}-{what.replace(' ', '-')}", f"Rough {shape}, {what}", scene)


def _depth_study(size: Size) -> Iterator[Series]:
    """Series at rest at prescribed depths, and pressed in at constant rates."""
    few = size.coarser.at_most(speeds=size.indentations, values=size.indentations, surfaces=6)
    for shape in SHAPES:
        scene = kelvin(shape)
        depths = _depths(scene, size.values_of(*LOADS))
        rest = replace(scene, motion=Indent(depth=depths[0]))
        yield replace(_series(size, f"{shape}-rest", f"Rough {shape}, at rest", rest, values=depths), speeds=())
        time = scene.elastomer.relaxation_time
        solid = StandardLinearSolid(scene.elastomer.modulus, GLASSY * scene.elastomer.modulus, time)
        sunk = tuple(depths[i] for i in np.linspace(0, len(depths) - 1, few.values).round().astype(int))
        pressed = replace(scene, elastomer=solid, motion=Program(stages=(Stage(duration=1.0, depth=sunk[0]),)))
        title = f"Rough {shape}, pressed in at constant rates"
        series = _series(few, f"{shape}-pressed-in", title, pressed, values=sunk)
        rates, steps = between(0.1 * sunk[-1] / time, 10 * sunk[-1] / time, few.speeds), size.steps
        yield replace(series, speeds=rates, bem=replace(series.bem, steps=steps), mdr=MDR(2000, steps=steps))


def _regime(size: Size) -> Iterator[Series]:
    """Small roughness that is steep: rolled off, so that h0 << d while its slope is several times the body's.

    Slow speeds stand apart, since those of a collapse must lie close. The seeds of each series are the same.
    """
    small = size.points <= 128
    points = 512 if small else 5 * size.points // 2
    speeds, values, fastest = (4, 3, 12.0) if small else (6, 6, 35.0)
    # Only two grids carry these waves: what coarse surfaces would add costs more than it narrows.
    few = replace(size.at_most(speeds=speeds, values=values, surfaces=6), points=points, interval=None)
    for shape, (scene, (low, high)) in STEEP.items():
        wave = _shortest(scene) / (2 * np.pi * scene.elastomer.relaxation_time)
        # Wider contacts have fewer pixels a wave.
        loads = few.values_of(low, 2 * low if small else high)
        knee = replace(few, range=(2.5 * wave, fastest * wave))
        title = f"Steeply rough {shape}"
        yield _series(knee, shape, title, scene, values=loads)
        if not small:
            slow = replace(few, range=(0.03 * wave, 0.06 * wave), speeds=2)
            yield _series(slow, f"{shape}-slow", f"{title}, slow", scene, values=loads)
            deep = knee.at_most(surfaces=4)
            yield _at_depths(deep, f"{shape}-depth", f"{title}, depth prescribed", scene, loads[::2])


_SERIES = {
    "collapse": _collapse,
    "solids": _solids,
    "hurst": _hurst,
    "parameters": _parameters,
    "regime": _regime,
    "depth": _depth_study,
}
STUDIES = {
    name: ReadyStudy(CATALOGUE[name].title, CATALOGUE[name].about, series) for name, series in _SERIES.items()
}


def _series(size, name, title, scene, values=None):
    rough = replace(scene.roughness, seed=1)
    return Series(
        name=name,
        title=title,
        scene=replace(scene, roughness=rough),
        speeds=size.rates,
        values=values or size.values_of(*LOADS),
        surfaces=size.surfaces,
        profiles=size.profiles,
        bem=BEM(points=size.points),
        mdr=MDR(points=5000),
        interval=size.interval,
    )


def _at_depths(size, name, title, scene, loads):
    """Series that slides at the depths which the smooth relaxed body has under loads."""
    depths = _depths(scene, loads)
    return _series(size, name, title, replace(scene, motion=Slide(speed=1.0, depth=depths[0])), values=depths)


def _slower(solid: Kelvin, factor):
    return replace(solid, relaxation_time=factor * solid.relaxation_time)


def _depths(scene, loads):
    return tuple(elastic_contact(replace(scene, motion=Indent(load=load))).depth for load in loads)


def _shortest(scene):
    return scene.roughness.shortest
