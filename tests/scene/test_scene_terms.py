"""Parts of a scene and tables of terms: what is absent is not asked about, what is lacking is refused by name."""

from dataclasses import dataclass, fields, replace

import pytest
from maps import refused
from pydantic.dataclasses import dataclass as validated
from sliding import ORDINARY as PLAIN

from bem3d import BEM
from compare.models.exact import Exact
from mdr1d import MDR
from scene import (
    WLF,
    Cone,
    Coulomb,
    Elastic,
    Heating,
    Indent,
    Kelvin,
    Layer,
    Refused,
    Scene,
    Shear,
    Slide,
    Sphere,
)
from scene.indenter import Axisymmetric
from scene.terms import Term, Unsupported, terms_of, unsupported, wrap_solve

WARM = WLF(temperature=310.0, reference=300.0, c1=10.0, c2=50.0)


def test_the_parts_of_a_scene_are_those_that_are_present():
    assert list(PLAIN.parts) == ["indenter", "elastomer", "motion"]
    full = replace(
        PLAIN,
        layer=Layer(thickness=1e-3),
        temperature=WARM,
        heating=Heating(conductivity=1.0),
        interface=Coulomb(0.1),
    )
    assert set(full.parts) == {field.name for field in fields(Scene)} - {"roughness"}
    assert all(full.parts[name] is getattr(full, name) for name in full.parts)
    assert list(full.parts)[-1] == "heating"  # outmost: all friction heats


def test_a_type_stands_for_its_subclasses_unless_they_have_a_line_of_their_own():
    @dataclass(frozen=True)
    class Own(Term):
        pass

    kinds = [type(term) for term in terms_of({Axisymmetric: Term, Kelvin: Own, Slide: Term}, PLAIN)]
    assert kinds == [Term, Own, Term]
    only_sphere = {Axisymmetric: Term, Sphere: Own, Kelvin: Term, Slide: Term}
    assert type(terms_of(only_sphere, PLAIN)[0]) is Own
    assert type(terms_of(only_sphere, replace(PLAIN, indenter=Cone(angle=0.1)))[0]) is Term


@pytest.mark.parametrize("solver", [MDR(), BEM(), Exact()])
def test_a_part_of_an_unknown_type_is_refused_by_its_name_and_that_of_the_solver(solver):
    @validated(frozen=True)
    class Frost:
        depth: float = 1.0

    @validated(frozen=True)
    class Frosted(Scene):
        frost: Frost | None = None

    at_rest = Frosted(Sphere(radius=10e-3), Elastic(1e6), Indent(load=1.0))
    assert solver.solve(at_rest).normal_force == pytest.approx(1.0)
    with pytest.raises(Refused, match=f"{solver.name} cannot solve this scene: frost = Frost: .*leave it out"):
        solver.solve(replace(at_rest, frost=Frost()))


def test_every_reason_is_given_at_once():
    terms = terms_of({Sphere: unsupported("first"), Kelvin: Term, Slide: unsupported("second")}, PLAIN)
    assert [reason for term in terms for reason in term.refusals(PLAIN)] == [
        "indenter = Sphere: first",
        "motion = Slide: second",
    ]
    assert sum(isinstance(term, Unsupported) for term in terms) == 2


def test_the_last_term_is_outmost_around_a_solve():
    @dataclass(frozen=True)
    class Marking(Term):
        def around(self, solve):
            return lambda scene: f"{self.field}({solve(scene)})"

    terms = terms_of({Sphere: Marking, Kelvin: Term, Slide: Marking}, PLAIN)
    assert wrap_solve(lambda scene: "solved", terms)(PLAIN) == "motion(indenter(solved))"


@pytest.mark.parametrize("given", [{}, {"displacement": 1e-6, "force": 1.0}])
def test_shear_is_drawn_by_one_quantity(given):
    refused("exactly one of displacement", Shear, load=1.0, **given)
    refused(r"motion = Shear .* give interface", replace, PLAIN, motion=Shear(load=1.0, displacement=1e-6))
