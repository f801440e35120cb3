"""Rigid macroscopic shapes: height z(x, y) >= 0 [m] above the lowest point, and its slope along x."""

from math import gamma, pi, sqrt, tan
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field
from pydantic.dataclasses import dataclass

from .quantities import CLOSED, Angle, Finite, Length, Positive, Unit
from .surfaces.measured import Measured


class Axisymmetric:
    """A body of revolution z = coefficient * r**exponent, r = sqrt(x^2 + y^2)."""

    if TYPE_CHECKING:

        @property
        def coefficient(self) -> float: ...

        @property
        def exponent(self) -> float: ...

    pressed_by: ClassVar[tuple[str, ...]] = ("load", "depth")

    def height(self, x, y):
        """z(x, y) [m] for coordinates [m] of any broadcastable shapes."""
        return self.coefficient * np.hypot(x, y) ** self.exponent

    def slope(self, x, y):
        """dz/dx [1]; at the tip of a cone, where it jumps, the mean of both sides: zero."""
        r = np.hypot(x, y)
        c, n = self.coefficient, self.exponent
        return np.where(r > 0, c * n * x * np.where(r > 0, r, 1.0) ** (n - 2), 0.0)

    def curvature(self, x, y):
        """d2z/dx2 [1/m]; at the tip infinite for exponents below 2, there NaN."""
        r = np.hypot(x, y)
        c, n = self.coefficient, self.exponent
        away = np.where(r > 0, r, 1.0 if n >= 2 else np.nan)
        return c * n * np.where(r > 0, r, 0.0 if n > 2 else 1.0) ** (n - 2) * (1 + (n - 2) * np.square(x / away))

    def radius_at(self, height):
        """Radius [m] at which the shape reaches a height [m] >= 0."""
        return (height / self.coefficient) ** (1 / self.exponent)

    @property
    def mdr_coefficient(self) -> float:
        """Coefficient of the one-dimensional profile g(x) = mdr_coefficient * |x|**exponent.

        The MDR transform g = |x| int_0^|x| z'(r) / sqrt(x^2 - r^2) dr multiplies the coefficient by
        (sqrt(pi)/2) n Gamma(n/2) / Gamma((n+1)/2): 2 for a sphere, pi/2 for a cone.
        """
        n = self.exponent
        return self.coefficient * (sqrt(pi) / 2 * n * gamma(n / 2) / gamma((n + 1) / 2))


@dataclass(frozen=True, config=CLOSED)
class Sphere(Axisymmetric):
    """Sphere near its apex, as the paraboloid z = r^2 / (2 radius). radius [m]."""

    radius: Length
    type: Literal["sphere"] = Field(default="sphere", repr=False)

    @property
    def coefficient(self) -> float:
        return 1 / (2 * self.radius)

    @property
    def exponent(self) -> float:
        return 2.0


@dataclass(frozen=True, config=CLOSED)
class Cone(Axisymmetric):
    """Cone z = r tan(angle). angle: between the flank and the flat surface [rad], 0 to pi/2."""

    angle: Annotated[Angle, Field(lt=pi / 2)]
    type: Literal["cone"] = Field(default="cone", repr=False)

    @property
    def coefficient(self) -> float:
        return tan(self.angle)

    @property
    def exponent(self) -> float:
        return 1.0


@dataclass(frozen=True, config=CLOSED)
class PowerLaw(Axisymmetric):
    """Body of revolution z = coefficient * r**exponent. coefficient [m^(1-exponent)], exponent 1 to 100."""

    coefficient: Annotated[Positive, Unit("m^(1-exponent)")]
    exponent: Annotated[Finite, Field(ge=1, le=100)]
    type: Literal["power-law"] = Field(default="power-law", repr=False)


@dataclass(frozen=True, config=CLOSED)
class Cylinder:
    """Cylinder lying across the sliding direction, as z = x^2 / (2 radius): a line contact. radius [m].

    Forces are per length of the line [N/m]. The surface of a half-space under a line load sinks without bound, so
    depths are counted from the surface one radius away from an elastic line load.
    """

    pressed_by: ClassVar[tuple[str, ...]] = ("line_load",)
    radius: Length
    type: Literal["cylinder"] = Field(default="cylinder", repr=False)

    def height(self, x, y):
        """z(x) [m], the same for every y."""
        return np.broadcast_to(np.square(x) / (2 * self.radius), np.broadcast_shapes(np.shape(x), np.shape(y)))

    def slope(self, x, y):
        """dz/dx [1]."""
        return np.broadcast_to(x / self.radius, np.broadcast_shapes(np.shape(x), np.shape(y)))

    def radius_at(self, height):
        """Half-width [m] at which the shape reaches a height [m] >= 0."""
        return np.sqrt(2 * self.radius * height)


@dataclass(frozen=True, config=CLOSED)
class Plane:
    """Nominally flat plane whose roughness repeats for ever: one period of it is a cell.

    Forces act on a cell [N]. The depth is the distance of the mean plane below the mean deformed surface: minus
    the mean gap.
    """

    pressed_by: ClassVar[tuple[str, ...]] = ("pressure", "gap")
    type: Literal["plane"] = Field(default="plane", repr=False)

    def height(self, x, y):
        """z [m]: zero."""
        return np.zeros(np.broadcast_shapes(np.shape(x), np.shape(y)))

    def slope(self, x, y):
        """dz/dx [1]: zero."""
        return self.height(x, y)


Indenter = Annotated[Sphere | Cone | PowerLaw | Cylinder | Plane | Measured, Field(discriminator="type")]
