"""Memory of a solve by formula: the arrays of its stages, as `Array`s of a plan."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import ceil, pi, prod

from scene import Plane, Scene
from scene.plan import Array

from .engine import Engine
from .memory import SMALL
from .problem import row_width
from .sliding import Flow

TOUCHING, ON_A_ROW = 0.4, 0.6  # of the points, in contact
SYMMETRIC, GENERAL = 8, 16  # vectors on the points in contact, of conjugate gradients and of GMRES
MATRICES = 6  # of the points in contact of a sliding row, while it is solved
SAMPLES = 7  # between two columns, in the mean
DRAWN = 13  # arrays in which a surface is drawn, each as large as half of its waves

Shape = tuple[int, int]


def engine_of(engine: Engine, scene: Scene) -> Engine:
    """Engine of the problem: single rows are solved in double precision."""
    return engine if row_width(scene) is None else replace(engine, precision="double")


def padded(engine: Engine, shape: Shape) -> Shape:
    """Sizes of the transforms on a free surface."""
    rows, points = shape
    return (1 if rows == 1 else engine.good_size(2 * rows - 1)), engine.good_size(2 * points - 1)


def product(engine: Engine, name: str, shape: Shape, sizes: Shape, real: bool) -> Iterator[Array]:
    """Arrays of a product with a symbol, on transforms of these sizes."""
    kind = engine.real if real else engine.complex
    yield Array(f"{name}: symbol", (sizes[0] // 2 + 1, sizes[1] // 2 + 1), kind().itemsize)
    yield Array(f"{name}: waves", (shape[0], sizes[1] // 2 + 1), engine.complex().itemsize)


def in_contact(engine: Engine, scene: Scene, flow: Flow, shape: Shape) -> Iterator[Array]:
    """While a contact is found: products, planes, and what the solver of a set of contact keeps."""
    yield from product(engine, "response", shape, _sizes(engine, scene, shape), flow.at_rest)
    yield from product(engine, "approximate inverse", shape, shape, real=True)
    yield from _sampled(scene, flow, shape)
    yield Array("heights, pressure, gap and the like", (9 if flow.at_rest else 11, *shape))
    yield Array("sets of contact", (3, *shape), 1)
    touching = ceil((ON_A_ROW if shape[0] == 1 else TOUCHING) * prod(shape))
    if shape[0] == 1 and not flow.at_rest:
        yield Array("matrices on the points in contact", (MATRICES, touching, touching))
    else:
        yield Array("vectors on the points in contact", (SYMMETRIC if flow.at_rest else GENERAL, touching))


def laying_out(engine: Engine, scene: Scene, flow: Flow, shape: Shape) -> Iterator[Array]:
    """While a kernel becomes a product; last, those of the loss."""
    sizes, repeats = _sizes(engine, scene, shape), isinstance(scene.indenter, Plane)
    half = sizes[0] // 2 + 1, sizes[1] // 2 + 1
    yield Array("heights, slopes, pressure, gap", (4, *shape))
    if not repeats:
        yield Array("kernel, as it is and as it is laid out", (4, shape[0], sizes[1]))
        yield from _sampled(scene, flow, shape)
    yield Array("symbol and its copies", (3, *half), 8 if flow.at_rest or repeats else 16)
    yield Array("waves of a plane", (shape[0], half[1]), engine.complex().itemsize)


def of_roughness(scene: Scene, pixel: float, points: int) -> Iterator[Array]:
    """Amplitudes of a rough surface, and its waves along the sides of a grid; of a smooth one, none. pixel [m]"""
    rough = scene.roughness
    if rough is None or rough.flat:
        return
    top = ceil(rough.period * rough.q_max(pixel) / (2 * pi))
    yield Array("amplitudes of the roughness", (2 * top + 1, top + 1), 16)
    yield Array("its waves along the sides", (3, points, top + 1), 16)


def as_drawn(waves: Sequence[Array]) -> Iterator[Array]:
    """While a surface is drawn."""
    for amplitudes in waves[:1]:
        yield Array("surface as it is drawn", (DRAWN, *amplitudes.shape))


def _sampled(scene, flow, shape):
    """Kernel between the columns of a small grid, kept for the next solve."""
    if 1 < shape[0] <= SMALL and not (flow.at_rest or isinstance(scene.indenter, Plane)):
        yield Array("kernel, as it is sampled", (SAMPLES, shape[0], 2 * shape[1]))


def _sizes(engine, scene, shape):
    return shape if isinstance(scene.indenter, Plane) else padded(engine, shape)
